#pragma once

#include "geo/result.hpp"
#include "lod/terrain.hpp"
#include "viewer/gl_object.hpp"

namespace relevo::viewer {

/// What the terrain's fragments read of the full data, whatever the mesh is: for each post the normal of the
/// surface with its true proportions, the height, and whether there is one; for each cell whether it may be
/// drawn.
///
/// Normals are central differences over the posts' distances on the ground, one-sided beside voids and
/// borders. They are in the grid's own directions, along the row and up the column (in a geographic grid east
/// and north): around a pole north turns, and cannot be filtered. All four channels are 16-bit and multiplied
/// by the validity (0 or 1), so that mip levels and filters average valid posts alone. Eleven bytes a post
/// with mip levels, and one and a third more where there is sea.
struct TerrainTextures {
    GlTexture
        posts;  ///< along row and up column of the unit normal; H from -1 (lowest) to 1 (highest); validity
    GlTexture sea;        ///< 8-bit: 255 at posts of the class sea, else 0; absent where no post is
    GlTexture cells;      ///< 8-bit: 0 where one of a cell's corners is void; absent where no post is
    double lowest_m = 0;  ///< H of the data; both 0 where all is void
    double highest_m = 0;
    double lowest_land_m = 0;  ///< of what is not sea; as highest_m where all is
    bool has_sea() const { return static_cast<bool>(sea); }
    bool has_voids() const { return static_cast<bool>(cells); }
};

/// Fails where the data is larger than the driver's textures, or does not fit in its memory.
Result<TerrainTextures> build_terrain_textures(const lod::Terrain& terrain);

}  // namespace relevo::viewer
