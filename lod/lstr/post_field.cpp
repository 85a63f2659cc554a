#include "lod/lstr/post_field.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include <glm/geometric.hpp>

#include "lod/static_mesh/post_rows.hpp"

namespace relevo::lod {

PostField::PostField(const Terrain& terrain, const GridPoint& first, int cells, int stride)
    : terrain_(&terrain), first_(first), cells_(cells), stride_(stride), side_(cells / stride + 1) {
    const auto posts = static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_);
    for (std::vector<float>* each : {&H_, &x_, &y_, &z_, &valid_}) each->resize(posts);
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
            if (!valid && (valid_[i] > 0 || H_[i] != 0)) continue;
            H_[i] = block.filled.at(c, r);
            valid_[i] = valid ? 1.F : 0.F;
        }
    }
    has_data_ = has_data_ || any;
    return any;
}

PlacedPost PostField::post(const GridPoint& at) const {
    const float H = H_[index(at)];
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

double PostField::error(const PlacedTriangle& triangle, double enough) const {
    const Plane plane(triangle, origin_);
    const glm::vec3 step(plane.a_column * static_cast<double>(stride_));
    const auto limit = static_cast<float>(enough * enough);
    float largest = 0;
    for_each_run(triangle, [&](int row, int first, int count) {
        const std::size_t i = index({first, row});
        const glm::vec3 from(plane.at(first, row));
        for (int k = 0; k < count; ++k) {
            const std::size_t j = i + static_cast<std::size_t>(k);
            const auto along = static_cast<float>(k);
            const float x = x_[j] - (from.x + step.x * along);
            const float y = y_[j] - (from.y + step.y * along);
            const float z = z_[j] - (from.z + step.z * along);
            largest = std::max(largest, valid_[j] * (x * x + y * y + z * z));
        }
        return largest <= limit;
    });
    return std::sqrt(static_cast<double>(largest));
}

PostField::Worst PostField::worst(const PlacedTriangle& triangle) const {
    const Plane plane(triangle, origin_);
    Worst worst{triangle[0]->at, 0};
    for_each_run(triangle, [&](int row, int first, int count) {
        for (int k = 0; k < count; ++k) {
            const GridPoint at{first + k * stride_, row};
            const std::size_t i = index(at);
            const bool on_side = at.column == first_.column || at.column == first_.column + cells_ ||
                                 at.row == first_.row || at.row == first_.row + cells_;
            if (on_side || !(valid_[i] > 0)) continue;
            const double error = glm::distance(
                plane.at(at.column, row), glm::dvec3(static_cast<double>(x_[i]), static_cast<double>(y_[i]),
                                                     static_cast<double>(z_[i])));
            if (error > worst.error_m) worst = {at, error};
        }
        return true;
    });
    for (const PlacedPost* corner : triangle) {
        if (corner->at == worst.at) worst.error_m = 0;
    }
    return worst;
}

}  // namespace relevo::lod
