#pragma once

#include <cmath>
#include <cstdlib>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lod/pyramid/memory_pyramid.hpp"
#include "lod/pyramid/scene_pyramid.hpp"
#include "lod/scene/level_grid.hpp"
#include "tests/lod/scratch_scene.hpp"

namespace relevo::test {

using lod::LevelGrid;

/// How far 8 bits may move a component of a normal, which keep its square root in steps of 1/127: (q + 1/2)^2
/// - q^2 in steps, and half of what 16 bits tell apart.
inline double normal_tolerance(int component) {
    const double q = 127 * std::sqrt(std::abs(component) / 32767.0);
    return (q + 0.25) * 32767 / (127 * 127) + 0.5;
}

/// "error at 3 4": where the block of one differs from the other's; empty where nothing does.
inline std::string difference_of_vertices(const lod::VertexPosts& read, const lod::VertexPosts& truth,
                                          bool all_looked_at) {
    const int side = truth.heights.columns();
    if (read.heights.columns() != side || read.heights.rows() != truth.heights.rows()) return "size";
    bool drawn = false;
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            if (!all_looked_at && column % 2 == 0 && row % 2 == 0) continue;
            if (read.error.at(column, row) != truth.error.at(column, row))
                return fmt::format("error at {} {}", column, row);
            if (read.radius.at(column, row) != truth.radius.at(column, row))
                return fmt::format("radius at {} {}", column, row);
            drawn = drawn || truth.radius.at(column, row) != 0;
        }
    }
    // What is never drawn needs no heights.
    if (drawn && read.heights.samples() != truth.heights.samples()) return "heights";
    return {};
}

inline std::string difference_of_ground(const lod::GroundPosts& read, const lod::GroundPosts& truth,
                                        bool exact_normals) {
    if (read.is_sea.samples() != truth.is_sea.samples()) return "sea";
    for (std::size_t i = 0; i < truth.heights.samples().size(); ++i) {
        const float H = truth.heights.samples()[i];
        const float got = read.heights.samples()[i];
        if (got != H && !(std::isnan(got) && std::isnan(H)))
            return fmt::format("height {}: {}, not {}", i, got, H);
        for (const std::size_t axis : {std::size_t{0}, std::size_t{1}}) {
            const int normal = truth.normals.samples()[i][axis];
            const int got_normal = read.normals.samples()[i][axis];
            if (std::abs(got_normal - normal) > (exact_normals ? 0 : normal_tolerance(normal)))
                return fmt::format("normal {}: {}, not {}", i, got_normal, normal);
        }
    }
    return {};
}

/// Every block of the padded grid at every level: what a pyramid reads from disk is what the same rasters
/// have in memory.
inline void expect_same_pyramid(const lod::ScenePyramid& read, const lod::MemoryPyramid& truth) {
    ASSERT_EQ(read.top(), truth.top());
    const int levels = truth.frame().levels();
    for (int level = 0; level <= truth.top(); ++level) {
        const int across = LevelGrid::blocks(levels, level);
        for (int i = 0; i < across * across; ++i) {
            const lod::PyramidBlock block{level, i % across, i / across};
            SCOPED_TRACE(testing::Message()
                         << "level " << level << ", block " << block.column << ' ' << block.row);
            for (const auto metric : {lod::ErrorMetric::bounded, lod::ErrorMetric::incremental}) {
                const auto posts = read.read_vertices(block, metric);
                ASSERT_TRUE(posts) << posts.error().message;
                const auto expected = truth.read_vertices(block, metric);
                ASSERT_EQ(difference_of_vertices(*posts, *expected, level == truth.top()), "");
            }
            const auto ground = read.read_ground(block);
            ASSERT_TRUE(ground) << ground.error().message;
            ASSERT_EQ(difference_of_ground(*ground, *truth.read_ground(block), level == 0), "");
        }
    }
}

}  // namespace relevo::test
