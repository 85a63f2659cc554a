#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lod/lstr/chunk_file.hpp"
#include "lod/terrain.hpp"

namespace relevo::lod {

/// What is wrong with a scene's chunks: nodes that cannot be read, neighbours of a level that do not have the
/// same vertices on the side that they share. Empty: nothing.
/// \param progress  gets the part that is done, 0 to 1
std::vector<std::string> check_chunks(const ChunkFile& chunks, const std::function<void(double)>& progress);

}  // namespace relevo::lod
