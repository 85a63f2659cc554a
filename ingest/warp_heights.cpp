#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include <tbb/parallel_for.h>

#include "ingest/interpolated_transform.hpp"
#include "ingest/read_heights.hpp"

namespace relevo::ingest {
namespace {

constexpr int kBlock = lod::SceneInfo::kBlockSide;
static_assert(kBlock % kTransformTile == 0);

// Source posts read at once for one part of a block: 128 MiB of doubles.
constexpr std::int64_t kMostSourcePosts = std::int64_t{1} << 24;

/// Where the posts of a block are in the source, and how much of it each stands for.
struct BlockPlaces {
    Window block;
    lod::Raster<Place> places;
    lod::Raster<Footprint> footprints;  // empty unless the method uses them

    Footprint footprint(int column, int row) const {
        return footprints.columns() == 0 ? Footprint{} : footprints.at(column, row);
    }
};

/// Half the distances in the source between a scene post's west and east, and north and south neighbours'
/// midpoints: at least the source post itself, so that coarse sources are interpolated and not repeated.
lod::Raster<Footprint> footprints(const GridMap& map, Window block) {
    const auto shifted = [&](double dx, double dy) {
        return transform_posts(
            [&, dx, dy](std::span<Place> places) {
                for (Place& p : places) p = {p.x + dx, p.y + dy};
                map.to_source(places);
            },
            block);
    };
    const auto west = shifted(-0.5, 0);
    const auto east = shifted(0.5, 0);
    const auto north = shifted(0, -0.5);
    const auto south = shifted(0, 0.5);
    const auto at_least_a_post = [](double half) { return half > 0.5 ? half : 0.5; };  // also where it is NaN
    lod::Raster<Footprint> result{block.columns, block.rows};
    for (int r = 0; r < block.rows; ++r)
        for (int c = 0; c < block.columns; ++c)
            result.at(c, r) = {at_least_a_post(0.5 * std::hypot(east.at(c, r).x - west.at(c, r).x,
                                                                south.at(c, r).x - north.at(c, r).x)),
                               at_least_a_post(0.5 * std::hypot(east.at(c, r).y - west.at(c, r).y,
                                                                south.at(c, r).y - north.at(c, r).y))};
    return result;
}

bool in_source(Place p, const Source& source) {
    return p.x >= -0.5 && p.y >= -0.5 && p.x <= source.columns() - 0.5 && p.y <= source.rows() - 0.5;
}

/// The part of the source that a part of a block (relative to it) is made of; nothing where it meets none.
std::optional<Window> source_window(const Source& source, const BlockPlaces& block, Window part,
                                    Resampling method) {
    double left = std::numeric_limits<double>::infinity();
    double top = left;
    double right = -left;
    double bottom = -left;
    int margin = 0;
    for (int r = part.row; r < part.row + part.rows; ++r)
        for (int c = part.column; c < part.column + part.columns; ++c) {
            const Place p = block.places.at(c, r);
            if (!in_source(p, source)) continue;
            left = std::min(left, p.x);
            right = std::max(right, p.x);
            top = std::min(top, p.y);
            bottom = std::max(bottom, p.y);
            margin = std::max(margin, reach(method, block.footprint(c, r)));
        }
    if (!(left <= right)) return {};
    const int first_column = static_cast<int>(std::floor(left)) - margin;
    const int first_row = static_cast<int>(std::floor(top)) - margin;
    return Window{first_column, first_row, static_cast<int>(std::floor(right)) + margin + 1 - first_column,
                  static_cast<int>(std::floor(bottom)) + margin + 1 - first_row};
}

class Warp {
  public:
    Warp(const Source& source, const GridMap& map, Resampling method, lod::Raster<float>& heights,
         Place origin = {})
        : source_(source),
          map_(map),
          method_(method),
          heights_(heights),
          left_(static_cast<int>(origin.x)),
          top_(static_cast<int>(origin.y)) {}

    Result<void> block(Window block) {
        BlockPlaces places{
            block, transform_posts([this](std::span<Place> p) { map_.to_source(p); }, block), {}};
        if (method_ == Resampling::average) places.footprints = footprints(map_, block);
        return part(places, {0, 0, block.columns, block.rows});
    }

  private:
    /// Halves a part until what it needs of the source can be held at once.
    Result<void> part(const BlockPlaces& block, Window w) {
        const auto window = source_window(source_, block, w, method_);
        if (!window) return {};
        if (std::int64_t{window->columns} * window->rows > kMostSourcePosts &&
            (w.columns > 1 || w.rows > 1)) {
            Window first = w;
            Window second = w;
            if (w.columns >= w.rows) {
                first.columns = w.columns / 2;
                second.column += first.columns;
                second.columns -= first.columns;
            } else {
                first.rows = w.rows / 2;
                second.row += first.rows;
                second.rows -= first.rows;
            }
            if (auto done = part(block, first); !done) return done;
            return part(block, second);
        }
        auto read = source_.read(*window);
        if (!read) return read.error();
        const SourcePart of_source{*window, std::move(*read)};
        tbb::parallel_for(w.row, w.row + w.rows, [&](int r) {
            float* out = heights_.row(block.block.row - top_ + r) + (block.block.column - left_);
            for (int c = w.column; c < w.column + w.columns; ++c) {
                const Place p = block.places.at(c, r);
                if (in_source(p, source_))
                    out[c] = static_cast<float>(resample(of_source, p, method_, block.footprint(c, r)));
            }
        });
        return {};
    }

    const Source& source_;
    const GridMap& map_;
    Resampling method_;
    lod::Raster<float>& heights_;
    int left_;
    int top_;
};

}  // namespace

Result<lod::Raster<float>> warp_heights(const Source& source, const GridMap& map, const geo::GridFrame& frame,
                                        Resampling method, const Stage& stage) {
    lod::Raster<float> heights{frame.columns, frame.rows, std::numeric_limits<float>::quiet_NaN()};
    Warp warp{source, map, method, heights};
    for (int row = 0; row < frame.rows; row += kBlock)
        for (int column = 0; column < frame.columns; column += kBlock) {
            const Window block{column, row, std::min(kBlock, frame.columns - column),
                               std::min(kBlock, frame.rows - row)};
            if (auto done = warp.block(block); !done) return done.error();
            if (!stage((row + static_cast<double>(block.rows) * (column + block.columns) / frame.columns) /
                       frame.rows))
                return interrupted();
        }
    return heights;
}

Result<lod::Raster<float>> warp_block(const Source& source, const GridMap& map, const geo::GridFrame& frame,
                                      Resampling method, Window window) {
    const auto down = [](int at) { return at / kTransformTile * kTransformTile; };
    const auto up = [](int at, int most) {
        return std::min((at + kTransformTile - 1) / kTransformTile * kTransformTile, most);
    };
    const int left = down(window.column);
    const int top = down(window.row);
    const Window tiles{left, top, up(window.column + window.columns, frame.columns) - left,
                       up(window.row + window.rows, frame.rows) - top};
    lod::Raster<float> heights{tiles.columns, tiles.rows, std::numeric_limits<float>::quiet_NaN()};
    Warp warp{source, map, method, heights, {static_cast<double>(left), static_cast<double>(top)}};
    if (auto done = warp.block(tiles); !done) return done.error();
    lod::Raster<float> part{window.columns, window.rows};
    for (int r = 0; r < window.rows; ++r)
        std::copy_n(heights.row(window.row - top + r) + (window.column - left), window.columns, part.row(r));
    return part;
}

}  // namespace relevo::ingest
