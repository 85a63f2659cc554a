#include "lod/ocean/geoclipmap.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace relevo::lod {

namespace {

/// Rings of a square, and blocks on each side of its middle one that the square inside of it takes: those
/// that need least cells a factor of distance, with spacings that double.
constexpr int kRings = 4;
constexpr int kHole = 1;
constexpr int kGrowth = (1 + 2 * kRings) / (1 + 2 * kHole);

/// Only the curved sea: one square of blocks that are two triangles each. What a block's sag of s^2 / 8R is
/// at least h away, where the horizon is at sqrt(2 R h) and D blocks across it: f / D^2 pixels. It is made a
/// quarter of the error.
GeoclipmapShape flat_shape(const SeaView& sea, const SeaSpacing& spacing) {
    const int across = static_cast<int>(std::ceil(std::sqrt(4 * spacing.focal_px() / spacing.error_px())));
    // The shader has numbers for so many; for errors that are next to nothing the sea is coarser than asked.
    constexpr int kMostRings = OceanPicture::kMostNumbers / Geoclipmap::kRingNumbers - 1;
    const int rings = std::clamp(across / 2, 1, kMostRings);
    GeoclipmapShape shape;
    const double block_m = 2 * sea.reach_m / blocks_a_side(rings);
    for (int ring = 0; ring <= rings; ++ring) shape.rings.push_back({0, ring, block_m, 1});
    return shape;
}

/// As numbers of the shader want it: where the lattice's vertex (0, 0) is from the nadir.
glm::dvec2 origin(const GeoclipmapShape::Ring& ring, const glm::dvec2& nadir) {
    return glm::round(nadir / ring.spacing_m()) * ring.spacing_m() - nadir;
}

}  // namespace

GeoclipmapShape geoclipmap_shape(int k, double block_m, const std::vector<int>& buffer_level) {
    GeoclipmapShape shape;
    for (std::size_t i = 0; i < buffer_level.size(); ++i)
        shape.rings.push_back({0, static_cast<int>(i), block_m, k >> buffer_level[i]});
    return shape;
}

GeoclipmapShape geoclipmap_shape_for(const SeaView& sea, const SeaSpacing& spacing) {
    if (spacing.flat_from(sea.error_distance_m(0))) return flat_shape(sea, spacing);
    GeoclipmapShape shape;
    // In steps of the square root of 2, so that lattices stay where they are while the eye rises or sinks by
    // less.
    const double steps = std::floor(2 * std::log2(spacing.at(sea.error_distance_m(0))));
    double block_m = Geoclipmap::kMostCells * std::exp2(0.5 * steps);
    double covered_m = 0;
    for (int square = 0; covered_m < sea.reach_m; ++square, block_m *= kGrowth) {
        for (int ring = square == 0 ? 0 : kHole + 1; ring <= kRings && covered_m < sea.reach_m; ++ring) {
            shape.rings.push_back({square, ring, block_m, 1});
            // The lattice's middle is up to half a cell from the eye.
            covered_m = (ring + 0.4) * block_m;
        }
    }
    // Inward, so that no ring is coarser than the one outside of it.
    double most_m = INFINITY;
    for (auto ring = shape.rings.rbegin(); ring != shape.rings.rend(); ++ring) {
        most_m = std::min(most_m, spacing.at(sea.error_distance_m(ring->inner_m())));
        // Two cells at least: lattices' middles are vertices.
        ring->cells = 2;
        while (ring->cells < Geoclipmap::kMostCells && ring->spacing_m() > most_m) ring->cells *= 2;
        most_m = std::min(most_m, ring->spacing_m());
    }
    return shape;
}

Geoclipmap::Geoclipmap() {
    for (int cells = 1; cells <= kMostCells; cells *= 2) patches_.push_back(cells_patch(cells, cells));
}

Geoclipmap::Geoclipmap(GeoclipmapShape shape) : Geoclipmap() {
    for (int cells = 2 * kMostCells; cells <= shape.rings.front().cells; cells *= 2)
        patches_.push_back(cells_patch(cells, cells));
    shape_ = std::move(shape);
}

void Geoclipmap::arrange(const SeaView& sea, const SeaSpacing& spacing, const WaterIn& water_in,
                         OceanPicture& picture) const {
    const GeoclipmapShape shape = shape_ ? *shape_ : geoclipmap_shape_for(sea, spacing);
    picture.copies.assign(patches_.size(), {});
    picture.numbers.clear();

    for (std::size_t i = 0; i < shape.rings.size(); ++i) {
        const GeoclipmapShape::Ring& ring = shape.rings[i];
        const GeoclipmapShape::Ring& next = shape.rings[std::min(i + 1, shape.rings.size() - 1)];
        const double cell_m = ring.spacing_m();
        const double next_m = next.spacing_m();
        // A lattice whose blocks are a cell each is the flat sea's: it may follow the eye.
        const bool fixed = ring.cells > 1;
        const glm::dvec2 at = fixed ? origin(ring, sea.nadir) : glm::dvec2(0);
        const glm::dvec2 next_at = next.cells > 1 ? origin(next, sea.nadir) : glm::dvec2(0);
        const bool changes = next_m > cell_m;
        // A lattice's middle is up to half a cell from the nadir: on the outer border all have arrived, on
        // the inner one none has left.
        const double inner_m = ring.inner_m() + 0.5 * cell_m;
        const double border_m = ring.outer_m() - 0.5 * cell_m;
        const double morph_m = std::max(0.4 * (ring.outer_m() - ring.inner_m()), 2 * next_m);
        const std::array<glm::dvec4, kRingNumbers> numbers{
            glm::dvec4(cell_m, at, next_m), glm::dvec4(next_at, next.cells > 1 ? 0 : 0.5, next_m / cell_m),
            // Where vertices move, and where they have arrived.
            changes ? glm::dvec4(std::max(border_m - morph_m, inner_m), border_m, 0, 0)
                    : glm::dvec4(1e30, 2e30, 0, 0),
            // Between these the spacing that waves are carried for grows from this ring's to the next one's:
            // vertices on a border that two rings share are given the same by both.
            glm::dvec4(inner_m, border_m, cell_m, next_m)};
        for (const glm::dvec4& four : numbers) picture.numbers.emplace_back(four);

        const auto patch = static_cast<std::size_t>(std::countr_zero(static_cast<unsigned>(ring.cells)));
        const double half = 0.5 * ring.block_m + next_m;  // vertices move less
        const auto add = [&](int x, int y) {
            const glm::dvec2 centre(x * ring.block_m, y * ring.block_m);
            const std::array<glm::dvec2, 4> corners{
                centre + at + glm::dvec2(-half, -half), centre + at + glm::dvec2(half, -half),
                centre + at + glm::dvec2(half, half), centre + at + glm::dvec2(-half, half)};
            if (!patch_in_view(sea, corners)) return;
            const glm::dvec2 corner = glm::dvec2(x, y) * static_cast<double>(ring.cells) - 0.5 * ring.cells;
            picture.add(patch, water_in(centre + at, std::sqrt(2.0) * half),
                        {glm::vec2(corner), static_cast<float>(i), 0});
        };
        for (int y = -ring.ring; y <= ring.ring; ++y) {
            const bool whole_row = std::abs(y) == ring.ring;
            for (int x = -ring.ring; x <= ring.ring; x += whole_row || ring.ring == 0 ? 1 : 2 * ring.ring)
                add(x, y);
        }
    }
}

}  // namespace relevo::lod
