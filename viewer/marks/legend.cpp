#include "viewer/marks/legend.hpp"

#include <cmath>

#include <fmt/format.h>

#include "viewer/draw_settings.hpp"
#include "viewer/overlay/ground_scale.hpp"

namespace relevo::viewer {

namespace {

std::vector<Legend::Mark> height_marks(const HeightSpan& span) {
    constexpr double kIntervals = 6;
    std::vector<Legend::Mark> marks;
    const double range = span.high - span.low;
    if (!(range > 0)) return {{0.5, fmt::format("{:.6g}", span.low)}};
    const double step = round_step(range / kIntervals);
    for (double i = std::ceil(span.low / step); i * step <= span.high; ++i)
        marks.push_back({(i * step - span.low) / range, fmt::format("{:.6g}", i * step + 0.0)});
    return marks;
}

}  // namespace

std::optional<Legend> legend(Layer layer, const HeightSpan& span, bool has_sea, const HeightRamp* ramp) {
    Legend made{.colours = colour_ramp(layer, span)};
    switch (layer) {
        case Layer::hypsometric: {
            made.title = "height";
            made.unit = "m";
            made.marks = height_marks(span);
            if (ramp != nullptr) made.colours = colours_of(*ramp, span);
            if (!has_sea || ramp != nullptr) return made;
            const auto sea = sea_ramp(span);
            const double below = span.high > span.low ? (0 - span.low) / (span.high - span.low) : 0;
            for (std::size_t i = 0; i < sea.size(); ++i) {
                if (static_cast<double>(i) < below * static_cast<double>(sea.size() - 1))
                    made.colours[i] = sea[i];
            }
            return made;
        }
        case Layer::slope:
            made.title = "slope";
            made.unit = "\u00b0";
            for (const int degrees : {0, 15, 30, 45, 60})
                made.marks.push_back({degrees / 60.0, std::to_string(degrees)});
            return made;
        case Layer::aspect:
            made.title = "aspect";
            made.cyclic = true;
            for (int i = 0; i < 9; ++i) {
                constexpr std::array<const char*, 9> kNames{"N", "NE", "E", "SE", "S", "SW", "W", "NW", "N"};
                made.marks.push_back({i / 8.0, kNames[static_cast<std::size_t>(i)]});
            }
            return made;
        default:
            return std::nullopt;
    }
}

std::optional<Legend> legend(const ViewState& view, const GroundFacts& facts) {
    const bool has_water = draw_settings(view).ocean.kind != OceanKind::off;
    return legend(view.layer, {facts.lowest_m, facts.highest_m, facts.lowest_land_m},
                  facts.has_sea && !has_water, view.ramp.get());
}

}  // namespace relevo::viewer
