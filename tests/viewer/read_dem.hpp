#pragma once

#include <array>
#include <filesystem>
#include <stdexcept>

#include <gdal_priv.h>

#include "geo/frame.hpp"
#include "lod/scene/raster.hpp"
#include "tests/lod/synthetic_terrain.hpp"

namespace relevo::test {

/// A part of a raster in a geographic CRS.
struct Dem {
    geo::GridFrame frame;
    lod::Raster<float> heights;
};

inline Dem read_dem(const std::filesystem::path& file, int column, int row, int side) {
    GDALAllRegister();
    const GDALDatasetUniquePtr from(GDALDataset::Open(file.c_str()));
    if (!from) throw std::runtime_error("cannot open " + file.string());
    std::array<double, 6> gt{};
    from->GetGeoTransform(gt.data());
    Dem dem{{geo::FrameKind::geographic, gt[0] + (column + 0.5) * gt[1], gt[3] + (row + 0.5) * gt[5], gt[1],
             -gt[5], side, side},
            lod::Raster<float>(side, side)};
    auto* band = from->GetRasterBand(1);
    if (band->RasterIO(GF_Read, column, row, side, side, dem.heights.row(0), side, side, GDT_Float32, 0, 0,
                       nullptr) != CE_None)
        throw std::runtime_error("cannot read " + file.string());
    for (int r = 0; r < side; ++r) {
        for (int c = 0; c < side; ++c) {
            if (static_cast<double>(dem.heights.at(c, r)) == band->GetNoDataValue())
                dem.heights.at(c, r) = kVoid;
        }
    }
    return dem;
}

}  // namespace relevo::test
