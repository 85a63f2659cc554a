#include "lod/ocean/projected_grid.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace relevo::lod {

namespace {

/// Points p with dot(normal, p) = offset. Here and below the origin is the eye's nadir, not the sphere's
/// centre: that keeps the digits that a low eye needs.
struct Plane {
    glm::dvec3 normal;
    double offset;
};

/// The sea that is in the picture: a piece of the sphere |p|^2 + 2 R p.z = 0, bounded by planes.
///
/// A place is seen if some height h within the waves puts it inside all of the picture's side planes, dot(n,
/// p) <= n.z R (e - h) / (R + h). These are linear in 1 / (R + h), so that it can be eliminated: each plane
/// takes the bound of h that leaves most, and of each two that pull h apart the sum without h, which is an
/// upright plane, bounds the piece, too. The horizon is one more plane.
///
/// What is bounded are functions whose levels are planes. On such a piece they have their extremes at its
/// corners, and where a level touches a bounding circle or the sphere itself. All of these points are where
/// two planes meet the sphere.
class SeenSea {
  public:
    /// \param depth_m  of the plane of the horizon below the nadir
    SeenSea(const SeaView& sea, double depth_m)
        : radius_m_(sea.radius_m), tolerance_m_(1e-9 * std::abs(sea.eye_m)) {
        for (const glm::dvec3& side : sea.view.side_planes()) {
            const glm::dvec3 n = widened(side, sea);
            const glm::dvec3 normal(glm::dot(n, sea.east), glm::dot(n, sea.north), glm::dot(n, sea.up));
            const double h = normal.z < 0 ? sea.crest_m : -sea.crest_m;
            borders_.push_back({normal, normal.z * radius_m_ * (sea.eye_m - h) / (radius_m_ + h)});
        }
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t j = 0; j < 4; ++j) {
                const glm::dvec3 a = borders_[i].normal, b = borders_[j].normal;
                if (a.z > 0 && b.z < 0) borders_.push_back({{glm::dvec2(a.z * b - b.z * a), 0}, 0});
            }
        }
        borders_.push_back({{0, 0, -1}, depth_m});
        for (std::size_t i = 0; i < borders_.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) add(borders_[i], borders_[j], corners_);
        }
    }

    /// Some point for each extreme of a linear function with this gradient, if no pole is inside.
    std::vector<glm::dvec3> extremes_along(const glm::dvec3& gradient) const {
        std::vector<glm::dvec3> points = corners_;
        for (const Plane& border : borders_) {
            const glm::dvec3 normal = glm::cross(border.normal, gradient);  // through the circle's axis
            add(border, {normal, -radius_m_ * normal.z}, points);
        }
        return points;
    }

    /// Some point for each extreme of the angle about a line that goes through a point over the nadir: a
    /// level touches a circle where the line's point in the circle's plane sees it on the sphere's horizon.
    std::vector<glm::dvec3> extremes_about(double height_m, const glm::dvec3& line) const {
        std::vector<glm::dvec3> points = corners_;
        for (const Plane& border : borders_) {
            const double slope = glm::dot(border.normal, line);
            const double gap = border.offset - border.normal.z * height_m;
            const glm::dvec3 normal = glm::dvec3(0, 0, slope * (radius_m_ + height_m)) + gap * line;
            add(border, {normal, -radius_m_ * (slope * height_m + gap * line.z)}, points);
        }
        return points;
    }

  private:
    /// Turned outward about the eye, so far that at the picture's corners, too, it is the margin.
    static glm::dvec3 widened(const glm::dvec3& side, const SeaView& sea) {
        const glm::dvec3 forward = sea.view.forward();
        const glm::dvec3 along = glm::normalize(forward - side * glm::dot(side, forward));
        // Not as far as the plane across the view: the pyramid would turn over.
        const double turn = std::min(ProjectedGrid::margin(sea) * sea.view.corner_secant(), 0.5);
        const double angle = turn * glm::dot(along, forward);
        return side * std::cos(angle) - along * std::sin(angle);
    }

    bool inside(const glm::dvec3& p) const {
        const double tolerance = tolerance_m_ + 1e-9 * glm::length(p);
        return std::all_of(borders_.begin(), borders_.end(), [&](const Plane& border) {
            return glm::dot(border.normal, p) <= border.offset + tolerance;
        });
    }

    /// Adds the points of the piece on both planes.
    void add(const Plane& a, const Plane& b, std::vector<glm::dvec3>& points) const {
        const double b_length = glm::length(b.normal);
        if (b_length == 0) return;
        const glm::dvec3 n = b.normal / b_length;
        const glm::dvec3 along = glm::cross(a.normal, n);
        const double along2 = glm::dot(along, along);
        if (along2 < 1e-30) return;  // parallel
        const glm::dvec3 foot =
            (a.offset * glm::cross(n, along) + b.offset / b_length * glm::cross(along, a.normal)) / along2;
        const double half_b = radius_m_ * along.z;
        const double c = glm::dot(foot, foot) + 2 * radius_m_ * foot.z;
        const double discriminant = half_b * half_b - along2 * c;
        if (discriminant < 0) return;
        const double q = -half_b - std::copysign(std::sqrt(discriminant), half_b);
        for (const double s : {q / along2, q != 0 ? c / q : 0.0}) {
            const glm::dvec3 p = foot + s * along;
            if (inside(p)) points.push_back(p);
        }
    }

    double radius_m_;
    double tolerance_m_;
    std::vector<Plane> borders_;
    std::vector<glm::dvec3> corners_;
};

/// Arc to where a ray meets the sphere, `reach_m` at most: see place().
double arc_m(double radius_m, double eye_m, double sin2_dip, double reach_m, const glm::dvec3& d) {
    const double toward = eye_m < 0 ? d.z : -d.z;
    const double discriminant = toward * toward - sin2_dip * glm::dot(d, d);
    if (toward <= 0 || discriminant < 0) return reach_m;
    const double tau = std::abs(sin2_dip) / (toward + std::sqrt(discriminant));
    return std::min(radius_m * std::atan2(tau * std::hypot(d.x, d.y), 1 + tau * d.z), reach_m);
}

double sin2_dip(double radius_m, double height_m) {
    const double k = radius_m + height_m;
    return height_m * (radius_m + k) / (k * k);
}

/// Offset from the projector of the place that it aims at; a blend of Johanson's two methods, by how steeply
/// the camera looks. Both lie in its azimuth.
glm::dvec3 aim(const SeaView& sea, const Projection& projector, glm::dvec3 ahead) {
    // A camera that looks away from the sea sees it, if at all, as one that looks as steeply towards it.
    ahead.z = projector.eye_m < 0 ? std::abs(ahead.z) : -std::abs(ahead.z);
    const double level = std::hypot(ahead.x, ahead.y);

    const double looked_at =
        arc_m(sea.radius_m, sea.eye_m, sin2_dip(sea.radius_m, sea.eye_m), sea.reach_m, ahead);
    constexpr double kAhead = 4;  // heights; at the horizon the projector then looks down by 14 degrees
    const double below_point_ahead = kAhead * std::abs(projector.eye_m) * level;
    const double blend = glm::mix(below_point_ahead, looked_at, std::abs(ahead.z));
    const double angle = std::min(blend, 0.9 * projector.reach_m) / sea.radius_m;  // never at the horizon

    const glm::dvec2 azimuth = level > 0 ? glm::dvec2(ahead) / level : glm::dvec2(0);
    const double half = std::sin(0.5 * angle);
    return {azimuth * (sea.radius_m * std::sin(angle)), -2 * sea.radius_m * half * half - projector.eye_m};
}

/// Is all of the sea that is seen in front of the projector?
bool in_front(const SeenSea& seen, const glm::dvec3& projector, const glm::dvec3& axis) {
    constexpr double kCosine = 0.05;
    const std::vector<glm::dvec3> points = seen.extremes_along(axis);
    return std::all_of(points.begin(), points.end(), [&](const glm::dvec3& p) {
        return glm::dot(axis, glm::normalize(p - projector)) > kCosine;
    });
}

/// The camera's right, turned with its forward direction into the axis: then the picture's sides are nearly
/// the grid's.
glm::dvec3 across(const glm::dvec3& axis, glm::dvec3 forward, glm::dvec3 right) {
    if (glm::dot(axis, forward) < -0.5) {  // looks away: its mirror image
        forward.z = -forward.z;
        right.z = -right.z;
    }
    const glm::dvec3 turned =
        right - (forward + axis) * (glm::dot(axis, right) / (1 + glm::dot(axis, forward)));
    return glm::normalize(turned - axis * glm::dot(axis, turned));
}

struct Range {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;

    void add(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    /// So that rounding leaves nothing out, and one point is not an empty range.
    void widen() {
        const double margin = 1e-9 * (high - low) + 1e-12;
        low -= margin;
        high += margin;
    }
};

}  // namespace

glm::dvec2 place(const Projection& p, double u, double v) {
    const glm::dvec3 d = p.d0 + u * p.du + v * p.dv;
    const double level = std::hypot(d.x, d.y);
    if (level == 0) return {0, 0};
    return glm::dvec2(d) * (arc_m(p.radius_m, p.eye_m, p.sin2_dip, p.reach_m, d) / level);
}

double ProjectedGrid::margin(const SeaView& sea) {
    return 0.006 + 0.03 * sea.reach_m / sea.radius_m;
}

ProjectedGrid::ProjectedGrid(int columns, int rows) : columns_(columns), rows_(rows) {
    assert(columns >= 2 && rows >= 2 && columns * rows <= 65536);
}

OceanPatch ProjectedGrid::patch() const {
    OceanPatch patch;
    for (int row = 0; row < rows_; ++row) {
        for (int column = 0; column < columns_; ++column) patch.vertices.emplace_back(column, row);
    }
    const auto index = [&](int column, int row) {
        return static_cast<std::uint16_t>(row * columns_ + column);
    };
    for (int row = 0; row + 1 < rows_; ++row) {
        for (int column = 0; column + 1 < columns_; ++column) {
            const std::uint16_t a = index(column, row), b = index(column + 1, row);
            const std::uint16_t c = index(column + 1, row + 1), d = index(column, row + 1);
            patch.indices.insert(patch.indices.end(), {a, b, c, a, c, d});
        }
    }
    return patch;
}

std::optional<Projection> ProjectedGrid::project(const SeaView& sea) const {
    constexpr double kClearance = 0.1;  // metres, for an eye in a calm sea
    const double radius = sea.radius_m;
    const double reach = std::min(sea.reach_m / radius, 1.5);  // an eye beyond 90 000 km may see farther
    const double height = radius * (1 / std::cos(reach) - 1) + kClearance;

    Projection projection{};
    // Under water the sea curves down to the level of the eye: from twice as deep all of it is overhead.
    projection.eye_m = sea.eye_m < 0 ? -2 * height : height;
    projection.radius_m = radius;
    projection.sin2_dip = sin2_dip(radius, projection.eye_m);
    projection.reach_m = radius * std::acos(radius / (radius + height));

    const auto local = [&](const glm::dvec3& v) {
        return glm::dvec3(glm::dot(v, sea.east), glm::dot(v, sea.north), glm::dot(v, sea.up));
    };
    const glm::dvec3 forward = local(sea.view.forward());
    const glm::dvec3 projector(0, 0, projection.eye_m);
    const SeenSea seen(sea, radius * height / (radius + height));
    glm::dvec3 axis = glm::normalize(aim(sea, projection, forward));
    // Straight down all within the horizon is in front (under water, straight up).
    if (!in_front(seen, projector, axis)) axis = {0, 0, projector.z < 0 ? 1 : -1};
    const glm::dvec3 x = across(axis, forward, local(sea.view.right()));
    const glm::dvec3 y = glm::cross(x, axis);

    const auto range_of = [&](const glm::dvec3& along, const glm::dvec3& other) {
        Range range;
        for (const glm::dvec3& p : seen.extremes_about(projection.eye_m, other)) {
            range.add(glm::dot(along, p - projector) / glm::dot(axis, p - projector));
        }
        return range;
    };
    Range us = range_of(x, y), vs = range_of(y, x);
    if (us.low > us.high || vs.low > vs.high) return std::nullopt;
    us.widen();
    vs.widen();
    projection.d0 = axis + us.low * x + vs.low * y;
    projection.du = (us.high - us.low) * x;
    projection.dv = (vs.high - vs.low) * y;
    projection.cell = {(us.high - us.low) / (columns_ - 1), (vs.high - vs.low) / (rows_ - 1)};
    return projection;
}

}  // namespace relevo::lod
