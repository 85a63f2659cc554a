#include "ingest/mosaic/layer.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "geo/angle.hpp"
#include "geo/ellipsoid.hpp"
#include "ingest/mosaic/lattice.hpp"

namespace relevo::ingest {
namespace {

/// Area of the cell around a place of a source on the ellipsoid, by the radii of curvature there.
double cell_area_m2(const SourceMap& map, Place at) {
    Place around[4] = {{at.x - 0.5, at.y}, {at.x + 0.5, at.y}, {at.x, at.y - 0.5}, {at.x, at.y + 0.5}};
    map.to_lon_lat(around);
    const auto radians = [](double degrees) { return geo::Degrees{degrees}.radians(); };
    const double lat = radians(0.5 * (around[0].y + around[1].y));
    const double w2 = 1 - geo::wgs84::kEccentricity2 * std::sin(lat) * std::sin(lat);
    const double across = geo::wgs84::kSemiMajor / std::sqrt(w2);
    const double along = across * (1 - geo::wgs84::kEccentricity2) / w2;
    const double lon_column = radians(std::remainder(around[1].x - around[0].x, 360));
    const double lat_column = radians(around[1].y - around[0].y);
    const double lon_row = radians(std::remainder(around[3].x - around[2].x, 360));
    const double lat_row = radians(around[3].y - around[2].y);
    return std::abs(lon_column * lat_row - lon_row * lat_column) * across * std::cos(lat) * along;
}

double spacing_of(const SourceMap& map) {
    // The middle, or else (it may be a pole, or outside what the CRS can show) a place beside it.
    for (const double part : {0.5, 0.25, 0.75, 0.1, 0.9}) {
        const double area = cell_area_m2(map, {part * (map.columns() - 1), part * (map.rows() - 1)});
        if (std::isfinite(area) && area > 0) return std::sqrt(area);
    }
    return std::numeric_limits<double>::infinity();
}

}  // namespace

Layer::Layer(const SourcePool& pool, const Affine& lattice, std::vector<Member> members,
             std::shared_ptr<const Operation> operation)
    : pool_(&pool),
      crs_(pool.facts(members[0].source).crs),
      operation_(std::move(operation)),
      posts_(lattice),
      members_(std::move(members)) {
    int left = members_[0].window.column;
    int top = members_[0].window.row;
    for (const Member& m : members_) {
        left = std::min(left, m.window.column);
        top = std::min(top, m.window.row);
    }
    // Its first post where it is the lattice's own first one stays that, bit for bit.
    if (left != 0 || top != 0) {
        const Place first = lattice.at({static_cast<double>(left), static_cast<double>(top)});
        posts_.x0 = first.x;
        posts_.y0 = first.y;
    }
    std::vector<Window> windows;
    for (Member& m : members_) {
        m.window.column -= left;
        m.window.row -= top;
        columns_ = std::max(columns_, m.window.column + m.window.columns);
        rows_ = std::max(rows_, m.window.row + m.window.rows);
        windows.push_back(m.window);
    }
    index_ = ExtentIndex{std::move(windows)};
    const bool level = std::abs(posts_.y_column) * columns_ <= kLatticeTolerance * std::abs(posts_.y_row) &&
                       std::abs(posts_.x_row) * rows_ <= kLatticeTolerance * std::abs(posts_.x_column);
    if (crs_->geographic() && level) {
        // Closed within half a step.
        const double turn = std::round(crs_->full_turn() / std::abs(posts_.x_column));
        if (columns_ >= turn) turn_ = static_cast<int>(turn);
    }
    spacing_m_ = spacing_of(map_of(members_[0]));
}

SourceMap Layer::map_of(const Member& member) const {
    Affine posts = posts_;
    const Place first =
        posts_.at({static_cast<double>(member.window.column), static_cast<double>(member.window.row)});
    posts.x0 = first.x;
    posts.y0 = first.y;
    return {*operation_, *crs_, posts, member.window.columns, member.window.rows};
}

std::vector<Layer::Piece> Layer::pieces(Window window) const {
    if (turn_ == 0) return {{window, 0}};
    std::vector<Piece> found;
    for (int done = 0; done < window.columns;) {
        const int from = ((window.column + done) % turn_ + turn_) % turn_;
        const int count = std::min(window.columns - done, turn_ - from);
        found.push_back({{from, window.row, count, window.rows}, done});
        done += count;
    }
    return found;
}

bool Layer::has_posts_in(Window window) const {
    const auto all = pieces(window);
    return std::any_of(all.begin(), all.end(),
                       [&](const Piece& piece) { return !index_.meeting(piece.window).empty(); });
}

Result<void> Layer::read_piece(const Piece& piece, LayerPart& into) const {
    for (const int i : index_.meeting(piece.window)) {
        const Member& member = members_[static_cast<std::size_t>(i)];
        const Window common = common_part(member.window, piece.window);
        const int left = piece.column + common.column - piece.window.column;
        const int top = common.row - piece.window.row;
        // A tile's last row is most often its neighbour's first: no need to read what is there already.
        bool missing = false;
        for (int r = 0; r < common.rows && !missing; ++r) {
            const double* row = into.posts.heights.row(top + r) + left;
            missing = std::any_of(row, row + common.columns, [](double h) { return std::isnan(h); });
        }
        if (!missing) continue;
        const auto read =
            pool_->read(member.source, {common.column - member.window.column, common.row - member.window.row,
                                        common.columns, common.rows});
        if (!read) return read.error();
        for (int r = 0; r < common.rows; ++r) {
            const double* from = read->row(r);
            double* to = into.posts.heights.row(top + r) + left;
            for (int c = 0; c < common.columns; ++c) {
                if (!std::isnan(to[c]) || std::isnan(from[c])) continue;
                to[c] = from[c];
                if (into.sources.columns() > 0)
                    into.sources.at(left + c, top + r) = static_cast<std::uint16_t>(
                        std::min(member.source, int{std::numeric_limits<std::uint16_t>::max()}));
            }
        }
    }
    return {};
}

Result<LayerPart> Layer::read(Window window) const {
    LayerPart part;
    part.posts = {window,
                  lod::Raster<double>{window.columns, window.rows, std::numeric_limits<double>::quiet_NaN()}};
    part.source = members_[0].source;
    if (members_.size() > 1) part.sources = lod::Raster<std::uint16_t>{window.columns, window.rows};
    for (const Piece& piece : pieces(window))
        if (auto done = read_piece(piece, part); !done) return done.error();
    return part;
}

}  // namespace relevo::ingest
