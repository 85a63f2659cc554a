#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>

#include "tests/lod/scratch_scene.hpp"

namespace relevo::test {

/// An elevation file to be made for a test. The default is 20 x 10 posts of a geographic grid, Int16.
struct SyntheticRaster {
    int columns = 20;
    int rows = 10;
    int bands = 1;
    std::array<double, 6> geotransform{10, 0.01, 0, 50, 0, -0.01};
    bool georeferenced = true;
    std::string crs = "EPSG:4326";
    GDALDataType type = GDT_Int16;
    std::function<double(int column, int row)> value = [](int column, int row) {
        return 100.0 + 3 * column - 2 * row;
    };
    std::optional<double> nodata = {};
    std::string unit = {};
    std::optional<double> scale = {};
    std::optional<double> offset = {};
    std::string area_or_point = "Area";
    std::string driver = "GTiff";
    std::vector<std::string> creation_options = {};
    std::vector<GDALColorInterp> interpretations = {};

    /// Writes the file with GDAL.
    std::filesystem::path write(const std::filesystem::path& file) const;
};

inline std::filesystem::path SyntheticRaster::write(const std::filesystem::path& file) const {
    GDALAllRegister();
    auto* format = GetGDALDriverManager()->GetDriverByName(driver.c_str());
    EXPECT_NE(format, nullptr) << driver;
    char** options = nullptr;
    for (const auto& option : creation_options) options = CSLAddString(options, option.c_str());
    GDALDataset* dataset = format->Create(file.c_str(), columns, rows, bands, type, options);
    CSLDestroy(options);
    EXPECT_NE(dataset, nullptr) << file;
    if (dataset == nullptr) return file;
    dataset->SetMetadataItem("AREA_OR_POINT", area_or_point.c_str());
    if (georeferenced) {
        auto transform = geotransform;
        dataset->SetGeoTransform(transform.data());
    }
    if (!crs.empty()) {
        OGRSpatialReference reference;
        EXPECT_EQ(reference.SetFromUserInput(crs.c_str()), OGRERR_NONE) << crs;
        reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
        dataset->SetSpatialRef(&reference);
    }
    for (int i = 1; i <= bands; ++i) {
        GDALRasterBand* band = dataset->GetRasterBand(i);
        if (static_cast<std::size_t>(i) <= interpretations.size())
            band->SetColorInterpretation(interpretations[static_cast<std::size_t>(i) - 1]);
        if (nodata) band->SetNoDataValue(*nodata);
        if (!unit.empty()) band->SetUnitType(unit.c_str());
        if (scale) band->SetScale(*scale);
        if (offset) band->SetOffset(*offset);
        std::vector<double> line(static_cast<std::size_t>(columns));
        for (int row = 0; row < rows; ++row) {
            for (int column = 0; column < columns; ++column)
                line[static_cast<std::size_t>(column)] = value(column, row);
            EXPECT_EQ(band->RasterIO(GF_Write, 0, row, columns, 1, line.data(), columns, 1, GDT_Float64, 0, 0,
                                     nullptr),
                      CE_None);
        }
    }
    GDALClose(dataset);
    return file;
}

}  // namespace relevo::test
