#pragma once

#include <functional>
#include <string>

#include "output/partial_file.hpp"
#include "output/vertex_places.hpp"
#include <nlohmann/json.hpp>

#include "lod/static_mesh/static_mesh.hpp"

namespace relevo::output {

/// A mesh on its way into a file.
struct MeshFile {
    const lod::StaticMesh& mesh;
    const lod::Raster<float>& heights;
    const VertexPlaces& places;
    nlohmann::ordered_json about;          ///< what the file says of itself: one level of keys
    std::function<bool(double)> progress;  ///< told the part done, 0 to 1; false stops the export
};

enum class MeshFormat { ply, glb, obj };

// The writers, one file each. Vertices are numbered as the mesh does, triangles counter-clockwise seen from
// above. What they write is the same on any number of threads. All fail as PartialFile and VertexPlaces do.

/// Binary little-endian PLY: coordinates as doubles; `about` as comments.
Result<void> write_ply(const MeshFile& from, PartialFile& file);

/// Binary glTF 2.0: floats relative to VertexPlaces::origin(), which stands in asset.extras with all of
/// `about`. A node turns z up into glTF's y up. Fails with ErrorKind::usage beyond the format's 4 GiB.
Result<void> write_glb(const MeshFile& from, PartialFile& file);

/// Wavefront OBJ: text, every number to the last bit; `about` as comments.
Result<void> write_obj(const MeshFile& from, PartialFile& file);

Result<void> write_mesh(MeshFormat format, const MeshFile& from, PartialFile& file);

}  // namespace relevo::output
