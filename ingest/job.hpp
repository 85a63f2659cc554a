#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "ingest/import.hpp"

namespace relevo::ingest {

/// What tells a file from the same file after a change. Of one that cannot be found, size and time are those
/// that the standard library has for this.
struct FileState {
    std::filesystem::path path;  ///< absolute
    std::uintmax_t size = 0;
    std::filesystem::file_time_type time;

    bool operator==(const FileState&) const = default;
};

/// Of each file that has a name.
std::vector<FileState> states_of(const std::vector<std::filesystem::path>& files);

/// Everything that the bytes of a scene depend on, as text: what was asked for, the files with their sizes
/// and times, and the versions of the programs. An import goes on only from what one with the same text has
/// left.
std::string job_text(const ImportOptions& options, const std::vector<FileState>& files, lod::HeightType type);

}  // namespace relevo::ingest
