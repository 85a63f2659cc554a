#include "ingest/resample/interpolated_transform.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
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

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr TileMesh::Box kNowhere{kFar, kFar, -kFar, -kFar};

/// A box widened to hold some places as well.
TileMesh::Box box_around(std::span<const Place> places, TileMesh::Box box) {
    for (const Place& p : places) {
        if (std::isnan(p.x)) continue;
        box = {std::min(box.left, p.x), std::min(box.top, p.y), std::max(box.right, p.x),
               std::max(box.bottom, p.y)};
    }
    return box;
}

/// The last of the nodes that is not beyond a post.
int node_before(const std::vector<int>& nodes, int post) {
    return static_cast<int>(std::upper_bound(nodes.begin(), nodes.end(), post) - nodes.begin()) - 1;
}

/// The cell that a post is in; the last node belongs to the last cell.
int cell_of(const std::vector<int>& nodes, int post) {
    return std::max(std::min(node_before(nodes, post), static_cast<int>(nodes.size()) - 2), 0);
}

}  // namespace

TileMesh::TileMesh(const ExactTransform& exact, Window tile, double tolerance) : tile_(tile) {
    assert(tile.columns > 0 && tile.columns <= kTransformTile && tile.rows > 0 &&
           tile.rows <= kTransformTile);
    for (int step = kTransformTile;; step /= 2) {
        place_corners(exact, step);
        if (step == 1 || close_enough(exact, tolerance)) return;
    }
}

void TileMesh::place_corners(const ExactTransform& exact, int step) {
    columns_ = nodes_along(tile_.columns, step);
    rows_ = nodes_along(tile_.rows, step);
    corners_ = lod::Raster<Place>{static_cast<int>(columns_.size()), static_cast<int>(rows_.size())};
    for (int j = 0; j < corners_.rows(); ++j)
        for (int i = 0; i < corners_.columns(); ++i)
            corners_.at(i, j) = {static_cast<double>(tile_.column + columns_[static_cast<std::size_t>(i)]),
                                 static_cast<double>(tile_.row + rows_[static_cast<std::size_t>(j)])};
    exact(corners_.samples());
}

/// Is interpolation in the cells within the tolerance (see the header)?
bool TileMesh::close_enough(const ExactTransform& exact, double tolerance) const {
    constexpr std::size_t kPlaces =
        5;  // a cell's centre and the middles of its edges: north, south, west, east
    const int across = std::max(corners_.columns() - 1, 1);
    const int down = std::max(corners_.rows() - 1, 1);
    std::vector<Place> checks;
    checks.reserve(kPlaces * static_cast<std::size_t>(across) * static_cast<std::size_t>(down));
    const auto column_at = [&](int i) { return tile_.column + columns_[static_cast<std::size_t>(i)]; };
    const auto row_at = [&](int j) { return tile_.row + rows_[static_cast<std::size_t>(j)]; };
    for (int j = 0; j < down; ++j)
        for (int i = 0; i < across; ++i) {
            // A tile of one column or row has cells without a width: both ends are the same corner.
            const double west = column_at(i);
            const double east = column_at(std::min(i + 1, corners_.columns() - 1));
            const double north = row_at(j);
            const double south = row_at(std::min(j + 1, corners_.rows() - 1));
            const double x = 0.5 * (west + east);
            const double y = 0.5 * (north + south);
            checks.insert(checks.end(), {{x, y}, {x, north}, {x, south}, {west, y}, {east, y}});
        }
    exact(checks);
    const Place* truth = checks.data();
    for (int j = 0; j < down; ++j)
        for (int i = 0; i < across; ++i, truth += kPlaces) {
            const int i1 = std::min(i + 1, corners_.columns() - 1);
            const int j1 = std::min(j + 1, corners_.rows() - 1);
            const Place nw = corners_.at(i, j);
            const Place ne = corners_.at(i1, j);
            const Place sw = corners_.at(i, j1);
            const Place se = corners_.at(i1, j1);
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

void TileMesh::row(int row, std::span<Place> places) const {
    assert(row >= 0 && row < tile_.rows && static_cast<int>(places.size()) == tile_.columns);
    const int cell_row = node_before(rows_, row);
    const int next_row = std::min(cell_row + 1, corners_.rows() - 1);
    const int top = rows_[static_cast<std::size_t>(cell_row)];
    const int height = std::max(rows_[static_cast<std::size_t>(next_row)] - top, 1);
    const double v = static_cast<double>(row - top) / height;
    // Corners as they are, so that single posts are exact and nothing next to them gets their NaN.
    const auto on_row = [&](int i) {
        return v == 0 ? corners_.at(i, cell_row)
                      : mixed(corners_.at(i, cell_row), corners_.at(i, next_row), v);
    };
    Place west = on_row(0);
    for (int i = 0; i < corners_.columns(); ++i) {
        const int left = columns_[static_cast<std::size_t>(i)];
        places[static_cast<std::size_t>(left)] = west;
        if (i + 1 == corners_.columns()) return;
        const int width = columns_[static_cast<std::size_t>(i) + 1] - left;
        const Place east = on_row(i + 1);
        for (int k = 1; k < width; ++k)
            places[static_cast<std::size_t>(left + k)] = mixed(west, east, static_cast<double>(k) / width);
        west = east;
    }
}

int TileMesh::cell_column(int column) const {
    return cell_of(columns_, column);
}

int TileMesh::cell_row(int row) const {
    return cell_of(rows_, row);
}

TileMesh::Box TileMesh::box() const {
    // Interpolated places lie between their cell's corners.
    return box_around(corners_.samples(), kNowhere);
}

TileMesh::Box TileMesh::box_of(Window window) const {
    if (window.columns == tile_.columns && window.rows == tile_.rows) return box();
    Box box = kNowhere;
    std::array<Place, kTransformTile> places;
    const std::span<Place> all{places.data(), static_cast<std::size_t>(tile_.columns)};
    for (int r = window.row; r < window.row + window.rows; ++r) {
        row(r, all);
        box = box_around(
            all.subspan(static_cast<std::size_t>(window.column), static_cast<std::size_t>(window.columns)),
            box);
    }
    return box;
}

bool TileMesh::separable() const {
    for (int j = 0; j < corners_.rows(); ++j)
        for (int i = 0; i < corners_.columns(); ++i)
            if (corners_.at(i, j).x != corners_.at(i, 0).x || corners_.at(i, j).y != corners_.at(0, j).y)
                return false;
    return true;
}

lod::Raster<Place> transform_posts(const ExactTransform& exact, Window window, double tolerance) {
    assert(window.column % kTransformTile == 0 && window.row % kTransformTile == 0);
    lod::Raster<Place> places{window.columns, window.rows};
    for (int row = 0; row < window.rows; row += kTransformTile)
        for (int column = 0; column < window.columns; column += kTransformTile) {
            const Window tile{window.column + column, window.row + row,
                              std::min(kTransformTile, window.columns - column),
                              std::min(kTransformTile, window.rows - row)};
            const TileMesh mesh{exact, tile, tolerance};
            for (int r = 0; r < tile.rows; ++r)
                mesh.row(r, {places.row(row + r) + column, static_cast<std::size_t>(tile.columns)});
        }
    return places;
}

}  // namespace relevo::ingest
