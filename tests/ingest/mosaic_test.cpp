#include "ingest/mosaic/mosaic.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/ingest/importing.hpp"

namespace relevo::ingest {
namespace {

using test::SceneFolder;
using test::SyntheticRaster;

Result<Mosaic> open(const std::vector<std::filesystem::path>& files) {
    MosaicRequest request;
    for (const auto& file : files) {
        SourceRequest source;
        source.input = file.string();
        request.sources.push_back(source);
    }
    return Mosaic::open(request);
}

TEST(Mosaic, APostIsTheSameWhateverTheWindow) {
    const SceneFolder folder;
    SyntheticRaster raster;
    raster.crs = "EPSG:32632";
    raster.type = GDT_Float32;
    raster.columns = 300;
    raster.rows = 200;
    raster.geotransform = {500000, 30, 3, 5200000, 2, -30};
    raster.nodata = -9999;
    raster.value = [](int c, int r) { return (c * 7 + r * 3) % 41 == 0 ? -9999.0 : std::sin(c * 0.3) * r; };
    const auto mosaic = open({raster.write(folder / "utm.tif")});
    ASSERT_TRUE(mosaic) << mosaic.error().message;
    const auto& frame = mosaic->frame();
    const auto whole = mosaic->read({0, 0, frame.columns, frame.rows});
    ASSERT_TRUE(whole);
    for (const Window window :
         {Window{0, 0, 64, 64}, Window{64, 64, 70, 90}, Window{100, 33, 1, 1},
          Window{frame.columns - 5, frame.rows - 9, 5, 9}, Window{0, frame.rows - 1, frame.columns, 1}}) {
        const auto part = mosaic->read(window);
        ASSERT_TRUE(part);
        for (int r = 0; r < window.rows; ++r)
            for (int c = 0; c < window.columns; ++c) {
                const float expected = whole->heights.at(window.column + c, window.row + r);
                const float found = part->heights.at(c, r);
                ASSERT_TRUE(found == expected || (std::isnan(found) && std::isnan(expected)))
                    << c << " " << r;
                ASSERT_EQ(part->marks.at(c, r), whole->marks.at(window.column + c, window.row + r));
                ASSERT_EQ(part->marks.at(c, r).is_void(), std::isnan(found));
            }
    }
}

}  // namespace
}  // namespace relevo::ingest
