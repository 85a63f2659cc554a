#include "lod/pyramid/memory_pyramid.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "lod/mesh_heights.hpp"
#include "lod/scene/post_mark.hpp"

namespace relevo::lod {

namespace {

constexpr float kVoid = std::numeric_limits<float>::quiet_NaN();

PostClass class_of(float height, bool is_sea) {
    if (std::isnan(height)) return PostClass::void_post;
    return is_sea ? PostClass::sea : PostClass::land;
}

Ground finest_ground(const geo::GridFrame& frame, const Raster<float>& heights,
                     const Raster<std::uint8_t>& sea) {
    Ground ground(heights.columns(), heights.rows());
    const BlockGrid::Box all{0, 0, heights.columns(), heights.rows()};
    const auto part = [&](const BlockGrid::Box& box) { return Result(part_of(heights, box)); };
    ground.normals = GroundNormals(frame).of(all, *with_border(frame, all, part));
    for (std::size_t i = 0; i < heights.samples().size(); ++i) {
        const bool is_sea = !sea.samples().empty() && sea.samples()[i] != 0;
        ground.classes.samples()[i] = static_cast<std::uint8_t>(class_of(heights.samples()[i], is_sea));
    }
    return ground;
}

/// The posts of a block in a raster of the whole padded grid.
template <class T>
Raster<T> posts_of(const PyramidBlock& block, const Raster<T>& all) {
    const int cells = std::min(Pyramid::kBlockCells, (all.columns() - 1) >> block.level);
    Raster<T> posts(cells + 1, cells + 1);
    for (int row = 0; row <= cells; ++row) {
        const T* from = all.row((block.row * cells + row) << block.level);
        for (int column = 0; column <= cells; ++column)
            posts.at(column, row) = from[(block.column * cells + column) << block.level];
    }
    return posts;
}

}  // namespace

MemoryPyramid::MemoryPyramid(const geo::GridFrame& frame, Raster<float> heights, MetricRasters metrics,
                             const Raster<std::uint8_t>& sea)
    : frame_(frame),
      heights_(std::move(heights)),
      filled_(mesh_heights(frame, heights_)),
      metrics_(std::move(metrics)) {
    ground_.push_back(finest_ground(frame, heights_, sea));
    for (int level = 1; level <= top(); ++level) {
        const Raster<std::uint8_t>& finer = ground_.back().classes;
        ground_.push_back(
            every_second(ground_.back(), {0, 0, (finer.columns() + 1) / 2, (finer.rows() + 1) / 2}));
    }
}

Result<VertexPosts> MemoryPyramid::read_vertices(const PyramidBlock& block, ErrorMetric metric) const {
    return VertexPosts{
        posts_of(block, filled_),
        posts_of(block, metric == ErrorMetric::bounded ? metrics_.bounded : metrics_.incremental),
        posts_of(block, metrics_.radius)};
}

Result<GroundPosts> MemoryPyramid::read_ground(const PyramidBlock& block) const {
    const Ground& level = ground_[static_cast<std::size_t>(block.level)];
    const int cells = std::min(kBlockCells, (frame_.padded_side() - 1) >> block.level);
    GroundPosts posts{Raster<float>(cells + 1, cells + 1, kVoid),
                      Raster<GroundPosts::Normal>(cells + 1, cells + 1),
                      Raster<std::uint8_t>(cells + 1, cells + 1)};
    for (int row = 0; row <= cells; ++row) {
        for (int column = 0; column <= cells; ++column) {
            const int x = block.column * cells + column;
            const int y = block.row * cells + row;
            if (x >= level.classes.columns() || y >= level.classes.rows()) continue;
            posts.heights.at(column, row) = heights_.at(x << block.level, y << block.level);
            posts.normals.at(column, row) = level.normals.at(x, y);
            if (level.classes.at(x, y) == static_cast<std::uint8_t>(PostClass::sea))
                posts.is_sea.at(column, row) = 255;
        }
    }
    return posts;
}

}  // namespace relevo::lod
