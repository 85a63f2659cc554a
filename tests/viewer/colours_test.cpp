#include <cmath>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include "tests/viewer/studio.hpp"

namespace relevo::test {
namespace {

using viewer::Layer;

constexpr double kStepM = 30.87;                           // 1" of latitude at 36 degrees
const double kFlat = 0.32 + 0.12 + 0.75 * std::sqrt(0.5);  // the shade of flat ground

/// A plane that rises to the east by `rise` metres a metre.
lod::Terrain plane(double rise) {
    const auto frame = geographic_frame(129, 129);
    const double east_m = frame.spacing({64, 64}).column_m;
    return make_terrain(frame,
                        make_heights(frame, [&](int column, int) { return 1000 + rise * east_m * column; }));
}

std::array<int, 3> centre(const viewer::Picture& picture) {
    return picture.at(picture.width / 2, picture.height / 2);
}

void expect_near(const std::array<int, 3>& pixel, const std::array<std::uint8_t, 4>& colour, double times) {
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(pixel[i], std::min(255.0, times * colour[i]), 3) << "channel " << i;
    }
}

TEST(Colours, SlopeIsTheTrueSteepnessWhateverTheExaggeration) {
    const auto ramp = viewer::colour_ramp(Layer::slope);
    for (const double rise : {0.0, 0.2, 0.5773502692, 1.0}) {
        Studio studio(plane(rise));
        const double degrees = std::atan(rise) * 180 / 3.14159265358979;
        const auto expected =
            ramp[static_cast<std::size_t>(std::lround(degrees / 60 * static_cast<double>(ramp.size() - 1)))];
        for (const double exaggeration : {1.0, 3.0}) {
            auto camera = above_looking_down(studio.terrain(), 64, 64, 3000);
            camera.eye.h.m *= exaggeration;
            const auto picture = studio.draw(
                camera, {.layer = Layer::slope, .exaggeration = exaggeration, .background = kMagenta});
            expect_near(centre(picture), expected, 1);
        }
    }
}

TEST(Colours, HillshadeIsTheCosineOfTheSunsAngle) {
    for (const double rise : {-0.5, 0.0, 0.5}) {
        Studio studio(plane(rise));
        for (const char* sun : {"90,30", "270,30", "0,60"}) {
            const auto setting = *viewer::parse_sun(sun);
            const auto picture =
                studio.draw(above_looking_down(studio.terrain(), 64, 64, 3000),
                            {.layer = Layer::hillshade, .sun = setting, .background = kMagenta});
            const double length = std::sqrt(1 + rise * rise);
            const double azimuth = setting.direction.azimuth.radians();
            const double elevation = setting.direction.elevation.radians();
            const double cosine =
                (-rise * std::cos(elevation) * std::sin(azimuth) + std::sin(elevation)) / length;
            const double grey = 255 * (0.06 + 0.94 * std::max(cosine, 0.0));
            EXPECT_NEAR(centre(picture)[0], grey, 3) << rise << " " << sun;
        }
    }
}

// With a vertex at every post, light at the vertices is light at the pixels.
TEST(Colours, PlainGroundIsLitAtItsVertices) {
    constexpr std::array<double, 3> kPlain{0.72, 0.68, 0.60};
    viewer::ViewState how;
    how.method = viewer::Method::full;
    for (const double rise : {-0.5, 0.0, 0.5}) {
        Studio studio(plane(rise));
        for (const char* sun : {"90,30", "0,60", "2026-03-20T23:00:00Z"}) {
            const auto setting = *viewer::parse_sun(sun);
            const auto camera = above_looking_down(studio.terrain(), 64, 64, 3000);
            const auto draw = [&](Layer layer) {
                return centre(
                    studio.draw(camera, {.layer = layer, .sun = setting, .background = kMagenta}, how));
            };
            const double lit = (draw(Layer::hillshade)[0] / 255.0 - 0.06) / 0.94;  // by day
            const double shade = 0.32 + 0.12 / std::sqrt(1 + rise * rise) + 0.75 * lit;
            const auto plain = draw(Layer::plain);
            for (std::size_t i = 0; i < 3; ++i)
                EXPECT_NEAR(plain[i], std::min(255.0, 255 * kPlain[i] * shade), 3) << rise << " " << sun;
        }
    }
}

TEST(Colours, PlainGroundHasHolesWhereTheDataHas) {
    const auto frame = geographic_frame(65, 65);
    Studio studio(make_terrain(frame, make_heights(frame, [](int column, int) {
                                   return column < 32 ? 100.0 : std::numeric_limits<double>::quiet_NaN();
                               })));
    const auto at = [&](int column) {
        return centre(studio.draw(above_looking_down(studio.terrain(), column, 32, 200, 20, 20),
                                  {.layer = Layer::plain, .background = kMagenta}));
    };
    EXPECT_FALSE(is_magenta(at(20)));
    EXPECT_TRUE(is_magenta(at(44)));
}

TEST(Colours, ExaggerationSteepensTheShade) {
    Studio studio(plane(0.1));
    const auto grey = [&](double exaggeration) {
        auto camera = above_looking_down(studio.terrain(), 64, 64, 3000);
        camera.eye.h.m *= exaggeration;
        return centre(studio.draw(camera, {.layer = Layer::hillshade,
                                           .exaggeration = exaggeration,
                                           .sun = *viewer::parse_sun("90,45"),
                                           .background = kMagenta}))[0];
    };
    const auto expected = [](double rise) {
        return 255 * (0.06 + 0.94 * std::sqrt(0.5) * (1 - rise) / std::sqrt(1 + rise * rise));
    };
    EXPECT_NEAR(grey(1), expected(0.1), 3);
    EXPECT_NEAR(grey(4), expected(0.4), 3);
}

// The same sun by a time and by its direction there: the one is turned into ECEF and back for every vertex.
TEST(Colours, ATimeOfDayIsADirectionOfTheSun) {
    Studio studio(plane(0.3));
    const auto time = *viewer::parse_sun("2026-03-20T23:00:00Z");
    const auto place = studio.terrain().frame().lat_lon({64, 64});
    viewer::SunSetting direction;
    direction.kind = viewer::SunSetting::Kind::direction;
    direction.direction = viewer::sun_at(time, place);
    ASSERT_GT(direction.direction.elevation.value, 10);
    const auto camera = above_looking_down(studio.terrain(), 64, 64, 2000);
    const auto a = studio.draw(camera, {.layer = Layer::hillshade, .sun = time, .background = kMagenta});
    const auto b = studio.draw(camera, {.layer = Layer::hillshade, .sun = direction, .background = kMagenta});
    EXPECT_NEAR(centre(a)[0], centre(b)[0], 1);
}

TEST(Colours, TintsRunOverTheScenesHeights) {
    const auto frame = geographic_frame(65, 65);
    // Two flats, with a step between them: tints are of heights, lit as flat ground is.
    Studio studio(make_terrain(
        frame, make_heights(frame, [](int column, int) { return column < 32 ? -50.0 : 3200.0; })));
    const auto ramp = viewer::colour_ramp(Layer::hypsometric, {-50, 3200, -50});
    for (const auto& [column, expected] : {std::pair(10, ramp.front()), std::pair(54, ramp.back())}) {
        const auto picture = studio.draw(above_looking_down(studio.terrain(), column, 32, 200, 20, 20),
                                         {.background = kMagenta});
        expect_near(centre(picture), expected, kFlat);
    }
}

/// What is sea is told by its class and not by its height: a polder is green, an estuary above 0 blue.
TEST(Colours, TheSeaIsBlueAndAPolderIsGreen) {
    const auto frame = geographic_frame(65, 65);
    const auto heights = make_heights(frame, [](int column, int row) {
        if (row > 32) return column < 32 ? -20.0 : 1.0;
        return column < 32 ? 0.0 : -20.0;
    });
    lod::Raster<std::uint8_t> sea(65, 65);
    for (int row = 0; row < 65; ++row) {
        for (int column = 0; column < 65; ++column)
            sea.at(column, row) = (row > 32) == (column >= 32) ? 255 : 0;
    }
    Studio studio(make_terrain(frame, heights, lod::ErrorMetric::bounded, {}, sea));
    const viewer::HeightSpan span{-20, 1, -20};
    const auto land = viewer::colour_ramp(Layer::hypsometric, span);
    const auto water = viewer::sea_ramp(span);
    const auto at = [&](const auto& ramp, double H) {
        return ramp[static_cast<std::size_t>(
            std::lround((H + 20) / 21 * static_cast<double>(ramp.size() - 1)))];
    };
    const auto shown = [&](int column, int row) {
        return centre(studio.draw(above_looking_down(studio.terrain(), column, row, 200, 20, 20),
                                  {.background = kMagenta}));
    };
    expect_near(shown(10, 10), at(water, 0), kFlat);
    expect_near(shown(54, 10), at(land, -20), kFlat);  // a polder
    expect_near(shown(10, 54), at(land, -20), kFlat);
    expect_near(shown(54, 54), at(water, 1), kFlat);
}

TEST(Colours, TintsRiseInLightness) {
    const auto lightness = [](const std::array<std::uint8_t, 4>& c) {
        return 0.2126 * std::pow(c[0] / 255.0, 2.2) + 0.7152 * std::pow(c[1] / 255.0, 2.2) +
               0.0722 * std::pow(c[2] / 255.0, 2.2);
    };
    const auto land = viewer::colour_ramp(Layer::hypsometric, {-1000, 1000, -400});
    const auto sea = viewer::sea_ramp({-1000, 1000, -400});
    for (std::size_t i = 0; i < land.size(); ++i) {
        EXPECT_GT(land[i][1], land[i][2] - 3) << "not blue: " << i;
        EXPECT_GT(sea[i][2], sea[i][1]) << "blue: " << i;
        if (i == 0) continue;
        EXPECT_GE(lightness(land[i]), lightness(land[i - 1]) - 0.004) << i;
        EXPECT_GE(lightness(sea[i]), lightness(sea[i - 1]) - 0.004) << i;
    }
    const auto slope = viewer::colour_ramp(Layer::slope);
    for (std::size_t i = 1; i < slope.size(); ++i)
        EXPECT_LE(lightness(slope[i]), lightness(slope[i - 1]) + 0.004) << i;
}

TEST(Colours, LevelsDiffer) {
    const auto frame = geographic_frame(129, 129);
    Studio studio(make_terrain(frame, make_heights(frame, mountains)));
    viewer::ViewState how;
    how.tau_px = 8;
    const auto camera = above_looking_down(studio.terrain(), 64, 64, 3000);
    const auto plain = studio.draw(
        camera, {.layer = Layer::lod, .sun = *viewer::parse_sun("0,90"), .background = kMagenta}, how);
    std::set<std::array<int, 3>> colours;
    for (int y = 0; y < plain.height; y += 3) {
        for (int x = 0; x < plain.width; x += 3) colours.insert(plain.at(x, y));
    }
    EXPECT_GT(colours.size(), 4u);

    const auto wired = studio.draw(camera, {.wireframe = true, .background = kMagenta}, how);
    const auto bare = studio.draw(camera, {.background = kMagenta}, how);
    int changed = 0;
    for (int y = 0; y < wired.height; ++y) {
        for (int x = 0; x < wired.width; ++x) changed += wired.at(x, y) != bare.at(x, y);
    }
    const int pixels = wired.width * wired.height;
    EXPECT_GT(changed, pixels / 50);     // there are lines
    EXPECT_LT(changed, pixels * 3 / 4);  // and ground between them
}

}  // namespace
}  // namespace relevo::test
