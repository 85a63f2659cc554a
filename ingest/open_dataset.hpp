#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include <gdal_priv.h>

#include "geo/result.hpp"
#include "ingest/gdal_messages.hpp"

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

/// Opens an input as GDAL does, with three additions: an archive NAME.zip with one raster in it stands for
/// that raster; so does a container (NetCDF, HDF) with one variable; and the half pixel of pixel-is-point
/// files is applied whatever the environment says.
/// \param messages  what GDAL says, for the error's message
Result<OpenDataset> open_dataset(const std::string& input, const GdalMessages& messages);

}  // namespace relevo::ingest
