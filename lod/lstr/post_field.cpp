#include "lod/lstr/post_field.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include <glm/geometric.hpp>

#include "lod/machine_clones.hpp"
#include "lod/static_mesh/post_rows.hpp"

namespace relevo::lod {

PostField::PostField(const Terrain& terrain, const GridPoint& first, int cells, int stride)
    : terrain_(&terrain),
      first_(first),
      cells_(cells),
      stride_(stride),
      side_(cells / stride + 1),
      H_(side_, side_) {
    const auto posts = static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_);
    constexpr std::size_t kBeyond = 7;  // rows are read by eights
    for (std::vector<float>* each : {&x_, &y_, &z_, &valid_}) each->resize(posts + kBeyond);
}

Result<PostField> PostField::read(const Terrain& terrain, const GridPoint& first, int cells, int stride,
                                  bool judges) {
    PostField made(terrain, first, cells, stride);
    if (auto done = made.read_heights(*terrain.pyramid()); !done) return done.error();
    if (!judges) return made;
    made.origin_ = terrain.position(first.column + cells / 2, first.row + cells / 2, 0, 1);
    for (int row = first.row; row <= first.row + cells; row += stride) {
        for (int column = first.column; column <= first.column + cells; column += stride) {
            const std::size_t i = made.index({column, row});
            const glm::vec3 offset(made.post({column, row}).position - made.origin_);
            made.x_[i] = offset.x;
            made.y_[i] = offset.y;
            made.z_[i] = offset.z;
            for (int axis = 0; axis < 3; ++axis)
                made.extent_m_ = std::max(made.extent_m_, static_cast<double>(std::abs(offset[axis])));
        }
    }
    return made;
}

Result<void> PostField::read_heights(const Pyramid& pyramid) {
    const geo::GridFrame& frame = pyramid.frame();
    // Strides beyond the pyramid's coarsest level take every so many of its posts.
    const int level = std::min(std::countr_zero(static_cast<unsigned>(stride_)), pyramid.top());
    const int block_cells = std::min(Pyramid::kBlockCells << level, 1 << frame.levels());
    const GridPoint last{first_.column + cells_, first_.row + cells_};
    // Blocks share their borders; one without data knows nothing of them, its neighbour may.
    for (const int beyond : {0, 1}) {
        const int east = std::min(last.column + beyond, frame.columns);
        const int south = std::min(last.row + beyond, frame.rows);
        bool all_have_data = true;
        for (int row = std::max(first_.row - beyond, 0) / block_cells; row * block_cells < south; ++row) {
            for (int column = std::max(first_.column - beyond, 0) / block_cells; column * block_cells < east;
                 ++column) {
                const auto block = pyramid.read_heights({level, column, row});
                if (!block) return block.error();
                if (!take({column * block_cells, row * block_cells}, level, *block)) all_have_data = false;
            }
        }
        if (all_have_data) break;
    }
    return {};
}

bool PostField::take(const GridPoint& corner, int level, const BlockHeights& block) {
    const int last_row = std::min(corner.row + ((block.data.rows() - 1) << level), first_.row + cells_);
    const int last_column =
        std::min(corner.column + ((block.data.columns() - 1) << level), first_.column + cells_);
    bool any = false;
    for (int row = std::max(corner.row, first_.row); row <= last_row; row += stride_) {
        for (int column = std::max(corner.column, first_.column); column <= last_column; column += stride_) {
            const int c = (column - corner.column) >> level;
            const int r = (row - corner.row) >> level;
            const std::size_t i = index({column, row});
            const bool valid = !std::isnan(block.data.at(c, r));
            any = any || valid;
            if (!valid && (valid_[i] > 0 || H_.samples()[i] != 0)) continue;
            H_.samples()[i] = block.filled.at(c, r);
            valid_[i] = valid ? 1.F : 0.F;
        }
    }
    has_data_ = has_data_ || any;
    return any;
}

PlacedPost PostField::post(const GridPoint& at) const {
    const float H = height(at);
    return {at, H, terrain_->position(at.column, at.row, static_cast<double>(H), 1)};
}

namespace {

/// A triangle's point as a function of column and row.
struct Plane {
    glm::dvec3 origin;
    glm::dvec3 a_column;
    glm::dvec3 a_row;
    GridPoint from;

    Plane(const PlacedTriangle& triangle, const glm::dvec3& relative_to) : from(triangle[0]->at) {
        const auto area = static_cast<double>(turn(from, triangle[1]->at, triangle[2]->at));
        const glm::dvec3 to_b = triangle[1]->position - triangle[0]->position;
        const glm::dvec3 to_c = triangle[2]->position - triangle[0]->position;
        const int b_column = triangle[1]->at.column - from.column, b_row = triangle[1]->at.row - from.row;
        const int c_column = triangle[2]->at.column - from.column, c_row = triangle[2]->at.row - from.row;
        origin = triangle[0]->position - relative_to;
        a_column = (to_c * static_cast<double>(b_row) - to_b * static_cast<double>(c_row)) / area;
        a_row = (to_b * static_cast<double>(c_column) - to_c * static_cast<double>(b_column)) / area;
    }
    glm::dvec3 at(int column, int row) const {
        return origin + a_column * static_cast<double>(column - from.column) +
               a_row * static_cast<double>(row - from.row);
    }
};

}  // namespace

template <class Visit>
void PostField::for_each_run(const PlacedTriangle& triangle, const Visit& visit) const {
    for_each_row({triangle[0]->at, triangle[1]->at, triangle[2]->at}, [&](int row, int first, int last) {
        if (row < first_.row || row > first_.row + cells_ || (row - first_.row) % stride_ != 0) return true;
        first = std::max(first, first_.column);
        first += (stride_ - (first - first_.column) % stride_) % stride_;
        last = std::min(last, first_.column + cells_);
        if (first > last) return true;
        return visit(row, first, (last - first) / stride_ + 1);
    });
}

namespace {

typedef float Eight __attribute__((vector_size(32)));
typedef float EightFloats __attribute__((vector_size(32), aligned(4), may_alias));
typedef int EightWhole __attribute__((vector_size(32)));

/// The largest squared distance of posts in a row from a line, of those that are valid.
[[RELEVO_CLONES("avx2", "default")]] float farthest_of_row(const float* x, const float* y, const float* z,
                                                           const float* valid, int count,
                                                           const glm::vec3& from, const glm::vec3& step) {
    constexpr Eight kLanes{0, 1, 2, 3, 4, 5, 6, 7};
    Eight largest{};
    for (int k = 0; k < count; k += 8) {
        const Eight along = kLanes + static_cast<float>(k);
        const Eight dx = *reinterpret_cast<const EightFloats*>(x + k) - (from.x + step.x * along);
        const Eight dy = *reinterpret_cast<const EightFloats*>(y + k) - (from.y + step.y * along);
        const Eight dz = *reinterpret_cast<const EightFloats*>(z + k) - (from.z + step.z * along);
        const Eight off = *reinterpret_cast<const EightFloats*>(valid + k) * (dx * dx + dy * dy + dz * dz);
        const EightWhole larger = (off > largest) & (along < static_cast<float>(count));
        largest = larger ? off : largest;
    }
    float most = largest[0];
    for (int lane = 1; lane < 8; ++lane) most = std::max(most, largest[lane]);
    return most;
}

}  // namespace

double PostField::error(const PlacedTriangle& triangle, double enough) const {
    const Plane plane(triangle, origin_);
    const glm::vec3 step(plane.a_column * static_cast<double>(stride_));
    const auto limit = static_cast<float>(enough * enough);
    float largest = 0;
    for_each_run(triangle, [&](int row, int first, int count) {
        const std::size_t i = index({first, row});
        largest = std::max(largest, farthest_of_row(&x_[i], &y_[i], &z_[i], &valid_[i], count,
                                                    glm::vec3(plane.at(first, row)), step));
        return largest <= limit;
    });
    return std::sqrt(static_cast<double>(largest));
}

double error_at(const PlacedPost& post, const PlacedTriangle& triangle) {
    return glm::distance(Plane(triangle, glm::dvec3(0)).at(post.at.column, post.at.row), post.position);
}

inline double PostField::off_squared(const glm::dvec3& drawn, int column, int row, int to_column, int to_row,
                                     double part) const {
    const auto is_here = [this](int at) { return at >= 0 && at < side_; };
    if (!is_here(column) || !is_here(row) || !is_here(to_column) || !is_here(to_row)) return 0;
    const auto i = static_cast<std::size_t>(row * side_ + column);
    const auto j = static_cast<std::size_t>(to_row * side_ + to_column);
    if (!(valid_[i] > 0 && valid_[j] > 0)) return 0;
    const auto mixed = [part](float p, float q) {
        return (1 - part) * static_cast<double>(p) + part * static_cast<double>(q);
    };
    const glm::dvec3 off = drawn - glm::dvec3(mixed(x_[i], x_[j]), mixed(y_[i], y_[j]), mixed(z_[i], z_[j]));
    return glm::dot(off, off);
}

// Compiled for newer machines too: rounding down is one instruction there, and making nodes takes 6 % less
// time.
[[RELEVO_CLONES("avx2", "default")]] double PostField::edge_error(const PlacedPost& a, const PlacedPost& b,
                                                                  double enough) const {
    // In posts of the field.
    const auto scaled = [&](int at, int first) { return static_cast<double>(at - first) / stride_; };
    const glm::dvec2 from(scaled(a.at.column, first_.column), scaled(a.at.row, first_.row));
    const glm::dvec2 way(scaled(b.at.column - a.at.column, 0), scaled(b.at.row - a.at.row, 0));
    const glm::dvec3 start = a.position - origin_;
    const glm::dvec3 along = b.position - a.position;
    // Roots are taken once, at the end: a little more than enough then surely is.
    const double limit = enough * enough * (1 + 1e-15);
    double largest = 0;
    // Lines of a family are where (x, y) has a product with `across` that is a multiple of `every`.
    const auto cross = [&](const glm::dvec2& across, int every, const auto& between) {
        const double begin = glm::dot(across, from);
        const double growth = glm::dot(across, way);
        if (growth == 0) return;
        const double low = std::min(begin, begin + growth), high = std::max(begin, begin + growth);
        for (int line = static_cast<int>(std::floor(low / every)) + 1;
             line * every < high && largest <= limit; ++line) {
            const double part = (line * every - begin) / growth;
            const glm::dvec2 at = from + part * way;
            largest = std::max(largest, between(at, line * every, start + part * along));
        }
    };
    cross({1, 0}, 1, [&](const glm::dvec2& at, int column, const glm::dvec3& drawn) {
        const int row = static_cast<int>(std::floor(at.y));
        return off_squared(drawn, column, row, column, row + 1, at.y - row);
    });
    cross({0, 1}, 1, [&](const glm::dvec2& at, int row, const glm::dvec3& drawn) {
        const int column = static_cast<int>(std::floor(at.x));
        return off_squared(drawn, column, row, column + 1, row, at.x - column);
    });
    // Diagonals (soar/cell.hpp) run along x - y and x + y that are even.
    cross({1, -1}, 2, [&](const glm::dvec2& at, int line, const glm::dvec3& drawn) {
        const int column = static_cast<int>(std::floor(at.x));
        return off_squared(drawn, column, column - line, column + 1, column + 1 - line, at.x - column);
    });
    cross({1, 1}, 2, [&](const glm::dvec2& at, int line, const glm::dvec3& drawn) {
        const int column = static_cast<int>(std::floor(at.x));
        return off_squared(drawn, column, line - column, column + 1, line - column - 1, at.x - column);
    });
    return std::sqrt(largest);
}

PostField::Worst PostField::worst(const PlacedTriangle& triangle, const GridPoint& first, int cells) const {
    const Plane plane(triangle, origin_);
    Worst worst{triangle[0]->at, 0};
    for_each_run(triangle, [&](int row, int first_column, int count) {
        for (int k = 0; k < count; ++k) {
            const GridPoint at{first_column + k * stride_, row};
            const std::size_t i = index(at);
            const bool inside = at.column > first.column && at.column < first.column + cells &&
                                at.row > first.row && at.row < first.row + cells;
            const bool is_corner = at == triangle[0]->at || at == triangle[1]->at || at == triangle[2]->at;
            if (!inside || is_corner || !(valid_[i] > 0)) continue;
            const double error = glm::distance(
                plane.at(at.column, row), glm::dvec3(static_cast<double>(x_[i]), static_cast<double>(y_[i]),
                                                     static_cast<double>(z_[i])));
            if (error > worst.error_m) worst = {at, error};
        }
        return true;
    });
    return worst;
}

}  // namespace relevo::lod
