// Pictures of the layer `terrain`: what the ground is made of, the time of day, and that its pattern stays
// put.

#include <cmath>
#include <numbers>
#include <optional>

#include <gtest/gtest.h>

#include "lod/lstr/chunk_mesher.hpp"
#include "tests/viewer/studio.hpp"

namespace relevo::test {
namespace {

using viewer::Layer;
using Colour = std::array<double, 3>;

viewer::DrawSettings lit(const char* sun, Layer layer = Layer::terrain) {
    return {.layer = layer, .sun = *viewer::parse_sun(sun), .background = kMagenta};
}

Colour mean(const viewer::Picture& picture, int first_row = 0, int last_row = 1 << 20) {
    Colour sum{};
    int pixels = 0;
    for (int y = first_row; y < std::min(picture.height, last_row); ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const auto pixel = picture.at(x, y);
            if (is_magenta(pixel)) continue;
            ++pixels;
            for (std::size_t i = 0; i < 3; ++i) sum[i] += pixel[i];
        }
    }
    for (double& channel : sum) channel /= std::max(pixels, 1);
    return sum;
}

double brightness(const Colour& colour) {
    return (colour[0] + colour[1] + colour[2]) / 3;
}

/// Mean difference of two pictures, a channel.
double difference(const viewer::Picture& a, const viewer::Picture& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) sum += std::abs(int{a.rgb[i]} - int{b.rgb[i]});
    return sum / static_cast<double>(a.rgb.size());
}

/// Mean difference of a picture's neighbouring pixels.
double contrast(const viewer::Picture& picture) {
    double sum = 0;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 1; x < picture.width; ++x)
            sum += std::abs(picture.at(x, y)[1] - picture.at(x - 1, y)[1]);
    }
    return sum / ((picture.width - 1) * picture.height);
}

/// A plane that rises to the east by so many degrees, H in its middle.
lod::Terrain plane(double degrees, double H) {
    const auto frame = geographic_frame(129, 129);
    const double rise = std::tan(degrees * std::numbers::pi / 180) * frame.spacing({64, 64}).column_m;
    return make_terrain(frame,
                        make_heights(frame, [&](int column, int) { return H + rise * (column - 64); }));
}

double smooth(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

/// What docs/viewer.md says of the ground inland, at 36 degrees of latitude.
struct Parts {
    double grass, rock, gravel, snow;
};
constexpr double kSnowLine = 4585;
Parts parts(double slope, double H) {
    const double snow = smooth(-250, 250, H - kSnowLine) * (1 - smooth(42, 58, slope));
    const double rock = smooth(26, 38, slope);
    const double scree = smooth(0.62, 0.90, H / kSnowLine);
    return {(1 - rock) * (1 - scree) * (1 - snow), rock * (1 - snow), (1 - rock) * scree * (1 - snow), snow};
}

/// The colour of such ground under a sun at the zenith, before its brightness varies.
Colour expected(double slope, double H, std::optional<Parts> given = {}) {
    const double dry = std::clamp(1.1 * H / kSnowLine - 0.05, 0.0, 1.0);
    const Parts share = given.value_or(parts(slope, H));
    const double lit = std::cos(slope * std::numbers::pi / 180);
    const Colour lush{0.255, 0.2975, 0.140}, straw{0.475, 0.425, 0.2575}, rock{0.415, 0.385, 0.3525},
        gravel{0.4525, 0.425, 0.385}, snow{0.830, 0.865, 0.915}, sun{1.00, 0.96, 0.88}, sky{0.35, 0.39, 0.45};
    Colour shown{};
    for (std::size_t i = 0; i < 3; ++i) {
        const double grass = lush[i] + dry * (straw[i] - lush[i]);
        const double ground =
            share.grass * grass + share.rock * rock[i] + share.gravel * gravel[i] + share.snow * snow[i];
        const double x = ground * (0.95 * sun[i] * lit + sky[i] * (0.62 + 0.38 * lit));
        shown[i] = 255 * (x < 0.6 ? x : 0.6 + 0.4 * (1 - std::exp(-(x - 0.6) / 0.4)));
    }
    return shown;
}

TEST(CoverPictures, SlopeAndHeightSayWhatTheGroundIsMadeOf) {
    struct Case {
        const char* what;
        double slope, H, tolerance;
    };
    for (const Case& at : {Case{"grass", 0, 300, 14}, Case{"dry grass", 0, 2300, 20},
                           Case{"rock", 50, 1500, 14}, Case{"gravel", 3, 4150, 16}, Case{"snow", 0, 6000, 10},
                           Case{"rock", 65, 6500, 16}, Case{"grass and rock", 32, 1500, 22}}) {
        Studio studio(plane(at.slope, at.H));
        const auto picture = studio.draw(above_looking_down(studio.terrain(), 64, 64, 3500), lit("0,90"));
        const Colour found = mean(picture, 65, 85);
        const Colour wanted = expected(at.slope, at.H);
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_NEAR(found[i], wanted[i], at.tolerance) << at.what << " channel " << i;
    }
}

/// Of the plane's grid, or of a part of its texels.
template <class Shares>
std::shared_ptr<const viewer::GroundMap> ground_map(int columns, int rows, Shares shares) {
    auto map = std::make_shared<viewer::GroundMap>(viewer::GroundMap{columns, rows, {}});
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) map->shares.push_back(shares(column, row));
    }
    return map;
}

TEST(CoverPictures, AMapSaysWhatTheGroundIsMadeOfWhateverItsSlopeAndHeight) {
    struct Case {
        const char* what;
        std::array<std::uint8_t, 4> given;
        Parts parts;
    };
    for (const Case& at :
         {Case{"grass", {255, 0, 0, 0}, {1, 0, 0, 0}}, Case{"rock", {0, 255, 0, 0}, {0, 1, 0, 0}},
          Case{"gravel", {0, 0, 255, 0}, {0, 0, 1, 0}}, Case{"snow", {0, 0, 0, 255}, {0, 0, 0, 1}},
          Case{"rock and snow", {0, 127, 0, 128}, {0, 0.5, 0, 0.5}}}) {
        for (const double H : {300.0, 6000.0}) {  // grass and snow, without a map
            Studio studio(plane(0, H), ground_map(129, 129, [&](int, int) { return at.given; }));
            const auto picture = studio.draw(above_looking_down(studio.terrain(), 64, 64, 3500), lit("0,90"));
            const Colour found = mean(picture, 65, 85);
            const Colour wanted = expected(0, H, at.parts);
            for (std::size_t i = 0; i < 3; ++i)
                EXPECT_NEAR(found[i], wanted[i], 18) << at.what << " at " << H << " m, channel " << i;
        }
    }
}

// The west is snow by the map, whose texels are of four posts; of the east it says nothing.
TEST(CoverPictures, WhereAMapHasNoDataTheGroundIsAsWithoutIt) {
    const auto west = ground_map(33, 129, [](int column, int) {
        return std::array<std::uint8_t, 4>{0, 0, 0, static_cast<std::uint8_t>(column < 16 ? 255 : 0)};
    });
    Studio studio(plane(0, 300), west);
    Studio without(plane(0, 300));
    const auto at = [&](Studio& drawn, double column) {
        return drawn.draw(above_looking_down(drawn.terrain(), column, 64, 300, 60, 40), lit("0,90"));
    };
    EXPECT_EQ(at(studio, 100).rgb, at(without, 100).rgb);
    const Colour snow = mean(at(studio, 30));
    const Colour wanted = expected(0, 300, Parts{0, 0, 0, 1});
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(snow[i], wanted[i], 18);
    // The border is at post 62 by the map's texels, and blended over one.
    EXPECT_GT(brightness(mean(at(studio, 59))), brightness(mean(at(studio, 66))) + 60);
}

TEST(CoverPictures, SeaIsWaterAndItsShoreIsSand) {
    const auto frame = geographic_frame(65, 65);
    const auto heights = make_heights(frame, [](int column, int) { return column < 32 ? 0.0 : 3.0; });
    lod::Raster<std::uint8_t> sea(65, 65);
    for (int row = 0; row < 65; ++row) {
        for (int column = 0; column < 32; ++column) sea.at(column, row) = 255;
    }
    Studio studio(make_terrain(frame, heights, lod::ErrorMetric::bounded, {}, sea));
    const auto at = [&](double column) {
        return mean(studio.draw(above_looking_down(studio.terrain(), column, 32, 8, 40, 30), lit("0,90")));
    };
    const Colour water = at(15);
    EXPECT_GT(water[2], water[0] + 20);
    const Colour beach = at(31.75);
    const Colour inland = at(50);
    EXPECT_GT(beach[0], beach[1]);
    EXPECT_GT(beach[0], inland[0] + 50);
    EXPECT_GT(inland[1], inland[0]);
}

TEST(CoverPictures, DayIsBrighterThanDuskAndDuskThanNight) {
    const auto frame = geographic_frame(129, 129);
    Studio studio(make_terrain(frame, make_heights(frame, mountains)));
    const auto camera = above_looking_down(studio.terrain(), 64, 64, 3000);
    const auto day = studio.draw(camera, lit("270,50"));
    const auto dusk = studio.draw(camera, lit("270,2"));
    const auto night = studio.draw(camera, lit("270,-30"));
    EXPECT_GT(brightness(mean(day)), 1.4 * brightness(mean(dusk)));
    EXPECT_GT(brightness(mean(dusk)), 1.4 * brightness(mean(night)));
    EXPECT_GT(brightness(mean(night)), 10);  // a moon, in which relief is seen
    EXPECT_GT(contrast(night), 0.5);
    EXPECT_GT(difference(day, studio.draw(camera, lit("270,50", Layer::hypsometric))), 10);
}

// The sky and the light of a time are those of the sun's direction then, whatever axes they are computed in.
TEST(CoverPictures, ATimeOfDayIsADirectionOfTheSun) {
    const auto frame = geographic_frame(129, 129);
    Studio studio(make_terrain(frame, make_heights(frame, mountains)));
    auto camera = above_looking_down(studio.terrain(), 64, 64, 1500);
    camera.pitch.value = -10;
    camera.heading.value = 250;
    viewer::DrawSettings time{.layer = Layer::terrain, .sun = *viewer::parse_sun("2026-03-20T08:30:00Z")};
    viewer::DrawSettings direction = time;
    direction.sun.kind = viewer::SunSetting::Kind::direction;
    direction.sun.direction = viewer::sun_at(time.sun, {camera.eye.lat, camera.eye.lon});
    ASSERT_NEAR(direction.sun.direction.elevation.value, 4, 6);
    EXPECT_LT(difference(studio.draw(camera, time), studio.draw(camera, direction)), 0.5);
}

TEST(CoverPictures, TheSkyIsWarmTowardsALowSunAndAsEverByDay) {
    const auto frame = geographic_frame(65, 65);
    Studio studio(make_terrain(frame, make_heights(frame, [](int, int) { return 100.0; })));
    auto camera = above_looking_down(studio.terrain(), 32, 32, 500);
    camera.pitch.value = 3;
    const auto sky = [&](const char* sun, Layer layer) {
        return mean(studio.draw(camera, {.layer = layer, .sun = *viewer::parse_sun(sun)}), 60, 90);
    };
    const Colour towards = sky("0,2", Layer::terrain);
    const Colour away = sky("180,2", Layer::terrain);
    EXPECT_GT(towards[0], towards[2] + 20);
    EXPECT_GT(away[2], away[0]);
    EXPECT_LT(brightness(sky("0,-30", Layer::terrain)), 40);
    EXPECT_EQ(sky("0,14", Layer::terrain), sky("auto", Layer::hypsometric));
}

TEST(CoverPictures, NodesOfTheQuadtreeLookLikeRefinement) {
    const auto frame = geographic_frame(257, 257);
    Studio studio(make_terrain(frame, make_heights(frame, mountains)));
    const auto chunks = must(lod::MemoryChunks::build(studio.terrain(), lod::ChunkErrors::for_spacing(25)));
    lod::ChunkMesher mesher(studio.terrain(), chunks);
    for (const double metres : {30.0, 1500.0}) {
        auto camera = above_looking_down(studio.terrain(), 128, 200, metres, 320, 240);
        camera.pitch.value = -20;
        const lod::View view(camera);
        const auto nodes = studio.draw(view, must(mesher.whole_picture(view, {.tau_px = 1})), lit("auto"));
        const auto refined = studio.draw(camera, lit("auto"));
        EXPECT_LT(difference(nodes, refined), 4) << metres << " m";
    }
}

// A float holds a grid coordinate of 8000 to 2 cm here; the pattern is 5 mm fine. Made of such coordinates it
// would jump from frame to frame.
TEST(CoverPictures, ThePatternStaysPutFarFromTheGridsOrigin) {
    const auto frame = geographic_frame(8193, 40);
    Studio studio(
        make_terrain(frame, make_heights(frame, [](int column, int) { return 100 + 0.01 * column; })));
    for (const double pitch : {-90.0, -35.0}) {
        auto camera = above_looking_down(studio.terrain(), 8100.3, 20.4, 1.5, 320, 240);
        camera.pitch.value = pitch;
        const auto before = studio.draw(camera, lit("auto"));
        const double rough = contrast(before);
        EXPECT_GT(rough, 2);
        camera.eye.lon.value += 0.001 / 90e3;  // a millimetre
        const auto after = studio.draw(camera, lit("auto"));
        EXPECT_GT(difference(before, after), 0);
        EXPECT_LT(difference(before, after), 0.5 * rough) << pitch;
    }
}

}  // namespace
}  // namespace relevo::test
