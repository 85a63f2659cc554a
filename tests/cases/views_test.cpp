// Hard case 4 of the design: cameras where no one would put them. Each mesh must keep its error, have no hole
// and no crack, and whatever is drawn must be finite. What the pictures of such views look like is tested in
// tests/viewer.

#include <cmath>

#include <gtest/gtest.h>

#include "lod/mesh_checks.hpp"
#include "lod/oracle.hpp"
#include "lod/soar/refiner.hpp"
#include "tests/lod/synthetic_terrain.hpp"

namespace relevo::lod {
namespace {

using geo::Degrees;

struct Eye {
    const char* name;
    double column, row;  // in posts; outside the data too
    double above_m;      // above the ground, or above sea level outside
    double heading = 30, pitch = -20, roll = 0, fov = 60;
    int width = 320, height = 180;
    bool ground_in_view = true;
};

void PrintTo(const Eye& eye, std::ostream* out) {
    *out << eye.name;
}

const Eye kEyes[] = {
    {"on_a_vertex", 64, 64, 0},
    {"on_the_root", 64, 64, 0, 200, -5},
    {"inside_every_sphere", 65.3, 62.7, 5},
    {"one_centimetre_above_ground", 40, 80, 0.01},
    {"one_centimetre_above_ground_looking_down", 40, 80, 0.01, 0, -90},
    {"under_ground", 64, 64, -50, 30, 10},
    {"under_ground_looking_down", 64, 64, -50, 0, -90, 0, 60, 320, 180, false},
    {"ten_thousand_kilometres_up", 64, 64, 1e7, 0, -90},
    {"straight_down", 64, 64, 3000, 77, -90},
    {"straight_up", 64, 64, 300, 0, 90, 0, 60, 320, 180, false},
    {"along_the_horizon", 64, 125, 300, 0, 0},
    {"rolled", 64, 100, 400, 0, -10, 73},
    {"upside_down", 64, 100, 400, 0, -10, 180},
    {"fov_1", 20, 120, 900, 20, -15, 0, 1},
    {"fov_150", 64, 64, 200, 20, -30, 0, 150},
    {"fov_179", 64, 64, 200, 20, -60, 0, 179},
    {"one_pixel", 64, 100, 400, 0, -20, 0, 60, 1, 1},
    {"one_pixel_wide_angle", 64, 64, 50, 0, -80, 0, 150, 1, 1},
    {"very_wide_picture", 64, 64, 200, 20, -30, 0, 60, 2000, 10},
    {"outside_looking_in", 64, 400, 3000, 0, -15},
    {"outside_looking_away", 64, 400, 3000, 180, -15, 0, 60, 320, 180, false},
    {"on_the_edge", 0, 0, 2, 135, -10},
    {"antipode", 64, 64, -1.2e7, 0, 90},
};

class HardViews : public testing::TestWithParam<Eye> {
  protected:
    static Camera camera(const Terrain& terrain, const Eye& eye) {
        Camera camera;
        const auto side = static_cast<double>(terrain.frame().columns - 1);
        const bool inside = eye.column >= 0 && eye.row >= 0 && eye.column <= side && eye.row <= side;
        if (inside && eye.column == std::floor(eye.column) && eye.row == std::floor(eye.row)) {
            camera.eye = test::above(terrain, eye.column, eye.row, eye.above_m);
        } else {
            const geo::LatLon place = terrain.frame().lat_lon({eye.column, eye.row});
            const double ground = inside ? test::above(terrain, eye.column, eye.row, 0).h.m : 0;
            camera.eye = {place.lat, place.lon, {ground + eye.above_m}};
        }
        // "North" in the list is up the grid.
        camera.heading = Degrees{eye.heading} + terrain.frame().up_azimuth(camera.eye.lon);
        camera.pitch = Degrees{eye.pitch};
        camera.roll = Degrees{eye.roll};
        camera.fov = Degrees{eye.fov};
        camera.width = eye.width;
        camera.height = eye.height;
        return camera;
    }

    static void expect_good_mesh(const Terrain& terrain, const Eye& eye) {
        Refiner refiner(terrain);
        const View view(camera(terrain, eye));
        for (const double tau : {0.5, 4.0, 16.0}) {
            for (const bool morph : {false, true}) {
                const Mesh& mesh = **refiner.refine_whole(view, {.tau_px = tau, .morph = morph});
                for (const MeshVertex& v : mesh.vertices) {
                    ASSERT_TRUE(std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z));
                }
                EXPECT_EQ(count_t_vertices(mesh), 0);
                EXPECT_EQ(count_torn_posts(mesh), 0);
                const auto error = measure_error(terrain, view, mesh);
                EXPECT_EQ(error.has_value(), eye.ground_in_view);
                if (!error) continue;
                EXPECT_LE(error->max_px, tau);
                EXPECT_EQ(error->uncovered_posts, 0u);
            }
        }
    }
};

TEST_P(HardViews, KeepTheErrorOnMountains) {
    const auto frame = test::geographic_frame(129, 129);
    expect_good_mesh(test::make_terrain(frame, test::make_heights(frame, test::mountains)), GetParam());
}

TEST_P(HardViews, KeepTheErrorOnASaltFlat) {
    const auto frame = test::geographic_frame(129, 129);
    expect_good_mesh(test::make_terrain(frame, test::make_heights(frame, [](int, int) { return 1280.0; })),
                     GetParam());
}

TEST_P(HardViews, KeepTheErrorAcrossTheAntimeridian) {
    const double step = 1.0 / 3600;
    const auto frame = test::geographic_frame(129, 129, 45, 180 - 64 * step, step);
    expect_good_mesh(test::make_terrain(frame, test::make_heights(frame, test::mountains)), GetParam());
}

TEST_P(HardViews, KeepTheErrorAroundThePoles) {
    for (const auto kind : {geo::FrameKind::ups_north, geo::FrameKind::ups_south}) {
        const auto frame = test::polar_frame(kind, 129, 129, 30);
        expect_good_mesh(test::make_terrain(frame, test::make_heights(frame, test::mountains)), GetParam());
    }
}

INSTANTIATE_TEST_SUITE_P(Views, HardViews, testing::ValuesIn(kEyes),
                         [](const auto& eye) { return std::string(eye.param.name); });

}  // namespace
}  // namespace relevo::lod
