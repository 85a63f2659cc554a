#include "ingest/resample/warp.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "ingest/resample/resample_tile.hpp"

namespace relevo::ingest {
namespace {

constexpr int kTile = kTransformTile;
constexpr double kFar = std::numeric_limits<double>::infinity();

/// A tile of the scene's posts in the layer.
struct Tile {
    TileMesh mesh;
    lod::Raster<Footprint> footprints;  // of the mesh's cells; empty unless the method uses them
    int reach = 0;                      // how far around a place the layer is needed, posts
};

/// Half the distances in the layer between a scene post's west and east, and north and south neighbours'
/// midpoints, in the middle of each cell of a mesh: at least the layer's post itself, so that coarse layers
/// are interpolated and not repeated.
lod::Raster<Footprint> footprints_of(const TileMesh& mesh, const ExactTransform& exact) {
    const auto& columns = mesh.node_columns();
    const auto& rows = mesh.node_rows();
    const auto middle = [](const std::vector<int>& nodes, int cell) {
        const auto next = std::min(static_cast<std::size_t>(cell) + 1, nodes.size() - 1);
        return 0.5 * (nodes[static_cast<std::size_t>(cell)] + nodes[next]);
    };
    const int across = std::max(static_cast<int>(columns.size()) - 1, 1);
    const int down = std::max(static_cast<int>(rows.size()) - 1, 1);
    std::vector<Place> around;
    for (int j = 0; j < down; ++j)
        for (int i = 0; i < across; ++i) {
            const double x = mesh.tile().column + middle(columns, i);
            const double y = mesh.tile().row + middle(rows, j);
            around.insert(around.end(), {{x - 0.5, y}, {x + 0.5, y}, {x, y - 0.5}, {x, y + 0.5}});
        }
    exact(around);
    const auto at_least_a_post = [](double half) { return half > 0.5 ? half : 0.5; };  // also where it is NaN
    lod::Raster<Footprint> found{across, down};
    for (std::size_t k = 0; k < found.samples().size(); ++k) {
        const Place* p = &around[4 * k];
        found.samples()[k] = {at_least_a_post(0.5 * std::hypot(p[1].x - p[0].x, p[3].x - p[2].x)),
                              at_least_a_post(0.5 * std::hypot(p[1].y - p[0].y, p[3].y - p[2].y))};
    }
    return found;
}

/// The window of a layer that posts with these places need; nothing where none is in it.
std::optional<Window> layer_window(const Layer& layer, TileMesh::Box box, int margin) {
    box.top = std::max(box.top, -0.5);
    box.bottom = std::min(box.bottom, layer.rows() - 0.5);
    if (layer.turn() == 0) {
        box.left = std::max(box.left, -0.5);
        box.right = std::min(box.right, layer.columns() - 0.5);
    }
    if (!(box.left <= box.right && box.top <= box.bottom)) return {};
    const int first_column = static_cast<int>(std::floor(box.left)) - margin;
    const int first_row = static_cast<int>(std::floor(box.top)) - margin;
    return Window{first_column, first_row,
                  static_cast<int>(std::floor(box.right)) + margin + 1 - first_column,
                  static_cast<int>(std::floor(box.bottom)) + margin + 1 - first_row};
}

/// One window of the scene being made.
class Work {
  public:
    Work(const Layer& layer, const GridMap& map, Resampling method, Window window,
         const std::vector<bool>& wanted)
        : layer_(layer), method_(method), window_(window), posts_(window.columns, window.rows) {
        const ExactTransform exact = [&](std::span<Place> p) { map.to_source(p); };
        across_ = (window.columns + kTile - 1) / kTile;
        const int down = (window.rows + kTile - 1) / kTile;
        tiles_.resize(static_cast<std::size_t>(across_) * static_cast<std::size_t>(down));
        for (std::size_t i = 0; i < tiles_.size(); ++i) {
            if (!wanted[i]) continue;
            const int column = static_cast<int>(i) % across_ * kTile;
            const int row = static_cast<int>(i) / across_ * kTile;
            Tile& tile = tiles_[i].emplace(
                Tile{TileMesh{exact,
                              {window.column + column, window.row + row,
                               std::min(kTile, window.columns - column), std::min(kTile, window.rows - row)}},
                     {},
                     reach(method, {})});
            if (method != Resampling::average) continue;
            tile.footprints = footprints_of(tile.mesh, exact);
            for (const Footprint& f : tile.footprints.samples())
                tile.reach = std::max(tile.reach, reach(method, f));
        }
    }

    Result<LayerPosts> posts() {
        if (auto done = part({0, 0, window_.columns, window_.rows}); !done) return done.error();
        return std::move(posts_);
    }

  private:
    /// Halves a part (relative to the window) until what it needs of the layer can be held at once.
    Result<void> part(Window w) {
        const auto needed = needed_for(w);
        if (!needed || !layer_.has_posts_in(*needed)) return {};
        if (std::int64_t{needed->columns} * needed->rows > kMostSourcePosts &&
            (w.columns > 1 || w.rows > 1)) {
            Window first = w;
            Window second = w;
            if (w.columns >= w.rows) {
                first.columns = half(w.columns);
                second.column += first.columns;
                second.columns -= first.columns;
            } else {
                first.rows = half(w.rows);
                second.row += first.rows;
                second.rows -= first.rows;
            }
            if (auto done = part(first); !done) return done;
            return part(second);
        }
        const auto read = layer_.read(*needed);
        if (!read) return read.error();
        for_each_tile(w, [&](const Tile& tile, Window inside) {
            resample_tile({layer_, *read, tile.mesh, tile.footprints, method_}, inside,
                          {tile.mesh.tile().column - window_.column, tile.mesh.tile().row - window_.row},
                          posts_);
        });
        return {};
    }

    /// About half, at a tile's border where there is more than one.
    static int half(int count) { return count > kTile ? (count / kTile + 1) / 2 * kTile : count / 2; }

    /// Calls f(tile, window) with the part of the window that is in each wanted tile, relative to the tile.
    template <class F>
    void for_each_tile(Window w, const F& f) const {
        for (int row = w.row / kTile; row * kTile < w.row + w.rows; ++row)
            for (int column = w.column / kTile; column * kTile < w.column + w.columns; ++column) {
                const auto& tile = tiles_[static_cast<std::size_t>(row) * static_cast<std::size_t>(across_) +
                                          static_cast<std::size_t>(column)];
                if (!tile) continue;
                const Window inside = common_part(
                    {column * kTile, row * kTile, tile->mesh.tile().columns, tile->mesh.tile().rows}, w);
                f(*tile, Window{inside.column - column * kTile, inside.row - row * kTile, inside.columns,
                                inside.rows});
            }
    }

    std::optional<Window> needed_for(Window w) const {
        TileMesh::Box box{kFar, kFar, -kFar, -kFar};
        int margin = 0;
        for_each_tile(w, [&](const Tile& tile, Window inside) {
            const auto b = tile.mesh.box_of(inside);
            box = {std::min(box.left, b.left), std::min(box.top, b.top), std::max(box.right, b.right),
                   std::max(box.bottom, b.bottom)};
            margin = std::max(margin, tile.reach);
        });
        return layer_window(layer_, box, margin);
    }

    const Layer& layer_;
    Resampling method_;
    Window window_;
    LayerPosts posts_;
    int across_ = 0;
    std::vector<std::optional<Tile>> tiles_;
};

}  // namespace

LayerPosts::LayerPosts(int columns, int rows)
    : heights(columns, rows, std::numeric_limits<float>::quiet_NaN()), sources(columns, rows) {}

Result<LayerPosts> Warp::read(Window window, const std::vector<bool>& wanted) const {
    return Work{*layer_, map_, method_, window, wanted}.posts();
}

}  // namespace relevo::ingest
