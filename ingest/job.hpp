#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ingest/import.hpp"

namespace relevo::ingest {

/// Everything that the bytes of a scene depend on, as text: what was asked for, the files with their sizes
/// and times, and the versions of the programs. An import goes on only from what one with the same text has
/// left.
std::string job_text(const ImportOptions& options, const std::vector<std::filesystem::path>& files,
                     lod::HeightType type);

}  // namespace relevo::ingest
