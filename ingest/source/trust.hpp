#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "geo/result.hpp"

namespace relevo::ingest {

/// How far the user trusts inputs.
struct Trust {
    bool allow_remote = false;  ///< --allow-remote: names may lead to a network
    std::vector<std::filesystem::path>
        allow_paths;  ///< --allow-path: where VRTs may read besides below themselves
};

/// The GDAL drivers that an elevation raster is opened with, ended by a null pointer. Pictures (PNG, JPEG,
/// BMP) are among them for height maps with a world file or --bounds.
const char* const* elevation_drivers();
bool is_elevation_driver(const std::string& name);

/// Would GDAL look for it in a network? ("https://...", "/vsicurl/...", also inside "/vsizip//vsicurl/...")
bool is_remote(const std::string& name);

/// Refuses names that are no files: addresses in a network (unless allowed), text that is itself a data set
/// (XML, JSON, "vrt://"), and standard input.
Result<void> check_input_name(const std::string& name, const Trust& trust);

}  // namespace relevo::ingest
