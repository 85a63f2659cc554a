#include "lod/measure/line_over_ground.hpp"

#include <array>
#include <utility>

#include "lod/measure/sight.hpp"

namespace relevo::lod {

bool LineOverGround::blocked(const Point& p, const Point& q) {
    const double dt = q.t - p.t;
    const double bend = bend_ * dt * dt + 1e-9;
    const auto [west, east] = std::minmax(p.column, q.column);
    const auto [north, south] = std::minmax(p.row, q.row);
    const double lowest = std::min(p.height, q.height) - std::max(sag_, 0.0) * dt * dt;
    const bool inside =
        ground_.inside(west - bend, north - bend) && ground_.inside(east + bend, south + bend);
    if (inside && ground_.highest(west - bend, east + bend, north - bend, south + bend) <= lowest)
        return false;
    constexpr double kShort = 2;
    constexpr double kStraight = 2e-5;
    if (east - west <= kShort && south - north <= kShort && bend <= kStraight) return blocked_in_cells(p, q);
    const Point middle = at(0.5 * (p.t + q.t));
    return blocked(p, middle) || blocked(middle, q);
}

bool LineOverGround::blocked_in_cells(const Point& p, const Point& q) {
    std::array<double, 12> cuts{};
    std::size_t count = 0;
    cuts[count++] = 0;
    const auto cross = [&](double from, double to) {
        const double low = std::min(from, to);
        const double high = std::max(from, to);
        for (double whole = std::floor(low) + 1; whole < high && count + 1 < cuts.size(); ++whole)
            cuts[count++] = (whole - from) / (to - from);
    };
    cross(p.column, q.column);
    cross(p.row, q.row);
    cuts[count++] = 1;
    for (std::size_t i = 1; i < count; ++i) {  // sorted by insertion: they are few
        for (std::size_t k = i; k > 0 && cuts[k] < cuts[k - 1]; --k) std::swap(cuts[k], cuts[k - 1]);
    }
    for (std::size_t i = 0; i + 1 < count; ++i) {
        if (cuts[i + 1] > cuts[i] && blocked_in_cell(p, q, cuts[i], cuts[i + 1])) return true;
    }
    return false;
}

bool LineOverGround::blocked_in_cell(const Point& p, const Point& q, double from, double to) {
    const double dc = q.column - p.column;
    const double dr = q.row - p.row;
    const double middle = 0.5 * (from + to);
    const bool inside = ground_.inside(p.column + middle * dc, p.row + middle * dr);
    const int column = ground_.cell_column(p.column + middle * dc);
    const int row = ground_.cell_row(p.row + middle * dr);
    const HighGround::Cell cell = ground_.cell(column, row);
    if (!inside || std::isnan(cell.nw + cell.ne + cell.sw + cell.se)) {
        unknown = unknown || (to - from) * std::max(std::abs(dc), std::abs(dr)) > 1e-6;
        return false;
    }
    const auto clearance = [&](double part) {
        const double t = p.t + part * (q.t - p.t);
        return sight_.height(t * sight_.length_m()) -
               cell.at(p.column + part * dc - column, p.row + part * dr - row);
    };
    const double first = clearance(from);
    const double half = clearance(middle);
    const double last = clearance(to);
    double least = std::min({first, half, last});
    const double curve = first + last - 2 * half;
    if (curve > 0) {
        const double off = 0.5 * (first - last) / curve;  // of half the piece, from its middle
        if (std::abs(off) < 1) least = std::min(least, clearance(middle + 0.5 * off * (to - from)));
    }
    if (least >= -kSightTolerance) return false;
    blocked_at = (p.t + middle * (q.t - p.t)) * sight_.length_m();
    return true;
}

}  // namespace relevo::lod
