#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#include <glm/vec3.hpp>

#include "lod/soar/bits.hpp"
#include "lod/soar/four.hpp"
#include "lod/soar/tile_mesher.hpp"

namespace relevo::lod {

/// Vertices of a tile that are looked at together, in rows: the centres of its squares, or the middles of
/// their sides along rows or along columns.
struct VertexRows {
    const Tile::Lanes* lanes;  // of the first row; the others follow
    int groups;                // in a row
    GridPoint first;           // in posts of the tile; the others follow at every second
    int rows;
    // By row, a bit a vertex.
    const Bits* candidates;
    const Bits* allowed;  // those whose parents are in the mesh
    Bits* here;           // to be filled: the vertex is in the mesh
    Bits* seen;           // it would be seen, drawn or not; only of candidates
    // To be filled: mesh vertices.
    std::uint32_t* vertex;
    int stride;
};

/// The mesh vertices at the ends of an edge.
struct Ends {
    std::uint32_t first;
    std::uint32_t second;
};

/// What makes the vertices of one tile. All of it is inlined, so that it becomes what its caller is compiled
/// for.
class VertexPlacing {
  public:
    VertexPlacing(const FrameTest& test, const TileGround& ground, const Tile& tile, unsigned inside,
                  MeshOutput& out)
        : test_(test),
          ground_(ground),
          first_(ground.grid.first_post(tile.id())),
          level_(tile.id().level),
          inside_(inside),
          out_(out) {}

    void set_bound(const LevelBound& bare) {
        const double share = std::abs(test_.exaggeration - 1);
        bare_error_ = share * bare.sag_m;
        bare_radius_ = share * bare.radius_m;
    }

    /// Looks at the candidates and puts those into the mesh that are allowed and needed.
    /// \param presence  of the vertex i in row k: how far it may have come in
    /// \param ends  (i, k): of the edge that the vertex splits
    template <class Presence, class EndsOf>
    RELEVO_INLINE void place(const VertexRows& rows, Presence presence, EndsOf ends) {
        const int count = list_groups(rows);
        std::fill_n(rows.here, rows.rows, Bits{0});
        std::fill_n(rows.seen, rows.rows, Bits{0});
        for (int n = 0; n < std::min(count, kAhead); ++n) prefetch(rows, n);

        const bool is_polar = ground_.positions.polar() != nullptr;
        const geo::PostPositions::Row* row_tables = nullptr;
        LevelTables::Columns columns{};
        if (!is_polar) {
            const int post = (first_.column >> level_) + rows.first.column;
            row_tables = &ground_.tables.row(level_, (first_.row >> level_) + rows.first.row);
            columns = rows.first.column == 0 ? ground_.tables.even_columns(level_, post)
                                             : ground_.tables.odd_columns(level_, post);
        }
        MeshVertex* const vertices = out_.vertices;
        std::uint32_t next = out_.next_vertex;
        for (int n = 0; n < count; ++n) {
            prefetch(rows, n + kAhead);
            const int k = listed_[n] / kMostGroups;
            const int group = listed_[n] % kMostGroups;
            const int grid_row = first_.row + ((rows.first.row + 2 * k) << level_);
            const Tile::Lanes& four = rows.lanes[k * rows.groups + group];
            const Four h = widened(four.N) + test_.exaggeration * widened(four.H);
            Four x, y, z;
            if (!is_polar) {
                const geo::PostPositions::Row& at = row_tables[2 * k];
                const Four from_axis = at.from_axis + h * at.cos_lat;
                x = from_axis * *reinterpret_cast<const FourDoubles*>(columns.cos_lon + 4 * group) -
                    test_.eye.x;
                y = from_axis * *reinterpret_cast<const FourDoubles*>(columns.sin_lon + 4 * group) -
                    test_.eye.y;
                z = (at.z - test_.eye.z) + h * at.sin_lat;
            } else {
                const Place& at = polar_place(grid_column(rows, 4 * group), grid_row, h);
                x = at.x;
                y = at.y;
                z = at.z;
            }
            const Four bare_radius = decoded(four.radius);
            const Four error = test_.exaggeration * decoded(four.error) + bare_error_;
            const Four radius = test_.exaggeration * bare_radius + bare_radius_;
            const Four distance2 = x * x + y * y + z * z;
            const Four within = test_.reach * error + radius;
            FourWhole seen_mask = bare_radius > 0.0;
            for (unsigned side = 0; side < 4; ++side) {
                if ((inside_ >> side & 1) != 0) continue;
                const glm::dvec3& plane = test_.planes[side];
                seen_mask &= plane.x * x + plane.y * y + plane.z * z <= radius;
            }
            const FourWhole here_mask = seen_mask & (error > 0.0) & (distance2 < within * within);
            const unsigned found = bits_of(seen_mask, here_mask);
            rows.seen[k] |= (found & rows.candidates[k] >> (4 * group) & 0xf) << (4 * group);
            const Bits here = found >> 4 & (rows.candidates[k] & rows.allowed[k]) >> (4 * group) & 0xf;
            rows.here[k] |= here << (4 * group);
            if (test_.moving) {
                Four t = {1, 1, 1, 1};
                if (test_.morph) {
                    // How far a vertex has come in, linear in 1 / rho, so that it needs no more than its
                    // distance.
                    const Four clearance = root(distance2) - radius - test_.kappa * error;
                    const Four part = 2.0 - 2 * test_.tau_min_px * clearance / (test_.lambda_px * error);
                    t = (clearance > 0.0) & (part < 1.0) ? part : t;
                }
                found_[n] = {x, y, z, t, here};
                continue;
            }
            // Without a branch, which would wait for all of the above each time that it was guessed wrong:
            // every vertex is written, and the next over it where it is not in the mesh.
            const FourVertices four_vertices = vertices_of(x, y, z, grid_column(rows, 4 * group), grid_row);
            std::uint32_t* const vertex = rows.vertex + k * rows.stride + 4 * group;
            for (int i = 0; i < 4; ++i) {
                std::memcpy(&vertices[next], &four_vertices.vertex[i], sizeof(MeshVertex));
                vertex[i] = next;
                next += static_cast<std::uint32_t>(here >> i & 1);
            }
        }
        if (test_.moving) {
            move_in(rows, count, presence, ends);
        } else {
            out_.next_vertex = next;
        }
    }

  private:
    static constexpr int kMostGroups = 16;  // in a row, for the list
    static constexpr int kAhead = 32;       // groups that are brought near: they lie all over memory

    /// Which groups hold candidates, row by row. Returns how many.
    RELEVO_INLINE int list_groups(const VertexRows& rows) {
        std::uint16_t* end = listed_;
        for (int k = 0; k < rows.rows; ++k) {
            end = list_byte(fours_with_any(static_cast<std::uint32_t>(rows.candidates[k])), kMostGroups * k,
                            end);
            // The 33rd vertex of a row.
            *end = static_cast<std::uint16_t>(kMostGroups * k + 8);
            end += rows.candidates[k] >> 32 != 0 ? 1 : 0;
        }
        const auto count = static_cast<int>(end - listed_);
        std::fill_n(end, kAhead, std::uint16_t{0});
        return count;
    }
    RELEVO_INLINE void prefetch(const VertexRows& rows, int n) const {
        const Tile::Lanes* group =
            rows.lanes + listed_[n] / kMostGroups * rows.groups + listed_[n] % kMostGroups;
        __builtin_prefetch(group);
        __builtin_prefetch(&group->radius[3]);  // a group may lie in two lines of the cache
    }
    RELEVO_INLINE int grid_column(const VertexRows& rows, int i) const {
        return first_.column + ((rows.first.column + 2 * i) << level_);
    }

    /// Makes what was found, in places between where it is and the middle of its edge.
    template <class Presence, class EndsOf>
    RELEVO_INLINE void move_in(const VertexRows& rows, int count, Presence presence, EndsOf ends) {
        for (int n = 0; n < count; ++n) {
            const Found& four = found_[n];
            const int k = listed_[n] / kMostGroups;
            const int group = listed_[n] % kMostGroups;
            for (Bits here = four.here; here != 0;) {
                const int lane = next_bit(here);
                const int i = 4 * group + lane;
                const glm::dvec3 exact(four.x[lane], four.y[lane], four.z[lane]);
                const auto [begin, end] = ends(i, k);
                const PlacedVertex& a = out_.placed[begin];
                const PlacedVertex& b = out_.placed[end];
                const double come_in = std::min(four.come_in[lane], presence(i, k));
                const glm::dvec3 drawn =
                    0.5 * (a.drawn + b.drawn) + come_in * (exact - 0.5 * (a.exact + b.exact));
                out_.placed[out_.next_vertex] = {exact, drawn};
                out_.vertices[out_.next_vertex] = {
                    static_cast<float>(drawn.x), static_cast<float>(drawn.y), static_cast<float>(drawn.z),
                    static_cast<std::uint16_t>(grid_column(rows, i)),
                    static_cast<std::uint16_t>(first_.row + ((rows.first.row + 2 * k) << level_))};
                rows.vertex[k * rows.stride + i] = out_.next_vertex++;
            }
        }
    }

    struct Place {
        Four x, y, z;
    };
    /// Of a group, in grids around a pole.
    [[gnu::noinline]] const Place& polar_place(int column, int row, const Four& h) {
        for (int i = 0; i < 4; ++i) {
            const glm::dvec3 p = ground_.positions.at(column + (2 * i << level_), row, h[i]) - test_.eye;
            polar_.x[i] = p.x;
            polar_.y[i] = p.y;
            polar_.z[i] = p.z;
        }
        return polar_;
    }

    struct FourVertices {
        FourFloats vertex[4];
    };
    /// As they lie in a mesh: three coordinates, then column and row in a word.
    RELEVO_INLINE FourVertices vertices_of(const Four& x, const Four& y, const Four& z, int column,
                                           int row) const {
        static_assert(std::endian::native == std::endian::little && sizeof(MeshVertex) == 16);
        using Order = FourWords;
        const std::uint32_t first = static_cast<std::uint32_t>(column) | static_cast<std::uint32_t>(row)
                                                                             << 16;
        const std::uint32_t step = 2u << level_;
        const FourWords posts = {first, first + step, first + 2 * step, first + 3 * step};
        const FourFloats xs = __builtin_convertvector(x, FourFloats);
        const FourFloats ys = __builtin_convertvector(y, FourFloats);
        const FourFloats zs = __builtin_convertvector(z, FourFloats);
        const FourFloats ps = reinterpret_cast<FourFloats>(posts);
        const FourFloats xy01 = __builtin_shuffle(xs, ys, Order{0, 4, 1, 5});
        const FourFloats xy23 = __builtin_shuffle(xs, ys, Order{2, 6, 3, 7});
        const FourFloats zp01 = __builtin_shuffle(zs, ps, Order{0, 4, 1, 5});
        const FourFloats zp23 = __builtin_shuffle(zs, ps, Order{2, 6, 3, 7});
        return {{__builtin_shuffle(xy01, zp01, Order{0, 1, 4, 5}),
                 __builtin_shuffle(xy01, zp01, Order{2, 3, 6, 7}),
                 __builtin_shuffle(xy23, zp23, Order{0, 1, 4, 5}),
                 __builtin_shuffle(xy23, zp23, Order{2, 3, 6, 7})}};
    }

    /// A group's vertices, where they may move.
    struct Found {
        Four x, y, z, come_in;
        Bits here;
    };
    static constexpr int kMostListed = (TileMesher::kMostSquares + 1) * (TileMesher::kMostSquares / 4 + 1);

    const FrameTest& test_;
    const TileGround& ground_;
    const GridPoint first_;
    const int level_;
    const unsigned inside_;
    MeshOutput& out_;
    double bare_error_ = 0;
    double bare_radius_ = 0;
    Place polar_;
    std::uint16_t listed_[kMostListed + kAhead + 8];
    Found found_[kMostListed];
};

}  // namespace relevo::lod
