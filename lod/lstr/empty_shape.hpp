#pragma once

#include "lod/lstr/chunk_errors.hpp"
#include "lod/lstr/chunk_shape.hpp"
#include "lod/lstr/post_field.hpp"

namespace relevo::lod {

/// A node of which only what its sides must have for its neighbours is known, and its middle.
/// \param field  of all posts
ChunkShape empty_shape(const PostField& field, const ChunkId& id, const ChunkErrors& errors);

}  // namespace relevo::lod
