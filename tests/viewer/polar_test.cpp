// Pictures around the poles: north where it is, no seam at any longitude, light from where the sun stands.

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/viewer/studio.hpp"

namespace relevo::test {
namespace {

using viewer::Layer;

constexpr int kSide = 257;
constexpr int kMiddle = 128;  // the pole
constexpr double kStep = 100;

/// A mountain on the pole that falls by `fall` metres a metre on every side.
lod::Terrain cone(geo::FrameKind kind, double fall) {
    const auto frame = polar_frame(kind, kSide, kSide, kStep);
    return make_terrain(frame, make_heights(frame, [&](int column, int row) {
                            return 5000 - fall * kStep / 0.994 * std::hypot(column - kMiddle, row - kMiddle);
                        }));
}

std::array<int, 3> pixel_of(const viewer::Picture& picture, const lod::View& view, const glm::dvec3& ecef) {
    const glm::dvec2 at = view.pixel(ecef - view.eye().m);
    return picture.at(static_cast<int>(at.x), static_cast<int>(at.y));
}

/// Posts on a circle around the pole.
std::vector<std::pair<int, int>> around_the_pole(double posts) {
    std::vector<std::pair<int, int>> all;
    for (int azimuth = 0; azimuth < 360; azimuth += 15) {
        const double angle = azimuth * 3.14159265358979 / 180;
        all.emplace_back(kMiddle + static_cast<int>(std::lround(posts * std::sin(angle))),
                         kMiddle - static_cast<int>(std::lround(posts * std::cos(angle))));
    }
    return all;
}

/// The ground's upward normal at a post, from the positions of its neighbours.
glm::dvec3 normal_at(const lod::Terrain& terrain, int column, int row) {
    const auto at = [&](int c, int r) { return terrain.position(c, r, 1); };
    return glm::normalize(
        glm::cross(at(column + 1, row) - at(column - 1, row), at(column, row - 1) - at(column, row + 1)));
}

class PolarPicture : public testing::TestWithParam<geo::FrameKind> {};

TEST_P(PolarPicture, NorthIsUp) {
    // A tower north of the eye's place, seen from straight above with heading 0, is above the middle.
    const auto frame = polar_frame(GetParam(), kSide, kSide, kStep);
    for (const double lon : {-170.0, -90.0, 0.0, 45.0, 100.0, 180.0}) {
        const double lat = GetParam() == geo::FrameKind::ups_north ? 89.95 : -89.95;
        const auto eye = frame.grid_position({geo::Degrees{lat}, geo::Degrees{lon}});
        const auto tower = frame.grid_position({geo::Degrees{lat + 0.01}, geo::Degrees{lon}});
        Studio studio(make_terrain(frame, make_heights(frame, [&](int column, int row) {
                                       return std::hypot(column - tower.column, row - tower.row) < 3 ? 1200
                                                                                                     : 1000;
                                   })));
        const auto camera = above_looking_down(studio.terrain(), eye.column, eye.row, 6000, 201, 201);
        const auto picture = studio.draw(camera, {.sun = *viewer::parse_sun("0,90"), .background = kMagenta});
        // Where the picture is brightest (the tints' top is nearly white).
        double sum_x = 0;
        double sum_y = 0;
        int count = 0;
        for (int y = 0; y < picture.height; ++y) {
            for (int x = 0; x < picture.width; ++x) {
                const auto pixel = picture.at(x, y);
                ASSERT_FALSE(is_magenta(pixel));
                if (pixel[2] < 200) continue;
                sum_x += x;
                sum_y += y;
                ++count;
            }
        }
        ASSERT_GT(count, 20) << lon;
        EXPECT_NEAR(sum_x / count, 100, 4) << lon;
        EXPECT_LT(sum_y / count, 60) << lon;
    }
}

TEST_P(PolarPicture, SlopeIsTheSameAllAround) {
    Studio studio(cone(GetParam(), 0.5));
    const auto ramp = viewer::colour_ramp(Layer::slope);
    const double degrees = std::atan(0.5) * 180 / 3.14159265358979;
    const auto expected =
        ramp[static_cast<std::size_t>(std::lround(degrees / 60 * static_cast<double>(ramp.size() - 1)))];
    const auto camera = above_looking_down(studio.terrain(), kMiddle, kMiddle, 40000, 400, 400);
    const auto picture = studio.draw(camera, {.layer = Layer::slope, .background = kMagenta});
    for (const auto& [column, row] : around_the_pole(90)) {
        const auto pixel = pixel_of(picture, lod::View(camera), studio.terrain().position(column, row, 1));
        for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(pixel[i], expected[i], 3) << column << " " << row;
    }
}

TEST_P(PolarPicture, ATimeOfDayLightsEachPlaceFromWhereTheSunStands) {
    Studio studio(cone(GetParam(), 0.7));
    const bool north = GetParam() == geo::FrameKind::ups_north;
    for (const char* time : north ? std::array{"2026-06-21T03:00:00Z", "2026-06-21T17:20:00Z"}
                                  : std::array{"2026-12-21T03:00:00Z", "2026-12-21T17:20:00Z"}) {
        const auto sun = *viewer::parse_sun(time);
        const auto camera = above_looking_down(studio.terrain(), kMiddle, kMiddle, 40000, 400, 400);
        const auto picture =
            studio.draw(camera, {.layer = Layer::hillshade, .sun = sun, .background = kMagenta});
        int dark = 0;
        for (const auto& [column, row] : around_the_pole(90)) {
            const auto place = studio.terrain().frame().lat_lon({double(column), double(row)});
            const auto stands = viewer::sun_at(sun, place);
            const geo::EnuFrame local({place.lat, place.lon, {}});
            const double flat = std::cos(stands.elevation.radians());
            const glm::dvec3 to_sun = flat * std::sin(stands.azimuth.radians()) * local.east() +
                                      flat * std::cos(stands.azimuth.radians()) * local.north() +
                                      std::sin(stands.elevation.radians()) * local.up();
            const double lit = std::max(0.0, glm::dot(to_sun, normal_at(studio.terrain(), column, row)));
            const auto pixel =
                pixel_of(picture, lod::View(camera), studio.terrain().position(column, row, 1));
            EXPECT_NEAR(pixel[0], 255 * (0.06 + 0.94 * lit), 4) << time << " " << column << " " << row;
            dark += lit < 0.1;
        }
        EXPECT_GT(dark, 3) << "the cone has a side in its shade";
    }
}

TEST_P(PolarPicture, ALampStandsOnOneSideOfTheWholeScene) {
    // By azimuth: that of the middle of the data, here on the meridian of 100 degrees east.
    const double x = 300e3 * std::sin(geo::Degrees{100}.radians());
    const double y =
        (GetParam() == geo::FrameKind::ups_north ? -1 : 1) * 300e3 * std::cos(geo::Degrees{100}.radians());
    const auto frame = polar_frame(GetParam(), kSide, kSide, kStep, x, y);
    Studio studio(make_terrain(frame, make_heights(frame, [&](int column, int row) {
                                   return 9000 - 70 * std::hypot(column - kMiddle, row - kMiddle);
                               })));
    const auto camera = above_looking_down(studio.terrain(), kMiddle, kMiddle, 40000, 400, 400);
    const auto picture = studio.draw(
        camera, {.layer = Layer::hillshade, .sun = *viewer::parse_sun("90,30"), .background = kMagenta});
    const auto middle = frame.lat_lon({kMiddle, kMiddle});
    const geo::EnuFrame local({middle.lat, middle.lon, {}});
    const glm::dvec3 to_sun = std::cos(geo::Degrees{30}.radians()) * local.east() +
                              std::sin(geo::Degrees{30}.radians()) * local.up();
    for (const auto& [column, row] : around_the_pole(90)) {
        const double lit = std::max(0.0, glm::dot(to_sun, normal_at(studio.terrain(), column, row)));
        const auto pixel = pixel_of(picture, lod::View(camera), studio.terrain().position(column, row, 1));
        EXPECT_NEAR(pixel[0], 255 * (0.06 + 0.94 * lit), 4) << column << " " << row;
    }
}

TEST_P(PolarPicture, HasNoHole) {
    const auto frame = polar_frame(GetParam(), kSide, kSide, kStep, 33, 21);
    Studio studio(make_terrain(frame, make_heights(frame, mountains)));
    for (const double tau : {0.5, 2.0, 8.0}) {
        viewer::ViewState how;
        how.tau_px = tau;
        const auto down = above_looking_down(studio.terrain(), kMiddle, kMiddle, 15000);
        auto across = down;
        across.eye.h.m -= 12000;
        across.pitch = geo::Degrees{-60};
        for (auto camera : {down, across}) {
            const auto picture = studio.draw(camera, {.background = kMagenta}, how);
            int holes = 0;
            for (int y = 0; y < picture.height; ++y) {
                for (int x = 0; x < picture.width; ++x) holes += is_magenta(picture.at(x, y));
            }
            EXPECT_EQ(holes, 0) << tau;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Poles, PolarPicture,
                         testing::Values(geo::FrameKind::ups_north, geo::FrameKind::ups_south),
                         [](const auto& kind) { return std::string(lod::to_string(kind.param)); });

}  // namespace
}  // namespace relevo::test
