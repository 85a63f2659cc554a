#include "viewer/measure/error_probe.hpp"

#include <chrono>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace relevo::viewer {

void ErrorProbe::begin(const lod::Terrain& terrain, const lod::View& view, const lod::Mesh& mesh,
                       double exaggeration, double tau_px) {
    if (busy()) return;
    tau_px_ = tau_px;
    running_ = std::async(std::launch::async, [&terrain, view, mesh, exaggeration] {
        return lod::measure_error(terrain, view, mesh, exaggeration);
    });
}

std::optional<std::string> ErrorProbe::finish() {
    if (!busy() || running_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return std::nullopt;
    const auto error = running_.get();
    if (!error) {
        last_ = {"No ground was in view."};
        return last_[0];
    }
    last_ = {fmt::format("Measured: {:.3f} px at most, RMS {:.3f}, 99 % below {:.3f}", error->max_px,
                         error->rms_px, error->p99_px),
             fmt::format("at {} posts and {} pixels, tau {:.3g} px", error->posts, error->pixels, tau_px_)};
    if (error->uncovered_posts > 0)
        last_.push_back(fmt::format("{} posts in view under no triangle", error->uncovered_posts));
    return fmt::format("{}", fmt::join(last_, ", "));
}

std::vector<std::string> ErrorProbe::report() const {
    if (busy()) return {"measuring the picture's error..."};
    return last_;
}

}  // namespace relevo::viewer
