#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <gdal_priv.h>

#include "geo/frame.hpp"
#include "geo/result.hpp"

namespace relevo::ingest {

// What pictures and weights have in common: rasters of bytes, in any CRS, that are brought to a scene's grid.

/// Fails with ErrorKind::input where one of the bands is not of bytes.
/// \param rule  for people, what is of bytes: "pictures are of bytes"
Result<void> check_bytes(GDALDataset& dataset, const std::string& name, const std::vector<int>& bands,
                         std::string_view rule);

/// Fails with ErrorKind::input where the file does not say where on earth it lies.
Result<void> check_georeference(GDALDataset& dataset, const std::string& name);

/// The CRS of a grid's coordinates, as GDAL reads it.
const char* crs_of(geo::FrameKind kind);

/// Outer edges, in the units of a grid's coordinates.
struct Edges {
    double west = 0;
    double south = 0;
    double east = 0;
    double north = 0;
};

/// Pixels row by row from the north-west, the bands of each together; the last band is how far there is data.
struct WarpedBytes {
    int bands = 0;
    std::vector<std::uint8_t> bytes;

    /// \pre Bands == bands
    template <std::size_t Bands>
    std::span<const std::uint8_t, Bands> pixel(std::size_t i) const {
        return std::span<const std::uint8_t, Bands>(bytes.data() + i * Bands, Bands);
    }
};

/// Bilinear between a raster's pixels, the mean of them where those that are asked for are larger. Nothing
/// where GDAL fails; its messages say why.
/// \param options  more words of gdalwarp's
std::optional<WarpedBytes> warp_bytes(GDALDataset& from, geo::FrameKind kind, const Edges& edges, int columns,
                                      int rows, std::initializer_list<const char*> options);

}  // namespace relevo::ingest
