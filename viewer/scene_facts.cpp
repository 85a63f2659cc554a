#include "viewer/scene_facts.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace relevo::viewer {

std::vector<std::string> scene_facts(const lod::SceneInfo& info) {
    const geo::GridFrame& frame = info.frame;
    std::vector<std::string> lines{
        fmt::format("{} x {} posts, every {:.6g} x {:.6g} {}s", frame.columns, frame.rows, frame.step_x,
                    frame.step_y, lod::step_unit(frame.kind)),
        fmt::format("heights {:.2f} to {:.2f} m above {}{}", info.height_min_m, info.height_max_m,
                    info.vertical.name, info.vertical.assumed ? " (assumed: the source does not say)" : "")};
    const std::uint64_t all = info.valid_posts + info.void_posts;
    const auto share = [&](std::uint64_t posts) {
        return 100 * static_cast<double>(posts) / static_cast<double>(std::max<std::uint64_t>(all, 1));
    };
    if (info.void_posts > 0)
        lines.push_back(fmt::format("voids: {} posts ({:.3g} %)", info.void_posts, share(info.void_posts)));
    if (info.sea_posts > 0) lines.push_back(fmt::format("sea: {:.3g} % of the posts", share(info.sea_posts)));
    if (info.filled_posts > 0)
        lines.push_back(fmt::format("interpolated over voids: {} posts", info.filled_posts));
    if (info.modelled_posts > 0)
        lines.push_back(fmt::format("made-up sea bed: {} posts", info.modelled_posts));
    lines.push_back(info.resampling_method == "none"
                        ? "not resampled: the sources' own posts"
                        : fmt::format("resampled ({}): {:.3g} m RMS, {:.3g} m at most off the sources' posts",
                                      info.resampling_method, info.resampling.rms_m, info.resampling.max_m));
    for (const lod::SourceInfo& source : info.sources)
        lines.push_back(fmt::format("source: {}, {}", source.name, source.crs));
    lines.emplace_back("how accurate the sources' heights are: not stated by them");
    return lines;
}

}  // namespace relevo::viewer
