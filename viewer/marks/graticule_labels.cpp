#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "lod/soar/pick.hpp"
#include "viewer/marks/map_labels.hpp"

namespace relevo::viewer {

namespace {

constexpr double kStep = 32;  // pixels between rays
constexpr double kApart = 60;
constexpr int kTries = 4;

std::string zone_name(geo::UtmZone zone) {
    return zone.number == 0 ? "UPS" : fmt::format("{}", zone.number);
}

class Edge {
  public:
    Edge(const lod::Terrain& terrain, const lod::View& view, const Graticule& graticule, double exaggeration)
        : terrain_(terrain), view_(view), graticule_(graticule), exaggeration_(exaggeration) {}

    struct Place {
        glm::dvec2 lines;
        geo::UtmZone zone;
    };
    std::optional<Place> place(const glm::dvec2& pixel) const {
        const auto hit = lod::pick(terrain_, view_.eye(), view_.ray(pixel), exaggeration_);
        if (!hit) return std::nullopt;
        const geo::LatLon at = terrain_.frame().lat_lon(hit->place);
        return Place{graticule_.lines(at), graticule_.zone_at(at)};
    }

    /// Between two places of different zones, where these meet: to 2 pixels, or nothing.
    std::optional<glm::dvec2> border(glm::dvec2 a, int zone_at_a, glm::dvec2 b) const {
        while (glm::distance(a, b) > 2) {
            const glm::dvec2 middle = 0.5 * (a + b);
            const auto there = place(middle);
            if (!there) return std::nullopt;
            (there->zone.number == zone_at_a ? a : b) = middle;
        }
        return 0.5 * (a + b);
    }

    /// Where between two places of the edge it meets a line, by false position: to 2 pixels, or nothing.
    std::optional<glm::dvec2> meets(int axis, double line, glm::dvec2 a, double at_a, glm::dvec2 b,
                                    double at_b) const {
        for (int i = 0; i < kTries; ++i) {
            const glm::dvec2 at = a + std::clamp((line - at_a) / (at_b - at_a), 0.02, 0.98) * (b - a);
            const auto there = place(at);
            if (!there) return std::nullopt;
            const double value = there->lines[axis];
            const double a_pixel = std::abs(at_b - at_a) / std::max(glm::distance(a, b), 1e-6);
            if (std::abs(value - line) <= 0.5 * a_pixel) return at;
            const bool before = (value < line) == (at_a < line);
            (before ? a : b) = at;
            (before ? at_a : at_b) = value;
            if (at_a == at_b) return std::nullopt;
        }
        return glm::distance(a, b) < 4 ? std::optional(0.5 * (a + b)) : std::nullopt;
    }

  private:
    const lod::Terrain& terrain_;
    const lod::View& view_;
    const Graticule& graticule_;
    double exaggeration_;
};

}  // namespace

std::vector<MapLabel> graticule_labels(const lod::Terrain& terrain, const lod::View& view,
                                       const Graticule& graticule, const LabelOptions& options) {
    std::vector<MapLabel> labels;
    const Edge edge(terrain, view, graticule, options.exaggeration);
    const double width = view.camera().width;
    const double height = view.camera().height;
    std::vector<MapLabel> found;
    const auto add = [&](const glm::dvec2& pixel, std::string text) {
        found.push_back({pixel, 0, std::move(text)});
    };
    const auto walk = [&](const glm::dvec2& from, const glm::dvec2& to) {
        const int steps = std::max(static_cast<int>(glm::distance(from, to) / kStep), 1);
        std::optional<Edge::Place> last;
        glm::dvec2 last_at = from;
        for (int i = 0; i <= steps; ++i) {
            const glm::dvec2 at = from + (to - from) * (static_cast<double>(i) / steps);
            const auto here = edge.place(at);
            const bool same_zone = last && here && last->zone.number == here->zone.number;
            if (last && here && !same_zone) {
                if (const auto met = edge.border(last_at, last->zone.number, at))
                    labels.push_back(
                        {*met, 0, fmt::format("{} | {}", zone_name(last->zone), zone_name(here->zone))});
            }
            for (int axis = 0; same_zone && axis < 2; ++axis) {
                const double a = last->lines[axis];
                const double b = here->lines[axis];
                const double line = std::ceil(std::min(a, b));
                // More than one line a step is too dense for letters, or a jump past a ridge or the
                // antimeridian.
                if (a == b || line > std::max(a, b) || std::abs(a - b) > 1) continue;
                const auto met = edge.meets(axis, line, last_at, a, at, b);
                if (met) add(*met, graticule.text(axis, line, here->zone));
            }
            last = here;
            last_at = at;
        }
    };
    constexpr double kLow = 16;   // pixels inside the lower edge: half a line of letters and some
    constexpr double kLeft = 44;  // inside the left one: half a label
    if (width < 4 * kLeft || height < 4 * kLow) return labels;
    walk({kLeft, height - kLow}, {width - kLeft, height - kLow});
    walk({kLeft, height - 4 * kLow}, {kLeft, kLow});
    // Where zones meet says more than a line's number.
    for (MapLabel& label : found) {
        const auto is_far = [&](const MapLabel& other) {
            return glm::distance(other.pixel, label.pixel) >= kApart;
        };
        if (std::all_of(labels.begin(), labels.end(), is_far) &&
            labels.size() < static_cast<std::size_t>(std::max(options.most, 0)))
            labels.push_back(std::move(label));
    }
    return labels;
}

}  // namespace relevo::viewer
