#pragma once

#include <optional>
#include <string>

#include "geo/result.hpp"
#include "ingest/affine.hpp"
#include "ingest/reference/crs.hpp"
#include "ingest/source/gdal_messages.hpp"
#include "ingest/source/open_dataset.hpp"

namespace relevo::ingest {

/// Where the posts of a raster are: in which CRS, and where in it.
struct Georeference {
    Crs crs;
    Affine posts;
    std::string note;  ///< what was taken from elsewhere than the file; may be empty
};

/// From the raster, a .prj beside it, or what the user says. Fails with the remedy where something is
/// missing. \param gdal_says  GDAL's complaints about the file, now and while this runs, for the message
Result<Georeference> georeference(const OpenDataset& opened, const std::optional<std::string>& crs,
                                  const std::optional<Bounds>& bounds, const GdalMessages& gdal_says);

}  // namespace relevo::ingest
