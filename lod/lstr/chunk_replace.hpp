#pragma once

#include <string>
#include <vector>

#include "geo/result.hpp"
#include "lod/lstr/chunk_mesh.hpp"
#include "lod/scene/scene.hpp"
#include "lod/terrain.hpp"

namespace relevo::lod {

/// A node's geometry for other programs: vertices at posts of the padded grid, heights in metres.
struct ChunkGeometry {
    struct Vertex {
        GridPoint at;
        float H = 0;
    };
    std::vector<Vertex> vertices;
    std::vector<IndexTriangle> triangles;  ///< counter-clockwise seen from above
};

/// Wavefront OBJ: `v COLUMN ROW H` and `f A B C`, nothing else. Rows grow southwards.
std::string to_obj(const ChunkGeometry& geometry);
/// Fails with ErrorKind::input. \param name  of the file, for the message
Result<ChunkGeometry> from_obj(const std::string& text, const std::string& name);

/// Puts another geometry in a node's place: one that covers its square and has the same vertices on its
/// sides, so that all its neighbours still fit. Its error is measured; it and its children move to and from
/// it. Nothing is changed where it fails. \return  the error, metres
Result<double> replace_chunk(const Scene& scene, const Terrain& terrain, const ChunkId& id,
                             const ChunkGeometry& geometry);

}  // namespace relevo::lod
