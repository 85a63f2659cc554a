// Mesh files read back by other code, and their coordinates against PROJ's.

#include "tests/output/mesh_files.hpp"

#include <cmath>
#include <map>
#include <memory>
#include <numbers>

#include "output/export_mesh.hpp"
#include <proj.h>

#include "tests/lod/measured_scene.hpp"
#include "tests/lod/synthetic_terrain.hpp"

namespace relevo::test {
namespace {

using output::Coordinates;
using output::MeshFormat;
using Place = std::array<double, 3>;

constexpr int kColumns = 70;
constexpr int kRows = 45;

geo::GridFrame frame_of_test() {
    return {geo::FrameKind::geographic, 10.1, 46.9, 0.002, 0.001, kColumns, kRows};
}

double ground(int column, int row) {
    return row == 20 && column > 30 && column < 34 ? std::nan("") : mountains(column, row);
}

/// A coordinate operation of PROJ's, from (lon, lat, h).
class Proj {
  public:
    Proj(const char* from, const char* to)
        : context_(proj_context_create(), proj_context_destroy), pj_(nullptr, proj_destroy) {
        PJ* const raw = proj_create_crs_to_crs(context_.get(), from, to, nullptr);
        pj_.reset(proj_normalize_for_visualization(context_.get(), raw));
        proj_destroy(raw);
    }
    explicit Proj(const std::string& pipeline)
        : context_(proj_context_create(), proj_context_destroy),
          pj_(proj_create(context_.get(), pipeline.c_str()), proj_destroy) {}

    Place operator()(const Place& p) const {
        const PJ_COORD there = proj_trans(pj_.get(), PJ_FWD, proj_coord(p[0], p[1], p[2], HUGE_VAL));
        return {there.xyz.x, there.xyz.y, there.xyz.z};
    }

  private:
    std::unique_ptr<PJ_CONTEXT, decltype(&proj_context_destroy)> context_;
    std::unique_ptr<PJ, decltype(&proj_destroy)> pj_;
};

class MeshFiles : public testing::Test {
  protected:
    output::ExportedMesh write(const lod::Scene& scene, const std::string& name, Coordinates coordinates,
                               double max_error = 15, std::optional<output::Bounds> bounds = {}) {
        output::MeshRequest request;
        request.format = name.ends_with(".ply")   ? MeshFormat::ply
                         : name.ends_with(".glb") ? MeshFormat::glb
                                                  : MeshFormat::obj;
        request.max_error_m = max_error;
        request.coordinates = coordinates;
        request.bounds = bounds;
        request.path = folder / name;
        request.overwrite = true;
        request.generator = "a test";
        request.progress = [](double) { return true; };
        const auto exported = output::export_mesh(scene, request);
        EXPECT_TRUE(exported) << exported.error().message;
        return exported ? *exported : output::ExportedMesh{};
    }

    /// Places of the vertices on the grid, by the mesh in degrees, which numbers them the same.
    std::vector<Place> degrees(const lod::Scene& scene, double max_error = 15) {
        write(scene, "degrees.ply", Coordinates::geodetic, max_error);
        return read_ply(folder / "degrees.ply").vertices;
    }

    SceneFolder folder;
    MeasuredScene made{frame_of_test(), ground};
};

TEST_F(MeshFiles, GeodeticVerticesArePostsWithTheirHeights) {
    const auto exported = write(made.scene(), "a.ply", Coordinates::geodetic);
    const ReadMesh mesh = read_ply(folder / "a.ply");
    EXPECT_EQ(mesh.vertices.size(), exported.vertices);
    EXPECT_EQ(mesh.triangles.size(), exported.triangles);
    EXPECT_LT(mesh.vertices.size(), 2000u);
    int last = -1;
    for (const Place& p : mesh.vertices) {
        const auto column = static_cast<int>(std::lround((p[0] - 10.1) / 0.002));
        const auto row = static_cast<int>(std::lround((46.9 - p[1]) / 0.001));
        ASSERT_TRUE(column >= 0 && column < kColumns && row >= 0 && row < kRows);
        EXPECT_NEAR(p[0], 10.1 + column * 0.002, 1e-12);
        EXPECT_NEAR(p[1], 46.9 - row * 0.001, 1e-12);
        EXPECT_EQ(p[2], static_cast<double>(made.heights().at(column, row)));
        EXPECT_GT(row * kColumns + column, last);
        last = row * kColumns + column;
    }
}

/// The error in the file's own terms: its triangles against all posts, and its edges.
TEST_F(MeshFiles, TheFileKeepsTheErrorItStates) {
    const auto exported = write(made.scene(), "a.ply", Coordinates::geodetic);
    const ReadMesh mesh = read_ply(folder / "a.ply");
    double worst = 0;
    std::map<std::pair<int, int>, bool> covered;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const auto& t : mesh.triangles) {
        std::array<Place, 3> p;
        for (std::size_t i = 0; i < 3; ++i) {
            ASSERT_LT(t[i], mesh.vertices.size());
            p[i] = mesh.vertices[t[i]];
            p[i] = {std::round((p[i][0] - 10.1) / 0.002), std::round((p[i][1] - 46.9) / 0.001), p[i][2]};
            EXPECT_EQ(++edges[std::pair(t[i], t[(i + 1) % 3])], 1);
        }
        const auto area = [](const Place& a, const Place& b, const Place& c) {
            return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
        };
        const double whole = area(p[0], p[1], p[2]);
        ASSERT_GT(whole, 0) << "not counter-clockwise from above";
        for (int row = 0; row < kRows; ++row) {
            for (int column = 0; column < kColumns; ++column) {
                const Place post{1.0 * column, -1.0 * row, 0};
                const double u = area(post, p[1], p[2]);
                const double v = area(post, p[2], p[0]);
                const double w = area(post, p[0], p[1]);
                if (u < 0 || v < 0 || w < 0) continue;
                covered[{column, row}] = true;
                const double drawn = (u * p[0][2] + v * p[1][2] + w * p[2][2]) / whole;
                worst =
                    std::max(worst, std::abs(drawn - static_cast<double>(made.heights().at(column, row))));
            }
        }
    }
    EXPECT_EQ(covered.size(), static_cast<std::size_t>(kColumns * kRows - 3));
    EXPECT_LE(worst, 15);
    EXPECT_NEAR(worst, exported.error.max_m, 1e-9);
    EXPECT_NE(mesh.about.find(fmt::format("max_error_m: {}", exported.error.max_m)), std::string::npos)
        << mesh.about;
    EXPECT_NE(mesh.about.find("vertical_datum: WGS 84 ellipsoid"), std::string::npos) << mesh.about;
}

TEST_F(MeshFiles, AllFormatsHoldTheSameMesh) {
    for (const auto coordinates : {Coordinates::geodetic, Coordinates::ecef, Coordinates::enu}) {
        write(made.scene(), "a.ply", coordinates);
        write(made.scene(), "a.obj", coordinates);
        write(made.scene(), "a.glb", coordinates);
        const ReadMesh ply = read_ply(folder / "a.ply");
        const ReadMesh obj = read_obj(folder / "a.obj");
        const ReadMesh glb = read_glb(folder / "a.glb");
        EXPECT_GT(ply.triangles.size(), 100u);
        EXPECT_EQ(ply.triangles, obj.triangles);
        EXPECT_EQ(ply.triangles, glb.triangles);
        EXPECT_EQ(ply.vertices, obj.vertices);  // to the last bit
        ASSERT_EQ(ply.vertices.size(), glb.vertices.size());
        const double rounding = nlohmann::json::parse(glb.about)["position_rounding"].get<double>();
        EXPECT_LT(rounding, 1e-3);
        for (std::size_t i = 0; i < ply.vertices.size(); ++i) {
            for (std::size_t k = 0; k < 3; ++k)
                EXPECT_LE(std::abs(glb.vertices[i][k] - ply.vertices[i][k]), rounding + 1e-9);
        }
    }
}

TEST_F(MeshFiles, GltfIsYUp) {
    write(made.scene(), "a.glb", Coordinates::enu);
    const std::string bytes = contents(folder / "a.glb");
    const auto json = nlohmann::json::parse(bytes.substr(20, number_at<std::uint32_t>(bytes, 12)));
    const auto q = json["nodes"][0]["rotation"].get<std::array<double, 4>>();
    // z, our up, turned by the quaternion: v + 2 w (u x v) + 2 u x (u x v).
    const glm::dvec3 u{q[0], q[1], q[2]};
    const glm::dvec3 up{0, 0, 1};
    const glm::dvec3 turned = up + 2 * q[3] * glm::cross(u, up) + 2.0 * glm::cross(u, glm::cross(u, up));
    EXPECT_NEAR(turned.x, 0, 1e-12);
    EXPECT_NEAR(turned.y, 1, 1e-12);
    EXPECT_NEAR(turned.z, 0, 1e-12);
}

TEST_F(MeshFiles, EcefAndEnuAreProjs) {
    write(made.scene(), "ecef.ply", Coordinates::ecef, 0);
    write(made.scene(), "enu.ply", Coordinates::enu, 0);
    const auto places = degrees(made.scene(), 0);
    const ReadMesh ecef = read_ply(folder / "ecef.ply");
    const ReadMesh enu = read_ply(folder / "enu.ply");
    ASSERT_EQ(ecef.vertices.size(), places.size());
    ASSERT_EQ(enu.vertices.size(), places.size());
    const Proj to_ecef("EPSG:4979", "EPSG:4978");
    const Proj to_enu(
        fmt::format("+proj=pipeline +step +proj=unitconvert +xy_in=deg +xy_out=rad +step +proj=cart "
                    "+ellps=WGS84 +step +proj=topocentric +ellps=WGS84 +lon_0={} +lat_0={} +h_0=0",
                    10.1 + 0.002 * 0.5 * (kColumns - 1), 46.9 - 0.001 * 0.5 * (kRows - 1)));
    for (std::size_t i = 0; i < places.size(); ++i) {
        const Place there = to_ecef(places[i]);
        const Place local = to_enu(places[i]);
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_NEAR(ecef.vertices[i][k], there[k], 2e-8);
            EXPECT_NEAR(enu.vertices[i][k], local[k], 2e-8);
        }
    }
    EXPECT_NE(enu.about.find("\"h_m\":0"), std::string::npos) << enu.about;
    EXPECT_NE(ecef.about.find("crs: EPSG:4978"), std::string::npos) << ecef.about;
}

TEST_F(MeshFiles, SourceCoordinatesAreProjs) {
    SceneParts parts = made_up_scene(40, 30);
    parts.info.sources[0].crs = "EPSG:32613";
    parts.info.sources[0].crs_wkt = "EPSG:32613";
    parts.info.sources[0].step_unit = "metre";
    ASSERT_TRUE(write_scene(parts, folder / "utm.relevo"));
    const auto scene = lod::Scene::open(folder / "utm.relevo");
    ASSERT_TRUE(scene);
    write(*scene, "a.ply", Coordinates::source, 1);
    const auto places = degrees(*scene, 1);
    const ReadMesh mesh = read_ply(folder / "a.ply");
    EXPECT_NE(mesh.about.find("crs: EPSG:32613"), std::string::npos) << mesh.about;
    ASSERT_EQ(mesh.vertices.size(), places.size());
    EXPECT_GT(places.size(), 10u);
    const Proj utm("EPSG:4326", "EPSG:32613");
    for (std::size_t i = 0; i < places.size(); ++i) {
        const Place there = utm({places[i][0], places[i][1], 0});
        EXPECT_NEAR(mesh.vertices[i][0], there[0], 1e-6);
        EXPECT_NEAR(mesh.vertices[i][1], there[1], 1e-6);
        EXPECT_EQ(mesh.vertices[i][2], places[i][2]);
    }
}

/// h = H + N: heights above the ellipsoid differ from H by the geoid, in all coordinates that hold them.
TEST_F(MeshFiles, HeightsAboveTheEllipsoidHoldTheGeoid) {
    SceneParts parts = made_up_scene(40, 30);
    for (int row = 0; row < 30; ++row)  // no plane anywhere: every post is a vertex
        for (int column = 0; column < 40; ++column)
            parts.heights.at(column, row) = static_cast<float>(rough(column, row));
    parts.info.void_posts = 0;
    parts.info.valid_posts = 40 * 30;
    ASSERT_TRUE(write_scene(parts, folder / "egm96.relevo"));
    const auto scene = lod::Scene::open(folder / "egm96.relevo");
    ASSERT_TRUE(scene);
    ASSERT_NE(scene->geoid(), nullptr);
    const auto places = degrees(*scene, 0);
    write(*scene, "ecef.ply", Coordinates::ecef, 0);
    const ReadMesh ecef = read_ply(folder / "ecef.ply");
    ASSERT_EQ(ecef.vertices.size(), places.size());
    const Proj to_ecef("EPSG:4979", "EPSG:4978");
    for (std::size_t i = 0; i < places.size(); ++i) {
        const auto& [lon, lat, H] = places[i];
        const double N = scene->geoid()->undulation({geo::Degrees{lat}, geo::Degrees{lon}}).m;
        const Place there = to_ecef({lon, lat, H + N});
        for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(ecef.vertices[i][k], there[k], 1.1e-4);
    }
    output::MeshRequest request;
    request.coordinates = Coordinates::geodetic;
    request.heights = output::Heights::ellipsoid;
    request.path = folder / "h.ply";
    request.progress = [](double) { return true; };
    ASSERT_TRUE(output::export_mesh(*scene, request));
    const ReadMesh mesh = read_ply(folder / "h.ply");
    ASSERT_EQ(mesh.vertices.size(), places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        const double N =
            scene->geoid()->undulation({geo::Degrees{places[i][1]}, geo::Degrees{places[i][0]}}).m;
        EXPECT_NEAR(mesh.vertices[i][2], places[i][2] + N, 1.1e-4);
    }
    EXPECT_NE(mesh.about.find("h_m"), std::string::npos) << mesh.about;
}

TEST_F(MeshFiles, AHeightWithoutAGeoidHasNoPlaceInSpace) {
    const MeasuredScene other(grid(10, 47, 0.01, 9, 9), mountains, lod::VerticalDatum::other);
    for (const auto coordinates : {Coordinates::ecef, Coordinates::enu}) {
        output::MeshRequest request;
        request.coordinates = coordinates;
        request.path = folder / "a.ply";
        const auto refused = output::export_mesh(other.scene(), request);
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().kind, ErrorKind::input);
        EXPECT_NE(refused.error().message.find("--geoid"), std::string::npos) << refused.error().message;
    }
    write(other.scene(), "a.ply", Coordinates::geodetic);
    EXPECT_FALSE(read_ply(folder / "a.ply").triangles.empty());
}

TEST_F(MeshFiles, StoppingLeavesNothing) {
    output::MeshRequest request;
    request.path = folder / "a.ply";
    request.progress = [](double) { return false; };
    EXPECT_FALSE(output::export_mesh(made.scene(), request));
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
        EXPECT_EQ(entry.path().filename(), "a.relevo");  // the scene itself
}

}  // namespace
}  // namespace relevo::test
