#include "lod/ocean/radial_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace relevo::lod {

namespace {

constexpr double kMostVertices = 400e3;
constexpr double kTurn = 2 * std::numbers::pi;

double distance(const SeaView& sea, double along_m) {
    return std::hypot(along_m, std::max(std::abs(sea.eye_m) - sea.crest_m, 0.1));
}

int round_up(double count, int to) {
    return std::max(static_cast<int>(std::ceil(count / to)), 1) * to;
}

}  // namespace

double RadialShape::radius_m(int ring) const {
    return first_m + growth_m * std::pow(ring, exponent);
}

double RadialShape::spacing_m(int ring) const {
    return std::max(radius_m(ring + 1) - radius_m(ring), kTurn * radius_m(ring + 1) / sectors);
}

RadialShape radial_shape(double first_m, double last_m, double exponent, int rings, int sectors) {
    return {first_m, (last_m - first_m) / std::pow(rings - 1, exponent), exponent, rings, sectors};
}

RadialShape radial_shape_for(const SeaView& sea, const SeaSpacing& spacing, double most_vertices) {
    // a0: the fan's edges are as long as the first cells'.
    const double first_m = spacing.at(distance(sea, 0));
    const double last_m = std::max(sea.reach_m, 4 * first_m);
    RadialShape best;
    double fewest = INFINITY;
    for (double looser = 1;; looser *= 1.1) {
        for (const double k : {2.0, 3.0, 4.0, 6.0, 8.0}) {
            double growth = INFINITY;  // a1: dr/di = k a1^(1/k) (r - a0)^((k - 1)/k) is the spacing at most
            double sectors = 0;
            for (double r = 1.05 * first_m; r < 1.05 * last_m; r *= 1.05) {
                const double most = looser * spacing.at(distance(sea, r));
                growth = std::min(growth, std::pow(most / k, k) / std::pow(r - first_m, k - 1));
                sectors = std::max(sectors, kTurn * r / most);
            }
            const int rings =
                round_up(std::pow((last_m - first_m) / growth, 1 / k), RadialGrid::kBlockCells) + 1;
            const int around = round_up(sectors, RadialGrid::kBlockCells);
            const double vertices = static_cast<double>(rings) * around;
            if (vertices >= fewest) continue;
            fewest = vertices;
            best = radial_shape(first_m, last_m, k, rings, around);
        }
        if (fewest <= most_vertices) return best;
    }
}

RadialGrid::RadialGrid() {
    patches_.push_back(cells_patch(kBlockCells, kBlockCells));
    OceanPatch fan;
    fan.vertices.emplace_back(-1, 0);
    for (int j = 0; j <= kBlockCells; ++j) fan.vertices.emplace_back(0, j);
    for (int j = 0; j < kBlockCells; ++j) {
        for (const int at : {0, j + 1, j + 2}) fan.indices.push_back(static_cast<std::uint16_t>(at));
    }
    patches_.push_back(std::move(fan));
}

RadialGrid::RadialGrid(const RadialShape& shape) : RadialGrid() {
    shape_ = shape;
}

void RadialGrid::arrange(const SeaView& sea, const SeaSpacing& spacing, const WaterIn& water_in,
                         OceanPicture& picture) const {
    const RadialShape shape = shape_ ? *shape_ : radial_shape_for(sea, spacing, kMostVertices);
    picture.copies.assign(patches_.size(), {});
    picture.numbers = {{shape.first_m, shape.growth_m, shape.exponent, shape.sectors}};

    const auto water = [&](double from_m, double to_m, int sector) {
        const double half_angle = 0.5 * kTurn * kBlockCells / shape.sectors;
        const double middle = kTurn * sector / shape.sectors + half_angle;
        const glm::dvec2 right(std::cos(middle - half_angle), std::sin(middle - half_angle));
        const glm::dvec2 left(std::cos(middle + half_angle), std::sin(middle + half_angle));
        const double outer_m = to_m / std::cos(half_angle);  // around the arc
        const std::array<glm::dvec2, 4> corners{from_m * right, outer_m * right, outer_m * left,
                                                from_m * left};
        if (!patch_in_view(sea, corners)) return Water::none;
        const glm::dvec2 centre = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
        return water_in(centre,
                        std::max(glm::distance(centre, corners[0]), glm::distance(centre, corners[1])));
    };
    for (int sector = 0; sector < shape.sectors; sector += kBlockCells) {
        picture.add(kFan, water(0, shape.first_m, sector), {0, sector, 0, 0});
        for (int ring = 0; ring + 1 < shape.rings; ring += kBlockCells) {
            const Water there = water(shape.radius_m(ring), shape.radius_m(ring + kBlockCells), sector);
            picture.add(kBlock, there, {ring, sector, 0, 0});
        }
    }
}

}  // namespace relevo::lod
