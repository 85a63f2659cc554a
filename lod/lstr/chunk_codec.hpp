#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "geo/result.hpp"
#include "lod/lstr/chunk_mesh.hpp"

namespace relevo::lod {

/// A node's mesh as bytes, without its number and error. Posts and heights without loss; what vertices move
/// by to the coarser level in steps of a 512th of the error that is allowed at its level, the same for all of
/// a level.
std::vector<std::byte> encode_chunk(const ChunkMesh& mesh, double allowed_m);

/// How far encoding puts a vertex that has moved to the coarser level off, metres, at most: half a step.
double rise_rounding_m(const ChunkMesh& mesh, double allowed_m);

/// The mesh in such bytes. Fails with ErrorKind::damaged. \param name  for the message
Result<ChunkMesh> decode_chunk(std::span<const std::byte> bytes, const ChunkId& id, double allowed_m,
                               const std::string& name);

}  // namespace relevo::lod
