#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "output/mesh_file.hpp"
#include "output/post_box.hpp"

namespace relevo::output {

struct MeshRequest {
    MeshFormat format = MeshFormat::ply;
    double max_error_m = 0;
    Coordinates coordinates = Coordinates::enu;
    Heights heights = Heights::datum;
    std::optional<Bounds> bounds;  ///< none: the whole scene
    std::uint64_t memory_bytes = std::uint64_t{1} << 30;
    std::filesystem::path path;
    bool overwrite = false;
    std::string generator;                 ///< name and version of the program, for the file
    std::function<bool(double)> progress;  ///< told the part done, 0 to 1; false stops it
};

/// What came of it. Seconds are wall time.
struct ExportedMesh {
    lod::BlockGrid::Box box;
    lod::MeshError error;  ///< measured, by height or in space (docs/export.md)
    std::uint64_t triangles = 0;
    std::uint64_t vertices = 0;
    std::uint64_t bytes = 0;
    double read_s = 0;
    double mesh_s = 0;     ///< from heights in memory: errors, vertices and triangles
    double measure_s = 0;  ///< every post against the triangles
    double write_s = 0;
    nlohmann::ordered_json about;  ///< what the file says of itself
};

/// A mesh of a scene within a stated error, in a file. Fails with ErrorKind::usage where the request cannot
/// be met (the box, the name, the memory), ErrorKind::input where the box has no cell of four valid posts or
/// VertexPlaces refuses, ErrorKind::damaged where the scene is.
Result<ExportedMesh> export_mesh(const lod::Scene& scene, const MeshRequest& request);

}  // namespace relevo::output
