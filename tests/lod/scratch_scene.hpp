#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "lod/pyramid/pyramid_writer.hpp"
#include "lod/pyramid/scene_pyramid.hpp"
#include "lod/pyramid/whole_grid.hpp"
#include "lod/scene/parallel_blocks.hpp"
#include "lod/scene/scene.hpp"
#include "lod/scene/scene_files.hpp"
#include "lod/scene/scene_writer.hpp"
#include "lod/soar/metrics.hpp"

namespace relevo::test {

/// A folder of its own for one test, gone with it.
class SceneFolder {
  public:
    SceneFolder() {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        const auto name = fmt::format("relevo-{}-{}-{}", test->test_suite_name(), test->name(), getpid());
        path_ = std::filesystem::temp_directory_path() / name;
        std::filesystem::remove_all(path_);
        std::filesystem::create_directories(path_);
    }
    SceneFolder(const SceneFolder&) = delete;
    SceneFolder& operator=(const SceneFolder&) = delete;
    ~SceneFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

  private:
    std::filesystem::path path_;
};

inline std::string contents(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

inline void replace(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
}

/// Every file below a folder, by its path in it.
inline std::map<std::string, std::string> all_files(const std::filesystem::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file()) {
            files[std::filesystem::relative(entry.path(), folder).string()] = contents(entry.path());
        }
    }
    return files;
}

/// The same samples, bit by bit (NaN is NaN).
inline bool same_bits(const lod::Raster<float>& a, const lod::Raster<float>& b) {
    return a.columns() == b.columns() && a.rows() == b.rows() &&
           std::equal(a.samples().begin(), a.samples().end(), b.samples().begin(), [](float x, float y) {
               return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y);
           });
}

/// What a scene is made of.
struct SceneParts {
    lod::SceneInfo info;
    lod::Raster<float> heights;
    lod::Raster<lod::PostMark> marks;  // none: plain ones
    lod::MetricRasters metrics;
    std::optional<geo::GeoidNodes> geoid;

    lod::UndulationGrid undulations() const {
        if (!geoid) return {};
        return {std::make_shared<const geo::Geoid>(*geo::Geoid::from_nodes(*geoid, "made up")), info.frame};
    }
};

/// A geoid that rises evenly to the north and, but for a polar frame, to the east, from -20 m in the corner.
inline geo::GeoidNodes sloping_geoid(const geo::GridFrame& frame, double rise_east_m, double rise_north_m) {
    const auto extent = frame.extent();
    geo::GeoidNodes nodes;
    nodes.rows = nodes.columns = 8;
    nodes.south = extent.south;
    nodes.west = extent.west;
    nodes.step_lat = std::max(extent.north - extent.south, frame.step_y) / 7;
    nodes.step_lon = frame.is_polar() ? 45 : std::max(extent.east - extent.west, frame.step_x) / 7;
    if (frame.is_polar()) rise_east_m = 0;
    for (int row = 0; row < nodes.rows; ++row) {
        for (int column = 0; column < nodes.columns; ++column)
            nodes.undulations.push_back(static_cast<double>(
                static_cast<float>(-20 + rise_east_m * column / 7 + rise_north_m * row / 7)));
    }
    return nodes;
}

/// A scene of the given size with made-up heights (a void at every 7th post of row 1) and metrics.
inline SceneParts made_up_scene(int columns, int rows, lod::HeightType type = lod::HeightType::float32) {
    SceneParts parts;
    geo::GridFrame& frame = parts.info.frame;
    frame.west = -105 - 1.0 / 3;
    frame.north = 37.1;
    frame.step_x = 1.0 / 1200;
    frame.step_y = 1.0 / 1200;
    frame.columns = columns;
    frame.rows = rows;

    parts.heights = lod::Raster<float>(columns, rows);
    std::uint64_t voids = 0;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            float height = static_cast<float>((column * 31 + row * 17) % 4000);
            if (type == lod::HeightType::float32) height += 0.1F;
            if (row == 1 && column % 7 == 0) {
                height = std::numeric_limits<float>::quiet_NaN();
                ++voids;
            }
            parts.heights.at(column, row) = height;
        }
    }
    parts.info.height_type = type;
    parts.info.height_max_m = 4000.1;
    parts.info.void_posts = voids;
    parts.info.valid_posts = static_cast<std::uint64_t>(columns) * static_cast<std::uint64_t>(rows) - voids;
    parts.info.resampling_method = "none";
    parts.info.resampling.posts = parts.info.valid_posts;
    lod::SourceInfo source;
    source.name = "made-up.tif";
    source.sha256 = std::string(64, 'a');
    source.crs = "EPSG:4326";
    source.columns = columns;
    source.rows = rows;
    source.step_unit = "degree";
    parts.info.sources.push_back(source);

    parts.geoid = sloping_geoid(frame, 3, 7);
    parts.metrics = lod::build_metrics(frame, parts.undulations(), parts.heights);
    return parts;
}

/// Every 8th post of the codes of a padded grid.
inline lod::MetricRasters lattice_of(const lod::MetricRasters& codes) {
    const int step = lod::BlockGrid::kLatticeSpacing;
    const int side = (codes.radius.columns() - 1) / step + 1;
    const auto thinned = [&](const lod::Raster<std::uint16_t>& all) {
        lod::Raster<std::uint16_t> some(side, side);
        for (int row = 0; row < side; ++row) {
            for (int column = 0; column < side; ++column)
                some.at(column, row) = all.at(step * column, step * row);
        }
        return some;
    };
    return {thinned(codes.bounded), thinned(codes.incremental), thinned(codes.radius)};
}

inline Result<void> write_posts(const lod::SceneWriter& writer, const SceneParts& parts) {
    auto posts = writer.posts(parts.info.frame, {parts.info.height_type, parts.info.max_height_error_m}, 0);
    if (!posts) return posts.error();
    const auto marks = parts.marks.columns() > 0 ? parts.marks : lod::plain_marks(parts.heights);
    return lod::for_each_block(posts->grid().count(), [&](int i) -> Result<void> {
        const int column = i % posts->grid().across;
        const int row = i / posts->grid().across;
        const auto box = posts->grid().box(column, row);
        return posts->write(column, row, {lod::part_of(parts.heights, box), lod::part_of(marks, box)});
    });
}

/// A part of codes without those of the lattice.
inline lod::MetricRasters fine_part(const lod::MetricRasters& codes, const lod::BlockGrid::Box& box) {
    const int step = lod::BlockGrid::kLatticeSpacing;
    const auto part = [&](const lod::Raster<std::uint16_t>& all) {
        auto some = lod::part_of(all, box);
        for (int y = 0; y < some.rows(); y += step) {
            for (int x = 0; x < some.columns(); x += step) some.at(x, y) = 0;
        }
        return some;
    };
    return {part(codes.bounded), part(codes.incremental), part(codes.radius)};
}

inline Result<void> write_pyramid(const lod::SceneWriter& writer, const SceneParts& parts) {
    const geo::GridFrame& frame = parts.info.frame;
    lod::MeshHeights fill(frame);
    fill.add(0, 0, parts.heights);
    fill.finish();
    const auto marks = parts.marks.columns() > 0 ? parts.marks : lod::plain_marks(parts.heights);
    auto pyramid = lod::PyramidWriter::open(
        writer, frame, parts.info.height_type, fill, [&](const lod::BlockGrid::Box& box) {
            return Result(lod::Posts{lod::part_of(parts.heights, box), lod::part_of(marks, box)});
        });
    if (!pyramid) return pyramid.error();
    const auto tiles = lod::BlockGrid::of_metrics(frame.padded_side());
    const auto done = lod::for_each_block(tiles.count(), [&](int i) {
        const auto [column, row] = lod::PyramidWriter::tile_in_order(tiles, i);
        auto box = tiles.box(column, row);
        ++box.columns;
        ++box.rows;
        return pyramid->add_tile(column, row, fine_part(parts.metrics, box));
    });
    if (!done) return done;
    return pyramid->finish(lattice_of(parts.metrics));
}

/// Writes a scene, with its geoid unless its heights are above the ellipsoid.
inline Result<void> write_scene(const SceneParts& parts, const std::filesystem::path& path,
                                bool overwrite = false) {
    auto writer = lod::SceneWriter::create(path, {.overwrite = overwrite});
    if (!writer) return writer.error();
    if (auto done = write_posts(*writer, parts); !done) return done;
    if (auto done = write_pyramid(*writer, parts); !done) return done;
    if (parts.geoid) {
        if (auto done = writer->write_geoid(*parts.geoid); !done) return done;
    }
    return writer->commit(parts.info);
}

/// The metrics of a scene's whole padded grid.
inline Result<lod::MetricRasters> metrics_of(const lod::Scene& scene) {
    const auto pyramid = lod::ScenePyramid::open(scene);
    if (!pyramid) return pyramid.error();
    auto bounded = lod::gather_codes(*pyramid, lod::ErrorMetric::bounded);
    if (!bounded) return bounded.error();
    auto incremental = lod::gather_codes(*pyramid, lod::ErrorMetric::incremental);
    if (!incremental) return incremental.error();
    return lod::MetricRasters{std::move(bounded->error), std::move(incremental->error),
                              std::move(bounded->radius)};
}

}  // namespace relevo::test
