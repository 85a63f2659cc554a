#include "lod/level_bounds.hpp"

#include <algorithm>
#include <cmath>

#include "geo/ellipsoid.hpp"
#include "lod/soar/diamond.hpp"

namespace relevo::lod {

namespace {

/// Largest first and second derivatives of the undulation along any direction, per post and per post^2.
struct UndulationDerivatives {
    double first_m = 0;
    double second_m = 0;
};

UndulationDerivatives undulation_derivatives(const UndulationGrid& undulations) {
    const Raster<float>& nodes = undulations.nodes();
    const double spacing = 1 << undulations.shift();
    double slope = 0;
    double bend = 0;
    double twist = 0;
    for (int row = 1; row + 1 < nodes.rows(); ++row) {
        for (int column = 1; column + 1 < nodes.columns(); ++column) {
            const auto N = [&](int dx, int dy) {
                return static_cast<double>(nodes.at(column + dx, row + dy));
            };
            slope = std::max({slope, std::abs(N(1, 0) - N(0, 0)), std::abs(N(0, 1) - N(0, 0)),
                              std::abs(N(0, 0) - N(-1, 0)), std::abs(N(0, 0) - N(0, -1))});
            bend = std::max({bend, std::abs(N(1, 0) - 2 * N(0, 0) + N(-1, 0)),
                             std::abs(N(0, 1) - 2 * N(0, 0) + N(0, -1))});
            twist = std::max(twist, std::abs(N(1, 1) - N(1, 0) - N(0, 1) + N(0, 0)));
        }
    }
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
    const UndulationDerivatives geoid = undulation_derivatives(undulations);
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
