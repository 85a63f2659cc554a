#include "lod/soar/refiner.hpp"

#include <cmath>
#include <limits>
#include <set>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "lod/mesh_checks.hpp"
#include "lod/oracle.hpp"
#include "lod/sample_views.hpp"
#include "tests/lod/synthetic_terrain.hpp"

namespace relevo::lod {
namespace {

/// The families of trouble that a terrain's heights can be.
struct Ground {
    const char* name;
    double (*height)(int, int);
    double north = 36;
    double west = 138;
    double step = 1.0 / 3600;
    int columns = 129;
    int rows = 129;
};

void PrintTo(const Ground& ground, std::ostream* out) {
    *out << ground.name;
}

double salt_flat(int, int) {
    return 1280;
}
double plane(int c, int r) {
    return 400 + 3 * c - 2 * r;
}
double spike(int c, int r) {
    return c == 77 && r == 50 ? 8000 : 0;
}
double cliff(int c, int r) {
    return c + r > 120 ? 900 : 0;
}
double checkerboard(int c, int r) {
    return (c + r) % 2 == 0 ? 100 : 0;
}
double with_voids(int c, int r) {
    return std::hypot(c - 40, r - 70) < 25 || (c > 100 && r < 50) ? std::nan("") : test::mountains(c, r);
}
double one_post(int c, int r) {
    return c == 60 && r == 60 ? 100 : std::nan("");
}

const Ground kGrounds[] = {
    {"mountains", test::mountains},
    {"salt_flat", salt_flat},
    {"plane", plane},
    {"spike", spike},
    {"cliff", cliff},
    {"checkerboard", checkerboard},
    {"with_voids", with_voids},
    {"padded", test::mountains, 36, 138, 1.0 / 3600, 150, 70},
    {"high_latitude", test::mountains, 83.95, 10, 1.0 / 1200},
    {"antimeridian", test::mountains, 45, 179.98, 1.0 / 1200},
    {"equator", test::mountains, 0.03, -0.02, 1.0 / 1200},
    {"coarse", test::mountains, 30, 10, 0.1},
};

Terrain make(const Ground& g, ErrorMetric metric = ErrorMetric::bounded) {
    const auto frame = test::geographic_frame(g.columns, g.rows, g.north, g.west, g.step);
    return test::make_terrain(frame, test::make_heights(frame, g.height), metric);
}

class RefinerTest : public testing::TestWithParam<Ground> {};

// The guarantee: the measured error is at most tau, with the morph and without, culled or not, and nothing is
// missing.
TEST_P(RefinerTest, MeasuredErrorIsAtMostTau) {
    const Terrain terrain = make(GetParam());
    Refiner refiner(terrain);
    for (const Camera& camera : sample_views(terrain, 30, 7, 200, 120)) {
        const View view(camera);
        for (const double tau : {0.5, 2.0, 8.0}) {
            for (const bool morph : {false, true}) {
                const Mesh& mesh = **refiner.refine_whole(view, {.tau_px = tau, .morph = morph});
                const auto error = measure_error(terrain, view, mesh);
                if (!error) continue;
                EXPECT_LE(error->max_px, tau) << "pitch " << camera.pitch.value << " h " << camera.eye.h.m;
                EXPECT_EQ(error->uncovered_posts, 0u);
            }
        }
    }
}

TEST_P(RefinerTest, MeasuredErrorIsAtMostTauWhenExaggerated) {
    const Terrain terrain = make(GetParam());
    Refiner refiner(terrain);
    for (const double exaggeration : {0.0, 0.5, 5.0}) {
        for (const Camera& camera : sample_views(terrain, 12, 11, 160, 100)) {
            const View view(camera);
            const Mesh& mesh =
                **refiner.refine_whole(view, {.tau_px = 1, .morph = true, .exaggeration = exaggeration});
            const auto error = measure_error(terrain, view, mesh, exaggeration);
            if (!error) continue;
            EXPECT_LE(error->max_px, 1) << "exaggeration " << exaggeration;
            EXPECT_EQ(error->uncovered_posts, 0u);
        }
    }
}

TEST_P(RefinerTest, HasNoCracks) {
    for (const ErrorMetric metric : {ErrorMetric::bounded, ErrorMetric::incremental}) {
        const Terrain terrain = make(GetParam(), metric);
        Refiner refiner(terrain);
        for (const Camera& camera : sample_views(terrain, 30, 3, 640, 360)) {
            for (const bool cull : {false, true}) {
                for (const bool morph : {false, true}) {
                    const Mesh& mesh =
                        **refiner.refine_whole(View(camera), {.tau_px = 1.5, .morph = morph, .cull = cull});
                    EXPECT_EQ(count_t_vertices(mesh), 0);
                    EXPECT_EQ(count_torn_posts(mesh), 0);
                }
            }
        }
    }
}

// What culling leaves out is not in the picture, and what it leaves is the same mesh.
TEST_P(RefinerTest, CullingTakesTrianglesAwayAndChangesNone) {
    const Terrain terrain = make(GetParam());
    Refiner refiner(terrain);
    using Key = std::array<float, 9>;
    const auto triangles = [](const Mesh& mesh) {
        std::set<Key> result;
        for (std::size_t t = 0; t < mesh.triangles(); ++t) {
            Key key{};
            for (std::size_t k = 0; k < 3; ++k) {
                const MeshVertex& v = mesh.vertices[mesh.indices[3 * t + k]];
                key[3 * k] = v.x, key[3 * k + 1] = v.y, key[3 * k + 2] = v.z;
            }
            result.insert(key);
        }
        return result;
    };
    for (const Camera& camera : sample_views(terrain, 10, 5, 640, 360)) {
        const View view(camera);
        const auto all = triangles(**refiner.refine_whole(view, {.tau_px = 2, .cull = false}));
        const auto kept = triangles(**refiner.refine_whole(view, {.tau_px = 2, .cull = true}));
        EXPECT_TRUE(std::includes(all.begin(), all.end(), kept.begin(), kept.end()));
        for (const Key& key : all) {
            if (kept.contains(key)) continue;
            // Outside: all three corners beyond one side plane, or none of them in the picture.
            int corners_seen = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                corners_seen +=
                    view.sees({static_cast<double>(key[3 * k]), static_cast<double>(key[3 * k + 1]),
                               static_cast<double>(key[3 * k + 2])});
            }
            EXPECT_EQ(corners_seen, 0);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Grounds, RefinerTest, testing::ValuesIn(kGrounds),
                         [](const auto& ground) { return ground.param.name; });

TEST(Refiner, DrawsNothingWhereNothingIsValid) {
    const Terrain terrain = make({"", one_post});
    Refiner refiner(terrain);
    Camera camera;
    camera.eye = test::above(terrain, 60, 60, 100);
    camera.pitch = geo::Degrees{-90};
    const Mesh& mesh = **refiner.refine_whole(View(camera), {.tau_px = 0.1});
    EXPECT_LE(mesh.triangles(), 40u) << "around the one post alone";
}

TEST(Refiner, DrawsNoPadding) {
    const Terrain terrain = make({"", test::mountains, 36, 138, 1.0 / 3600, 150, 70});
    Refiner refiner(terrain);
    Camera camera;
    camera.eye = test::above(terrain, 140, 60, 500);
    camera.pitch = geo::Degrees{-60};
    const Mesh& mesh = **refiner.refine_whole(View(camera), {.tau_px = 0.5, .cull = false});
    for (std::size_t t = 0; t < mesh.triangles(); ++t) {
        int left = 1 << 20;
        int top = 1 << 20;
        for (std::size_t k = 0; k < 3; ++k) {
            left = std::min<int>(left, mesh.vertices[mesh.indices[3 * t + k]].column);
            top = std::min<int>(top, mesh.vertices[mesh.indices[3 * t + k]].row);
        }
        EXPECT_LT(left, 149);
        EXPECT_LT(top, 69);
    }
}

// Nothing under tau: a salt flat close by needs a handful of triangles, and with tau so small that every
// vertex is drawn, every cell is.
TEST(Refiner, TauDecidesHowMuchIsDrawn) {
    const Terrain flat = make({"", salt_flat});
    Camera camera;
    camera.eye = test::above(flat, 64, 64, 2000);
    camera.pitch = geo::Degrees{-90};
    Refiner refiner(flat);
    EXPECT_LE((**refiner.refine_whole(View(camera), {.tau_px = 1, .cull = false})).triangles(), 40u);

    const Terrain rough = make({"", test::mountains});
    Refiner rough_refiner(rough);
    camera.eye = test::above(rough, 64, 64, 100);
    EXPECT_EQ(rough_refiner.refine(View(camera), {.tau_px = 1e-7, .cull = false}).triangles(),
              2u * 128 * 128);
}

/// The drawn surface at every post, relative to ECEF's origin, by interpolation in the mesh.
std::vector<glm::dvec3> surface(const Terrain& terrain, const View& view, const Mesh& mesh) {
    const auto side = static_cast<std::size_t>(terrain.frame().columns);
    std::vector<glm::dvec3> points(side * static_cast<std::size_t>(terrain.frame().rows));
    for (std::size_t t = 0; t < mesh.triangles(); ++t) {
        std::array<MeshVertex, 3> v;
        for (std::size_t k = 0; k < 3; ++k) v[k] = mesh.vertices[mesh.indices[3 * t + k]];
        const auto cross = [](int ax, int ay, int bx, int by) { return ax * by - ay * bx; };
        const auto [left, right] = std::minmax({v[0].column, v[1].column, v[2].column});
        const auto [top, bottom] = std::minmax({v[0].row, v[1].row, v[2].row});
        const double area = cross(v[1].column - v[0].column, v[1].row - v[0].row, v[2].column - v[0].column,
                                  v[2].row - v[0].row);
        for (int row = top; row <= std::min<int>(bottom, terrain.frame().rows - 1); ++row) {
            for (int column = left; column <= std::min<int>(right, terrain.frame().columns - 1); ++column) {
                glm::dvec3 sum(0);
                bool inside = true;
                for (std::size_t k = 0; k < 3; ++k) {
                    const MeshVertex& a = v[(k + 1) % 3];
                    const MeshVertex& b = v[(k + 2) % 3];
                    const double w =
                        cross(b.column - a.column, b.row - a.row, column - a.column, row - a.row) / area;
                    inside = inside && w >= 0;
                    sum += w * glm::dvec3(static_cast<double>(v[k].x), static_cast<double>(v[k].y),
                                          static_cast<double>(v[k].z));
                }
                if (inside)
                    points[static_cast<std::size_t>(row) * side + static_cast<std::size_t>(column)] =
                        view.eye().m + sum;
            }
        }
    }
    return points;
}

// A tau beyond the picture's size: once every triangle of the ground was drawn there, as the picture had been
// widened by tau for what moves into it.
TEST(Refiner, MoreToleranceNeverTakesMoreTriangles) {
    const Terrain terrain = make({"", test::mountains, 36, 138, 1.0 / 3600, 129, 129});
    Refiner refiner(terrain);
    Camera camera;
    camera.eye = test::above(terrain, 64, 120, 3000);
    camera.pitch = geo::Degrees{-20};
    camera.width = 320;
    camera.height = 180;
    const View view(camera);
    std::size_t least = std::numeric_limits<std::size_t>::max();
    for (double tau = 0.25; tau < 1e7; tau *= 4) {
        const Mesh& mesh = **refiner.refine_whole(view, {.tau_px = tau, .morph = false});
        EXPECT_LE(mesh.triangles(), least) << "tau " << tau;
        least = mesh.triangles();
        const auto error = measure_error(terrain, view, mesh);
        ASSERT_TRUE(error);
        EXPECT_LE(error->max_px, tau);
    }
    EXPECT_LT(least, 100);
}

// Must show: no height jumps along a flight of 1000 steps of 1 m. With the morph the largest change of the
// surface between steps is bounded: a vertex of error delta comes in over a band of distances lambda delta (1
// / tau_min - 1 / tau_max), so that a step of 1 m moves it by at most its surplus over that band; without it
// the surface jumps.
TEST(Refiner, SurfaceMovesContinuouslyAlongAFlight) {
    const Terrain terrain = make({"", test::mountains, 36, 138, 1.0 / 3600, 65, 65});
    Refiner refiner(terrain);
    double largest[2] = {0, 0};
    for (const bool morph : {false, true}) {
        std::vector<glm::dvec3> before;
        for (int step = 0; step < 1000; ++step) {
            Camera camera;
            camera.eye = test::above(terrain, 5, 5, 1500);
            const geo::EnuFrame start(camera.eye);
            camera.eye = geo::to_geodetic(start.to_ecef({glm::dvec3(step, -step, 0)}));
            camera.height = 360;
            camera.width = 640;
            const View view(camera);
            const auto now = surface(
                terrain, view, **refiner.refine_whole(view, {.tau_px = 8, .morph = morph, .cull = false}));
            for (std::size_t i = 0; i < before.size(); ++i) {
                largest[morph] = std::max(largest[morph], glm::distance(now[i], before[i]));
            }
            before = now;
        }
    }
    const double lambda = View(Camera{}).error_scale().lambda_px / 2;  // a picture half as high
    const double steepest = std::sqrt(2.0) * 2 * 8 / lambda;           // metres a metre of flight, a vertex
    RecordProperty("largest_change_morph_m", std::to_string(largest[1]));
    RecordProperty("largest_change_step_m", std::to_string(largest[0]));
    EXPECT_LT(largest[1], 12 * steepest) << "a chain of at most 12 levels";
    EXPECT_GT(largest[0], 4 * largest[1]) << "the test sees jumps where there are some";
}

// Must show: jitter. A camera that moves by 1 mm moves every projected vertex by what geometry says, within
// 0.01 px.
TEST(Refiner, OneMillimetreMovesThePictureSmoothly) {
    struct Place {
        double lat, lon;
    };
    for (const Place place : {Place{0, 0}, {83.9, 0}, {45, 179.999}}) {
        const double step = 1.0 / 3600;
        const auto frame =
            test::geographic_frame(129, 129, place.lat + 64 * step, place.lon - 64 * step, step);
        const Terrain terrain = test::make_terrain(frame, test::make_heights(frame, test::mountains));
        Refiner refiner(terrain);
        TruePosts::Reader posts(terrain.posts());
        for (const double above : {2.0, 2000.0}) {
            Camera camera;
            camera.eye = test::above(terrain, 64, 64, above);
            camera.pitch = geo::Degrees{above < 10 ? -10.0 : -60.0};
            const geo::EnuFrame local(camera.eye);
            glm::dvec2 worst(0);
            for (int step_mm = 0; step_mm <= 20; ++step_mm) {
                camera.eye =
                    geo::to_geodetic(local.to_ecef({glm::dvec3(0.001 * step_mm, 0.0005 * step_mm, 0)}));
                const View view(camera);
                const Mesh& mesh = **refiner.refine_whole(view, {.tau_px = 1, .morph = false});
                for (const MeshVertex& v : mesh.vertices) {
                    const glm::dvec3 drawn(static_cast<double>(v.x), static_cast<double>(v.y),
                                           static_cast<double>(v.z));
                    // What geometry says: GeographicLib's position of the post, all in double.
                    const glm::dvec3 truth =
                        frame.ecef({static_cast<double>(v.column), static_cast<double>(v.row)},
                                   {static_cast<double>(posts.H(v.column, v.row))}) -
                        view.eye();
                    if (!view.sees(truth) || view.depth(drawn) <= 0) continue;
                    worst = glm::max(worst, glm::abs(view.pixel(drawn) - view.pixel(truth)));
                }
            }
            EXPECT_LT(worst.x, 0.005) << place.lat << ' ' << above;
            EXPECT_LT(worst.y, 0.005) << place.lat << ' ' << above;
        }
    }
}

}  // namespace
}  // namespace relevo::lod
