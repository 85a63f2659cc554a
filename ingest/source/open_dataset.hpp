#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <gdal_priv.h>

#include "geo/result.hpp"
#include "ingest/source/gdal_messages.hpp"
#include "ingest/source/raw_layout.hpp"
#include "ingest/source/trust.hpp"

namespace relevo::ingest {

struct CloseDataset {
    void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using DatasetPtr = std::unique_ptr<GDALDataset, CloseDataset>;

/// A raster that GDAL has open, and the file it stands for.
struct OpenDataset {
    DatasetPtr dataset;
    std::string
        name;  ///< for people: the file's name without its folder, with the variable where one was named
    std::filesystem::path
        file;  ///< the file on disk (the archive of a zipped raster); empty where there is none
};

/// What to open.
struct OpenRequest {
    std::string input;                    ///< a file; or FILE:VARIABLE; or a name of GDAL's for one
    std::optional<std::string> variable;  ///< of a container (NetCDF, HDF)
    std::optional<RawLayout> raw;         ///< the file has no header, but this layout
    Trust trust;
};

/// Opens an input as GDAL does, with three additions: an archive NAME.zip with one raster in it stands for
/// that raster; so does a container (NetCDF, HDF) with one variable; and the half pixel of pixel-is-point
/// files is applied whatever the environment says. And with limits: elevation_drivers() alone, nothing that
/// the request's trust does not reach, and no sizes that the file cannot mean (check_size).
/// \param messages  what GDAL says, for the error's message
Result<OpenDataset> open_dataset(const OpenRequest& request, const GdalMessages& messages);

/// Refuses a raster whose header claims far more posts than a file of `bytes` can hold, or blocks that would
/// take more than kMostBlockBytes of memory each.
Result<void> check_size(GDALDataset& dataset, const std::string& name, std::optional<std::uint64_t> bytes);
inline constexpr std::uint64_t kMostBlockBytes = std::uint64_t{512} << 20;

}  // namespace relevo::ingest
