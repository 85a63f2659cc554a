#include "ingest/resample/resample_tile.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace relevo::ingest {
namespace {

constexpr std::size_t kTile = kTransformTile;

std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}

/// The source of the post that is nearest to a place; for an average, whose nearest may be void, of the
/// nearest valid one.
std::uint16_t source_of(const TileOverLayer& tile, Place place, int reach) {
    const int column = static_cast<int>(std::floor(place.x + 0.5));
    const int row = static_cast<int>(std::floor(place.y + 0.5));
    const lod::Raster<double>& heights = tile.part.posts.heights;
    const Window& held = tile.part.posts.window;
    const auto is_void = [&](int c, int r) { return std::isnan(heights.at(c - held.column, r - held.row)); };
    Window best{column, row, 0, 0};
    if (tile.method == Resampling::average && is_void(column, row)) {
        double nearest = std::numeric_limits<double>::infinity();
        for (int r = row - reach; r <= row + reach; ++r)
            for (int c = column - reach; c <= column + reach; ++c) {
                const double distance = std::hypot(c - place.x, r - place.y);
                const bool inside = c >= held.column && r >= held.row && c < held.column + held.columns &&
                                    r < held.row + held.rows;
                if (!inside || distance >= nearest || is_void(c, r)) continue;
                nearest = distance;
                best = {c, r, 0, 0};
            }
    }
    return static_cast<std::uint16_t>(tile.part.source_at(best.column, best.row));
}

/// Where the scene's rows of one tile are in a layer whose columns do not depend on the row.
struct SeparablePlaces {
    std::array<double, kTile> x{};
    std::array<double, kTile> y{};
};

SeparablePlaces separable_places(const TileMesh& mesh, Window window) {
    SeparablePlaces places;
    std::array<Place, kTile> row;
    const std::span<Place> all{row.data(), at(mesh.tile().columns)};
    for (int r = window.row; r < window.row + window.rows; ++r) {
        mesh.row(r, all);
        places.y[at(r)] = row[0].y;
    }
    for (std::size_t c = 0; c < all.size(); ++c) places.x[c] = row[c].x;
    return places;
}

/// A layer's rows, interpolated along them at the columns of a tile: sum, lowest and highest of the 4 posts.
struct AcrossRows {
    std::vector<std::array<double, kTile>> sum, low, high;
};

AcrossRows interpolate_across(const LayerPart& part, const SeparablePlaces& places, int first, int last,
                              int first_row, int rows) {
    AcrossRows across;
    across.sum.resize(at(rows));
    across.low.resize(at(rows));
    across.high.resize(at(rows));
    std::array<int, kTile> left{};
    std::array<std::array<double, 4>, kTile> weights{};
    for (int c = first; c < last; ++c) {
        const double cell = std::floor(places.x[at(c)]);
        left[at(c)] = static_cast<int>(cell) - 1 - part.posts.window.column;
        weights[at(c)] = keys_weights(places.x[at(c)] - cell);
    }
    for (int r = 0; r < rows; ++r) {
        const double* from = part.posts.heights.row(first_row + r - part.posts.window.row);
        auto& sum = across.sum[at(r)];
        auto& low = across.low[at(r)];
        auto& high = across.high[at(r)];
        for (int c = first; c < last; ++c) {
            const double* h = from + left[at(c)];
            const auto& w = weights[at(c)];
            sum[at(c)] = w[0] * h[0] + w[1] * h[1] + w[2] * h[2] + w[3] * h[3];
            low[at(c)] = std::min(std::min(h[0], h[1]), std::min(h[2], h[3]));
            high[at(c)] = std::max(std::max(h[0], h[1]), std::max(h[2], h[3]));
        }
    }
    return across;
}

/// Makes the window's posts whose 16 layer posts are valid; others stay void. False where the layer's posts
/// are much closer than the tile's, so that rows have nothing to share.
bool cubic_by_rows(const TileOverLayer& tile, Window window, const SeparablePlaces& places, TileOrigin origin,
                   LayerPosts& into) {
    const auto holds = [&](int c, int r) { return tile.layer.holds({places.x[at(c)], places.y[at(r)]}); };
    int first = window.column;
    int last = window.column + window.columns;
    int top = window.row;
    int bottom = window.row + window.rows;
    // Places are in order along each axis: what the layer holds is one run of columns and one of rows.
    const auto row_inside = [&](int r) {
        return places.y[at(r)] >= -0.5 && places.y[at(r)] <= tile.layer.rows() - 0.5;
    };
    while (top < bottom && !row_inside(top)) ++top;
    while (top < bottom && !row_inside(bottom - 1)) --bottom;
    if (top == bottom) return true;
    while (first < last && !holds(first, top)) ++first;
    while (first < last && !holds(last - 1, top)) --last;
    if (first == last) return true;

    const double low_y = std::min(places.y[at(top)], places.y[at(bottom - 1)]);
    const double high_y = std::max(places.y[at(top)], places.y[at(bottom - 1)]);
    const int first_row = static_cast<int>(std::floor(low_y)) - 1;
    const int rows = static_cast<int>(std::floor(high_y)) + 3 - first_row;
    if (rows > 4 * (bottom - top) + 4) return false;
    const AcrossRows across = interpolate_across(tile.part, places, first, last, first_row, rows);
    for (int r = top; r < bottom; ++r) {
        const double cell = std::floor(places.y[at(r)]);
        const auto w = keys_weights(places.y[at(r)] - cell);
        const std::size_t i = at(static_cast<int>(cell) - 1 - first_row);
        const auto &s0 = across.sum[i], &s1 = across.sum[i + 1], &s2 = across.sum[i + 2],
                   &s3 = across.sum[i + 3];
        const auto &l0 = across.low[i], &l1 = across.low[i + 1], &l2 = across.low[i + 2],
                   &l3 = across.low[i + 3];
        const auto &h0 = across.high[i], &h1 = across.high[i + 1], &h2 = across.high[i + 2],
                   &h3 = across.high[i + 3];
        float* out = into.heights.row(origin.row + r) + origin.column;
        for (std::size_t c = at(first); c < at(last); ++c) {
            const double sum = 0.0 + w[0] * s0[c] + w[1] * s1[c] + w[2] * s2[c] + w[3] * s3[c];
            const double low = std::min(std::min(l0[c], l1[c]), std::min(l2[c], l3[c]));
            const double high = std::max(std::max(h0[c], h1[c]), std::max(h2[c], h3[c]));
            // A NaN among the posts makes the sum NaN, and the order of these keeps it.
            out[c] = static_cast<float>(std::min(std::max(sum, low), high));
        }
    }
    return true;
}

}  // namespace

void resample_tile(const TileOverLayer& tile, Window window, TileOrigin origin, LayerPosts& into) {
    const bool by_rows = tile.method == Resampling::cubic && tile.mesh.separable() &&
                         cubic_by_rows(tile, window, separable_places(tile.mesh, window), origin, into);
    const bool one_source = tile.part.sources.columns() == 0;
    std::array<Place, kTile> places;
    const std::span<Place> row{places.data(), at(tile.mesh.tile().columns)};
    for (int r = window.row; r < window.row + window.rows; ++r) {
        float* heights = into.heights.row(origin.row + r) + origin.column;
        std::uint16_t* sources = into.sources.row(origin.row + r) + origin.column;
        if (one_source)
            std::fill_n(sources + window.column, window.columns,
                        static_cast<std::uint16_t>(tile.part.source));
        const float* begin = heights + window.column;
        if (by_rows && one_source &&
            std::none_of(begin, begin + window.columns, [](float h) { return std::isnan(h); }))
            continue;
        tile.mesh.row(r, row);
        const int cell_row = tile.footprints.rows() == 0 ? 0 : tile.mesh.cell_row(r);
        for (int c = window.column; c < window.column + window.columns; ++c) {
            const Place p = places[at(c)];
            if (!tile.layer.holds(p)) continue;
            const Footprint footprint = tile.footprints.rows() == 0
                                            ? Footprint{}
                                            : tile.footprints.at(tile.mesh.cell_column(c), cell_row);
            if (!by_rows || std::isnan(heights[c]))
                heights[c] = static_cast<float>(
                    resample(tile.part.posts, p, by_rows ? Resampling::bilinear : tile.method, footprint));
            if (!one_source && !std::isnan(heights[c]))
                sources[c] = source_of(tile, p, reach(tile.method, footprint));
        }
    }
}

}  // namespace relevo::ingest
