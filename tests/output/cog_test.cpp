// Heights as a GeoTIFF, as GDAL and its checks see them.

#include "output/cog.hpp"

#include <cmath>
#include <memory>

#include "output/post_box.hpp"
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include "tests/lod/measured_scene.hpp"
#include "tests/lod/synthetic_terrain.hpp"

namespace relevo::test {
namespace {

class Cog : public testing::Test {
  protected:
    void SetUp() override { GDALAllRegister(); }

    GDALDatasetUniquePtr write(const lod::Scene& scene, const lod::BlockGrid::Box& box,
                               const std::string& compression = "DEFLATE") {
        auto file = output::PartialFile::create(folder / "a.tif", true);
        EXPECT_TRUE(file);
        output::CogRequest request;
        request.compression = compression;
        const auto done = output::write_cog(scene, box, request, *file);
        EXPECT_TRUE(done) << done.error().message;
        EXPECT_TRUE(file->take());
        // Nothing is left beside it.
        int files = 0;
        for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
            files += entry.path().filename() != "a.relevo";
        EXPECT_EQ(files, 1);
        return GDALDatasetUniquePtr(
            GDALDataset::Open((folder / "a.tif").c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY));
    }

    template <class T>
    std::vector<T> read(GDALRasterBand& band, GDALDataType type) {
        std::vector<T> samples(static_cast<std::size_t>(band.GetXSize()) *
                               static_cast<std::size_t>(band.GetYSize()));
        EXPECT_EQ(band.RasterIO(GF_Read, 0, 0, band.GetXSize(), band.GetYSize(), samples.data(),
                                band.GetXSize(), band.GetYSize(), type, 0, 0, nullptr),
                  CE_None);
        return samples;
    }

    void expect_heights(const lod::Raster<float>& all, const lod::BlockGrid::Box& box, GDALRasterBand& band) {
        ASSERT_EQ(band.GetXSize(), box.columns);
        ASSERT_EQ(band.GetYSize(), box.rows);
        const auto samples = read<float>(band, GDT_Float32);
        std::size_t i = 0;
        for (int row = 0; row < box.rows; ++row) {
            for (int column = 0; column < box.columns; ++column, ++i) {
                const float H = all.at(box.column + column, box.row + row);
                ASSERT_TRUE(samples[i] == H || (std::isnan(samples[i]) && std::isnan(H)))
                    << column << ", " << row;
            }
        }
    }

    SceneFolder folder;
};

double rough_with_voids(int column, int row) {
    return row % 97 == 5 && column > 300 ? std::nan("") : rough(column, row);
}

TEST_F(Cog, HasEveryHeightWhereItIs) {
    const MeasuredScene made(grid(10, 50, 0.001, 1300, 700), rough_with_voids);
    for (const char* const compression : {"DEFLATE", "ZSTD"}) {
        for (const lod::BlockGrid::Box& box : {lod::BlockGrid::Box{0, 0, 1300, 700}, {400, 100, 777, 555}}) {
            const auto file = write(made.scene(), box, compression);
            ASSERT_TRUE(file);
            expect_heights(made.heights(), box, *file->GetRasterBand(1));
            double transform[6];
            ASSERT_EQ(file->GetGeoTransform(transform), CE_None);
            EXPECT_NEAR(transform[0] + 0.5 * transform[1], 10 + box.column * 0.001, 1e-12);
            EXPECT_NEAR(transform[3] + 0.5 * transform[5], 50 - box.row * 0.001, 1e-12);
            EXPECT_NEAR(transform[1], 0.001, 1e-15);
            EXPECT_NEAR(transform[5], -0.001, 1e-15);
            EXPECT_STREQ(file->GetMetadataItem("AREA_OR_POINT"), "Point");
            EXPECT_STREQ(file->GetMetadataItem("LAYOUT", "IMAGE_STRUCTURE"), "COG");
            EXPECT_STREQ(file->GetMetadataItem("COMPRESSION", "IMAGE_STRUCTURE"), compression);
            EXPECT_STREQ(file->GetMetadataItem("VERTICAL_DATUM"), "WGS 84 ellipsoid");
            EXPECT_TRUE(std::isnan(file->GetRasterBand(1)->GetNoDataValue()));
            EXPECT_STREQ(file->GetRasterBand(1)->GetUnitType(), "m");
            ASSERT_NE(file->GetSpatialRef(), nullptr);
            EXPECT_EQ(file->GetSpatialRef()->GetAxesCount(), 3);  // EPSG:4979: heights above the ellipsoid
        }
    }
}

TEST_F(Cog, OverviewsHoldPostsAndNoAverages) {
    const MeasuredScene made(grid(10, 50, 0.001, 1200, 1000),
                             [](int x, int y) { return (x + y) % 2 == 0 ? 0.0 : 1000.0; });
    const auto file = write(made.scene(), {0, 0, 1200, 1000});
    ASSERT_TRUE(file);
    ASSERT_GT(file->GetRasterBand(1)->GetOverviewCount(), 0);
    for (const float H : read<float>(*file->GetRasterBand(1)->GetOverview(0), GDT_Float32))
        ASSERT_TRUE(H == 0 || H == 1000) << H;
}

TEST_F(Cog, WholeMetresStayWhole) {
    SceneParts parts = made_up_scene(600, 40);
    parts.info.height_type = lod::HeightType::int16;
    for (float& H : parts.heights.samples()) H = std::round(H);
    ASSERT_TRUE(write_scene(parts, folder / "a.relevo"));
    const auto scene = lod::Scene::open(folder / "a.relevo");
    ASSERT_TRUE(scene) << scene.error().message;
    const auto file = write(*scene, {0, 0, 600, 40});
    ASSERT_TRUE(file);
    GDALRasterBand& band = *file->GetRasterBand(1);
    EXPECT_EQ(band.GetRasterDataType(), GDT_Int16);
    EXPECT_EQ(band.GetNoDataValue(), -32768);
    const auto samples = read<std::int16_t>(band, GDT_Int16);
    bool voids = false;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const float H = parts.heights.samples()[i];
        voids = voids || std::isnan(H);
        ASSERT_EQ(samples[i], std::isnan(H) ? -32768 : static_cast<std::int16_t>(H));
    }
    EXPECT_TRUE(voids);
    // EGM96: a compound CRS.
    ASSERT_NE(file->GetSpatialRef(), nullptr);
    EXPECT_TRUE(file->GetSpatialRef()->IsCompound());
    EXPECT_STREQ(file->GetSpatialRef()->GetAuthorityCode("VERT_CS"), "5773");
}

TEST_F(Cog, AroundAPole) {
    using Datum = lod::VerticalDatum;
    for (const auto& [kind, datum] : {std::pair{geo::FrameKind::ups_north, Datum::ellipsoid},
                                      {geo::FrameKind::ups_south, Datum::egm96}}) {
        const auto frame = polar_frame(kind, 50, 40, 1000, 20000, -30000);
        const MeasuredScene made(frame, rough, datum);
        const auto file = write(made.scene(), {3, 4, 30, 20});
        ASSERT_TRUE(file);
        expect_heights(made.heights(), {3, 4, 30, 20}, *file->GetRasterBand(1));
        double transform[6];
        ASSERT_EQ(file->GetGeoTransform(transform), CE_None);
        EXPECT_NEAR(transform[0] + 0.5 * transform[1], frame.west + 3 * 1000, 1e-6);
        EXPECT_NEAR(transform[3] + 0.5 * transform[5], frame.north - 4 * 1000, 1e-6);
        // A post of the file, through GDAL's CRS, is at the latitude and longitude of the scene's.
        OGRSpatialReference degrees;
        degrees.importFromEPSG(4326);
        degrees.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
        ASSERT_NE(file->GetSpatialRef(), nullptr);
        OGRSpatialReference flat(*file->GetSpatialRef());
        EXPECT_EQ(flat.IsCompound() != FALSE, datum == Datum::egm96);
        flat.StripVertical();
        const std::unique_ptr<OGRCoordinateTransformation> way(
            OGRCreateCoordinateTransformation(&flat, &degrees));
        ASSERT_TRUE(way);
        double x = transform[0] + 7.5 * transform[1];
        double y = transform[3] + 11.5 * transform[5];
        ASSERT_TRUE(way->Transform(1, &x, &y));
        const auto place = frame.lat_lon({3 + 7.0, 4 + 11.0});
        EXPECT_NEAR(x, place.lon.value, 1e-8);
        EXPECT_NEAR(y, place.lat.value, 1e-9);
    }
}

TEST_F(Cog, ADamagedBlockIsAnErrorAndLeavesNothing) {
    const MeasuredScene made(grid(10, 50, 0.001, 1300, 700), rough);
    const auto victim = made.scene().path() / made.scene().info().heights[4].file;
    std::filesystem::permissions(victim, std::filesystem::perms::owner_write,
                                 std::filesystem::perm_options::add);
    replace(victim, "damaged");
    {
        auto file = output::PartialFile::create(folder / "a.tif", false);
        ASSERT_TRUE(file);
        const auto done = output::write_cog(made.scene(), {0, 0, 1300, 700}, {}, *file);
        ASSERT_FALSE(done);
        EXPECT_EQ(done.error().kind, ErrorKind::damaged);
        EXPECT_NE(done.error().message.find("heights/"), std::string::npos) << done.error().message;
    }
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
        files += entry.path().filename() != "a.relevo";
    EXPECT_EQ(files, 0);
}

TEST_F(Cog, StoppingLeavesNothing) {
    const MeasuredScene made(grid(10, 50, 0.001, 1300, 700), rough);
    {
        auto file = output::PartialFile::create(folder / "a.tif", false);
        ASSERT_TRUE(file);
        int calls = 0;
        output::CogRequest request;
        request.progress = [&](double) { return ++calls < 3; };
        const auto done = output::write_cog(made.scene(), {0, 0, 1300, 700}, request, *file);
        EXPECT_FALSE(done);
    }
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
        files += entry.path().filename() != "a.relevo";
    EXPECT_EQ(files, 0);
}

}  // namespace
}  // namespace relevo::test
