#pragma once

#include <filesystem>

#include "lod/measure/viewshed.hpp"

namespace relevo::output {

/// A viewshed as a GeoTIFF of bytes on the scene's own posts (pixel-is-point): 0 hidden, 1 visible, 2
/// unknown, 255 nodata; with colours. Fails as PartialFile does, and with ErrorKind::internal where GDAL
/// cannot write it.
Result<void> write_viewshed(const std::filesystem::path& file, const lod::SceneInfo& info,
                            const lod::Viewshed& shed, bool overwrite);

}  // namespace relevo::output
