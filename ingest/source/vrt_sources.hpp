#pragma once

#include <string>

#include "geo/result.hpp"
#include "ingest/source/trust.hpp"

namespace relevo::ingest {

/// Refuses a VRT that would read anything but elevation rasters below its own folder (symbolic links
/// followed) or below a folder that the user allows, through any number of nested VRTs, and one that runs
/// Python. Other files pass. Nothing is opened as a raster. \param name   as GDAL knows the file: a path, or
/// one inside an archive \param shown  for the error's message
Result<void> check_vrt_sources(const std::string& name, const std::string& shown, const Trust& trust);

}  // namespace relevo::ingest
