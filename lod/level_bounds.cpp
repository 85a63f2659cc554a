#include "lod/level_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include "geo/ellipsoid.hpp"
#include "lod/soar/diamond.hpp"

namespace relevo::lod {

namespace {

/// Largest first and second derivatives of the undulation along any direction, per post and per post^2.
struct UndulationDerivatives {
    double first_m = 0;
    double second_m = 0;
};

UndulationDerivatives undulation_derivatives(const UndulationGrid& undulations, int levels) {
    const int side = (1 << (levels - undulations.shift())) + 1;
    const double spacing = 1 << undulations.shift();
    const auto row_of_nodes = [&](int row) {
        std::vector<double> N(static_cast<std::size_t>(side));
        for (int column = 0; column < side; ++column)
            N[static_cast<std::size_t>(column)] =
                undulations.at(geo::GridPosition{column * spacing, row * spacing});
        return N;
    };
    struct Largest {
        double slope = 0;
        double bend = 0;
        double twist = 0;
    };
    const auto of_rows = [&](const tbb::blocked_range<int>& rows, Largest largest) {
        auto& [slope, bend, twist] = largest;
        std::vector<double> above = row_of_nodes(rows.begin() - 1);
        std::vector<double> here = row_of_nodes(rows.begin());
        for (int row = rows.begin(); row < rows.end(); ++row) {
            std::vector<double> below = row_of_nodes(row + 1);
            for (std::size_t i = 1; i + 1 < here.size(); ++i) {
                slope = std::max({slope, std::abs(here[i + 1] - here[i]), std::abs(below[i] - here[i]),
                                  std::abs(here[i] - here[i - 1]), std::abs(here[i] - above[i])});
                bend = std::max({bend, std::abs(here[i + 1] - 2 * here[i] + here[i - 1]),
                                 std::abs(below[i] - 2 * here[i] + above[i])});
                twist = std::max(twist, std::abs(below[i + 1] - here[i + 1] - below[i] + here[i]));
            }
            above = std::exchange(here, std::move(below));
        }
        return largest;
    };
    const auto [slope, bend, twist] = tbb::parallel_reduce(
        tbb::blocked_range<int>(1, std::max(side - 1, 1)), Largest{}, of_rows,
        [](const Largest& a, const Largest& b) {
            return Largest{std::max(a.slope, b.slope), std::max(a.bend, b.bend), std::max(a.twist, b.twist)};
        });
    // Differences between nodes are means of the derivatives between them: half as much again covers their
    // peaks.
    constexpr double kPeak = 1.5;
    return {kPeak * std::sqrt(2.0) * slope / spacing, kPeak * (bend + twist) / (spacing * spacing)};
}

/// Largest first and second derivatives of a place on the ellipsoid along any direction, per post and per
/// post^2.
struct EllipsoidDerivatives {
    double first_m = 0;
    double second_m = 0;
};

EllipsoidDerivatives geographic_derivatives(const geo::GridFrame& frame) {
    using namespace geo::wgs84;
    const double south = frame.lat_lon({0, static_cast<double>(frame.padded_side() - 1)}).lat.radians();
    const double north = frame.lat_lon({0, 0}).lat.radians();
    const double cos_max =
        south <= 0 && north >= 0 ? 1 : std::max(std::abs(std::cos(south)), std::abs(std::cos(north)));
    const double x = geo::Degrees{frame.step_x}.radians();
    const double y = geo::Degrees{frame.step_y}.radians();

    // No radius of curvature of the ellipsoid exceeds that at the pole, a^2 / b: derivatives by longitude are
    // at most it times cos(lat), those by latitude at most it, and its own change with latitude adds
    // under 1.1 % to the second.
    const double polar_radius = kSemiMajor * kSemiMajor / kSemiMinor;
    const double xx = polar_radius * cos_max * x * x;
    const double yy = 1.011 * polar_radius * y * y;
    const double xy = polar_radius * x * y;
    const double bend = 0.5 * (xx + yy) + std::hypot(0.5 * (xx - yy), xy);
    const double stretch = std::max(polar_radius * cos_max * x, polar_radius * y);
    return {1.001 * stretch, 1.001 * bend};
}

/// UPS is conformal: a metre of the plane is 1 / k on the ground, and k is 0.994 (1 + t^2), t = tan of half
/// the angle from the pole (on a sphere of radius R). Of the second derivative the sphere's curvature is the
/// normal part, 1 / (k^2 R); the tangential part is the gradient of ln k, t / (k^2 R). Together that is (1 +
/// t^2)^(-3/2) / (0.994^2 R): largest at the pole. 1 %: the ellipsoid, whose curvature nowhere exceeds the
/// meridian's at the equator.
EllipsoidDerivatives polar_derivatives(const geo::GridFrame& frame) {
    using namespace geo::wgs84;
    constexpr double kPoleScale = 0.994;
    constexpr double kCurvature = kSemiMajor / (kSemiMinor * kSemiMinor);
    const double step = std::max(frame.step_x, frame.step_y) / kPoleScale;
    return {step, 1.01 * step * step * kCurvature};
}

}  // namespace

std::vector<LevelBound> level_bounds(const geo::GridFrame& frame, const UndulationGrid& undulations) {
    const int levels = frame.levels();
    const EllipsoidDerivatives ellipsoid =
        frame.is_polar() ? polar_derivatives(frame) : geographic_derivatives(frame);
    const UndulationDerivatives geoid = undulation_derivatives(undulations, levels);
    const double second = ellipsoid.second_m + geoid.second_m;
    const double first = ellipsoid.first_m + geoid.first_m;

    std::vector<LevelBound> bounds(static_cast<std::size_t>(2 * levels));
    double finer_radius = 0;
    for (int level = 2 * levels - 1; level >= 0; --level) {
        const double s = half_size(levels, level);
        const double reach = level % 2 == 0 ? s * std::sqrt(2.0) : s;  // to the diamond's corners, posts
        const double to_child = level % 2 == 0 ? s : s / std::sqrt(2.0);
        LevelBound& bound = bounds[static_cast<std::size_t>(level)];
        // Linear interpolation over a triangle errs by at most half its circumradius squared times the
        // largest second derivative (Waldron 1998, "The error in linear interpolation at the vertices of a
        // simplex").
        bound.sag_m = 0.5 * reach * reach * second + 2 * UndulationGrid::kMaxErrorM;
        bound.radius_m = std::max(reach * first, to_child * first + finer_radius);
        finer_radius = bound.radius_m;
    }
    return bounds;
}

}  // namespace relevo::lod
