// Where the tiles of the ground's materials lie (viewer/ground/cover_block.hpp). A tile: the anchor's place in it; its
// axis over its length, along the row and up the column.
const int kRungs = 8;
const float kFinestTile = 1.2;  // metres, of the lowest rung; a rung's is six times that of the one below
const float kGrainTile = 0.3;
layout(std140, binding = 4) uniform Cover {
    vec4 anchor;         // its column and row; metres a column and a row
    vec4 rungs[kRungs];
    vec4 bumps[kRungs];  // how much of a rung's slopes is shown; the tile's length
    vec4 grain;
    vec4 macro;
}
cover;
