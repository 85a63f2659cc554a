#include "app/machine_report.hpp"

#include <optional>

#include <fmt/format.h>

#include "lod/cache_sizes.hpp"
#include "lod/machine_figures.hpp"
#ifdef RELEVO_VIEWER
#include "viewer/gl/gl_check.hpp"
#include "viewer/gl/gl_context_egl.hpp"
#include "viewer/gl/gl_memory.hpp"
#endif

namespace relevo::app {

namespace {

std::string mib(std::uint64_t bytes) {
    return fmt::format("{:.0f} MiB", static_cast<double>(bytes) / (1 << 20));
}

/// Asks the graphics card. \return  what draws; nothing where nothing does
std::optional<std::string> ask_graphics([[maybe_unused]] lod::MachineFigures& machine) {
#ifdef RELEVO_VIEWER
    if (const auto context = viewer::OffscreenContext::create()) {
        machine.graphics_free = viewer::free_graphics_memory();
        return viewer::gl_description();
    }
#endif
    return std::nullopt;
}

std::string of_disk(const lod::MachineFigures& machine) {
    const std::string cached = fmt::format(
        "{:.0f} % of what was tried was in memory already and is not counted", 100 * machine.cached_part);
    if (!machine.read_mib_s) return fmt::format("reading speed unknown ({})", cached);
    return fmt::format("read at {:.0f} MiB/s{}", *machine.read_mib_s,
                       machine.cached_part > 0 ? " (" + cached + ")" : "");
}

}  // namespace

MachineReport machine_report(const std::filesystem::path& scene) {
    lod::MachineFigures machine = lod::find_machine(scene);
    const auto drawn_by = ask_graphics(machine);
    const lod::CacheSizes sizes = lod::cache_sizes(machine);
    MachineReport report;
    report.json = {{"memory_bytes", machine.memory_total},
                   {"memory_available_bytes", machine.memory_available},
                   {"cores", machine.cores},
                   {"gl_renderer", nullptr},
                   {"graphics_free_bytes", nullptr},
                   {"read_mib_s", nullptr},
                   {"read_cached_part", machine.cached_part},
                   {"chosen",
                    {{"memory_bytes", sizes.memory_bytes},
                     {"mesh_bytes", sizes.mesh_bytes},
                     {"texel_bytes", sizes.texel_bytes},
                     {"threads", sizes.threads},
                     {"swap_factor", sizes.swap_factor}}}};
    if (drawn_by) report.json["gl_renderer"] = *drawn_by;
    if (machine.graphics_free) report.json["graphics_free_bytes"] = *machine.graphics_free;
    if (machine.read_mib_s) report.json["read_mib_s"] = *machine.read_mib_s;

    report.text =
        fmt::format("machine      {} of {} available, {} cores, {}\n", mib(machine.memory_available),
                    mib(machine.memory_total), machine.cores, of_disk(machine));
    report.text += fmt::format("             {}{}\n", drawn_by.value_or("nothing that draws"),
                               machine.graphics_free ? ", " + mib(*machine.graphics_free) + " free" : "");
    report.text += fmt::format(
        "caches       --memory {}: {} for meshes, {} for textures; {} threads read, {:.2g} "
        "times as far as is drawn\n",
        mib(sizes.memory_bytes), mib(sizes.mesh_bytes), mib(sizes.texel_bytes), sizes.threads,
        sizes.swap_factor);
    return report;
}

}  // namespace relevo::app
