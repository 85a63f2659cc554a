// Marks over pictures: the bar is as long as it says, and they are where they should be.

#include "viewer/marks/marks.hpp"

#include <cmath>

#include <GeographicLib/Geodesic.hpp>
#include <gtest/gtest.h>

#include "lod/soar/pick.hpp"
#include "tests/viewer/studio.hpp"
#include "viewer/marks/scale_bar.hpp"
#include "viewer/ui/picture_marks.hpp"

namespace relevo::test {
namespace {

using viewer::Marks;

TEST(Marks, AreReadAsTheyAreWritten) {
    EXPECT_EQ(*viewer::parse_marks("all"), (Marks{true, true, true, true}));
    EXPECT_FALSE(viewer::parse_marks("none")->any());
    EXPECT_EQ(*viewer::parse_marks("north,legend"), (Marks{.legend = true, .north = true}));
    EXPECT_EQ(to_string(*viewer::parse_marks("north,legend")), "legend,north");
    EXPECT_EQ(to_string(Marks{}), "none");
    for (const char* text : {"", "everything", "legend,", "legend scale"})
        EXPECT_EQ(viewer::parse_marks(text).error().kind, ErrorKind::usage) << text;
}

TEST(Marks, GrowWithThePicture) {
    EXPECT_EQ(viewer::marks_scale(800, 600), 1);
    EXPECT_EQ(viewer::marks_scale(2560, 1440), 2);
    EXPECT_EQ(viewer::marks_scale(5120, 1440), 2);
}

/// The distance between what two pixels of a view show, by GeographicLib.
double ground_between(const lod::Terrain& terrain, const lod::View& view, glm::dvec2 a, glm::dvec2 b) {
    const auto at = [&](const glm::dvec2& pixel) {
        const auto hit = lod::pick_exactly(terrain, view.eye(), view.ray(pixel));
        if (!hit) throw std::runtime_error("sky");
        return terrain.frame().lat_lon(hit->place);
    };
    const geo::LatLon from = at(a);
    const geo::LatLon to = at(b);
    double metres = 0;
    GeographicLib::Geodesic::WGS84().Inverse(from.lat.value, from.lon.value, to.lat.value, to.lon.value,
                                             metres);
    return metres;
}

// A plain 2000 m up at 60 degrees of latitude, so that a degree is not as long both ways and heights count.
TEST(ScaleBar, IsAsLongOnTheGroundAsItSays) {
    auto frame = geographic_frame(513, 513);
    frame.north = 60;
    Studio studio(make_terrain(frame, make_heights(frame, [](int, int) { return 2000.0; })));
    for (const double heading : {0.0, 33.0, 250.0}) {
        for (const double pitch : {-90.0, -60.0, -20.0}) {
            for (const double metres : {100.0, 800.0}) {
                auto camera = above_looking_down(studio.terrain(), 256, 256, metres, 1280, 720);
                camera.heading.value = heading;
                camera.pitch.value = pitch;
                const lod::View view(camera);
                const auto hit = lod::pick_exactly(studio.terrain(), view.eye(), view.ray({640, 360}));
                ASSERT_TRUE(hit);
                const auto bar = viewer::scale_bar(view, hit->distance_m, 280);
                ASSERT_TRUE(bar);
                EXPECT_LE(bar->length_px, 280);
                EXPECT_GT(bar->length_px, 280 / 2.7);
                const glm::dvec2 half(0.5 * bar->length_px, 0);
                const double ground = ground_between(studio.terrain(), view, glm::dvec2(640, 360) - half,
                                                     glm::dvec2(640, 360) + half);
                // Triangles of the plain sag by a millimetre under the ellipsoid's curve; what is seen to the
                // side of the middle is a little farther away along a curved earth.
                EXPECT_NEAR(ground, bar->metres, 2e-5 * bar->metres)
                    << heading << " " << pitch << " " << metres;
                const double digits = std::log10(bar->metres) - std::floor(std::log10(bar->metres));
                EXPECT_TRUE(std::abs(digits) < 1e-9 || std::abs(digits - std::log10(2)) < 1e-9 ||
                            std::abs(digits - std::log10(5)) < 1e-9)
                    << bar->metres;
            }
        }
    }
}

TEST(ScaleBar, IsNotThereWhereRowsAreNotLevel) {
    const auto frame = geographic_frame(65, 65);
    const auto terrain = make_terrain(frame, make_heights(frame, [](int, int) { return 0.0; }));
    auto camera = above_looking_down(terrain, 32, 32, 1000);
    camera.pitch.value = -10;
    camera.roll.value = 90;
    EXPECT_FALSE(viewer::scale_bar(lod::View(camera), 1000, 100));
}

TEST(UpAzimuth, IsTheHeadingAndStraightDownAlsoTheRoll) {
    const auto frame = geographic_frame(65, 65);
    const auto terrain = make_terrain(frame, make_heights(frame, [](int, int) { return 0.0; }));
    for (const double heading : {0.0, 77.0, 300.0}) {
        for (const double pitch : {-90.0, -45.0, 0.0}) {
            for (const double roll : {0.0, 20.0}) {
                auto camera = above_looking_down(terrain, 32, 32, 1000);
                camera.heading.value = heading;
                camera.pitch.value = pitch;
                camera.roll.value = roll;
                const lod::View view(camera);
                const double up = viewer::up_azimuth(view).value;
                if (roll == 0 || pitch == 0) {
                    EXPECT_NEAR(std::remainder(up - heading, 360.0), 0, 1e-6) << pitch << " " << roll;
                }
                if (pitch == -90) {
                    // Where the picture's upper edge is, from its middle.
                    const geo::EnuFrame here(camera.eye);
                    const double azimuth =
                        std::atan2(glm::dot(view.up(), here.east()), glm::dot(view.up(), here.north()));
                    EXPECT_NEAR(std::remainder(up - azimuth * 180 / 3.14159265358979, 360.0), 0, 1e-6);
                }
            }
        }
    }
}

class MarkedPicture : public testing::Test {
  protected:
    MarkedPicture()
        : frame_(geographic_frame(257, 257)),
          studio_(make_terrain(frame_, make_heights(frame_, mountains))) {}

    /// How many pixels marks change in a part of a picture of one grey, and the largest change.
    struct Change {
        int pixels = 0;
        int most = 0;
    };
    Change change(const viewer::Picture& picture, int grey, int left, int top, int right, int bottom) const {
        Change found;
        for (int y = top; y < bottom; ++y) {
            for (int x = left; x < right; ++x) {
                const int by = std::abs(picture.at(x, y)[1] - grey);
                found.pixels += by > 8 ? 1 : 0;
                found.most = std::max(found.most, by);
            }
        }
        return found;
    }

    geo::GridFrame frame_;
    Studio studio_;
};

// White as snow, and dark as the sea at night: on both there is much contrast.
TEST_F(MarkedPicture, HasMarksInItsCornersAndNoneInTheMiddle) {
    for (const auto& [width, height] : {std::pair(320, 240), {800, 600}, {2560, 1440}}) {
        for (const int grey : {250, 20}) {
            const auto camera = above_looking_down(studio_.terrain(), 128, 128, 3000, width, height);
            const lod::View view(camera);
            viewer::Picture picture(width, height);
            std::fill(picture.rgb.begin(), picture.rgb.end(), static_cast<std::uint8_t>(grey));
            const double scale = viewer::marks_scale(width, height);
            auto marks = must(viewer::PictureMarks::create(scale));
            viewer::MapMarks map{.legend = viewer::legend(viewer::Layer::slope, {}, false),
                                 .scale = viewer::scale_bar(view, 3000, 0.22 * width),
                                 .north = true,
                                 .labels = {}};
            must(marks.draw(map, view, picture));
            const int side = static_cast<int>(100 * scale);
            const auto expect_mark = [&](const char* what, int left, int top, int right, int bottom) {
                const Change found = change(picture, grey, left, top, right, bottom);
                EXPECT_GT(found.pixels, 300 * scale * scale) << what << " " << width << " " << grey;
                EXPECT_GT(found.most, 150) << what << " " << width << " " << grey;
            };
            expect_mark("north", width - side, 0, width, side);
            expect_mark("scale", width - side, height - side, width, height);
            expect_mark("legend", 0, height - side, side, height);
            const int third = width / 2 - static_cast<int>(40 * scale);
            EXPECT_EQ(change(picture, grey, third, height / 3, width - third, height / 2).pixels, 0);
        }
    }
}

// The bar itself, in a picture that is drawn in several tiles.
TEST_F(MarkedPicture, HasABarOfItsLength) {
    constexpr int kWidth = 2560;
    constexpr int kHeight = 1440;
    const auto camera = above_looking_down(studio_.terrain(), 128, 128, 3000, kWidth, kHeight);
    const lod::View view(camera);
    const auto bar = viewer::scale_bar(view, 3000, 0.4 * kWidth);
    ASSERT_TRUE(bar);
    viewer::Picture picture(kWidth, kHeight);
    auto marks = must(viewer::PictureMarks::create(viewer::marks_scale(kWidth, kHeight)));
    must(marks.draw({.legend = {}, .scale = bar, .north = false, .labels = {}}, view, picture));
    int longest = 0;
    for (int y = kHeight - 200; y < kHeight; ++y) {
        int run = 0;
        for (int x = 0; x < kWidth; ++x) {
            run = picture.at(x, y)[0] > 240 ? run + 1 : 0;
            longest = std::max(longest, run);
        }
    }
    EXPECT_NEAR(longest, bar->length_px, 2);
}

}  // namespace
}  // namespace relevo::test
