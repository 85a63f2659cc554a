#include "lod/measure/plane.hpp"

#include <charconv>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "lod/measure/profile.hpp"

namespace relevo::lod {
namespace {

Result<double> lowest_on_sides(HeightSampler& sampler, std::span<const geo::LatLon> polygon) {
    std::vector<geo::LatLon> sides(polygon.begin(), polygon.end());
    sides.push_back(polygon.front());
    const auto profile = measure_profile(sampler, sides);
    if (!profile) return profile.error();
    if (!profile->lowest)
        return Error{ErrorKind::input,
                     "no height is known on the polygon's sides, so there is no plane of its border: choose "
                     "lowest, mean or a height"};
    return profile->lowest->value;
}

}  // namespace

std::string to_string(const Plane& plane) {
    switch (plane.kind) {
        case Plane::Kind::border:
            return "border";
        case Plane::Kind::mean:
            return "mean";
        case Plane::Kind::given:
            return fmt::format("{}", plane.H_m);
        case Plane::Kind::lowest:
            break;
    }
    return "lowest";
}

Result<Plane> parse_plane(std::string_view text) {
    for (const auto kind : {Plane::Kind::lowest, Plane::Kind::border, Plane::Kind::mean}) {
        if (text == to_string(Plane{kind, 0})) return Plane{kind, 0};
    }
    Plane plane{Plane::Kind::given, 0};
    const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), plane.H_m);
    if (failed != std::errc() || end != text.data() + text.size() || !std::isfinite(plane.H_m))
        return Error{ErrorKind::usage,
                     fmt::format("a plane is lowest, border, mean or metres, not \"{}\"", text)};
    return plane;
}

Result<AreaMeasurement> measure_area(HeightSampler& sampler, std::span<const geo::LatLon> polygon,
                                     const Plane& plane, const std::function<bool(double)>& progress) {
    const Scene& scene = sampler.scene();
    switch (plane.kind) {
        case Plane::Kind::lowest:
            return measure_area(scene, polygon, {{}, progress});
        case Plane::Kind::given:
            return measure_area(scene, polygon, {plane.H_m, progress});
        case Plane::Kind::border: {
            const auto lowest = lowest_on_sides(sampler, polygon);
            if (!lowest) return lowest.error();
            return measure_area(scene, polygon, {*lowest, progress});
        }
        case Plane::Kind::mean:
            break;
    }
    const auto half = [&](double before) -> std::function<bool(double)> {
        if (!progress) return {};
        return [&progress, before](double done) { return progress(before + done / 2); };
    };
    auto first = measure_area(scene, polygon, {{}, half(0)});
    if (!first || !first->mean_H_m) return first;
    return measure_area(scene, polygon, {first->mean_H_m, half(0.5)});
}

}  // namespace relevo::lod
