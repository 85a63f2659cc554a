#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "geo/result.hpp"
#include "lod/lstr/chunk_seams.hpp"
#include "lod/lstr/chunk_set.hpp"
#include "lod/lstr/fixed_frame.hpp"
#include "lod/pyramid/block_cache.hpp"
#include "lod/pyramid/pyramid.hpp"
#include "lod/terrain.hpp"

namespace relevo::lod {

/// A node ready to be drawn.
struct PlacedChunk {
    struct Vertex {
        glm::ivec3 at{0};  ///< in the group's fixed frame
        float rise_m = 0;  ///< to the coarser level, along the ellipsoid's normal
        std::uint16_t column = 0;
        std::uint16_t row = 0;
    };
    std::vector<Vertex> vertices;
    std::shared_ptr<const std::vector<IndexTriangle>> triangles;  ///< leaves share theirs
    std::array<std::vector<SideVertex>, kSides> sides;
    std::vector<SeamEdge> seams;  ///< none for leaves, which have no finer neighbours
    glm::dvec3 middle{0};         ///< of a sphere around all that it draws, ECEF
    double radius_m = 0;

    bool is_in(const View& view) const;
    double distance_m(const glm::dvec3& eye) const;
};

/// The four children of a node: what is loaded and let go together. Those without data have no vertices.
struct ChunkGroup {
    std::array<PlacedChunk, 4> children;
    std::uint64_t bytes = 0;
};

/// Loads groups. May be used from several threads.
class ChunkGroups {
  public:
    /// Both must outlive this.
    ChunkGroups(const Terrain& terrain, const ChunkSet& chunks, double exaggeration);

    const FixedFrame& frame() const { return frame_; }

    /// The root is the only child of a node that is not there: (top + 1, 0, 0).
    Result<ChunkGroup> load(const ChunkId& parent) const;

    /// About how large a group is that has not been loaded.
    std::uint64_t bytes(const ChunkId& parent) const;

  private:
    Result<ChunkGroup> leaves(const ChunkId& parent) const;
    PlacedChunk placed(const ChunkMesh& mesh) const;
    PlacedChunk leaf(const ChunkId& id, const Raster<float>& block, const CoarseSurface* coarse) const;
    void add(PlacedChunk& chunk, const ChunkVertex& vertex) const;

    const Terrain& terrain_;
    const ChunkSet& chunks_;
    double exaggeration_;
    FixedFrame frame_;
    std::shared_ptr<const std::vector<IndexTriangle>> leaf_triangles_;
    mutable BlockCache<PyramidBlock, BlockHeights> blocks_;
};

}  // namespace relevo::lod
