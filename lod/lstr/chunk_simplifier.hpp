#pragma once

#include <array>

#include "lod/lstr/chunk_errors.hpp"
#include "lod/lstr/chunk_shape.hpp"
#include "lod/lstr/post_field.hpp"
#include "lod/static_mesh/post_set.hpp"

namespace relevo::lod {

// The mesh of one node. Posts are put in until none is farther off than the level may be, then taken away as
// long as that stays so: those of level 1 that the filter finds (removable_posts.hpp) first, then those in
// the node's middle, last those near its border. On the border stay the posts that border_line.hpp names,
// whatever is inside. What the error is in the end is not said.

/// Of level 1. \param removable  places in the field
ChunkShape finest_shape(const PostField& field, const ChunkId& id, const ChunkErrors& errors,
                        const PostSet& removable);

/// Of a coarser level, from its children's.
ChunkShape coarser_shape(const PostField& field, const ChunkId& id, const ChunkErrors& errors,
                         const std::array<ChunkShape, 4>& children);

}  // namespace relevo::lod
