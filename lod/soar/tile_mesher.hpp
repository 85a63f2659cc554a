#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include <glm/vec3.hpp>

#include "geo/post_positions.hpp"
#include "lod/level_bounds.hpp"
#include "lod/mesh.hpp"
#include "lod/soar/level_tables.hpp"
#include "lod/tiles/tile_store.hpp"

namespace relevo::lod {

/// What a frame asks of every vertex, whatever tile it is in.
struct FrameTest {
    glm::dvec3 eye;                    // ECEF
    std::array<glm::dvec3, 4> planes;  // of the picture's sides, through the eye
    double exaggeration = 1;
    double reach = 0;  // times the error, plus the radius: the distance within which a vertex is drawn
    double lambda_px = 0;
    double kappa = 0;
    double tau_min_px = 0;
    double view_distance_m = std::numeric_limits<double>::infinity();
    bool cull = true;     // leave out what is outside the picture
    bool morph = false;   // vertices move in by their errors
    bool moving = false;  // some vertices are not at their exact places: the morph's, or those fading in
};

/// Where tiles lie.
struct TileGround {
    const TileGrid& grid;
    const geo::PostPositions& positions;
    const LevelTables& tables;
    const std::vector<LevelBound>& bounds;  // by vertex level
};

/// A mesh vertex while its descendants are made: where it is and where it is drawn, relative to the eye.
struct PlacedVertex {
    glm::dvec3 exact;
    glm::dvec3 drawn;
};

/// Where meshers put what they make. Vertices are numbered over all meshers of a frame.
struct MeshOutput {
    MeshVertex* vertices = nullptr;
    PlacedVertex* placed = nullptr;  // not written where nothing moves
    std::uint32_t next_vertex = 0;
    std::uint32_t* next_index = nullptr;
};

/// The most that one tile adds.
inline constexpr std::size_t kMostTileVertices = 3 * 32 * 32 + 2 * 32 + 4;
inline constexpr std::size_t kMostTileIndices = 3 * 2 * 64 * 64;

/// Refines one tile. Keeps which of its posts are in the mesh, for its children.
///
/// A vertex of the hierarchy can be in the mesh where its parents are. Of a tile these are: for the centre of
/// a square of 2 x 2 cells two of the square's corners, which are older; for the middle of a side the centres
/// on both of its sides. So a row of squares needs nothing but the bits of the rows above and below, and
/// candidates are looked at by fours. A triangle is written where the vertex that would split it is *not*
/// drawn.
class TileMesher {
  public:
    static constexpr int kMostSquares = TileGrid::kCells / 2;

    /// Mesh vertices at the corners of the squares, and which of them are in the mesh.
    struct Corners {
        std::array<std::uint32_t, (kMostSquares + 1) * (kMostSquares + 1)> vertex;
        std::array<std::uint64_t, kMostSquares + 1> here;
    };
    Corners corners;

    /// The parts of a tile that go on in its children, by row and column; a tile with one child has one.
    using Quarters = std::array<bool, 4>;

    /// Makes the tile's vertices and tells which quarters have sides that are split, so that a finer tile has
    /// to say what becomes of their halves. \pre the corners are set
    Quarters place_vertices(const FrameTest& test, const TileStore::Resident& resident,
                            const TileGround& ground, unsigned inside, MeshOutput& out);

    /// Writes the triangles that end here: those that are not split, and in the quarters that do not go on
    /// both halves of those that are.
    void write_triangles(const TileGrid& grid, const Quarters& goes_on, MeshOutput& out) const;

    /// The corners of a child's squares. \pre place_vertices was called
    void hand_down(const TileGrid& grid, int quarter, Corners& child) const;

  private:
    /// Of a row of squares, for which of them the two corners that are their centre's parents are in the
    /// mesh.
    struct Parents {
        std::uint64_t first;   // of falling squares the north-east corner, else the north-west one
        std::uint64_t second;  // the south-west one, else the south-east one
    };
    Parents parents_of_centres(int row) const {
        // The diagonal of a falling square, which its centre splits, runs from its north-west to its
        // south-east corner: where column and row are both even or both odd.
        constexpr std::uint64_t even = 0x5555555555555555;
        const std::uint64_t falling = row % 2 == 0 ? even : ~even;
        const std::uint64_t above = corners.here[static_cast<std::size_t>(row)];
        const std::uint64_t below = corners.here[static_cast<std::size_t>(row) + 1];
        return {((above >> 1) & falling) | (above & ~falling), (below & falling) | ((below >> 1) & ~falling)};
    }

    TileId id_;
    int squares_ = 0;
    // Mesh vertices, with room for groups of four beyond the last.
    std::array<std::uint32_t, kMostSquares * kMostSquares + 3> centre_;
    std::array<std::uint32_t, (kMostSquares + 1) * kMostSquares + 3> across_;
    std::array<std::uint32_t, kMostSquares*(kMostSquares + 1) + 3> down_;
    // Bits: the vertex is in the mesh; the vertex would be seen, drawn or not.
    std::array<std::uint64_t, kMostSquares> centre_here_, centre_seen_;
    std::array<std::uint64_t, kMostSquares + 1> across_here_, across_seen_;
    std::array<std::uint64_t, kMostSquares> down_here_, down_seen_;
};

}  // namespace relevo::lod
