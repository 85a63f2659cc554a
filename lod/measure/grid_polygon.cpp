#include "lod/measure/grid_polygon.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "geo/geodesic.hpp"

namespace relevo::lod {
namespace {

constexpr double kTolerance = 1e-6;  // posts

Error no_polygon(std::string what) {
    return {ErrorKind::input, std::move(what)};
}

/// Adds points of a geodesic to a ring, the end left out.
class Sides {
  public:
    explicit Sides(const geo::GridFrame& frame) : frame_(frame) {}

    void add(geo::LatLon from, geo::LatLon to, GridRing& ring) const {
        const geo::GeodesicPath path(from, to);
        // At least so many parts, as the middle of a side may be on its chord by symmetry alone.
        constexpr int kParts = 8;
        Point begin = at(path, 0);
        for (int i = 0; i < kParts; ++i) {
            const Point end = at(path, path.length_m() * (i + 1) / kParts);
            divide(path, begin, end, 0, ring);
            begin = end;
        }
    }

  private:
    struct Point {
        double s;
        geo::LatLon place;
        geo::GridPosition grid;
    };

    Point at(const geo::GeodesicPath& path, double s) const {
        const geo::LatLon place = path.at(s);
        if (frame_.is_polar()) return {s, place, frame_.grid_position(place)};
        return {s,
                place,
                {(place.lon.value - frame_.west) / frame_.step_x,
                 (frame_.north - place.lat.value) / frame_.step_y}};
    }

    /// Adds the first point, and as many after it as it takes.
    void divide(const geo::GeodesicPath& path, const Point& begin, const Point& end, int depth,
                GridRing& ring) const {
        constexpr int kDeepest = 22;
        const Point middle = at(path, 0.5 * (begin.s + end.s));
        const double narrow = frame_.is_polar() ? 1 : std::cos(middle.place.lat.radians());
        const double off =
            std::hypot((middle.grid.column - 0.5 * (begin.grid.column + end.grid.column)) * narrow,
                       middle.grid.row - 0.5 * (begin.grid.row + end.grid.row));
        if (off <= kTolerance || depth == kDeepest) {
            ring.push_back(begin.grid);
            return;
        }
        divide(path, begin, middle, depth + 1, ring);
        divide(path, middle, end, depth + 1, ring);
    }

    const geo::GridFrame& frame_;
};

double cross(geo::GridPosition o, geo::GridPosition a, geo::GridPosition b) {
    return (a.column - o.column) * (b.row - o.row) - (a.row - o.row) * (b.column - o.column);
}

/// Finds sides of a ring that cross, by boxes around ever shorter parts of it.
class Crossings {
  public:
    explicit Crossings(const GridRing& ring) : ring_(ring), count_(ring.size()) {
        leaves_ = 1;
        while (leaves_ < count_) leaves_ *= 2;
        boxes_.resize(2 * leaves_);
        for (std::size_t i = 0; i < count_; ++i) {
            const auto a = ring_[i];
            const auto b = ring_[(i + 1) % count_];
            boxes_[leaves_ + i] = {std::min(a.column, b.column), std::max(a.column, b.column),
                                   std::min(a.row, b.row), std::max(a.row, b.row)};
        }
        for (std::size_t i = leaves_ - 1; i > 0; --i) {
            const Box& a = boxes_[2 * i];
            const Box& b = boxes_[2 * i + 1];
            boxes_[i] = {std::min(a.west, b.west), std::max(a.east, b.east), std::min(a.north, b.north),
                         std::max(a.south, b.south)};
        }
    }

    /// A place where two sides cross.
    std::optional<geo::GridPosition> find() const { return within(1); }

  private:
    struct Box {
        double west = INFINITY;
        double east = -INFINITY;
        double north = INFINITY;
        double south = -INFINITY;
    };

    static bool meet(const Box& a, const Box& b) {
        return a.west <= b.east && b.west <= a.east && a.north <= b.south && b.north <= a.south;
    }

    std::optional<geo::GridPosition> within(std::size_t node) const {
        if (node >= leaves_) return {};
        if (auto found = within(2 * node)) return found;
        if (auto found = within(2 * node + 1)) return found;
        return between(2 * node, 2 * node + 1);
    }

    std::optional<geo::GridPosition> between(std::size_t first, std::size_t second) const {
        if (!meet(boxes_[first], boxes_[second])) return {};
        if (first >= leaves_) return crossing(first - leaves_, second - leaves_);
        for (const std::size_t a : {2 * first, 2 * first + 1}) {
            for (const std::size_t b : {2 * second, 2 * second + 1}) {
                if (auto found = between(a, b)) return found;
            }
        }
        return {};
    }

    std::optional<geo::GridPosition> crossing(std::size_t i, std::size_t j) const {
        if (i + 1 == j || (j + 1) % count_ == i) return {};  // neighbours meet at their vertex
        const auto a = ring_[i];
        const auto b = ring_[i + 1];
        const auto c = ring_[j];
        const auto d = ring_[(j + 1) % count_];
        const double from_c = cross(a, b, c);
        const double from_d = cross(a, b, d);
        if (!(from_c * from_d < 0) || !(cross(c, d, a) * cross(c, d, b) < 0)) return {};
        const double t = from_c / (from_c - from_d);
        return geo::GridPosition{c.column + t * (d.column - c.column), c.row + t * (d.row - c.row)};
    }

    const GridRing& ring_;
    std::size_t count_;
    std::size_t leaves_ = 1;
    std::vector<Box> boxes_;
};

template <class Along, class Across>
GridRing clip(const GridRing& ring, double cut, Side side, const Along& along, const Across& across) {
    GridRing kept;
    const double sign = side == Side::low ? -1 : 1;
    const auto inside = [&](const geo::GridPosition& p) { return sign * (p.*along - cut) >= 0; };
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const geo::GridPosition& a = ring[i];
        const geo::GridPosition& b = ring[i + 1 < ring.size() ? i + 1 : 0];
        if (inside(a)) kept.push_back(a);
        if (inside(a) == inside(b) || a.*along == cut || b.*along == cut) continue;
        geo::GridPosition between;
        between.*along = cut;
        between.*across = a.*across + (cut - a.*along) / (b.*along - a.*along) * (b.*across - a.*across);
        kept.push_back(between);
    }
    return kept;
}

}  // namespace

double signed_area(const GridRing& ring) {
    double twice = 0;
    for (std::size_t i = 2; i < ring.size(); ++i) twice += cross(ring[0], ring[i - 1], ring[i]);
    return 0.5 * twice;
}

GridRing clip_columns(const GridRing& ring, double column, Side side) {
    return clip(ring, column, side, &geo::GridPosition::column, &geo::GridPosition::row);
}

GridRing clip_rows(const GridRing& ring, double row, Side side) {
    return clip(ring, row, side, &geo::GridPosition::row, &geo::GridPosition::column);
}

Result<std::vector<GridRing>> grid_rings(const geo::GridFrame& frame, std::span<const geo::LatLon> polygon) {
    const Sides sides(frame);
    GridRing ring;
    const double first = polygon.front().lon.value;
    double lon = first;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const geo::LatLon& from = polygon[i];
        const geo::LatLon& to = polygon[(i + 1) % polygon.size()];
        const double next = lon + std::remainder(to.lon.value - from.lon.value, 360.0);
        if (from.lat != to.lat || next != lon)
            sides.add({from.lat, geo::Degrees{lon}}, {to.lat, geo::Degrees{next}}, ring);
        lon = next;
    }
    if (ring.size() < 3) return no_polygon("the polygon has no area: its vertices are one place");

    const bool counter_clockwise = geo::geodesic_area(polygon).counter_clockwise;
    const double turn = lon - first;
    if (!frame.is_polar() && std::abs(turn) > 180) {
        // Once round the earth. Eastwards the north is on the left.
        const double lat = (turn > 0) == counter_clockwise ? 90 : -90;
        const double row = (frame.north - lat) / frame.step_y;
        const double end = ring.front().column + std::copysign(360.0, turn) / frame.step_x;
        ring.push_back({end, ring.front().row});
        ring.push_back({end, row});
        ring.push_back({ring.front().column, row});
    }
    if (const auto place = Crossings(ring).find()) {
        const geo::LatLon where = frame.lat_lon(*place);
        return no_polygon(fmt::format(
            "the polygon's sides cross each other at {:.6f},{:.6f}: put its vertices in order around it",
            where.lat.value, geo::wrapped_180(where.lon).value));
    }
    const double area = signed_area(ring);
    if (area == 0) return no_polygon("the polygon has no area: its vertices are on one line");
    if ((area < 0) != counter_clockwise)  // rows run south
        return no_polygon(
            "the polygon is larger than half the earth, or has a pole in it that this scene's "
            "grid cannot show: measure it in parts");
    if (area < 0) std::reverse(ring.begin(), ring.end());
    if (frame.is_polar()) return std::vector<GridRing>{std::move(ring)};

    const auto [west, east] = std::minmax_element(
        ring.begin(), ring.end(), [](const auto& a, const auto& b) { return a.column < b.column; });
    const double columns_a_turn = 360 / frame.step_x;
    std::vector<GridRing> rings;
    const double least = std::ceil(-east->column / columns_a_turn);
    const double most = std::floor((frame.columns - 1 - west->column) / columns_a_turn);
    for (double k = least; k <= most; ++k) {
        rings.push_back(ring);
        for (geo::GridPosition& p : rings.back()) p.column += k * columns_a_turn;
    }
    return rings;
}

}  // namespace relevo::lod
