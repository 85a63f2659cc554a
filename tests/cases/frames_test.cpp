// Hard case 1 of the design, below ingest: wherever on earth a grid lies, its mesh keeps the promised error
// and has no hole, and what is measured does not depend on the frame.

#include <cmath>

#include <gtest/gtest.h>

#include "geo/geodesic.hpp"
#include "lod/mesh_checks.hpp"
#include "lod/oracle.hpp"
#include "lod/sample_views.hpp"
#include "lod/soar/refiner.hpp"
#include "tests/lod/marched_line.hpp"
#include "tests/lod/synthetic_terrain.hpp"

namespace relevo::lod {
namespace {

using geo::FrameKind;

struct Case {
    const char* name;
    geo::GridFrame frame;
};

void PrintTo(const Case& c, std::ostream* out) {
    *out << c.name;
}

/// A polar grid whose middle is at a place.
geo::GridFrame polar_at(FrameKind kind, double lat, double lon, int side, double step) {
    const geo::GridFrame whole = test::polar_frame(kind, 3, 3, 1);
    const auto at = whole.grid_position({geo::Degrees{lat}, geo::Degrees{lon}});
    return test::polar_frame(kind, side, side, step, at.column - 1, 1 - at.row);
}

constexpr double kStep = 1.0 / 3600;

const Case kCases[] = {
    {"equator", test::geographic_frame(129, 129, 64 * kStep, 20, kStep)},
    {"greenwich", test::geographic_frame(129, 129, 51.5, -64 * kStep, kStep)},
    {"antimeridian", test::geographic_frame(129, 129, -16.5, 180 - 64 * kStep, kStep)},
    {"north_pole", test::polar_frame(FrameKind::ups_north, 129, 129, 30)},
    {"south_pole", test::polar_frame(FrameKind::ups_south, 129, 129, 30)},
    {"north_pole_in_a_corner", test::polar_frame(FrameKind::ups_north, 129, 129, 30, 64 * 30, 64 * 30)},
    {"south_pole_on_a_border", test::polar_frame(FrameKind::ups_south, 129, 129, 30, 0, -64 * 30)},
    {"antimeridian_in_the_arctic", polar_at(FrameKind::ups_north, 80, 180, 129, 30)},
    {"change_of_frame_geographic", test::geographic_frame(129, 129, 75 + 64 * kStep, -40, kStep)},
    {"change_of_frame_ups", polar_at(FrameKind::ups_north, 75, -40, 129, 30)},
    {"change_of_frame_south_geographic", test::geographic_frame(129, 129, -75 + 64 * kStep, 166, kStep)},
    {"change_of_frame_south_ups", polar_at(FrameKind::ups_south, -75, 166, 129, 30)},
    {"geographic_to_the_north_pole", test::geographic_frame(129, 129, 90, 0, 0.02)},
    {"whole_antarctica", test::polar_frame(FrameKind::ups_south, 129, 129, 45e3)},
    {"whole_earth", {FrameKind::geographic, -180, 90, 3, 3, 121, 61}},
};

class Frames : public testing::TestWithParam<Case> {};

TEST_P(Frames, KeepTheError) {
    const geo::GridFrame& frame = GetParam().frame;
    const bool whole_earth = frame.closes();
    const Terrain terrain =
        test::make_terrain(frame, test::make_heights(frame, [&](int column, int row) {
                               if (whole_earth && (row == 0 || row == 60)) return 0.0;
                               return test::mountains(whole_earth ? column % 120 : column, row);
                           }));
    Refiner refiner(terrain);
    for (const Camera& camera : sample_views(terrain, 24, 5, 320, 180)) {
        const View view(camera);
        for (const double exaggeration : {1.0, 3.0}) {
            for (const bool morph : {false, true}) {
                constexpr double kTau = 2;
                const Mesh& mesh = **refiner.refine_whole(
                    view, {.tau_px = kTau, .morph = morph, .exaggeration = exaggeration});
                EXPECT_EQ(count_t_vertices(mesh), 0);
                EXPECT_EQ(count_torn_posts(mesh), 0);
                const auto error = measure_error(terrain, view, mesh, exaggeration);
                if (!error) continue;
                EXPECT_LE(error->max_px, kTau);
                EXPECT_EQ(error->uncovered_posts, 0u);
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Places, Frames, testing::ValuesIn(kCases),
                         [](const auto& c) { return std::string(c.param.name); });

/// A surface of latitude and longitude, with posts dense enough that a bilinear grid of it errs by 2 mm.
double waves(geo::LatLon place) {
    const auto p = geo::to_ecef({place.lat, place.lon, {}}).m / 5000.0;
    return 1000 + 100 * std::sin(p.x) + 100 * std::sin(p.y) + 50 * std::cos(p.z);
}

TEST(FramesAgree, OnEitherSideOfTheChangeAtSeventyFive) {
    for (const bool north : {true, false}) {
        const double lat = north ? 75 : -75;
        const geo::GridFrame degrees = test::geographic_frame(301, 301, lat + 0.04, 178.8, 0.00028);
        const auto middle = degrees.lat_lon({150, 150});
        const geo::GridFrame metres = polar_at(north ? FrameKind::ups_north : FrameKind::ups_south,
                                               middle.lat.value, middle.lon.value, 301, 30);
        const test::Ends ends{degrees.lat_lon({70.2, 80.1}), degrees.lat_lon({230.5, 220.7})};
        std::vector<LineMeasurement> lines;
        for (const geo::GridFrame& frame : {degrees, metres}) {
            test::MeasuredScene scene(frame, [&](int column, int row) {
                return waves(frame.lat_lon({static_cast<double>(column), static_cast<double>(row)}));
            });
            for (int i = 0; i < 100; ++i) {
                const auto place = degrees.lat_lon({60 + 1.83 * i, 240 - 1.71 * i});
                const auto H = scene.sampler().height(frame.grid_position(place));
                ASSERT_TRUE(H && *H);
                EXPECT_NEAR(**H, waves(place), 0.01);
            }
            lines.push_back(test::measure(scene, ends));
        }
        ASSERT_TRUE(lines[0].surface_m && lines[1].surface_m);
        EXPECT_EQ(lines[0].geodesic.length_m, lines[1].geodesic.length_m);
        EXPECT_NEAR(*lines[0].surface_m / *lines[1].surface_m, 1, 1e-6);
        EXPECT_NEAR(*lines[0].climb_m, *lines[1].climb_m, 0.1);
    }
}

}  // namespace
}  // namespace relevo::lod
