#include "lod/measure/line.hpp"

#include <cmath>

#include "lod/measure/ground_legs.hpp"

namespace relevo::lod {
namespace {

/// Integral of sqrt(k^2 + p^2) over a distance in which p goes evenly from p0 to p1.
double arc_length(double distance, double k, double p0, double p1) {
    const auto element = [k](double p) { return std::hypot(k, p); };
    if (std::abs(p1 - p0) < 1e-4 * k)  // Simpson; the closed form would lose digits
        return distance * (element(p0) + 4 * element(0.5 * (p0 + p1)) + element(p1)) / 6;
    const auto primitive = [&](double p) { return 0.5 * (p * element(p) + k * k * std::asinh(p / k)); };
    return distance * (primitive(p1) - primitive(p0)) / (p1 - p0);
}

/// Length over the ground from one distance to another within a leg.
double ground_length(const GridPath& path, const GroundLeg& leg, const Scene& scene, double begin,
                     double end) {
    // In steps so short that a geodesic is straight in the grid and N is even; and so low that it is no
    // matter where in the step the surface is steep: 10 m of height are 1.6e-6 of k.
    constexpr double kLongestStep = 5000;
    constexpr double kHighestStep = 10;
    const auto undulation = [&](geo::LatLon place) {
        return scene.geoid() == nullptr ? 0 : scene.geoid()->undulation(place).m;
    };
    const double rise = leg.height(path, end) - leg.height(path, begin);
    const int steps =
        static_cast<int>(std::ceil(std::max((end - begin) / kLongestStep, std::abs(rise) / kHighestStep)));
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double s0 = begin + (end - begin) * i / steps;
        const double s1 = begin + (end - begin) * (i + 1) / steps;
        const auto point0 = path.at(s0, leg.turn);
        const auto point1 = path.at(s1, leg.turn);
        const double N0 = undulation(point0.place);
        const double N1 = undulation(point1.place);
        const double h0 = leg.cell->height(point0.grid) + N0;
        const double h1 = leg.cell->height(point1.grid) + N1;
        const double p0 = leg.slope(path, s0) + (N1 - N0) / (s1 - s0);
        const double p1 = leg.slope(path, s1) + (N1 - N0) / (s1 - s0);
        const double mean_h = 0.5 * (h0 + h1) + (p0 - p1) * (s1 - s0) / 12;  // of a quadratic
        const double k = 1 + mean_h * 0.5 * (point0.curvature_per_m + point1.curvature_per_m);
        sum += arc_length(s1 - s0, k, p0, p1);
    }
    return sum;
}

}  // namespace

Result<LineMeasurement> measure_line(HeightSampler& sampler, geo::LatLon from, geo::LatLon to) {
    const GridPath path(sampler.scene().info().frame, from, to);
    double surface = 0;
    double climb = 0;
    double descent = 0;
    bool whole = true;
    const auto visit = [&](const GroundLeg& leg) -> Result<bool> {
        whole = leg.cell.has_value();
        if (!whole) return false;
        const auto add = [&](double begin, double end) {
            if (end <= begin) return;
            surface += ground_length(path, leg, sampler.scene(), begin, end);
            const double rise = leg.height(path, end) - leg.height(path, begin);
            (rise > 0 ? climb : descent) += std::abs(rise);
        };
        const double middle = leg.extremum(path).value_or(leg.end);
        add(leg.begin, middle);
        add(middle, leg.end);
        return true;
    };
    if (const auto done = for_each_leg(sampler, path, visit); !done) return done.error();

    LineMeasurement line;
    line.geodesic = geo::geodesic(from, to);
    if (whole) {
        line.surface_m = surface;
        line.climb_m = climb;
        line.descent_m = descent;
    }
    return line;
}

}  // namespace relevo::lod
