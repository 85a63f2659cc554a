// The sea of a wave map as it is drawn, against lod::WaveMap, which is tested for itself.

#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lod/ocean/geoclipmap.hpp"
#include "tests/viewer/studio.hpp"
#include "viewer/ocean/ocean_probe.hpp"

namespace relevo::test {
namespace {

using viewer::OceanKind;

constexpr int kWidth = 200;
constexpr int kHeight = 150;

/// Sea alone, so deep.
lod::Terrain sea_of_depth(double depth_m) {
    const auto frame = geographic_frame(65, 65, 10, 20, 0.002);
    lod::Raster<std::uint8_t> sea(65, 65);
    for (int row = 0; row < 65; ++row) {
        for (int column = 0; column < 65; ++column) sea.at(column, row) = 255;
    }
    // A depth that changes, lest it be taken for a sea without a bed.
    const auto heights = make_heights(
        frame, [&](int column, int row) { return column + row == 0 ? -depth_m - 50 : -depth_m; });
    return make_terrain(frame, heights, lod::ErrorMetric::bounded, {}, sea);
}

/// 64 m of waves from 6 to 30 m long, which run anywhere, some 1.5 m high, or so many times that.
std::shared_ptr<const lod::WaveMap> waves_of_map(double times = 1) {
    constexpr int kSide = 64;
    constexpr double kTurn = 2 * std::numbers::pi;
    std::mt19937_64 random(5);
    const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    std::vector<float> heights(std::size_t{kSide} * kSide);
    for (int wave = 0; wave < 24; ++wave) {
        const double count = 2 * std::pow(5.0, uniform());
        const double angle = kTurn * uniform();
        const double east = std::round(count * std::cos(angle));
        const double north = std::round(count * std::sin(angle));
        const double phase = kTurn * uniform();
        for (std::size_t i = 0; i < heights.size(); ++i) {
            const auto column = static_cast<double>(i % kSide) + 0.5;
            const std::size_t line = i / kSide;
            const double row = static_cast<double>(line) + 0.5;
            const double h = std::cos(kTurn * (east * column + north * row) / kSide + phase) / count;
            heights[i] += static_cast<float>(0.5 * times * h);
        }
    }
    return std::make_shared<lod::WaveMap>(kSide, heights, 64, geo::Degrees{300});
}

class OceanOfMap : public testing::Test {
  protected:
    explicit OceanOfMap(double depth_m = 4000)
        : map_(waves_of_map()),
          studio_(sea_of_depth(depth_m)),
          probe_(must(viewer::OceanProbe::create(kWidth, kHeight))) {
        sea_.map = map_.get();
    }

    static lod::Camera camera(double height_m, double pitch) {
        return {.eye = {geo::Degrees{9.936}, geo::Degrees{20.064}, {height_m}},
                .heading = geo::Degrees{0},
                .pitch = geo::Degrees{pitch},
                .roll = geo::Degrees{0},
                .fov = geo::Degrees{60},
                .width = kWidth,
                .height = kHeight};
    }
    viewer::DrawSettings settings(OceanKind kind, double time_s = 5000) const {
        viewer::DrawSettings settings;
        settings.ocean = {
            .kind = kind, .wind = {.speed_m_s = 4, .from = geo::Degrees{300}}, .map = map_, .time_s = time_s};
        return settings;
    }
    viewer::ProbePicture probe(const lod::Camera& camera, const viewer::DrawSettings& settings) {
        studio_.draw(camera, settings);  // uploads
        return must(probe_.draw(studio_.renderer(), lod::View(camera), settings));
    }
    /// Vertices so far apart near the nadir.
    void use_spacing(double spacing_m) {
        constexpr int kCells = 64;
        studio_.renderer().ocean().use_mesh(
            OceanKind::geoclipmap, std::make_unique<lod::Geoclipmap>(
                                       lod::geoclipmap_shape(kCells, kCells * spacing_m, {0, 0, 1, 1, 1})));
    }

    std::shared_ptr<const lod::WaveMap> map_;
    Studio studio_;
    viewer::OceanProbe probe_;
    viewer::TrueSea sea_;
};

class MeshesOfMap : public OceanOfMap, public testing::WithParamInterface<OceanKind> {};

TEST_P(MeshesOfMap, KeepToAPixelAndAreWhole) {
    for (const double height_m : {6.0, 80.0, 2500.0}) {
        for (const double pitch : {-90.0, -40.0, -3.0}) {
            const auto picture = probe(camera(height_m, pitch), settings(GetParam()));
            const auto error = viewer::measure_sea_error(picture, sea_);
            EXPECT_GT(error.pixels, 5000u) << height_m << " m, " << pitch;
            EXPECT_LE(error.max_px, 1) << height_m << " m, " << pitch;
            const auto holes = viewer::HoleFinder(studio_.terrain(), sea_).holes(picture);
            EXPECT_EQ(holes.size(), 0u) << height_m << " m, " << pitch;
        }
    }
}

TEST_P(MeshesOfMap, HardlySwim) {
    const lod::Camera before = camera(80, -30);
    lod::Camera after = before;
    after.eye.lon.value += 0.8 / 111e3;  // a hundredth of the height
    const auto first = probe(before, settings(GetParam()));
    const auto second = probe(after, settings(GetParam()));
    const auto swimming = viewer::measure_swimming(first, second, sea_);
    EXPECT_GT(swimming.pixels, swimming.sea_pixels / 2);
    EXPECT_LE(swimming.max_px, 0.5);
    EXPECT_LE(swimming.rms_px, 0.05);
}

INSTANTIATE_TEST_SUITE_P(All, MeshesOfMap,
                         testing::Values(OceanKind::geoclipmap, OceanKind::radial, OceanKind::projected),
                         [](const auto& one) { return std::string(to_string(one.param)); });

TEST_F(OceanOfMap, IsTheMapWhateverTheTimeAndThePlace) {
    use_spacing(0.1);
    for (const double time_s : {0.0, 1.25, 86400.0 * 365, -1e9}) {
        lod::Camera away = camera(4, -90);
        away.eye.lon.value += 0.5;  // beyond the data the sea goes on
        for (const auto& at : {camera(4, -90), away}) {
            const auto picture = probe(at, settings(OceanKind::geoclipmap, time_s));
            double worst = 0;
            double most = 0;
            for (const auto& pixel : picture.pixels) {
                ASSERT_EQ(pixel.what, viewer::ProbePicture::What::sea);
                worst = std::max(worst, std::abs(pixel.wave_m - map_->height(pixel.place, time_s)));
                most = std::max(most, std::abs(pixel.wave_m));
            }
            EXPECT_GT(most, 0.1) << "waves are seen at all";
            EXPECT_LT(worst, 1e-3) << time_s;
        }
    }
}

TEST_F(OceanOfMap, CoarseMeshesCarryWhatTheirSpacingAllows) {
    double all = 0;
    for (const double spacing_m : {0.25, 1.5, 3.0, 5.0, 8.0, 14.0, 200.0}) {
        use_spacing(spacing_m);
        const auto picture = probe(camera(60, -90), settings(OceanKind::geoclipmap));
        double drawn = 0;
        double told = 0;
        for (const auto& pixel : picture.pixels) {
            drawn += pixel.wave_m * pixel.wave_m;
            told += std::pow(map_->height(pixel.place, 5000, spacing_m), 2);
        }
        if (all == 0) all = told;
        // Between vertices lines cut the corners of the shortest waves.
        EXPECT_LE(drawn, told + 1e-3 * all) << spacing_m;
        EXPECT_GE(drawn, 0.7 * told - 1e-3 * all) << spacing_m;
    }
}

/// Of the light, straight from above, with the slopes that the mesh carries along a direction.
class LitSeaOfMap : public OceanOfMap {
  protected:
    struct Mesh {
        double spacing_m, eye_m;
        double times;  // the map's heights
    };
    double correlation(const Mesh& mesh, double sun_azimuth, const glm::dvec2& along) {
        use_spacing(mesh.spacing_m);
        map_ = waves_of_map(mesh.times);
        lod::Camera at = camera(mesh.eye_m, -90);
        at.fov = geo::Degrees{20};  // every line of sight is almost straight down
        double n = 0, sx = 0, sy = 0, sxx = 0, syy = 0, sxy = 0;
        for (const double time_s : {0.0, 100.0, 200.0, 300.0}) {
            auto lit = settings(OceanKind::geoclipmap, time_s);
            lit.sun = must(viewer::parse_sun(fmt::format("{},75", sun_azimuth)));
            lit.ocean.wind.speed_m_s = 1;
            const auto shown = studio_.draw(at, lit);
            const auto picture = probe(at, lit);
            for (int y = 0; y < kHeight; ++y) {
                for (int x = 0; x < kWidth; ++x) {
                    const auto height = [&](double step) {
                        return map_->height(picture.at(x, y).place + step * along, time_s, mesh.spacing_m);
                    };
                    const double slope = (height(0.05) - height(-0.05)) / 0.1;
                    const double light = shown.at(x, y)[0];
                    n += 1;
                    sx += slope;
                    sy += light;
                    sxx += slope * slope;
                    syy += light * light;
                    sxy += slope * light;
                }
            }
        }
        return (n * sxy - sx * sy) / std::sqrt((n * sxx - sx * sx) * (n * syy - sy * sy));
    }
};

TEST_F(LitSeaOfMap, RisesAwayFromTheSunWhereItIsBright) {
    // The finer mesh has mostly the first copy's slopes; of the coarser one the second's alone are left,
    // which are a quarter as steep.
    for (const Mesh& mesh : {Mesh{0.25, 100, 1}, {8, 800, 4}}) {
        for (const auto& [azimuth, to_sun] :
             {std::pair{90.0, glm::dvec2(1, 0)}, {0.0, glm::dvec2(0, 1)}, {225.0, glm::dvec2(-0.7, -0.7)}}) {
            EXPECT_LT(correlation(mesh, azimuth, to_sun), -0.3) << mesh.spacing_m << " m, " << azimuth;
            EXPECT_NEAR(correlation(mesh, azimuth, {-to_sun.y, to_sun.x}), 0, 0.2)
                << mesh.spacing_m << " m, " << azimuth;
        }
    }
}

class ShallowSeaOfMap : public OceanOfMap {
  protected:
    static constexpr double kDepth = 7;  // less than half of what both copies' waves are long
    ShallowSeaOfMap() : OceanOfMap(kDepth) {
        sea_.depth_m = [](geo::LatLon) { return kDepth; };
    }
};

TEST_F(ShallowSeaOfMap, IsLowerThanADeepOne) {
    ASSERT_LT(kDepth, 0.5 * map_->copies()[1].length_m);
    use_spacing(0.1);
    const auto picture = probe(camera(4, -90), settings(OceanKind::geoclipmap));
    double worst = 0;
    double less = 0;
    for (const auto& pixel : picture.pixels) {
        const double deep = map_->height(pixel.place, 5000);
        worst = std::max(worst, std::abs(pixel.wave_m - map_->height(pixel.place, 5000, 0, kDepth)));
        less = std::max(less, std::abs(pixel.wave_m - deep));
    }
    EXPECT_LT(worst, 5e-3);
    EXPECT_GT(less, 0.05);
}

}  // namespace
}  // namespace relevo::test
