#include "ingest/interpolated_transform.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

namespace relevo::ingest {
namespace {

constexpr double kMargin = 2;  // for second derivatives that change inside a cell

double distance(Place a, Place b) {
    return std::hypot(a.x - b.x, a.y - b.y);
}
Place middle(Place a, Place b) {
    return {0.5 * (a.x + b.x), 0.5 * (a.y + b.y)};
}
Place mixed(Place a, Place b, double t) {
    return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

/// Node positions along one axis: 0, step, 2 step, ..., and the last post.
std::vector<int> nodes_along(int posts, int step) {
    std::vector<int> nodes;
    for (int i = 0; i < posts - 1; i += step) nodes.push_back(i);
    nodes.push_back(posts - 1);
    return nodes;
}

/// The exact map at the corners of a tile's cells.
struct Mesh {
    std::vector<int> columns;  // relative to the tile
    std::vector<int> rows;
    lod::Raster<Place> corners;
};

Mesh exact_mesh(const ExactTransform& exact, Window tile, int step) {
    Mesh mesh{nodes_along(tile.columns, step), nodes_along(tile.rows, step), {}};
    mesh.corners =
        lod::Raster<Place>{static_cast<int>(mesh.columns.size()), static_cast<int>(mesh.rows.size())};
    for (int j = 0; j < mesh.corners.rows(); ++j)
        for (int i = 0; i < mesh.corners.columns(); ++i)
            mesh.corners.at(i, j) = {
                static_cast<double>(tile.column + mesh.columns[static_cast<std::size_t>(i)]),
                static_cast<double>(tile.row + mesh.rows[static_cast<std::size_t>(j)])};
    exact(mesh.corners.samples());
    return mesh;
}

/// Is interpolation in the mesh's cells within the tolerance (see the header)?
bool close_enough(const ExactTransform& exact, Window tile, const Mesh& mesh, double tolerance) {
    constexpr std::size_t kPlaces =
        5;  // a cell's centre and the middles of its edges: north, south, west, east
    const int across = std::max(mesh.corners.columns() - 1, 1);
    const int down = std::max(mesh.corners.rows() - 1, 1);
    std::vector<Place> checks;
    checks.reserve(kPlaces * static_cast<std::size_t>(across) * static_cast<std::size_t>(down));
    const auto column_at = [&](int i) { return tile.column + mesh.columns[static_cast<std::size_t>(i)]; };
    const auto row_at = [&](int j) { return tile.row + mesh.rows[static_cast<std::size_t>(j)]; };
    for (int j = 0; j < down; ++j)
        for (int i = 0; i < across; ++i) {
            // A tile of one column or row has cells without a width: both ends are the same corner.
            const double west = column_at(i);
            const double east = column_at(std::min(i + 1, mesh.corners.columns() - 1));
            const double north = row_at(j);
            const double south = row_at(std::min(j + 1, mesh.corners.rows() - 1));
            const double x = 0.5 * (west + east);
            const double y = 0.5 * (north + south);
            checks.insert(checks.end(), {{x, y}, {x, north}, {x, south}, {west, y}, {east, y}});
        }
    exact(checks);
    const Place* truth = checks.data();
    for (int j = 0; j < down; ++j)
        for (int i = 0; i < across; ++i, truth += kPlaces) {
            const int i1 = std::min(i + 1, mesh.corners.columns() - 1);
            const int j1 = std::min(j + 1, mesh.corners.rows() - 1);
            const Place nw = mesh.corners.at(i, j);
            const Place ne = mesh.corners.at(i1, j);
            const Place sw = mesh.corners.at(i, j1);
            const Place se = mesh.corners.at(i1, j1);
            const double centre = distance(truth[0], middle(middle(nw, ne), middle(sw, se)));
            const double along_columns =
                std::max(distance(truth[1], middle(nw, ne)), distance(truth[2], middle(sw, se)));
            const double along_rows =
                std::max(distance(truth[3], middle(nw, sw)), distance(truth[4], middle(ne, se)));
            // Written so that a NaN fails.
            if (!(kMargin * (along_columns + along_rows) <= tolerance && kMargin * centre <= tolerance))
                return false;
        }
    return true;
}

void interpolate(const Mesh& mesh, Window tile, Window window, lod::Raster<Place>& into) {
    for (int j = 0; j < tile.rows; ++j) {
        int cell_row = 0;
        while (cell_row + 1 < mesh.corners.rows() && mesh.rows[static_cast<std::size_t>(cell_row) + 1] <= j)
            ++cell_row;
        const int next_row = std::min(cell_row + 1, mesh.corners.rows() - 1);
        const int top = mesh.rows[static_cast<std::size_t>(cell_row)];
        const int height = std::max(mesh.rows[static_cast<std::size_t>(next_row)] - top, 1);
        const double v = static_cast<double>(j - top) / height;

        Place* out = into.row(tile.row + j - window.row) + (tile.column - window.column);
        for (int i = 0; i < mesh.corners.columns(); ++i) {
            const int next = std::min(i + 1, mesh.corners.columns() - 1);
            const int left = mesh.columns[static_cast<std::size_t>(i)];
            const int width = std::max(mesh.columns[static_cast<std::size_t>(next)] - left, 1);
            // Corners as they are, so that single posts are exact and nothing next to them gets their NaN.
            const bool on_row = v == 0;
            const Place west = on_row ? mesh.corners.at(i, cell_row)
                                      : mixed(mesh.corners.at(i, cell_row), mesh.corners.at(i, next_row), v);
            out[left] = west;
            if (next == i || width == 1) continue;
            const Place east =
                on_row ? mesh.corners.at(next, cell_row)
                       : mixed(mesh.corners.at(next, cell_row), mesh.corners.at(next, next_row), v);
            for (int k = 1; k < width; ++k) out[left + k] = mixed(west, east, static_cast<double>(k) / width);
        }
    }
}

}  // namespace

lod::Raster<Place> transform_posts(const ExactTransform& exact, Window window, double tolerance) {
    assert(window.column % kTransformTile == 0 && window.row % kTransformTile == 0);
    lod::Raster<Place> places{window.columns, window.rows};
    for (int row = 0; row < window.rows; row += kTransformTile)
        for (int column = 0; column < window.columns; column += kTransformTile) {
            const Window tile{window.column + column, window.row + row,
                              std::min(kTransformTile, window.columns - column),
                              std::min(kTransformTile, window.rows - row)};
            for (int step = kTransformTile;; step /= 2) {
                const Mesh mesh = exact_mesh(exact, tile, step);
                if (step > 1 && !close_enough(exact, tile, mesh, tolerance)) continue;
                interpolate(mesh, tile, window, places);
                break;
            }
        }
    return places;
}

}  // namespace relevo::ingest
