#include "viewer/ground/cover_block.hpp"

#include <algorithm>

#include <glm/common.hpp>
#include <glm/vec2.hpp>

namespace relevo::viewer {

namespace {

/// Turned tiles of different sizes do not lie on each other.
CoverBlock::Tile tile_at(const glm::dvec2& place_m, double tile_m, double turned) {
    const glm::dvec2 axis(std::cos(turned), std::sin(turned));
    const glm::dvec2 in_tile(axis.x * place_m.x + axis.y * place_m.y,
                             axis.x * place_m.y - axis.y * place_m.x);
    return glm::dvec4(glm::fract(in_tile / tile_m), axis / tile_m);
}

/// Slopes of the materials go on where those of the data end: its posts tell of what is longer than two of
/// them, and most that a tile shows is an eighth of it.
double bump(double tile_m, double post_m) {
    const double t = std::clamp((tile_m / 8 - 0.5 * post_m) / (1.5 * post_m), 0.0, 1.0);
    return 1 - t * t * (3 - 2 * t);
}

}  // namespace

CoverBlock cover_block(const geo::GridFrame& grid, geo::LatLon eye) {
    const auto metres = grid.spacing({0.5 * (grid.columns - 1), 0.5 * (grid.rows - 1)});
    const geo::GridPosition at = grid.grid_position(eye);
    // No farther than the data: all that is drawn is there.
    const double column = std::round(std::clamp(at.column, 0.0, grid.columns - 1.0));
    const double row = std::round(std::clamp(at.row, 0.0, grid.rows - 1.0));
    const glm::dvec2 place(column * metres.column_m, -row * metres.row_m);

    CoverBlock block{};
    block.anchor = glm::dvec4(column, row, metres.column_m, metres.row_m);
    for (int rung = 0; rung < CoverBlock::kRungs; ++rung) {
        const double tile_m = CoverBlock::tile_m(rung);
        const auto i = static_cast<std::size_t>(rung);
        block.rungs[i] = tile_at(place, tile_m, 2.4 * rung);
        block.bumps[i] = glm::dvec4(bump(tile_m, std::min(metres.column_m, metres.row_m)), tile_m, 0, 0);
    }
    block.grain = tile_at(place, CoverBlock::kGrainM, 1.0);
    block.macro = tile_at(place, CoverBlock::kMacroM, 0.5);
    return block;
}

}  // namespace relevo::viewer
