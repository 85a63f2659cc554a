#include "lod/ocean/radial_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace relevo::lod {

namespace {

constexpr double kFewestSectors = 96;  // a sixth of the circle a block: what is culled is not much larger
constexpr double kMostGrowth = 4;  // of a block's radius: what is culled is not much larger than what is seen
constexpr double kTurn = 2 * std::numbers::pi;

int round_up(double count, int to) {
    return std::max(static_cast<int>(std::ceil(count / to)), 1) * to;
}

}  // namespace

double RadialShape::radius_m(int ring) const {
    return first_m + growth_m * std::pow(ring, exponent);
}

RadialShape radial_shape(double first_m, double last_m, double exponent, int rings, int sectors) {
    return {first_m, (last_m - first_m) / std::pow(rings - 1, exponent), exponent, rings, sectors};
}

double RadialRings::spacing_m(std::size_t block) const {
    const double radius = blocks[block].radius_m;
    // Of the cells between this ring and the next one inwards or outwards.
    const auto across = [&](std::size_t from) {
        const double inner = blocks[from].radius_m, outer = blocks[from + 1].radius_m;
        if (blocks[from].growth == Growth::factor)
            return radius * std::log(outer / inner) / RadialGrid::kBlockCells;
        if (blocks[from].growth == Growth::even) return (outer - inner) / RadialGrid::kBlockCells;
        const double first = blocks.front().radius_m;
        const auto last = static_cast<double>((blocks.size() - 1) * RadialGrid::kBlockCells);
        const auto ring = static_cast<double>(block * RadialGrid::kBlockCells);
        const double growth_m = (blocks.back().radius_m - first) / std::pow(last, exponent);
        return growth_m *
               std::abs(std::pow(ring + (from == block ? 1 : -1), exponent) - std::pow(ring, exponent));
    };
    double spacing = kTurn * radius / sectors;
    if (block > 0) spacing = std::max(spacing, across(block - 1));
    if (block + 1 < blocks.size()) spacing = std::max(spacing, across(block));
    return spacing;
}

RadialRings rings_of(const RadialShape& shape) {
    RadialRings made{{}, shape.sectors, shape.exponent};
    for (int ring = 0; ring < shape.rings; ring += RadialGrid::kBlockCells)
        made.blocks.push_back({shape.radius_m(ring), RadialRings::Growth::power});
    return made;
}

RadialRings rings_for(const SeaView& sea, const SeaSpacing& spacing) {
    const auto allowed = [&](double radius_m) {
        return spacing.at(RadialGrid::kSlack * sea.error_distance_m(radius_m));
    };
    RadialRings made;
    double sectors = kFewestSectors;
    // The fan's edges are as long as the first cells'.
    double radius = allowed(0);
    while (radius < sea.reach_m && made.blocks.size() + 3 < OceanPicture::kMostNumbers) {
        const double cell = allowed(radius);
        sectors = std::max(sectors, kTurn * radius / cell);
        if (radius < sea.clear_m) {
            made.blocks.push_back({radius, RadialRings::Growth::even});
            radius += cell * RadialGrid::kBlockCells;
            continue;
        }
        // The factor that the block's beginning allows, or its end where the spacing grows less than the
        // radius.
        double outer =
            std::min(radius * std::pow(1 + cell / radius, RadialGrid::kBlockCells), kMostGrowth * radius);
        for (int trial = 0; trial < 3; ++trial) {
            const double growth = std::log1p(allowed(outer) / outer);
            outer = std::min(outer, radius * std::exp(growth * RadialGrid::kBlockCells));
        }
        made.blocks.push_back({radius, RadialRings::Growth::factor});
        radius = outer;
    }
    // Where an error of next to nothing took all the blocks, the last one still reaches the horizon.
    made.blocks.push_back({std::max(radius, sea.reach_m), RadialRings::Growth::factor});
    made.sectors = round_up(sectors, RadialGrid::kBlockCells);
    return made;
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
    rings_ = rings_of(shape);
}

void RadialGrid::arrange(const SeaView& sea, const SeaSpacing& spacing, const WaterIn& water_in,
                         OceanPicture& picture) const {
    const RadialRings rings = rings_ ? *rings_ : rings_for(sea, spacing);
    picture.copies.assign(patches_.size(), {});
    picture.numbers = {{rings.sectors, rings.exponent, rings.blocks.front().radius_m, 0}};
    for (std::size_t i = 0; i < rings.blocks.size(); ++i) {
        const auto growth = static_cast<float>(rings.blocks[i].growth);
        picture.numbers.emplace_back(rings.blocks[i].radius_m, rings.spacing_m(i), growth, 0);
    }

    const auto water = [&](double from_m, double to_m, int sector) {
        const double half_angle = 0.5 * kTurn * kBlockCells / rings.sectors;
        const double middle = kTurn * sector / rings.sectors + half_angle;
        const glm::dvec2 right(std::cos(middle - half_angle), std::sin(middle - half_angle));
        const glm::dvec2 left(std::cos(middle + half_angle), std::sin(middle + half_angle));
        const double around_m = to_m / std::cos(half_angle);  // the arc
        const std::array<glm::dvec2, 4> corners{from_m * right, around_m * right, around_m * left,
                                                from_m * left};
        if (!patch_in_view(sea, corners)) return Water::none;
        const glm::dvec2 centre = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
        return water_in(centre,
                        std::max(glm::distance(centre, corners[0]), glm::distance(centre, corners[1])));
    };
    for (int sector = 0; sector < rings.sectors; sector += kBlockCells) {
        const double first_m = rings.blocks.front().radius_m;
        picture.add(kFan, water(0, first_m, sector), {0, sector, 0, 0});
        for (std::size_t i = 0; i + 1 < rings.blocks.size(); ++i) {
            const double inner_m = rings.blocks[i].radius_m, outer_m = rings.blocks[i + 1].radius_m;
            picture.add(kBlock, water(inner_m, outer_m, sector), {i, sector, 0, 0});
        }
    }
}

}  // namespace relevo::lod
