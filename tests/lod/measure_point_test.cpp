#include <cmath>
#include <limits>
#include <random>

#include "lod/measure/point.hpp"
#include "lod/measure/source_position.hpp"
#include "tests/lod/measured_scene.hpp"

namespace relevo::lod {
namespace {

using test::grid;
using test::lat_lon;
using test::MeasuredScene;
using test::rough;

constexpr double kVoid = std::numeric_limits<double>::quiet_NaN();

PointMeasurement measure(MeasuredScene& scene, geo::LatLon place) {
    const auto point = measure_point(scene.sampler(), place);
    EXPECT_TRUE(point) << point.error().message;
    return point ? *point : PointMeasurement{};
}

std::optional<double> height(MeasuredScene& scene, double column, double row) {
    const auto H = scene.sampler().height({column, row});
    EXPECT_TRUE(H) << H.error().message;
    return H ? *H : std::nullopt;
}

TEST(MeasurePoint, IsThePostBitForBitAtEveryPost) {
    // Across block borders, and with steps that are no binary fractions.
    MeasuredScene scene(grid(-105 - 1.0 / 3, 37.1, 1.0 / 1200, 1030, 517), rough);
    std::mt19937 random(1);
    for (int i = 0; i < 3000; ++i) {
        const int column = static_cast<int>(random() % 1030);
        const int row = static_cast<int>(random() % 517);
        const auto place = scene.frame().lat_lon({static_cast<double>(column), static_cast<double>(row)});
        const auto point = measure(scene, place);
        ASSERT_TRUE(point.H) << column << ' ' << row;
        EXPECT_EQ(point.H->m, static_cast<double>(scene.heights().at(column, row)));
        EXPECT_EQ(point.kind, PointClass::land);
    }
    // Both within 1e-6 of a post and farther.
    EXPECT_EQ(height(scene, 100 + 9e-7, 50 - 9e-7), static_cast<double>(scene.heights().at(100, 50)));
    EXPECT_NE(height(scene, 100 + 2e-6, 50), static_cast<double>(scene.heights().at(100, 50)));
}

TEST(MeasurePoint, IsBilinearBetweenPosts) {
    MeasuredScene scene(grid(10, 50, 0.01, 700, 30), rough);
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> column(0, 699);
    std::uniform_real_distribution<double> row(0, 29);
    for (int i = 0; i < 3000; ++i) {
        const auto place = scene.frame().lat_lon({column(random), row(random)});
        const auto point = measure(scene, place);
        ASSERT_TRUE(point.H);
        EXPECT_NEAR(point.H->m, static_cast<double>(scene.brute_height(place)), 1e-7);
    }
}

TEST(MeasurePoint, APlaneIsAPlane) {
    const auto plane = [](double column, double row) { return 100 + 3 * column - 2 * row; };
    MeasuredScene scene(grid(10, 50, 0.01, 20, 30), plane);
    for (double column = 0; column <= 19; column += 0.37)
        for (double row = 0; row <= 29; row += 0.41)
            EXPECT_NEAR(height(scene, column, row).value_or(-1), plane(column, row), 1e-11);
}

TEST(MeasurePoint, ACellWithAVoidCornerIsVoid) {
    MeasuredScene scene(grid(10, 50, 0.01, 5, 5), [](int column, int row) {
        return column == 2 && row == 2 ? kVoid : 10.0 * column + row;
    });
    EXPECT_EQ(measure(scene, scene.frame().lat_lon({2, 2})).kind, PointClass::none);
    for (const double column : {1.5, 2.5})
        for (const double row : {1.001, 2.999}) EXPECT_FALSE(height(scene, column, row));
    EXPECT_FALSE(height(scene, 1.5, 2));  // an edge with a void end
    EXPECT_EQ(height(scene, 1, 1), 11);
    EXPECT_EQ(height(scene, 1, 1.5), 11.5);  // the border between a void cell and one with heights
    EXPECT_EQ(height(scene, 0.5, 1.5), 6.5);
    const auto point = measure(scene, scene.frame().lat_lon({1.5, 1.5}));
    EXPECT_EQ(point.kind, PointClass::none);
    EXPECT_FALSE(point.H || point.h);
}

TEST(MeasurePoint, OnlyTheDataIsInside) {
    MeasuredScene scene(grid(10, 50, 0.01, 5, 4), rough);
    for (const auto& [column, row] :
         {std::pair{-1e-5, 0.0}, {4 + 1e-5, 0.0}, {0.0, -1e-5}, {0.0, 3 + 1e-5}, {-100.0, 2.0}}) {
        const auto point = measure(scene, scene.frame().lat_lon({column, row}));
        EXPECT_EQ(point.kind, PointClass::outside);
        EXPECT_FALSE(point.H);
    }
    EXPECT_EQ(height(scene, -5e-7, 3 + 5e-7), static_cast<double>(scene.heights().at(0, 3)));
    EXPECT_EQ(measure(scene, lat_lon(-90, 0)).kind, PointClass::outside);
    EXPECT_EQ(measure(scene, lat_lon(90, 180)).kind, PointClass::outside);
}

/// The class is the nearest post's; filled and modelled is what any post of the height is.
TEST(MeasurePoint, SaysWhatThePostsAre) {
    const auto mark = [](int column, int row) {
        PostMark here(column >= 512 ? PostClass::sea : PostClass::land, 0);
        if (column == 100 && row == 10) here.set_filled();
        if (column >= 600) here.set_modelled();
        return here;
    };
    MeasuredScene scene(
        grid(10, 50, 0.01, 700, 30), [](int, int) { return -3; }, VerticalDatum::ellipsoid, {}, mark);
    const auto at = [&](double column, double row) {
        return measure(scene, scene.frame().lat_lon({column, row}));
    };
    EXPECT_EQ(at(511, 5).kind, PointClass::land);  // below 0, and no sea
    EXPECT_EQ(at(511.49, 5).kind, PointClass::land);
    EXPECT_EQ(at(511.51, 5.5).kind, PointClass::sea);  // over the border of two blocks
    EXPECT_EQ(at(512, 5).kind, PointClass::sea);
    EXPECT_EQ(at(512, 5).H->m, -3);
    for (const auto& [column, row] : {std::pair{100.0, 10.0}, {99.5, 10.0}, {100.7, 10.9}, {99.01, 9.01}}) {
        EXPECT_TRUE(at(column, row).filled) << column << ' ' << row;
        EXPECT_FALSE(at(column, row).modelled);
    }
    for (const auto& [column, row] : {std::pair{99.0, 10.0}, {98.9, 10.5}, {101.0, 10.0}, {100.0, 11.0}})
        EXPECT_FALSE(at(column, row).filled) << column << ' ' << row;
    EXPECT_TRUE(at(599.2, 3).modelled);
    EXPECT_FALSE(at(599, 3).modelled);
    EXPECT_FALSE(at(5, 5).source);  // the scene names no sources
}

TEST(MeasurePoint, SmallestScenes) {
    MeasuredScene one(grid(10, 50, 0.01, 1, 1), [](int, int) { return 7; });
    EXPECT_EQ(height(one, 0, 0), 7);
    EXPECT_FALSE(height(one, 0.01, 0));
    MeasuredScene column(grid(10, 50, 0.01, 1, 3), [](int, int row) { return row; });
    EXPECT_EQ(height(column, 0, 1.25), 1.25);
    EXPECT_FALSE(height(column, 0.1, 1.25));
    MeasuredScene row(grid(10, 50, 0.01, 3, 1), [](int c, int) { return c; });
    EXPECT_EQ(height(row, 1.75, 0), 1.75);
}

TEST(MeasurePoint, IsTheSameFromBothSidesOfTheAntimeridian) {
    MeasuredScene scene(grid(179, -16, 0.01, 201, 101), rough);
    for (const double lon : {179.995, 180.0, 180.005, 180.9}) {
        const auto east = measure(scene, lat_lon(-16.505, lon));
        const auto west = measure(scene, lat_lon(-16.505, lon - 360));
        ASSERT_TRUE(east.H && west.H);
        EXPECT_NEAR(east.H->m, west.H->m, 1e-7);
    }
    EXPECT_EQ(measure(scene, lat_lon(-16.5, 180)).H->m, static_cast<double>(scene.heights().at(100, 50)));
    EXPECT_EQ(measure(scene, lat_lon(-16.5, -180)).H->m, static_cast<double>(scene.heights().at(100, 50)));
}

TEST(MeasurePoint, WholeEarthHasNoSeam) {
    MeasuredScene scene(grid(-180, 90, 1, 361, 181),
                        [](int column, int row) { return rough(column % 360, row); });
    for (const double lon : {-180.0, 180.0, 540.0}) {
        const auto point = measure(scene, lat_lon(10.5, lon));
        ASSERT_TRUE(point.H);
        EXPECT_NEAR(point.H->m,
                    0.5 * static_cast<double>(scene.heights().at(0, 79) + scene.heights().at(0, 80)), 1e-4);
    }
    EXPECT_TRUE(measure(scene, lat_lon(90, 33)).H);
    EXPECT_TRUE(measure(scene, lat_lon(-90, -33)).H);
}

TEST(MeasurePoint, HeightsOverTheEllipsoid) {
    const auto geoid = geo::Geoid::egm96();
    ASSERT_TRUE(geoid) << geoid.error().message;
    const auto place = lat_lon(49.995, 10.005);
    const auto frame = grid(10, 50, 0.01, 5, 4);
    const auto nodes = geoid->nodes_around(frame.extent());
    {
        MeasuredScene scene(frame, rough, VerticalDatum::egm96, nodes);
        const auto point = measure_point(scene.sampler(), place);
        ASSERT_TRUE(point && point->H && point->h && point->N);
        EXPECT_NEAR(point->N->m, geoid->undulation(place).m, 1e-9);
        EXPECT_EQ(point->h->m, point->H->m + point->N->m);
        const auto outside = measure_point(scene.sampler(), lat_lon(0, 0));
        ASSERT_TRUE(outside);
        EXPECT_FALSE(outside->N || outside->H || outside->h);
    }
    {
        MeasuredScene scene(frame, rough, VerticalDatum::ellipsoid);
        const auto point = measure_point(scene.sampler(), place);
        ASSERT_TRUE(point && point->H && point->h && point->N);
        EXPECT_EQ(point->h->m, point->H->m);
        EXPECT_EQ(point->N->m, 0);
    }
    {
        MeasuredScene scene(frame, rough, VerticalDatum::other, nodes);  // EGM96, for its pictures
        const auto point = measure_point(scene.sampler(), place);
        ASSERT_TRUE(point && point->H);
        EXPECT_FALSE(point->h || point->N);
    }
}

TEST(MeasurePoint, ResolutionIsTheLargerSpacing) {
    MeasuredScene scene(grid(10, 60, 1.0 / 3600, 50, 50), rough);
    EXPECT_NEAR(measure(scene, scene.frame().lat_lon({3, 0})).resolution_m, 30.95,
                0.01);  // along the meridian
}

TEST(MeasurePoint, DamageIsAnErrorNotAHeight) {
    test::SceneFolder folder;
    test::SceneParts parts = test::made_up_scene(20, 20);
    ASSERT_TRUE(test::write_scene(parts, folder / "a.relevo"));
    const auto scene = Scene::open(folder / "a.relevo");
    ASSERT_TRUE(scene);
    const auto file = folder / "a.relevo" / scene->info().heights.front().file;
    std::string bytes = test::contents(file);
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
    std::filesystem::permissions(file, std::filesystem::perms::owner_write,
                                 std::filesystem::perm_options::add);
    test::replace(file, bytes);
    HeightSampler sampler(*scene);
    const auto H = sampler.height({3.5, 4.5});
    ASSERT_FALSE(H);
    EXPECT_EQ(H.error().kind, ErrorKind::damaged);
}

TEST(SourcePosition, IsThePlaceInTheSourcesCrs) {
    SourceInfo source;
    source.crs_wkt = "EPSG:32613";
    // The central meridian on the equator, and a corner by the formula of GeographicLib (to 1 mm).
    const auto middle = source_position(source, lat_lon(0, -105));
    ASSERT_TRUE(middle);
    EXPECT_NEAR(middle->x, 500000, 1e-6);
    EXPECT_NEAR(middle->y, 0, 1e-6);

    source.crs_wkt = "EPSG:4326";  // x is the longitude, whatever the axis order
    const auto same = source_position(source, lat_lon(37.5, -105.25));
    ASSERT_TRUE(same);
    EXPECT_EQ(same->x, -105.25);
    EXPECT_EQ(same->y, 37.5);

    source.crs_wkt = "EPSG:4326+5773";  // with heights
    EXPECT_TRUE(source_position(source, lat_lon(37.5, -105.25)));
    source.crs_wkt = "EPSG:4979";
    EXPECT_TRUE(source_position(source, lat_lon(37.5, -105.25)));
    source.crs_wkt = "no CRS at all";
    EXPECT_FALSE(source_position(source, lat_lon(37.5, -105.25)));
}

}  // namespace
}  // namespace relevo::lod
