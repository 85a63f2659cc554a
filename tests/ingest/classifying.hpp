#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "ingest/sea/sea_bed.hpp"
#include "ingest/sea/sea_classifier.hpp"

namespace relevo::test {

using Heights = lod::Raster<float>;
using Marks = lod::Raster<lod::PostMark>;

/// Land where there is a height, void where it is NaN.
inline Marks marks_of(const Heights& heights, int source = 3) {
    Marks marks(heights.columns(), heights.rows());
    for (std::size_t i = 0; i < marks.samples().size(); ++i) {
        const bool gap = std::isnan(heights.samples()[i]);
        marks.samples()[i] = {gap ? lod::PostClass::void_post : lod::PostClass::land, source};
    }
    return marks;
}

template <class T>
lod::Raster<T> part(const lod::Raster<T>& whole, ingest::Window window) {
    lod::Raster<T> cut(window.columns, window.rows);
    for (int r = 0; r < window.rows; ++r) {
        for (int c = 0; c < window.columns; ++c) cut.at(c, r) = whole.at(window.column + c, window.row + r);
    }
    return cut;
}

template <class T>
void put(const lod::Raster<T>& from, ingest::Window inside, int column, int row, lod::Raster<T>& whole) {
    for (int r = 0; r < inside.rows; ++r) {
        for (int c = 0; c < inside.columns; ++c)
            whole.at(column + c, row + r) = from.at(inside.column + c, inside.row + r);
    }
}

/// A block of a raster with a halo as far as the raster goes.
struct HaloBlock {
    ingest::Window all;     // in the raster
    ingest::Window inside;  // the block, in `all`
};

inline HaloBlock halo_block(int columns, int rows, ingest::Window block, int halo) {
    const int west = std::min(halo, block.column);
    const int north = std::min(halo, block.row);
    const int east = std::min(halo, columns - block.column - block.columns);
    const int south = std::min(halo, rows - block.row - block.rows);
    return {{block.column - west, block.row - north, west + block.columns + east, north + block.rows + south},
            {west, north, block.columns, block.rows}};
}

/// The blocks of a raster, by rows.
inline std::vector<ingest::Window> blocks_of(int columns, int rows, int side) {
    std::vector<ingest::Window> blocks;
    for (int r = 0; r < rows; r += side) {
        for (int c = 0; c < columns; c += side)
            blocks.push_back({c, r, std::min(side, columns - c), std::min(side, rows - r)});
    }
    return blocks;
}

struct Classified {
    Heights heights;
    Marks marks;
    lod::SeaInfo info;

    std::uint64_t count(lod::PostClass post_class) const {
        std::uint64_t posts = 0;
        for (const auto mark : marks.samples()) posts += mark.post_class() == post_class ? 1 : 0;
        return posts;
    }
    std::uint64_t land() const { return count(lod::PostClass::land); }
    std::uint64_t sea() const { return count(lod::PostClass::sea); }
    std::uint64_t voids() const { return count(lod::PostClass::void_post); }
};

inline geo::GridFrame frame_for(const Heights& heights, double step = 1.0 / 1200) {
    geo::GridFrame frame;
    frame.west = 4;
    frame.north = 52;
    frame.step_x = step;
    frame.step_y = step;
    frame.columns = heights.columns();
    frame.rows = heights.rows();
    return frame;
}

inline ingest::SeaRequest asking(lod::SeaInfo::Request kind) {
    ingest::SeaRequest request;
    request.kind = kind;
    return request;
}

/// Classifies a scene block by block, in the order of rows or backwards, as an import does.
inline Classified classify(const Heights& heights, const ingest::SeaRequest& request = {}, int side = 512,
                           bool backwards = false, geo::GridFrame frame = {}) {
    if (frame.columns == 0) frame = frame_for(heights);
    Classified result{heights, marks_of(heights), {}};
    auto classifier = ingest::SeaClassifier::create(frame, request, side);
    if (!classifier) {
        ADD_FAILURE() << classifier.error().message;
        return result;
    }
    auto blocks = blocks_of(heights.columns(), heights.rows(), side);
    if (backwards) std::reverse(blocks.begin(), blocks.end());
    if (classifier->needs_blocks()) {
        for (const auto& block : blocks)
            classifier->add_block(block.column / side, block.row / side, part(heights, block),
                                  part(result.marks, block));
    }
    result.info = classifier->decide();
    const Marks before = result.marks;
    for (const auto& block : blocks) {
        Heights block_heights = part(heights, block);
        Marks block_marks = part(before, block);
        const auto modelled =
            classifier->mark_block(block.column / side, block.row / side, block_heights, block_marks);
        if (!modelled) {
            ADD_FAILURE() << modelled.error().message;
            return result;
        }
        put(block_marks, {0, 0, block.columns, block.rows}, block.column, block.row, result.marks);
        if (*modelled == 0) continue;
        const auto halo = halo_block(heights.columns(), heights.rows(), block, ingest::kSeaBedHalo);
        Heights wide = part(heights, halo.all);
        Marks wide_marks = part(before, halo.all);
        put(block_marks, {0, 0, block.columns, block.rows}, halo.inside.column, halo.inside.row, wide_marks);
        ingest::model_sea_bed(frame, halo.all.column, halo.all.row, halo.inside, wide, wide_marks);
        put(wide, halo.inside, block.column, block.row, result.heights);
    }
    return result;
}

/// Heights from a drawing: a character is `scale` x `scale` posts of the height that the legend gives it.
inline Heights drawn(const std::vector<std::string>& rows, const std::map<char, float>& legend,
                     int scale = 1) {
    Heights heights(static_cast<int>(rows.front().size()) * scale, static_cast<int>(rows.size()) * scale);
    for (int r = 0; r < heights.rows(); ++r) {
        for (int c = 0; c < heights.columns(); ++c)
            heights.at(c, r) =
                legend.at(rows[static_cast<std::size_t>(r / scale)][static_cast<std::size_t>(c / scale)]);
    }
    return heights;
}

/// The classes as a drawing of the same size: ~ sea, # land, a space void. A character that is not all of one
/// class is an x.
inline std::vector<std::string> picture(const Classified& scene, int scale = 1) {
    std::vector<std::string> rows(static_cast<std::size_t>(scene.marks.rows() / scale));
    for (int r = 0; r < scene.marks.rows(); ++r) {
        for (int c = 0; c < scene.marks.columns(); ++c) {
            const auto post_class = scene.marks.at(c, r).post_class();
            const char drawn = post_class == lod::PostClass::sea    ? '~'
                               : post_class == lod::PostClass::land ? '#'
                                                                    : ' ';
            auto& row = rows[static_cast<std::size_t>(r / scale)];
            if (r % scale == 0 && c % scale == 0) row += drawn;
            char& there = row[static_cast<std::size_t>(c / scale)];
            if (there != drawn) there = 'x';
        }
    }
    return rows;
}

}  // namespace relevo::test
