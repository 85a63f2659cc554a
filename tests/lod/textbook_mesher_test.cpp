#include "lod/textbook/textbook_mesher.hpp"

#include <array>
#include <cstdlib>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "lod/mesh_checks.hpp"
#include "lod/oracle.hpp"
#include "tests/lod/scratch_scene.hpp"
#include "tests/lod/synthetic_terrain.hpp"

namespace relevo::lod {
namespace {

class TextbookOnAScene : public testing::Test {
  protected:
    /// A scene of mountains above the ellipsoid. \param columns, rows  129: no padding
    void make(int columns, int rows) {
        test::SceneParts parts;
        frame_ = test::geographic_frame(columns, rows);
        parts.heights = test::make_heights(frame_, test::mountains);
        parts.metrics = build_metrics(frame_, {}, parts.heights);
        parts.info.frame = frame_;
        parts.info.vertical = {VerticalDatum::ellipsoid, "WGS 84 ellipsoid", false};
        parts.info.height_max_m = 4000;
        parts.info.valid_posts = parts.heights.samples().size();
        parts.info.resampling_method = "none";
        const auto written = test::write_scene(parts, folder_ / "a.relevo");
        ASSERT_TRUE(written) << written.error().message;
        const auto scene = Scene::open(folder_ / "a.relevo");
        ASSERT_TRUE(scene) << scene.error().message;
        auto made = TextbookMesher::create(*scene, 1);
        ASSERT_TRUE(made) << made.error().message;
        mesher_.emplace(std::move(*made));
        auto terrain = Terrain::open(*scene, ErrorMetric::bounded, {.threads = 0, .fade_s = 0});
        ASSERT_TRUE(terrain) << terrain.error().message;
        terrain_.emplace(std::move(*terrain));
    }

    Camera camera(double column, double row, double h, double heading, double pitch) const {
        const geo::LatLon place = frame_.lat_lon({column, row});
        return {.eye = {place.lat, place.lon, {h}},
                .heading = geo::Degrees{heading},
                .pitch = geo::Degrees{pitch},
                .roll = {},
                .fov = geo::Degrees{60},
                .width = 320,
                .height = 180};
    }

    const Mesh& mesh(const Camera& c, double tau_px) {
        const View view(c);
        mesher_->refine(view, {c.eye.h.m}, tau_px);
        return mesher_->mesh(view);
    }

    test::SceneFolder folder_;
    geo::GridFrame frame_;
    std::optional<TextbookMesher> mesher_;
    std::optional<Terrain> terrain_;
};

/// Twice the area in the grid; positive where the corners go round as seen from above (rows run down).
long turning(const Mesh& mesh, std::size_t k) {
    const MeshVertex& a = mesh.vertices[mesh.indices[k]];
    const MeshVertex& b = mesh.vertices[mesh.indices[k + 1]];
    const MeshVertex& c = mesh.vertices[mesh.indices[k + 2]];
    return -((b.column - a.column) * (c.row - a.row) - (b.row - a.row) * (c.column - a.column));
}

/// Is a triangle one of the bisection's: half of a square or a quarter of one?
bool is_right_isosceles(const Mesh& mesh, std::size_t k) {
    std::array<long, 3> sides{};
    for (std::size_t i = 0; i < 3; ++i) {
        const MeshVertex& p = mesh.vertices[mesh.indices[k + i]];
        const MeshVertex& q = mesh.vertices[mesh.indices[k + (i + 1) % 3]];
        const long x = q.column - p.column;
        const long y = q.row - p.row;
        sides[i] = x * x + y * y;
    }
    std::sort(sides.begin(), sides.end());
    return sides[0] == sides[1] && sides[2] == 2 * sides[0];
}

TEST_F(TextbookOnAScene, SeesEverythingAsATriangulationOfTheGrid) {
    make(129, 129);
    for (const double tau : {0.001, 0.05, 0.5, 5.0}) {
        const Mesh& made = mesh(camera(64, 64, 20000, 0, -90), tau);
        long area = 0;
        for (std::size_t k = 0; k < made.indices.size(); k += 3) {
            EXPECT_TRUE(is_right_isosceles(made, k)) << "tau " << tau << " triangle " << k / 3;
            EXPECT_GT(turning(made, k), 0) << "tau " << tau << " triangle " << k / 3;
            area += turning(made, k);
        }
        EXPECT_EQ(area, 2 * 128 * 128) << "tau " << tau;
        EXPECT_EQ(count_t_vertices(made), 0);
        EXPECT_EQ(count_torn_posts(made), 0);
    }
    EXPECT_EQ(mesh(camera(64, 64, 20000, 0, -90), 1e-6).triangles(), 2u * 128 * 128);
}

TEST_F(TextbookOnAScene, ItsPostsAreWhereTheTerrainHasThem) {
    make(100, 70);
    const Camera c = camera(50, 80, 4000, 10, -25);
    const Mesh& made = mesh(c, 0.5);
    const View view(c);
    ASSERT_GT(made.triangles(), 100u);
    for (const MeshVertex& v : made.vertices) {
        if (v.column >= frame_.columns || v.row >= frame_.rows) continue;
        const glm::dvec3 truth = terrain_->position(v.column, v.row, 1) - view.eye().m;
        EXPECT_LT(glm::distance(glm::dvec3(static_cast<double>(v.x), static_cast<double>(v.y),
                                           static_cast<double>(v.z)),
                                truth),
                  1e-6 * glm::length(truth) + 1e-6);
    }
}

// Its culling may leave triangles at the picture's edges unrefined, and its error is an estimate: but of the
// right size.
TEST_F(TextbookOnAScene, ItsErrorIsOfTheSizeOfTau) {
    make(129, 129);
    for (const double tau : {0.25, 1.0, 4.0}) {
        for (const double heading : {0.0, 45.0, 200.0}) {
            const Camera c = camera(64, 64, 3500, heading, -30);
            const auto error = measure_error(*terrain_, View(c), mesh(c, tau));
            ASSERT_TRUE(error);
            EXPECT_LT(error->rms_px, tau) << tau << " heading " << heading;
            EXPECT_LT(error->p99_px, 3 * tau) << tau << " heading " << heading;
            EXPECT_GT(error->max_px, 0.1 * tau) << tau << " heading " << heading;
        }
    }
}

}  // namespace
}  // namespace relevo::lod
