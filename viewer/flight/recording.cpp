#include "viewer/flight/recording.hpp"

#include <fmt/format.h>

namespace relevo::viewer {

std::filesystem::path fresh_file(const std::filesystem::path& folder, const char* name, const char* ending) {
    std::filesystem::path file;
    for (int i = 1; file.empty() || std::filesystem::exists(file); ++i)
        file = folder / fmt::format("{}-{:04d}.{}", name, i, ending);
    return file;
}

void Recording::see(const ViewState& view, std::chrono::steady_clock::time_point now) {
    if (!recorder_.any()) begin_ = now;
    recorder_.see(view, std::chrono::duration<double>(now - begin_).count());
}

Result<std::optional<std::string>> Recording::write() const {
    if (!recorder_.any()) return std::optional<std::string>();
    const FlightPath flown = recorder_.finish();
    if (auto done = write_flight(flown, file_); !done) return done.error();
    return std::optional(
        fmt::format("flight {}: {:.1f} s, {} keys", file_.string(), flown.duration_s(), flown.keys().size()));
}

}  // namespace relevo::viewer
