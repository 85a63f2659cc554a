#include "lod/soar/tile_mesher.hpp"

#include <bit>
#include <cmath>
#include <cstring>

#include <glm/geometric.hpp>

#include "lod/scene/metric_code.hpp"
#include "lod/soar/machine_clones.hpp"

// All functions that pass vectors are inlined: there is no ABI that they could change.
#pragma GCC diagnostic ignored "-Wpsabi"
#define RELEVO_INLINE [[gnu::always_inline]] inline

namespace relevo::lod {

namespace {

using Bits = std::uint64_t;

// GCC and clang make of these what the machine has.
typedef double Four __attribute__((vector_size(32)));
typedef double FourDoubles __attribute__((vector_size(32), aligned(8), may_alias));
typedef long long FourWhole __attribute__((vector_size(32)));
typedef float FourFloats __attribute__((vector_size(16), aligned(4), may_alias));
typedef std::uint16_t FourCodes __attribute__((vector_size(8), aligned(2), may_alias));
typedef std::uint32_t FourWords __attribute__((vector_size(16)));
static_assert(Tile::kLanes == 4);

RELEVO_INLINE Four widened(const float* values) {
    return __builtin_convertvector(*reinterpret_cast<const FourFloats*>(values), Four);
}

/// As lod::decode, four at a time.
RELEVO_INLINE Four decoded(const std::uint16_t* codes) {
    const FourWords bits = __builtin_convertvector(*reinterpret_cast<const FourCodes*>(codes), FourWords)
                           << (23 - kCodeMantissaBits);
    return __builtin_convertvector(reinterpret_cast<FourFloats>(bits), Four);
}

RELEVO_INLINE unsigned bits_of(FourWhole mask) {
    const FourWhole weights = {1, 2, 4, 8};
    mask &= weights;
    return static_cast<unsigned>(mask[0] | mask[1] | mask[2] | mask[3]);
}

RELEVO_INLINE Four root(const Four& v) {
    return Four{std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2]), std::sqrt(v[3])};
}

RELEVO_INLINE Bits first_bits(int count) {
    return (Bits{1} << count) - 1;
}

/// Has the groups of a row's candidates brought near: what a frame looks at next lies all over memory.
RELEVO_INLINE void prefetch(const Tile::Lanes* lanes, Bits candidates) {
    while (candidates != 0) {
        const int group = std::countr_zero(candidates) / Tile::kLanes;
        candidates &= ~(Bits{0xf} << (4 * group));
        __builtin_prefetch(lanes + group);
    }
}

RELEVO_INLINE int next_bit(Bits& bits) {
    const int at = std::countr_zero(bits);
    bits &= bits - 1;
    return at;
}

constexpr Bits kEvenBits = 0x5555555555555555;

/// Of a row of squares, those whose diagonal runs from their north-west to their south-east corner: where
/// column and row are both even or both odd.
RELEVO_INLINE Bits falling_squares(int row) {
    return row % 2 == 0 ? kEvenBits : ~kEvenBits;
}

/// Of a row of squares, for which of them the two corners that are their centre's parents are in the mesh.
struct Parents {
    Bits first;   // of falling squares the north-east corner, else the north-west one
    Bits second;  // the south-west one, else the south-east one
};
RELEVO_INLINE Parents parents_of_centres(const TileMesher::Corners& corners, int row) {
    const Bits above = corners.here[static_cast<std::size_t>(row)];
    const Bits below = corners.here[static_cast<std::size_t>(row) + 1];
    const Bits falling = falling_squares(row);
    return {((above >> 1) & falling) | (above & ~falling), (below & falling) | ((below >> 1) & ~falling)};
}

/// What makes the vertices of one tile.
class Placing {
  public:
    Placing(const FrameTest& test, const TileGround& ground, const Tile& tile, unsigned inside,
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

    struct Found {
        Bits here = 0;
        Bits seen = 0;
    };

    /// Looks at the candidates of a row and puts those into the mesh that are `allowed` and needed.
    /// \param column  of the first vertex of the row, posts of the tile; the others follow at every second
    /// \param presence  of the vertex i: how far it may have come in
    /// \param ends  (i, left, right): the mesh vertices of the edge that vertex i splits
    template <class Presence, class Ends>
    RELEVO_INLINE Found row(const Tile::Lanes* lanes, int column, int row, Bits candidates, Bits allowed,
                            std::uint32_t* vertex, Presence presence, Ends ends) {
        Found found;
        const int grid_row = first_.row + (row << level_);
        const bool is_polar = ground_.positions.polar() != nullptr;
        geo::PostPositions::Row at{};
        LevelTables::Columns columns{};
        if (!is_polar) {
            const int post = (first_.column >> level_) + column;
            at = ground_.tables.row(level_, grid_row >> level_);
            columns = column == 0 ? ground_.tables.even_columns(level_, post)
                                  : ground_.tables.odd_columns(level_, post);
        }
        MeshVertex* const vertices = out_.vertices;
        std::uint32_t next = out_.next_vertex;
        for (Bits left = candidates; left != 0;) {
            const int group = std::countr_zero(left) / 4;
            left &= ~(Bits{0xf} << (4 * group));
            const Tile::Lanes& four = lanes[group];
            const Four h = widened(four.N) + test_.exaggeration * widened(four.H);
            Four x{}, y{}, z{};
            if (!is_polar) {
                const Four from_axis = at.from_axis + h * at.cos_lat;
                x = from_axis * *reinterpret_cast<const FourDoubles*>(columns.cos_lon + 4 * group) -
                    test_.eye.x;
                y = from_axis * *reinterpret_cast<const FourDoubles*>(columns.sin_lon + 4 * group) -
                    test_.eye.y;
                z = (at.z - test_.eye.z) + h * at.sin_lat;
            } else {
                for (int k = 0; k < 4; ++k) {
                    const int grid_column = first_.column + ((column + 2 * (4 * group + k)) << level_);
                    const glm::dvec3 p = ground_.positions.at(grid_column, grid_row, h[k]) - test_.eye;
                    x[k] = p.x;
                    y[k] = p.y;
                    z[k] = p.z;
                }
            }
            const Four bare_radius = decoded(four.radius);
            const Four error = test_.exaggeration * decoded(four.error) + bare_error_;
            const Four radius = test_.exaggeration * bare_radius + bare_radius_;
            const Four distance2 = x * x + y * y + z * z;
            const Four within = test_.reach * error + radius;
            FourWhole seen_mask = bare_radius > 0.0;
            for (unsigned k = 0; k < 4; ++k) {
                if ((inside_ >> k & 1) != 0) continue;
                const glm::dvec3& plane = test_.planes[k];
                seen_mask &= plane.x * x + plane.y * y + plane.z * z <= radius;
            }
            const FourWhole here_mask = seen_mask & (error > 0.0) & (distance2 < within * within);
            const Bits four_bits = candidates >> (4 * group) & 0xf;
            found.seen |= (bits_of(seen_mask) & four_bits) << (4 * group);
            const Bits here = bits_of(here_mask) & four_bits & (allowed >> (4 * group));
            found.here |= here << (4 * group);
            if (test_.moving) {
                store(x_ + 4 * group, x);
                store(y_ + 4 * group, y);
                store(z_ + 4 * group, z);
                Four t = {1, 1, 1, 1};
                if (test_.morph) {
                    // How far a vertex has come in, linear in 1 / rho, so that it needs no more than its
                    // distance.
                    const Four clearance = root(distance2) - radius - test_.kappa * error;
                    const Four part = 2.0 - 2 * test_.tau_min_px * clearance / (test_.lambda_px * error);
                    t = (clearance > 0.0) & (part < 1.0) ? part : t;
                }
                store(come_in_ + 4 * group, t);
                continue;
            }
            // Without a branch, which would wait for all of the above each time that it was guessed wrong:
            // every vertex is written, and the next over it where it is not in the mesh.
            const FourVertices four_vertices =
                vertices_of(x, y, z, first_.column + ((column + 8 * group) << level_), grid_row);
            for (int k = 0; k < 4; ++k) {
                std::memcpy(&vertices[next], &four_vertices.vertex[k], sizeof(MeshVertex));
                vertex[4 * group + k] = next;
                next += static_cast<std::uint32_t>(here >> k & 1);
            }
        }
        out_.next_vertex = next;
        if (!test_.moving) return found;
        for (Bits here = found.here; here != 0;) {
            const int i = next_bit(here);
            const glm::dvec3 exact(x_[i], y_[i], z_[i]);
            const auto [begin, end] = ends(i);
            const PlacedVertex& a = out_.placed[begin];
            const PlacedVertex& b = out_.placed[end];
            const double come_in = std::min(come_in_[i], presence(i));
            const glm::dvec3 drawn =
                0.5 * (a.drawn + b.drawn) + come_in * (exact - 0.5 * (a.exact + b.exact));
            out_.placed[out_.next_vertex] = {exact, drawn};
            out_.vertices[out_.next_vertex] = {
                static_cast<float>(drawn.x), static_cast<float>(drawn.y), static_cast<float>(drawn.z),
                static_cast<std::uint16_t>(first_.column + ((column + 2 * i) << level_)),
                static_cast<std::uint16_t>(grid_row)};
            vertex[i] = out_.next_vertex++;
        }
        return found;
    }

  private:
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
    RELEVO_INLINE static void store(double* to, const Four& v) { *reinterpret_cast<Four*>(to) = v; }

    const FrameTest& test_;
    const TileGround& ground_;
    const GridPoint first_;
    const int level_;
    const unsigned inside_;
    MeshOutput& out_;
    double bare_error_ = 0;
    double bare_radius_ = 0;
    // Of the vertices of a row, where they may move.
    alignas(32) double x_[TileMesher::kMostSquares + 4];
    alignas(32) double y_[TileMesher::kMostSquares + 4];
    alignas(32) double z_[TileMesher::kMostSquares + 4];
    alignas(32) double come_in_[TileMesher::kMostSquares + 4];
};

struct Ends {
    std::uint32_t first;
    std::uint32_t second;
};

}  // namespace

[[RELEVO_CLONES("arch=x86-64-v3", "default")]] TileMesher::Quarters TileMesher::place_vertices(
    const FrameTest& test, const TileStore::Resident& resident, const TileGround& ground, unsigned inside,
    MeshOutput& out) {
    const Tile& tile = resident.tile;
    id_ = tile.id();
    squares_ = tile.squares();
    const int squares = squares_;
    const TileGrid& grid = ground.grid;
    const auto vertex_level = static_cast<std::size_t>(2 * (grid.levels - 1 - id_.level));
    const Bits in_row = first_bits(squares);
    Placing placing(test, ground, tile, inside, out);

    placing.set_bound(ground.bounds[vertex_level]);
    for (int k = 0; k < squares; ++k) {
        const auto [first, second] = parents_of_centres(corners, k);
        prefetch(tile.centres(k), (first | second) & in_row);
    }
    Bits any_centre = 0;
    for (int k = 0; k < squares; ++k) {
        const auto [first, second] = parents_of_centres(corners, k);
        const Bits candidates = (first | second) & in_row;
        const auto row = static_cast<std::size_t>(k);
        centre_here_[row] = centre_seen_[row] = 0;
        if (candidates == 0) continue;
        const std::uint32_t* above = corners.vertex.data() + k * (squares + 1);
        const std::uint32_t* below = above + squares + 1;
        const auto ends = [&](int i) {
            return (i + k) % 2 == 0 ? Ends{above[i], below[i + 1]} : Ends{above[i + 1], below[i]};
        };
        const auto found = placing.row(
            tile.centres(k), 1, 2 * k + 1, candidates, first & second, centre_.data() + k * squares,
            [&](int) { return resident.presence; }, ends);
        centre_here_[row] = found.here;
        centre_seen_[row] = found.seen & candidates;
        any_centre |= found.here;
        prefetch(tile.across(k), found.here);
        prefetch(tile.across(k + 1), found.here);
        prefetch(tile.down(k), found.here | (found.here << 1));
    }
    if (any_centre == 0) {
        across_here_.fill(0);
        down_here_.fill(0);
        return {};
    }

    placing.set_bound(ground.bounds[vertex_level + 1]);
    const auto& [north, south, west, east] = resident.side_presence;
    for (int k = 0; k <= squares; ++k) {
        const auto row = static_cast<std::size_t>(k);
        const Bits above = k > 0 ? centre_here_[row - 1] : 0;
        const Bits below = k < squares ? centre_here_[row] : 0;
        across_here_[row] = across_seen_[row] = 0;
        if ((above | below) == 0) continue;
        // A side on the tile's border has its other parent in the neighbour, where it is if this one needs
        // it: errors and spheres are nested.
        const double presence = k == 0 ? north : k == squares ? south : resident.presence;
        const Bits allowed = k == 0 || k == squares ? (presence > 0 ? ~Bits{0} : 0) : above & below;
        const std::uint32_t* in_line = corners.vertex.data() + k * (squares + 1);
        const auto found = placing.row(
            tile.across(k), 1, 2 * k, above | below, allowed, across_.data() + k * squares,
            [&](int) { return presence; },
            [&](int i) {
                return Ends{in_line[i], in_line[i + 1]};
            });
        across_here_[row] = found.here;
        across_seen_[row] = found.seen;
    }
    const Bits side_columns = (west > 0 ? Bits{1} : 0) | (east > 0 ? Bits{1} << squares : 0);
    for (int k = 0; k < squares; ++k) {
        const auto row = static_cast<std::size_t>(k);
        const Bits centres = centre_here_[row];
        down_here_[row] = down_seen_[row] = 0;
        if (centres == 0) continue;
        const std::uint32_t* above = corners.vertex.data() + k * (squares + 1);
        const auto presence = [&](int i) { return i == 0 ? west : i == squares ? east : resident.presence; };
        const auto found = placing.row(tile.down(k), 0, 2 * k + 1, centres | (centres << 1),
                                       (centres & (centres << 1)) | side_columns,
                                       down_.data() + k * (squares + 1), presence, [&](int i) {
                                           return Ends{above[i], above[i + squares + 1]};
                                       });
        down_here_[row] = found.here;
        down_seen_[row] = found.seen;
    }
    if (id_.level == 0) return {};

    Quarters split{};
    const int half = grid.children(id_.level) == 2 ? squares / 2 : squares;
    const Bits west_half = first_bits(half);
    for (int k = 0; k < squares; ++k) {
        const auto row = static_cast<std::size_t>(k);
        const Bits split_squares = centre_here_[row] & (across_here_[row] | across_here_[row + 1] |
                                                        down_here_[row] | (down_here_[row] >> 1));
        const std::size_t quarter = k < half ? 0 : 2;
        if ((split_squares & west_half) != 0) split[quarter] = true;
        if ((split_squares & ~west_half) != 0) split[quarter + 1] = true;
    }
    return split;
}

namespace {

struct TriangleWriter {
    std::uint32_t* next;

    RELEVO_INLINE void write(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        next[0] = a;
        next[1] = b;
        next[2] = c;
        next += 3;
    }
    /// The same without a branch: what is not wanted is written over.
    RELEVO_INLINE void write_if(Bits wanted, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        next[0] = a;
        next[1] = b;
        next[2] = c;
        next += 3 * (wanted & 1);
    }
};

}  // namespace

void TileMesher::write_triangles(const TileGrid& grid, const Quarters& goes_on, MeshOutput& out) const {
    const int squares = squares_;
    // What lies wholly beyond the data is never seen: squares, and the eastern and southern halves of those
    // whose middle is the data's last column or row.
    const GridPoint first_post = grid.first_post(id_);
    const auto with_data = [&](int first, int last) {
        return std::clamp((last - first + (2 << id_.level) - 1) >> (id_.level + 1), 1, squares);
    };
    const Bits in_row = first_bits(with_data(first_post.column, grid.last_column));
    const int rows = with_data(first_post.row, grid.last_row);
    const auto with_far_half = [&](int first, int last) {
        return std::clamp((last - first + (1 << id_.level) - 1) >> (id_.level + 1), 0, squares);
    };
    const Bits with_east = first_bits(with_far_half(first_post.column, grid.last_column));
    const int rows_with_south = with_far_half(first_post.row, grid.last_row);
    TriangleWriter triangles{out.next_index};
    const int half = id_.level > 0 && grid.children(id_.level) == 2 ? squares / 2 : squares;
    for (int k = 0; k < rows; ++k) {
        const auto row = static_cast<std::size_t>(k);
        const std::uint32_t* above = corners.vertex.data() + k * (squares + 1);
        const std::uint32_t* below = above + squares + 1;

        // Halves of squares whose centre is not in the mesh.
        const auto [first, second] = parents_of_centres(corners, k);
        for (Bits whole = (first | second) & in_row & centre_seen_[row] & ~centre_here_[row]; whole != 0;) {
            const int i = next_bit(whole);
            const bool falls = (i + k) % 2 == 0;
            const std::uint32_t a = falls ? above[i] : below[i];
            const std::uint32_t b = falls ? below[i + 1] : above[i + 1];
            triangles.write_if(first >> i, a, b, falls ? above[i + 1] : above[i]);
            triangles.write_if(second >> i, b, a, falls ? below[i] : below[i + 1]);
        }

        // Quarters of the others: whole where the side is not split, or in halves that no finer tile looks
        // at.
        const std::uint32_t* centres = centre_.data() + k * squares;
        const std::uint32_t* tops = across_.data() + k * squares;
        const std::uint32_t* bottoms = tops + squares;
        const std::uint32_t* lefts = down_.data() + k * (squares + 1);
        const Bits top_here = across_here_[row];
        const Bits bottom_here = across_here_[row + 1];
        const Bits left_here = down_here_[row];
        const Bits right_here = left_here >> 1;
        const Bits top_whole = across_seen_[row] & ~top_here;
        const Bits with_south = k < rows_with_south ? ~Bits{0} : 0;
        const Bits bottom_whole = across_seen_[row + 1] & ~bottom_here & with_south;
        const Bits south_here = bottom_here & with_south;
        const Bits left_whole = down_seen_[row] & ~left_here;
        const Bits east_here = right_here & with_east;
        const Bits right_whole = (down_seen_[row] >> 1) & ~right_here & with_east;
        for (Bits split = centre_here_[row] & in_row; split != 0;) {
            const int i = next_bit(split);
            const std::uint32_t centre = centres[i];
            triangles.write_if(top_whole >> i, above[i + 1], above[i], centre);
            triangles.write_if(bottom_whole >> i, below[i], below[i + 1], centre);
            triangles.write_if(left_whole >> i, above[i], below[i], centre);
            triangles.write_if(right_whole >> i, below[i + 1], above[i + 1], centre);
        }
        const std::size_t quarter = k < half ? 0 : 2;
        const Bits ends_here = (goes_on[quarter] ? 0 : first_bits(half)) |
                               (half < squares && !goes_on[quarter + 1] ? ~first_bits(half) : 0);
        for (Bits split = centre_here_[row] & in_row & ends_here; split != 0;) {
            const int i = next_bit(split);
            const std::uint32_t centre = centres[i];
            triangles.write_if((top_here & with_east) >> i, centre, above[i + 1], tops[i]);
            triangles.write_if(top_here >> i, above[i], centre, tops[i]);
            triangles.write_if(south_here >> i, centre, below[i], bottoms[i]);
            triangles.write_if((south_here & with_east) >> i, below[i + 1], centre, bottoms[i]);
            triangles.write_if(left_here >> i, centre, above[i], lefts[i]);
            triangles.write_if((left_here & with_south) >> i, below[i], centre, lefts[i]);
            triangles.write_if((east_here & with_south) >> i, centre, below[i + 1], lefts[i + 1]);
            triangles.write_if(east_here >> i, above[i + 1], centre, lefts[i + 1]);
        }
    }
    out.next_index = triangles.next;
}

void TileMesher::hand_down(const TileGrid& grid, int quarter, Corners& child) const {
    const bool whole = grid.children(id_.level) == 1;
    const int half = whole ? squares_ : squares_ / 2;  // squares of this tile a side
    const int x0 = whole ? 0 : quarter % 2 * half;
    const int y0 = whole ? 0 : quarter / 2 * half;
    const int stride = squares_ + 1;
    const int child_stride = 2 * half + 1;
    // Bits of two rows, one between the other.
    const auto spread = [](Bits bits) {
        bits = (bits | bits << 16) & 0x0000ffff0000ffff;
        bits = (bits | bits << 8) & 0x00ff00ff00ff00ff;
        bits = (bits | bits << 4) & 0x0f0f0f0f0f0f0f0f;
        bits = (bits | bits << 2) & 0x3333333333333333;
        return (bits | bits << 1) & 0x5555555555555555;
    };
    for (int k = 0; k <= half; ++k) {
        const int y = y0 + k;
        const auto row = static_cast<std::size_t>(y);
        const Bits at_corners = corners.here[row] >> x0 & first_bits(half + 1);
        const Bits at_sides = across_here_[row] >> x0 & first_bits(half);
        child.here[static_cast<std::size_t>(2 * k)] = spread(at_corners) | spread(at_sides) << 1;
        std::uint32_t* to = child.vertex.data() + 2 * k * child_stride;
        const std::uint32_t* corner = corners.vertex.data() + y * stride + x0;
        const std::uint32_t* across = across_.data() + y * squares_ + x0;
        for (int i = 0; i < half; ++i) {
            to[2 * i] = corner[i];
            to[2 * i + 1] = across[i];
        }
        to[2 * half] = corner[half];
        if (k == half) break;
        const Bits down = down_here_[row] >> x0 & first_bits(half + 1);
        const Bits centres = centre_here_[row] >> x0 & first_bits(half);
        child.here[static_cast<std::size_t>(2 * k + 1)] = spread(down) | spread(centres) << 1;
        to += child_stride;
        const std::uint32_t* side = down_.data() + y * stride + x0;
        const std::uint32_t* centre = centre_.data() + y * squares_ + x0;
        for (int i = 0; i < half; ++i) {
            to[2 * i] = side[i];
            to[2 * i + 1] = centre[i];
        }
        to[2 * half] = side[half];
    }
}

}  // namespace relevo::lod
