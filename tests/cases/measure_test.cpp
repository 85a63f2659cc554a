// Hard cases of measuring, on real elevation models imported as a user would: profiles in every direction and
// over voids against stepping through the posts in long double, a large polygon against Planimeter, a
// viewshed against a line of sight to every tenth of its posts.

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "geo/geodesic.hpp"
#include "lod/measure/area.hpp"
#include "lod/measure/profile.hpp"
#include "lod/measure/viewshed.hpp"
#include "tests/geo/outside_program.hpp"
#include "tests/ingest/importing.hpp"
#include "tests/lod/scratch_scene.hpp"
#include "tests/shared_data.hpp"

namespace relevo::lod {
namespace {

class MeasureCases : public testing::Test {
  protected:
    void open(const char* file) {
        const auto imported =
            ingest::import_scene(test::options_for(test::shared_data(file)), {folder / "real.relevo"});
        ASSERT_TRUE(imported) << imported.error().message;
        auto opened = Scene::open(folder / "real.relevo");
        ASSERT_TRUE(opened) << opened.error().message;
        scene = std::make_unique<Scene>(*std::move(opened));
        sampler = std::make_unique<HeightSampler>(*scene);
        heights = *scene->read_all_heights();
    }

    geo::LatLon at(double column, double row) const { return scene->info().frame.lat_lon({column, row}); }

    /// H by the four weights, in long double; NaN for voids.
    long double height(geo::LatLon place) const {
        const geo::GridFrame& f = scene->info().frame;
        const long double row = (static_cast<long double>(f.north) - place.lat.value) / f.step_y;
        long double column = (static_cast<long double>(place.lon.value) - f.west) / f.step_x;
        if (column < 0) column += 360 / static_cast<long double>(f.step_x);
        const int i = std::clamp(static_cast<int>(column), 0, f.columns - 2);
        const int j = std::clamp(static_cast<int>(row), 0, f.rows - 2);
        // Within 1e-6 of a row or column of posts the surface is that of the edge, whatever is beside it.
        const auto on_edge = [](long double w) { return w < 1e-6L ? 0 : w > 1 - 1e-6L ? 1 : w; };
        const long double u = on_edge(column - i);
        const long double v = on_edge(row - j);
        const auto part = [&](long double weight, int c, int r) {
            return weight == 0 ? 0 : weight * static_cast<long double>(heights.at(c, r));
        };
        return part((1 - u) * (1 - v), i, j) + part(u * (1 - v), i + 1, j) + part((1 - u) * v, i, j + 1) +
               part(u * v, i + 1, j + 1);
    }

    /// The profile's figures are those of so many steps along the geodesic.
    void expect_stepped(geo::LatLon from, geo::LatLon to) {
        const auto profile = measure_profile(*sampler, std::array{from, to});
        ASSERT_TRUE(profile) << profile.error().message;
        const geo::GeodesicPath path(from, to);
        constexpr int kSteps = 200000;
        const double step = path.length_m() / kSteps;
        long double sum = 0;
        long double slopes = 0;
        long double highest = -1e9L;
        long double last = height(from);
        int known = 0;
        for (int i = 0; i < kSteps; ++i) {
            const long double H = height(path.at((i + 0.5) * step));
            const long double next = height(path.at((i + 1) * step));
            if (!std::isnan(H)) {
                sum += H;
                ++known;
                highest = std::max(highest, H);
            }
            if (!std::isnan(next - last)) slopes += std::abs(next - last);
            last = next;
        }
        EXPECT_EQ(profile->gaps.empty(), known == kSteps);
        EXPECT_NEAR(profile->measured_m, known * step,
                    (4.0 + 4 * static_cast<double>(profile->gaps.size())) * step);
        EXPECT_NEAR(*profile->mean_H_m, static_cast<double>(sum / known), 0.02);
        EXPECT_NEAR(*profile->mean_slope * profile->measured_m, static_cast<double>(slopes),
                    0.002 * static_cast<double>(slopes));
        EXPECT_NEAR(profile->highest->value, static_cast<double>(highest), 0.2);
        EXPECT_GE(profile->highest->value, static_cast<double>(highest) - 1e-6);
    }

    test::SceneFolder folder;
    std::unique_ptr<Scene> scene;
    std::unique_ptr<HeightSampler> sampler;
    Raster<float> heights;
};

TEST_F(MeasureCases, ProfilesInEveryDirectionAndOverVoids) {
    RELEVO_NEEDS_DATA("mountains/mt_rainier_90m.tif");
    open("mountains/mt_rainier_90m.tif");
    expect_stepped(at(300, 100), at(300, 1100));      // along a column of posts, north to south
    expect_stepped(at(300.4, 1100), at(300.4, 100));  // between columns, south to north
    expect_stepped(at(100, 950.5), at(1100, 950.5));  // east
    expect_stepped(at(1100, 1000), at(100, 1000));    // west
    expect_stepped({geo::Degrees{46.8523}, geo::Degrees{-121.7603}},
                   {geo::Degrees{46.7867}, geo::Degrees{-121.7356}});  // over the mountain's void
}

TEST_F(MeasureCases, AProfileAcrossTheAntimeridian) {
    RELEVO_NEEDS_DATA("mountains/baltoro.tif");
    // The same posts, moved there.
    const auto moved = folder / "moved.tif";
    const std::string command = fmt::format(
        "gdal_translate -q -a_ullr 179.6 -16 180.316666666666667 -16.3583333333333333 '{}' '{}' 2>&1",
        test::shared_data("mountains/baltoro.tif").string(), moved.string());
    if (std::system(command.c_str()) != 0)
        GTEST_SKIP() << "gdal_translate is not installed (package gdal-bin)";
    const auto imported = ingest::import_scene(test::options_for(moved), {folder / "real.relevo"});
    ASSERT_TRUE(imported) << imported.error().message;
    scene = std::make_unique<Scene>(*Scene::open(folder / "real.relevo"));
    sampler = std::make_unique<HeightSampler>(*scene);
    heights = *scene->read_all_heights();
    ASSERT_GT(scene->info().frame.extent().east, 180);
    const geo::LatLon west = at(20.2, 300.7);
    geo::LatLon east = at(840.6, 90.1);
    expect_stepped(west, east);
    east.lon = geo::wrapped_180(east.lon);  // as a user writes it
    expect_stepped(west, east);
    expect_stepped(east, west);
}

TEST_F(MeasureCases, ALargePolygonIsPlanimeters) {
    RELEVO_NEEDS_DATA("mountains/mt_everest_90m.tif");
    open("mountains/mt_everest_90m.tif");
    const std::vector<geo::LatLon> polygon{at(5.5, 1190.2), at(1180, 1195), at(1195.3, 600),
                                           at(1000, 10.1),  at(430, 500),   at(40, 8)};
    const auto area = measure_area(*scene, polygon);
    ASSERT_TRUE(area) << area.error().message;
    EXPECT_GT(area->void_m2, 0);
    EXPECT_EQ(area->outside_m2, 0);
    std::vector<std::string> input;
    for (const geo::LatLon& p : polygon)
        input.push_back(fmt::format("{:.17g} {:.17g}", p.lat.value, p.lon.value));
    const auto answer = test::ask("Planimeter -p 10", input);
    if (answer.empty()) GTEST_SKIP() << "Planimeter is not installed (package geographiclib-tools)";
    const auto expected = test::numbers(answer[0]);
    EXPECT_NEAR(area->geodesic.perimeter_m, expected[1], 1e-7);
    EXPECT_NEAR(area->geodesic.area_m2, std::abs(expected[2]), 0.01);
    // What was summed cell by cell: sides are followed to 1e-6 posts of 93 m.
    EXPECT_NEAR(area->measured_m2 + area->void_m2, std::abs(expected[2]), expected[1] * 93e-6);
}

TEST_F(MeasureCases, AViewshedIsLinesOfSight) {
    RELEVO_NEEDS_DATA("mountains/mt_rainier_90m.tif");
    open("mountains/mt_rainier_90m.tif");
    const geo::LatLon eye = at(400.3, 700.6);
    const ViewshedRequest request{{30, 2, 0.13}, 15000, {}};
    const auto shed = measure_viewshed(*sampler, eye, request);
    ASSERT_TRUE(shed) << shed.error().message;
    EXPECT_GT(shed->visible_posts, 1000u);
    int looked = 0;
    int differ = 0;
    for (int row = 0; row < shed->box.rows; row += 7) {
        for (int column = row % 11; column < shed->box.columns; column += 11) {
            const int seen = shed->posts.at(column, row);
            if (seen == Viewshed::none) continue;
            const auto sight = measure_sight(
                *sampler, eye, at(shed->box.column + column, shed->box.row + row), request.looking);
            ASSERT_TRUE(sight);
            int expected = Viewshed::unknown;
            if (sight->visible) expected = *sight->visible ? Viewshed::visible : Viewshed::hidden;
            ++looked;
            differ += seen == expected ? 0 : 1;
        }
    }
    EXPECT_GT(looked, 1000);
    EXPECT_EQ(differ, 0);
}

}  // namespace
}  // namespace relevo::lod
