#pragma once

#include <algorithm>
#include <cmath>

#include "lod/measure/high_ground.hpp"
#include "lod/measure/sight_line.hpp"

namespace relevo::lod {

/// A coordinate along a line: a cubic of t in [0, 1].
struct Cubic {
    double a = 0;
    double b = 0;
    double c = 0;
    double d = 0;

    /// Through values at 0, 1/3, 2/3 and 1.
    static Cubic through(double p0, double p1, double p2, double p3) {
        return {p0, -5.5 * p0 + 9 * p1 - 4.5 * p2 + p3, 9 * p0 - 22.5 * p1 + 18 * p2 - 4.5 * p3,
                -4.5 * p0 + 13.5 * p1 - 13.5 * p2 + 4.5 * p3};
    }
    double at(double t) const { return a + t * (b + t * (c + t * d)); }
    /// An eighth of the largest second derivative: how far it bends off a chord over t of length 1.
    double bend() const { return std::max(std::abs(2 * c), std::abs(2 * c + 6 * d)) / 8; }
};

/// One line of sight over the ground: straight in curved air, a cubic in the grid. Keeps references to all it
/// is given.
class LineOverGround {
  public:
    /// \param steepest  no less than the tangent of its angle with the horizon, anywhere
    LineOverGround(const HighGround& ground, const Cubic& column, const Cubic& row, const SightLine& sight,
                   double steepest)
        : ground_(ground),
          column_(column),
          row_(row),
          sight_(sight),
          bend_(std::max(column.bend(), row.bend())),
          // A straight line's height bends away from its chord by no more than this over a whole length: its
          // second derivative is the curvature times (1 + 2 tan^2) of its angle with the horizon, nearly.
          sag_(sight.length_m() * sight.length_m() * sight.effective_curvature() / 8 *
               (1.01 + 2 * steepest * steepest)) {}

    /// Is ground in the way between two parts of the length, 0 to 1?
    bool is_blocked(double from, double to) { return blocked(at(from), at(to)); }

    bool unknown = false;   ///< a void was met, or the data left
    double blocked_at = 0;  ///< metres from the eye, where is_blocked found ground

  private:
    struct Point {
        double t;
        double column;
        double row;
        double height;
    };

    Point at(double t) const { return {t, column_.at(t), row_.at(t), sight_.height(t * sight_.length_m())}; }

    bool blocked(const Point& p, const Point& q);
    /// Exactly, over few cells, in which the line is straight: 2e-5 posts from the cubic at most.
    bool blocked_in_cells(const Point& p, const Point& q);
    bool blocked_in_cell(const Point& p, const Point& q, double from, double to);

    const HighGround& ground_;
    const Cubic& column_;
    const Cubic& row_;
    const SightLine& sight_;
    double bend_;
    double sag_;
};

}  // namespace relevo::lod
