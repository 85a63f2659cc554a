#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "ingest/mosaic/mosaic.hpp"
#include "ingest/source/inputs.hpp"
#include "lod/scene/block_grid.hpp"
#include "lod/scene/parallel_blocks.hpp"

namespace relevo::test {

/// A mosaic with all its posts in memory, read block by block on all cores as an import does.
struct WholeMosaic {
    geo::GridFrame frame;
    lod::Raster<float> heights;
    lod::Raster<lod::PostMark> marks;
    std::vector<lod::SourceInfo> sources;
    lod::VerticalReference vertical;
    std::string method;
    bool fits_int16 = false;
    std::vector<std::string> notes;
    lod::ResamplingError error;

    float at(geo::LatLon place) const {
        const auto p = frame.grid_position(place);
        return heights.at(static_cast<int>(std::lround(p.column)), static_cast<int>(std::lround(p.row)));
    }

    /// Bilinear height at a place; NaN where a corner is void or outside.
    double height(double lat, double lon) const {
        const auto p = frame.grid_position({geo::Degrees{lat}, geo::Degrees{lon}});
        const int i = static_cast<int>(std::floor(p.column));
        const int j = static_cast<int>(std::floor(p.row));
        if (i < 0 || j < 0 || i + 1 >= heights.columns() || j + 1 >= heights.rows()) return std::nan("");
        const double u = p.column - i;
        const double v = p.row - j;
        const auto post = [&](int c, int r) { return static_cast<double>(heights.at(c, r)); };
        return (1 - v) * ((1 - u) * post(i, j) + u * post(i + 1, j)) +
               v * ((1 - u) * post(i, j + 1) + u * post(i + 1, j + 1));
    }

    int valid_posts() const {
        return static_cast<int>(std::count_if(heights.samples().begin(), heights.samples().end(),
                                              [](float h) { return !std::isnan(h); }));
    }
};

inline ingest::MosaicRequest request_for(const std::vector<std::filesystem::path>& files) {
    ingest::MosaicRequest request;
    std::vector<std::string> inputs;
    for (const auto& file : files) inputs.push_back(file.string());
    const auto expanded = ingest::expand_inputs(inputs);
    EXPECT_TRUE(expanded) << (expanded ? "" : expanded.error().message);
    if (!expanded) return request;
    for (const std::string& input : *expanded) {
        request.sources.emplace_back();
        request.sources.back().input = input;
    }
    return request;
}

/// Calls work for each block of a frame, on all cores.
template <class Work>
Result<void> for_each_block_of(const geo::GridFrame& frame, const Work& work) {
    const auto grid = lod::BlockGrid::of_heights(frame.columns, frame.rows);
    return lod::for_each_block(grid.count(), [&](int i) -> Result<void> {
        const auto box = grid.box(i % grid.across, i / grid.across);
        return work(ingest::Window{box.column, box.row, box.columns, box.rows});
    });
}

inline WholeMosaic read_whole(const ingest::Mosaic& mosaic, bool with_error = false) {
    WholeMosaic whole;
    whole.frame = mosaic.frame();
    whole.heights = lod::Raster<float>{whole.frame.columns, whole.frame.rows};
    whole.marks = lod::Raster<lod::PostMark>{whole.frame.columns, whole.frame.rows};
    whole.sources = mosaic.sources();
    whole.vertical = mosaic.vertical();
    whole.method = mosaic.resampling_method();
    whole.fits_int16 = mosaic.fits_int16();
    whole.notes = mosaic.notes();
    const auto done = for_each_block_of(whole.frame, [&](ingest::Window w) -> Result<void> {
        const auto posts = mosaic.read(w);
        if (!posts) return posts.error();
        for (int r = 0; r < w.rows; ++r) {
            std::copy_n(posts->heights.row(r), w.columns, whole.heights.row(w.row + r) + w.column);
            std::copy_n(posts->marks.row(r), w.columns, whole.marks.row(w.row + r) + w.column);
        }
        return {};
    });
    EXPECT_TRUE(done) << (done ? "" : done.error().message);
    if (!with_error) return whole;
    const auto scene = [&](ingest::Window w) -> Result<lod::Raster<float>> {
        lod::Raster<float> part{w.columns, w.rows};
        for (int r = 0; r < w.rows; ++r)
            std::copy_n(whole.heights.row(w.row + r) + w.column, w.columns, part.row(r));
        return part;
    };
    const ingest::Progress none;
    const auto error = mosaic.resampling_error(scene, ingest::Stage{none, 0, 1});
    EXPECT_TRUE(error) << (error ? "" : error.error().message);
    if (error) whole.error = *error;
    return whole;
}

/// Opens and reads a mosaic; a failure fails the test and gives an empty one.
inline WholeMosaic whole_mosaic(const ingest::MosaicRequest& request, bool with_error = false) {
    const auto mosaic = ingest::Mosaic::open(request);
    EXPECT_TRUE(mosaic) << (mosaic ? "" : mosaic.error().message);
    if (!mosaic) return {};
    return read_whole(*mosaic, with_error);
}

/// Are two heights the same, voids included?
inline bool same(float a, float b) {
    return a == b || (std::isnan(a) && std::isnan(b));
}

}  // namespace relevo::test
