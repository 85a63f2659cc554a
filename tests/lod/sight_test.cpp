#include "lod/measure/sight.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <glm/geometric.hpp>

#include "lod/measure/sight_line.hpp"
#include "lod/measure/viewshed.hpp"
#include "tests/lod/measured_scene.hpp"
#include "tests/lod/synthetic_terrain.hpp"

namespace relevo::lod {
namespace {

using test::grid;
using test::lat_lon;
using test::MeasuredScene;
using test::rough;

constexpr double kVoid = std::numeric_limits<double>::quiet_NaN();

/// Height over the ellipsoid of the chord in space between two places, where it is over a place near it.
double chord_height(geo::LatLon a, double h_a, geo::LatLon b, double h_b, double distance) {
    const auto from = geo::to_ecef({a.lat, a.lon, {h_a}}).m;
    const auto to = geo::to_ecef({b.lat, b.lon, {h_b}}).m;
    double low = 0;
    double high = 1;
    for (int i = 0; i < 60; ++i) {  // the point of the chord whose foot is that far along
        const double t = 0.5 * (low + high);
        const auto foot = geo::to_geodetic({from + t * (to - from)});
        (geo::geodesic(a, {foot.lat, foot.lon}).length_m < distance ? low : high) = t;
    }
    return geo::to_geodetic({from + low * (to - from)}).h.m;
}

TEST(SightLine, WithoutAirIsTheChordInSpace) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> any(0, 1);
    double worst = 0;
    for (int i = 0; i < 200; ++i) {
        const auto a = lat_lon(-85 + 170 * any(random), 360 * any(random));
        const auto b = geo::geodesic_destination(a, geo::Degrees{360 * any(random)}, 1e5);
        const double h_a = 5000 * any(random);
        const double h_b = 5000 * any(random);
        const geo::GeodesicPath path(a, b);
        const SightLine sight(path.length_m(), mean_curvature(path), 0, h_a, h_b);
        EXPECT_NEAR(sight.height(0), h_a, 1e-8);
        EXPECT_NEAR(sight.height(path.length_m()), h_b, 1e-8);
        for (const double part : {0.1, 0.5, 0.8}) {
            const double s = part * path.length_m();
            const double off = sight.height(s) - chord_height(a, h_a, b, h_b, s);
            worst = std::max(worst, std::abs(off));
        }
    }
    EXPECT_LT(worst, 0.02);  // the claim of sight_line.hpp
    RecordProperty("worst_m", std::to_string(worst));
}

TEST(SightLine, AirBendsItByK) {
    const auto a = lat_lon(45, 7);
    const auto b = geo::geodesic_destination(a, geo::Degrees{30}, 2e4);
    const geo::GeodesicPath path(a, b);
    const double curvature = mean_curvature(path);
    const SightLine straight(2e4, curvature, 0, 100, 100);
    const SightLine bent(2e4, curvature, 0.13, 100, 100);
    // The sagitta of the arc of curvature k/R over the chord: s (S - s) k / 2R.
    EXPECT_NEAR(bent.height(8000) - straight.height(8000), 8000 * 12000 * 0.13 * curvature / 2, 1e-4);
    EXPECT_NEAR(straight.height(1e4), 100 - 1e8 * curvature / 2, 2e-3);
    const SightLine flat(2e4, curvature, 1 - 1e-12, 100, 300);
    EXPECT_NEAR(flat.height(5000), 150, 1e-6);
}

TEST(Sight, OverTheRoundSea) {
    // Two heights see each other as far as the dips of both reach.
    MeasuredScene scene(grid(0, 46, 0.01, 200, 100), [](int, int) { return 0; });
    const auto eye = lat_lon(45.5, 0.1);
    const double radius = 6378137;
    for (const double k : {0.0, 0.13}) {
        const double reach = std::sqrt(2 * radius / (1 - k) * 50) + std::sqrt(2 * radius / (1 - k) * 20);
        for (const double part : {0.985, 1.015}) {
            const auto target = geo::geodesic_destination(eye, geo::Degrees{90}, part * reach);
            const auto sight = measure_sight(scene.sampler(), eye, target, {50, 20, k});
            ASSERT_TRUE(sight) << sight.error().message;
            ASSERT_TRUE(sight->visible);
            EXPECT_EQ(*sight->visible, part < 1) << k;
            EXPECT_EQ(sight->first_blocked.has_value(), part > 1);
            if (part < 1) {
                // Nearest to the sea at the middle of the dips.
                ASSERT_TRUE(sight->least_clearance);
                EXPECT_NEAR(sight->least_clearance->distance_m / (part * reach),
                            std::sqrt(50.0) / (std::sqrt(50.0) + std::sqrt(20.0)), 0.01);
            } else {
                EXPECT_NEAR(sight->first_blocked->clearance_m, 0, 1e-5);
                EXPECT_LT(sight->worst->clearance_m, -0.1);
            }
        }
    }
}

TEST(Sight, AWallBetweenPostsIsNotMissed) {
    // One ridge along a column; the line runs to just above and just below it, between posts.
    MeasuredScene scene(grid(0, 0.02, 0.001, 41, 41), [](int column, int) { return column == 20 ? 100 : 0; });
    const auto at = [&](double column, double row) { return scene.frame().lat_lon({column, row}); };
    const auto eye = at(5.3, 20.4);
    const auto target = at(35.1, 12.7);
    const geo::GeodesicPath path(eye, target);
    const SightLine level(path.length_m(), mean_curvature(path), 0.13, 100, 100);
    const double part = (20 - 5.3) / (35.1 - 5.3);
    const double sag = 100 - level.height(part * path.length_m());
    for (const double above : {-0.01, 0.01}) {
        const auto sight =
            measure_sight(scene.sampler(), eye, target, {100 + sag + above, 100 + sag + above, 0.13});
        ASSERT_TRUE(sight && sight->visible);
        EXPECT_EQ(*sight->visible, above > 0);
        const auto& nearest = above > 0 ? sight->least_clearance : sight->worst;
        ASSERT_TRUE(nearest);
        EXPECT_NEAR(nearest->clearance_m, above, 1e-3);
        EXPECT_NEAR(nearest->H_m, 100, 1e-6);
        EXPECT_NEAR(nearest->distance_m, part * path.length_m(), 0.5);
    }
}

/// By another way: marching in space, heights in long double.
double least_clearance_marched(const MeasuredScene& scene, geo::LatLon eye, geo::LatLon target,
                               const Looking& looking, int steps) {
    const geo::GeodesicPath path(eye, target);
    const double curvature = mean_curvature(path) * (1 - looking.refraction);
    const double h0 = static_cast<double>(scene.brute_height(eye)) + looking.eye_height_m;
    const double h1 = static_cast<double>(scene.brute_height(target)) + looking.target_height_m;
    const long double R = 1 / static_cast<long double>(curvature);
    const long double P = path.length_m() / R;
    double least = 1e9;
    for (int i = 0; i <= steps; ++i) {
        const double s = path.length_m() * i / steps;
        // Two points of a plane and the ray between them.
        const long double p = s / R;
        const long double x1 = (R + h1) * std::sin(P);
        const long double y1 = (R + h1) * std::cos(P);
        const long double r = (x1 * (R + h0)) / (x1 * std::cos(p) - (y1 - (R + h0)) * std::sin(p));
        least = std::min(least, static_cast<double>(r - R - scene.brute_height(path.at(s))));
    }
    return least;
}

TEST(Sight, EqualsMarching) {
    MeasuredScene scene(grid(10, 50, 0.001, 80, 80),
                        [](int column, int row) { return 0.02 * rough(column, row); });
    std::mt19937_64 random(12);
    std::uniform_real_distribution<double> any(1, 78);
    std::uniform_real_distribution<double> high(0, 18);
    int seen = 0;
    for (int i = 0; i < 60; ++i) {
        const auto eye = scene.frame().lat_lon({any(random), any(random)});
        const auto target = scene.frame().lat_lon({any(random), any(random)});
        const Looking looking{high(random), high(random), 0.13};
        const auto sight = measure_sight(scene.sampler(), eye, target, looking);
        ASSERT_TRUE(sight && sight->visible);
        const double least = least_clearance_marched(scene, eye, target, looking, 20000);
        if (std::abs(least) < 0.05) continue;  // marching steps over it
        EXPECT_EQ(*sight->visible, least > 0) << i;
        if (sight->worst) {
            EXPECT_NEAR(sight->worst->clearance_m, least, 0.05);
            EXPECT_LE(sight->worst->clearance_m, least + 1e-6);
            EXPECT_LE(sight->first_blocked->distance_m, sight->worst->distance_m);
            EXPECT_NEAR(sight->first_blocked->clearance_m, 0, 1e-5);
        }
        // The other way round it is the same.
        const auto back = measure_sight(scene.sampler(), target, eye,
                                        {looking.target_height_m, looking.eye_height_m, looking.refraction});
        EXPECT_EQ(*back->visible, *sight->visible);
        if (sight->worst) {
            EXPECT_NEAR(back->worst->clearance_m, sight->worst->clearance_m, 1e-4);
        }
        seen += *sight->visible ? 1 : 0;
    }
    EXPECT_GT(seen, 10);
    EXPECT_LT(seen, 50);
}

TEST(Sight, UnknownIsNotVisible) {
    MeasuredScene scene(grid(0, 0.05, 0.01, 20, 11),
                        [](int column, int row) { return column == 10 && row == 5 ? kVoid : 100.0; });
    const auto at = [&](double column, double row) { return scene.frame().lat_lon({column, row}); };
    const auto over_void = measure_sight(scene.sampler(), at(7, 5.2), at(13, 5.2), {50, 50, 0.13});
    ASSERT_TRUE(over_void);
    EXPECT_FALSE(over_void->visible);
    EXPECT_NEAR(over_void->unknown_m, 2 * 1113.2, 1);
    const auto from_void = measure_sight(scene.sampler(), at(10, 5), at(13, 5.2), {50, 50, 0.13});
    ASSERT_TRUE(from_void);
    EXPECT_FALSE(from_void->visible || from_void->eye_H_m);
    const auto to_outside = measure_sight(scene.sampler(), at(7, 5), at(30, 5.2), {50, 50, 0.13});
    EXPECT_FALSE(to_outside->visible || to_outside->target_H_m);
    EXPECT_EQ(measure_sight(scene.sampler(), at(7, 5), at(8, 5), {-1, 0, 0.13}).error().kind,
              ErrorKind::usage);
    EXPECT_EQ(measure_sight(scene.sampler(), at(7, 5), at(8, 5), {1, 0, 1}).error().kind, ErrorKind::usage);
    const auto here = measure_sight(scene.sampler(), at(3, 3), at(3, 3), {});
    ASSERT_TRUE(here && here->visible);
    EXPECT_TRUE(*here->visible);
}

// --- Viewshed

/// Every post by its own line of sight.
void expect_oracle(MeasuredScene& scene, geo::LatLon eye, const ViewshedRequest& request) {
    const auto shed = measure_viewshed(scene.sampler(), eye, request);
    ASSERT_TRUE(shed) << shed.error().message;
    const geo::GridFrame& frame = scene.frame();
    int differ = 0;
    int grazing = 0;
    std::array<std::uint64_t, 3> counts{};
    double visible = 0;
    for (int row = 0; row < frame.rows; ++row) {
        for (int column = 0; column < frame.columns; ++column) {
            const geo::GridPosition at{column + 0.0, row + 0.0};
            const auto place = frame.lat_lon(at);
            const int x = column - shed->box.column;
            const int y = row - shed->box.row;
            const bool in_box = x >= 0 && y >= 0 && x < shed->box.columns && y < shed->box.rows;
            const int seen = in_box ? int{shed->posts.at(x, y)} : int{Viewshed::none};
            const bool is_void = std::isnan(scene.heights().at(column, row));
            if (is_void || geo::geodesic(eye, place).length_m > request.radius_m) {
                EXPECT_EQ(seen, Viewshed::none);
                continue;
            }
            const auto sight = measure_sight(scene.sampler(), eye, place, request.looking);
            ASSERT_TRUE(sight);
            int expected = Viewshed::unknown;
            if (sight->visible) expected = *sight->visible ? Viewshed::visible : Viewshed::hidden;
            // The claim of viewshed.hpp: lines are within 1e-3 posts, over slopes up to 110 m a post here.
            const auto& nearest = sight->worst ? sight->worst : sight->least_clearance;
            const bool grazes = nearest && std::abs(nearest->clearance_m) < 0.11;
            grazing += seen != expected && grazes ? 1 : 0;
            differ += seen == expected || grazes ? 0 : 1;
            ++counts[static_cast<std::size_t>(seen)];
            const auto spacing = frame.spacing(at);
            if (seen == Viewshed::visible) visible += spacing.column_m * spacing.row_m;
        }
    }
    EXPECT_EQ(differ, 0);
    EXPECT_LE(grazing, 1);
    EXPECT_EQ(counts[0], shed->hidden_posts);
    EXPECT_EQ(counts[1], shed->visible_posts);
    EXPECT_EQ(counts[2], shed->unknown_posts);
    EXPECT_GT(counts[1], 10u);
    EXPECT_NEAR(shed->visible_m2 / visible, 1, 1e-12);
}

TEST(Viewshed, EqualsALineOfSightToEveryPost) {
    const auto hills = [](int column, int row) {
        return 300 * std::sin(column * 0.21) * std::cos(row * 0.17) + 0.05 * rough(column, row);
    };
    {
        MeasuredScene scene(grid(10, 50, 0.001, 70, 60), hills);
        expect_oracle(scene, scene.frame().lat_lon({33.3, 28.8}), {{1.7, 0, 0.13}, 2500, {}});
        expect_oracle(scene, scene.frame().lat_lon({12, 40}), {{30, 10, 0}, 1e5, {}});       // on a post
        expect_oracle(scene, scene.frame().lat_lon({68.5, 0.5}), {{2, 2, 0.13}, 3000, {}});  // in the corner
    }
    {
        MeasuredScene scene(grid(179.97, -16, 0.001, 60, 50), [&](int column, int row) {
            return column > 40 && column < 44 && row < 20 ? kVoid : hills(column, row);
        });
        expect_oracle(scene, lat_lon(-16.02, -179.999), {{20, 0, 0.13}, 4000, {}});
    }
    {
        MeasuredScene scene(test::polar_frame(geo::FrameKind::ups_north, 60, 50, 90, 1000, -300), hills);
        expect_oracle(scene, scene.frame().lat_lon({20.5, 31}), {{5, 0, 0.13}, 3000, {}});
    }
    {
        MeasuredScene scene(grid(10, 60, 0.05, 60, 50), hills);  // coarse: the earth is round in it
        expect_oracle(scene, scene.frame().lat_lon({30.4, 25.1}), {{400, 0, 0.13}, 9e4, {}});
    }
}

TEST(Viewshed, SaysWhatIsWrong) {
    MeasuredScene scene(grid(10, 50, 0.001, 70, 60), rough);
    const auto kind = [&](geo::LatLon eye, double radius) {
        return measure_viewshed(scene.sampler(), eye, {{}, radius, {}}).error().kind;
    };
    EXPECT_EQ(kind(lat_lon(0, 0), 100), ErrorKind::usage);
    EXPECT_EQ(kind(lat_lon(49.99, 10.02), 0), ErrorKind::usage);
    EXPECT_EQ(kind(lat_lon(49.99, 10.02), NAN), ErrorKind::usage);
    const auto stopped =
        measure_viewshed(scene.sampler(), lat_lon(49.99, 10.02), {{}, 100, [](double) { return false; }});
    EXPECT_EQ(stopped.error().kind, ErrorKind::internal);
}

}  // namespace
}  // namespace relevo::lod
