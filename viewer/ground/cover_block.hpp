#pragma once

#include <array>
#include <cmath>

#include <glm/vec4.hpp>

#include "geo/frame.hpp"

namespace relevo::viewer {

/// Where the tiles of the ground's materials lie: the uniform block of shaders/cover_block.glsl (std140).
///
/// They are fixed to the grid, whose coordinates reach 2^15: a float in the fragment shader would step by
/// 0.002 posts there, which is 6 cm where posts are 30 m apart, and the pattern would swim. So a fragment
/// knows its place from the post nearest to the eye, and that post's place in each tile is computed here in
/// double.
struct CoverBlock {
    /// The ladder of tiles: a pixel takes the two rungs whose texels are about its size.
    static constexpr int kRungs = 8;
    static constexpr double kSteps = 6;      ///< a rung's tile over that of the rung below it
    static constexpr double kFinestM = 1.2;  ///< the lowest rung's tile
    static double tile_m(int rung) { return kFinestM * std::pow(kSteps, rung); }

    static constexpr double kGrainM = 0.3;   ///< the tile of the detail near the eye
    static constexpr double kMacroM = 2900;  ///< of what makes materials vary over a landscape

    /// A tile: the anchor's place in it, 0 to 1; its axis over its length, along the row and up the column.
    using Tile = glm::vec4;

    glm::vec4 anchor;  ///< its column and row; metres a column and a row
    std::array<Tile, kRungs> rungs;
    std::array<glm::vec4, kRungs> bumps;  ///< how much of a rung's slopes is shown; the tile's length
    Tile grain;
    Tile macro;
};

/// Metres a post are those in the middle of the data: in a scene of many degrees of latitude tiles are wider
/// towards the equator.
CoverBlock cover_block(const geo::GridFrame& grid, geo::LatLon eye);

}  // namespace relevo::viewer
