#include "output/export_mesh.hpp"

#include <chrono>
#include <limits>

#include <fmt/format.h>

namespace relevo::output {
namespace {

class Stopwatch {
  public:
    /// Seconds since the last lap.
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        return std::chrono::duration<double>(now - std::exchange(start_, now)).count();
    }

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

constexpr std::uint64_t kMiB = std::uint64_t{1} << 20;
/// The program with its libraries, blocks that are being read, triangles that wait, pieces of the file, N of
/// the scene: measured, 90 to 190 MiB.
constexpr std::uint64_t kFixed = 256 * kMiB;

Result<void> check_memory(const MeshRequest& request, const lod::BlockGrid::Box& box) {
    const auto posts = static_cast<std::uint64_t>(box.columns) * static_cast<std::uint64_t>(box.rows);
    const std::uint64_t needed =
        kFixed + posts * sizeof(float) + lod::StaticMesh::memory_bytes(box.columns, box.rows);
    if (needed <= request.memory_bytes) return {};
    return Error{
        ErrorKind::usage,
        fmt::format("{} x {} posts take {} MiB of memory, and --memory allows {}: allow {}MiB, or export "
                    "the scene in parts with --bounds",
                    box.columns, box.rows, (needed + kMiB - 1) / kMiB, request.memory_bytes / kMiB,
                    (needed + kMiB - 1) / kMiB)};
}

nlohmann::ordered_json about(const lod::Scene& scene, const MeshRequest& request,
                             const lod::BlockGrid::Box& box, const VertexPlaces& places,
                             const lod::MeshError& error) {
    const lod::SceneInfo& info = scene.info();
    const geo::GridFrame::Extent extent = frame_of(info.frame, box).extent();
    nlohmann::ordered_json json;
    json["generator"] = request.generator;
    json["scene"] = scene.path().filename().string();
    json["coordinates"] = to_string(request.coordinates);
    json["axes"] = places.axes();
    json["crs"] =
        places.crs().empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(places.crs());
    if (request.coordinates == Coordinates::enu) {
        const geo::LatLon origin = places.enu_origin();
        json["origin"] = {{"lat", origin.lat.value}, {"lon", origin.lon.value}, {"h_m", 0}};
    }
    json["vertical_datum"] = places.vertical_datum();
    json["vertical_assumed"] = info.vertical.assumed;
    json["extent"] = {
        {"west", extent.west}, {"south", extent.south}, {"east", extent.east}, {"north", extent.north}};
    json["columns"] = box.columns;
    json["rows"] = box.rows;
    json["requested_error_m"] = request.max_error_m;
    json["max_error_m"] = error.max_m;
    json["rms_error_m"] = error.rms_m;
    const bool in_space = request.coordinates == Coordinates::ecef || request.coordinates == Coordinates::enu;
    json["error"] = in_space ? "in space" : "vertical";
    json["measured_posts"] = error.posts;
    return json;
}

/// Makes, measures and writes the mesh with a surface of either kind.
template <class Surface>
Result<void> make(const lod::Scene& scene, const MeshRequest& request, const Surface& surface,
                  const VertexPlaces& places, PartialFile& file, ExportedMesh& exported) {
    Stopwatch watch;
    const lod::StaticMesh mesh = lod::StaticMesh::build(surface, request.max_error_m);
    exported.mesh_s = watch.lap();
    exported.triangles = mesh.triangles();
    exported.vertices = mesh.vertices();
    if (mesh.triangles() == 0) {
        return Error{ErrorKind::input,
                     fmt::format("{}: no cell there has four valid posts: there is no ground to "
                                 "make a mesh of",
                                 scene.path().string())};
    }
    if (mesh.vertices() > std::numeric_limits<std::uint32_t>::max()) {
        return Error{ErrorKind::usage,
                     "more vertices than 32 bits count: allow a larger --max-error, or export "
                     "the scene in parts with --bounds"};
    }
    exported.error = mesh.measure(surface);
    exported.measure_s = watch.lap();
    const bool kept =
        exported.error.max_m <= request.max_error_m && exported.error.posts == mesh.posts_to_cover();
    if (!kept) {
        return Error{
            ErrorKind::internal,
            fmt::format("the mesh errs by {} m, and covers {} of {} posts: this is a defect of Relevo",
                        exported.error.max_m, exported.error.posts, mesh.posts_to_cover())};
    }
    exported.about = about(scene, request, exported.box, places, exported.error);
    const MeshFile from{mesh, surface.heights(), places, exported.about, request.progress};
    if (auto done = write_mesh(request.format, from, file); !done) return done;
    exported.bytes = file.bytes();
    if (auto done = file.take(); !done) return done;
    exported.write_s = watch.lap();
    return {};
}

}  // namespace

Result<ExportedMesh> export_mesh(const lod::Scene& scene, const MeshRequest& request) {
    const geo::GridFrame& frame = scene.info().frame;
    ExportedMesh exported;
    exported.box = {0, 0, frame.columns, frame.rows};
    if (request.bounds) {
        const auto box = posts_around(frame, *request.bounds);
        if (!box) return box.error();
        exported.box = *box;
    }
    if (auto fits = check_memory(request, exported.box); !fits) return fits.error();
    auto file = PartialFile::create(request.path, request.overwrite);
    if (!file) return file.error();
    const auto places = VertexPlaces::create(scene, exported.box, request.coordinates, request.heights);
    if (!places) return places.error();
    Stopwatch watch;
    const auto heights = read_box(scene, exported.box);
    if (!heights) return heights.error();
    exported.read_s = watch.lap();

    Result<void> done;
    if (request.coordinates == Coordinates::ecef || request.coordinates == Coordinates::enu) {
        const lod::SpaceSurface surface(*heights, frame, places->undulations(), exported.box.column,
                                        exported.box.row);
        done = make(scene, request, surface, *places, *file, exported);
    } else {
        done = make(scene, request, lod::HeightSurface(*heights), *places, *file, exported);
    }
    if (!done) return done.error();
    return exported;
}

}  // namespace relevo::output
