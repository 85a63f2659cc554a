#include "viewer/ocean/ocean_probe.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "lod/ocean/geoclipmap.hpp"
#include "lod/ocean/projected_mesh.hpp"
#include "lod/ocean/radial_grid.hpp"
#include "tests/viewer/studio.hpp"

namespace relevo::test {
namespace {

using viewer::OceanKind;

constexpr int kWidth = 240;
constexpr int kHeight = 160;
constexpr int kColumns = 321;  // two pages: one has the island, the other is sea alone
constexpr int kRows = 65;

/// An ocean 4000 m deep all around, with one island.
lod::Terrain ocean_with_island() {
    const auto frame = geographic_frame(kColumns, kRows, 10.064, 20, 0.002);
    const auto is_land = [](int column, int row) { return std::hypot(column - 225, row - 32) < 4; };
    lod::Raster<std::uint8_t> sea(kColumns, kRows);
    for (int row = 0; row < kRows; ++row) {
        for (int column = 0; column < kColumns; ++column)
            sea.at(column, row) = is_land(column, row) ? 0 : 255;
    }
    const auto heights =
        make_heights(frame, [&](int column, int row) { return is_land(column, row) ? 300 : -4000; });
    return make_terrain(frame, heights, lod::ErrorMetric::bounded, {}, sea);
}

/// A mesh that forgets every fourth of its blocks.
template <class Mesh>
class WithoutBlocks final : public lod::OceanMesh {
  public:
    const std::vector<lod::OceanPatch>& patches() const override { return whole_.patches(); }
    void arrange(const lod::SeaView& sea, const lod::SeaSpacing& spacing, const lod::WaterIn& water_in,
                 lod::OceanPicture& picture) const override {
        whole_.arrange(sea, spacing, water_in, picture);
        for (auto& [open, shore] : picture.copies) {
            for (auto* const copies : {&open, &shore}) {
                std::size_t nth = 0;
                std::erase_if(*copies, [&](const glm::vec4&) { return nth++ % 4 == 0; });
            }
        }
    }

  private:
    Mesh whole_;
};

class OceanProbeTest : public testing::Test {
  protected:
    OceanProbeTest()
        : studio_(ocean_with_island()), probe_(must(viewer::OceanProbe::create(kWidth, kHeight))) {}

    /// Over the deep, east of the island, looking at it.
    static lod::Camera camera(double height_m, double pitch, double heading = 270) {
        return {.eye = {geo::Degrees{9.998}, geo::Degrees{20.5}, {height_m}},
                .heading = geo::Degrees{heading},
                .pitch = geo::Degrees{pitch},
                .roll = geo::Degrees{0},
                .fov = geo::Degrees{60},
                .width = kWidth,
                .height = kHeight};
    }

    viewer::ProbePicture probe(const lod::Camera& camera, OceanKind kind, double wind_m_s = 10) {
        viewer::DrawSettings settings;
        settings.ocean.kind = kind;
        settings.ocean.wind.speed_m_s = wind_m_s;
        settings.ocean.time_s = 3 * 3600;
        studio_.draw(camera, settings);  // uploads
        auto picture = must(probe_.draw(studio_.renderer(), lod::View(camera), settings));
        sea_.waves = &studio_.renderer().ocean().waves();
        return picture;
    }

    std::size_t holes(const viewer::ProbePicture& picture) {
        return viewer::HoleFinder(studio_.terrain(), sea_).holes(picture).size();
    }

    void use_mesh(OceanKind kind, std::unique_ptr<lod::OceanMesh> mesh) {
        studio_.renderer().ocean().use_mesh(kind, std::move(mesh));
    }

    Studio studio_;
    viewer::OceanProbe probe_;
    viewer::TrueSea sea_;
};

std::size_t count(const viewer::ProbePicture& picture, viewer::ProbePicture::What what) {
    return static_cast<std::size_t>(std::count_if(picture.pixels.begin(), picture.pixels.end(),
                                                  [&](const auto& pixel) { return pixel.what == what; }));
}

class OceanMeshes : public OceanProbeTest, public testing::WithParamInterface<OceanKind> {};

// 4.5 standard deviations of what a mesh leaves out of the waves are to be a pixel: of 38 400 pixels not one.
TEST_P(OceanMeshes, KeepToAPixelAndAreWhole) {
    for (const double height_m : {5.0, 80.0, 2500.0, 60e3}) {
        for (const double pitch : {-90.0, -40.0, -3.0}) {
            const auto picture = probe(camera(height_m, pitch, 90), GetParam());
            const auto error = viewer::measure_sea_error(picture, sea_);
            EXPECT_GT(error.pixels, 5000u) << height_m << " m, " << pitch;
            EXPECT_LE(error.max_px, 1) << height_m << " m, " << pitch;
            EXPECT_EQ(holes(picture), 0u) << height_m << " m, " << pitch;
        }
    }
}

// The bed falls 4000 m in one post: waves end at cliffs, in their troughs too.
TEST_P(OceanMeshes, AreWholeAtAShore) {
    for (const double height_m : {5.0, 80.0, 800.0, 2500.0, 60e3}) {
        for (const double pitch : {-40.0, -15.0, -3.0}) {
            const auto picture = probe(camera(height_m, pitch), GetParam());
            EXPECT_EQ(holes(picture), 0u) << height_m << " m, " << pitch;
        }
    }
}

// Places are exact but for the rasteriser's floats; waves too short for any mesh would hide that: no wind.
TEST_P(OceanMeshes, AreWhereTheEllipsoidIs) {
    for (const double height_m : {2.0, 300.0, 30e3}) {
        const auto picture = probe(camera(height_m, -20), GetParam(), 0);
        const auto error = viewer::measure_sea_error(picture, sea_);
        EXPECT_GT(error.pixels, 5000u) << height_m;
        EXPECT_LE(error.max_px, 1e-6) << height_m;
        EXPECT_LE(error.position_max_px, 1) << height_m;
    }
}

TEST_P(OceanMeshes, HardlySwim) {
    const lod::Camera before = camera(80, -30);
    lod::Camera after = before;
    after.eye.lon.value += 0.8 / 111e3;  // a hundredth of the height
    const auto first = probe(before, GetParam());
    const auto second = probe(after, GetParam());
    const auto swimming = viewer::measure_swimming(first, second, sea_);
    EXPECT_GT(swimming.pixels, swimming.sea_pixels / 2);
    EXPECT_LE(swimming.max_px, 0.5);
    EXPECT_LE(swimming.rms_px, 0.05);
    EXPECT_LE(viewer::measure_swimming(first, first, sea_).max_px, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(All, OceanMeshes,
                         testing::Values(OceanKind::geoclipmap, OceanKind::radial, OceanKind::projected),
                         [](const auto& one) { return std::string(to_string(one.param)); });

// The measures must be able to fail.

TEST_F(OceanProbeTest, ACoarseMeshIsSeenToBeOff) {
    use_mesh(OceanKind::geoclipmap,
             std::make_unique<lod::Geoclipmap>(lod::geoclipmap_shape(4, 400, {0, 0, 0, 0})));
    use_mesh(OceanKind::radial, std::make_unique<lod::RadialGrid>(lod::radial_shape(50, 50e3, 2, 33, 32)));
    use_mesh(OceanKind::projected, std::make_unique<lod::ProjectedMesh>(9));
    for (const auto kind : {OceanKind::geoclipmap, OceanKind::radial, OceanKind::projected}) {
        const auto error = viewer::measure_sea_error(probe(camera(20, -40), kind), sea_);
        EXPECT_GT(error.max_px, 2) << to_string(kind);
        EXPECT_GT(error.over, 100u) << to_string(kind);
    }
}

TEST_F(OceanProbeTest, MissingBlocksAreSeen) {
    use_mesh(OceanKind::geoclipmap, std::make_unique<WithoutBlocks<lod::Geoclipmap>>());
    use_mesh(OceanKind::radial, std::make_unique<WithoutBlocks<lod::RadialGrid>>());
    use_mesh(OceanKind::projected, std::make_unique<WithoutBlocks<lod::ProjectedMesh>>());
    for (const auto kind : {OceanKind::geoclipmap, OceanKind::radial, OceanKind::projected}) {
        const auto picture = probe(camera(80, -60, 90), kind);
        const auto filled = count(picture, viewer::ProbePicture::What::filled);
        EXPECT_GT(holes(picture) + filled, 50u) << to_string(kind);
    }
}

TEST_F(OceanProbeTest, GroundIsGroundAndSkyIsNothing) {
    const auto picture = probe(camera(2000, -5), OceanKind::geoclipmap);
    EXPECT_GT(count(picture, viewer::ProbePicture::What::ground), 20u);
    EXPECT_GT(count(picture, viewer::ProbePicture::What::nothing), 5000u);
    EXPECT_EQ(picture.at(kWidth / 2, 2).what, viewer::ProbePicture::What::nothing);
    EXPECT_EQ(picture.at(kWidth / 2, kHeight - 2).what, viewer::ProbePicture::What::sea);
}

}  // namespace
}  // namespace relevo::test
