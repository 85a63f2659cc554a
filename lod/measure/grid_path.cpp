#include "lod/measure/grid_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "geo/ellipsoid.hpp"
#include "lod/measure/height_sampler.hpp"

namespace relevo::lod {
namespace {

constexpr double kRootTolerance = 2e-8;  // m: what is left of a double after 20 000 km

/// A monotone function of the distance at one place: its value, and its slope a metre.
struct Sample {
    double value;
    double slope;
};

/// The distance in [low, high] where a monotone function takes a value that lies between those of the ends.
/// Newton's method, with bisection where that would leave the bracket: a wrong slope costs time, never the
/// root.
template <class Function>
double root(const Function& function, double target, double low, double high, bool rising, double guess) {
    double s = guess;
    for (int i = 0; i < 200 && high - low > kRootTolerance; ++i) {
        if (!(s > low && s < high)) s = low + 0.5 * (high - low);
        const Sample here = function(s);
        if (here.value == target) return s;
        ((here.value < target) == rising ? low : high) = s;
        const double next = s + (target - here.value) / here.slope;
        if (std::abs(next - s) < kRootTolerance) return std::clamp(next, low, high);
        s = next;
    }
    return low + 0.5 * (high - low);
}

}  // namespace

/// A part of the line on which rows and columns are monotone.
struct GridPath::Interval {
    double begin = 0;
    double end = 0;
    int turn = 0;
};

GridPath::GridPath(const geo::GridFrame& frame, geo::LatLon from, geo::LatLon to)
    : frame_(frame), path_(from, to) {
    constexpr double kMetresPerDegree = geo::wgs84::kSemiMinor * std::numbers::pi / 180;
    same_place_m_ = HeightSampler::kPostTolerance * (frame.is_polar() ? 1 : kMetresPerDegree) *
                    std::min(frame.step_x, frame.step_y);
    if (frame.closes()) seam_columns_ = 0.5 * (360 / frame.step_x - (frame.columns - 1));
}

GridPath::Point GridPath::at(double distance_m, int turn) const {
    const auto here = path_.point(distance_m);
    Point point;
    point.place = here.place;

    const double sin_lat = std::sin(here.place.lat.radians());
    const double w2 = 1 - geo::wgs84::kEccentricity2 * sin_lat * sin_lat;
    const double across = geo::wgs84::kSemiMajor / std::sqrt(w2);
    const double along = across * (1 - geo::wgs84::kEccentricity2) / w2;
    const double north = std::cos(here.azimuth.radians());
    const double east = std::sin(here.azimuth.radians());
    point.curvature_per_m = north * north / along + east * east / across;

    if (frame_.is_polar()) {
        point.grid = frame_.grid_position(here.place);
        const auto spacing = frame_.spacing(point.grid);
        const double from_up = (here.azimuth - frame_.up_azimuth(here.place.lon)).radians();
        point.columns_per_m = std::sin(from_up) / spacing.column_m;
        point.rows_per_m = -std::cos(from_up) / spacing.row_m;
        return point;
    }
    point.grid = {(here.place.lon.value + 360.0 * turn - frame_.west) / frame_.step_x,
                  (frame_.north - here.place.lat.value) / frame_.step_y};
    point.columns_per_m =
        geo::Degrees::from_radians(east / (across * std::cos(here.place.lat.radians()))).value /
        frame_.step_x;
    point.rows_per_m = -geo::Degrees::from_radians(north / along).value / frame_.step_y;
    return point;
}

/// The whole line, divided where it is nearest to a pole. The two parts end and begin on either side of that
/// point: a line over the pole itself changes its longitude there by half a turn.
std::vector<GridPath::Interval> GridPath::monotone_pieces() const {
    if (frame_.is_polar()) return polar_pieces();
    const auto northward = [&](double s) {
        const double azimuth = path_.azimuth(s).value;
        return azimuth < 90 || azimuth > 270;
    };
    const bool begins_northward = northward(0);
    if (begins_northward == northward(length_m())) return {{0, length_m()}};
    double low = 0;
    double high = length_m();
    while (high - low > kRootTolerance) {
        const double middle = low + 0.5 * (high - low);
        if (middle <= low || middle >= high) break;
        (northward(middle) == begins_northward ? low : high) = middle;
    }
    return {{0, low}, {high, length_m()}};
}

/// The whole line, divided where its direction in the plane of a polar grid goes along a row or a column.
std::vector<GridPath::Interval> GridPath::polar_pieces() const {
    // Between places this near the line turns by little (but around the far pole, where there is no data), so
    // that a turn past an axis cannot be missed.
    constexpr double kLongestStep = 50e3;
    const auto from_up = [&](double s) {
        const auto here = path_.point(s);
        return here.azimuth.value - frame_.up_azimuth(here.place.lon).value;
    };
    const auto quarter = [](double degrees) { return static_cast<int>(std::floor(degrees / 90)); };
    const int steps = std::max(1, static_cast<int>(std::ceil(length_m() / kLongestStep)));
    std::vector<Interval> pieces{{0, length_m()}};
    double direction = geo::wrapped_360(geo::Degrees{from_up(0)}).value;
    for (int i = 0; i < steps; ++i) {
        double low = length_m() * i / steps;
        const double end = length_m() * (i + 1) / steps;
        const double next = direction + std::remainder(from_up(end) - direction, 360);
        if (quarter(next) != quarter(direction)) {
            const double axis = 90 * std::max(quarter(next), quarter(direction));
            double high = end;
            while (high - low > kRootTolerance) {
                const double middle = low + 0.5 * (high - low);
                if (middle <= low || middle >= high) break;
                const double there = direction + std::remainder(from_up(middle) - direction, 360);
                ((there < axis) == (direction < axis) ? low : high) = middle;
            }
            pieces.back().end = low;
            pieces.push_back({high, length_m()});
        }
        direction = next;
    }
    return pieces;
}

/// Where the line is inside the data: an interval for each monotone piece and each turn in which the data may
/// be met.
std::vector<GridPath::Interval> GridPath::intervals_inside() const {
    constexpr double kSlack =
        0.5 * HeightSampler::kPostTolerance;  // the sampler's border, and room for rounding
    const double first_column = -kSlack - seam_columns_;
    const double last_column = frame_.columns - 1 + kSlack + seam_columns_;
    const double last_row = frame_.rows - 1 + kSlack;

    std::vector<Interval> found;
    for (const Interval& piece : monotone_pieces()) {
        // A polar grid has no turns: there is one column for a place.
        const double turn_columns =
            frame_.is_polar() ? std::numeric_limits<double>::infinity() : 360 / frame_.step_x;
        const double column0 = at(piece.begin, 0).grid.column;
        const double column1 = at(piece.end, 0).grid.column;
        const auto first_turn = std::ceil((first_column - std::max(column0, column1)) / turn_columns);
        const auto last_turn = std::floor((last_column - std::min(column0, column1)) / turn_columns);
        for (int turn = static_cast<int>(first_turn); turn <= static_cast<int>(last_turn); ++turn) {
            Interval inside{piece.begin, piece.end, turn};
            const auto narrow = [&](const auto& function, double least, double most) {
                if (inside.end < inside.begin) return;
                const double from = function(inside.begin).value;
                const double to = function(inside.end).value;
                if (std::max(from, to) < least || std::min(from, to) > most) {
                    inside.end = -1;
                    return;
                }
                const bool rising = to >= from;
                const Interval whole = inside;
                const auto cut = [&](double target) {
                    return root(function, target, whole.begin, whole.end, rising, whole.begin);
                };
                if (from < least || from > most) inside.begin = cut(rising ? least : most);
                if (to < least || to > most) inside.end = cut(rising ? most : least);
            };
            narrow(
                [&](double s) {
                    const Point p = at(s, turn);
                    return Sample{p.grid.row, p.rows_per_m};
                },
                -kSlack, last_row);
            narrow(
                [&](double s) {
                    const Point p = at(s, turn);
                    return Sample{p.grid.column, p.columns_per_m};
                },
                first_column, last_column);
            if (inside.end >= inside.begin) found.push_back(inside);
        }
    }

    // Data all round the earth is met in two turns at its seam: each place counts once.
    std::sort(found.begin(), found.end(),
              [](const Interval& a, const Interval& b) { return a.begin < b.begin; });
    double done = -1;
    std::erase_if(found, [&](Interval& i) {
        i.begin = std::max(i.begin, done);
        if (i.end < i.begin || (i.end == i.begin && length_m() > 0) || (length_m() == 0 && done >= 0))
            return true;
        done = i.end;
        return false;
    });
    return found;
}

void GridPath::add_crossings(const Interval& inside, bool of_columns, std::vector<double>& cuts) const {
    const auto function = [&](double s) {
        const Point p = at(s, inside.turn);
        return of_columns ? Sample{p.grid.column, p.columns_per_m} : Sample{p.grid.row, p.rows_per_m};
    };
    const double from = function(inside.begin).value;
    const double to = function(inside.end).value;
    const bool rising = to >= from;
    const double first = rising ? std::floor(from) + 1 : std::ceil(from) - 1;
    const double count = rising ? std::ceil(to) - first : first - std::floor(to);

    double s = inside.begin;
    for (int i = 0; i < count; ++i) {
        const double target = rising ? first + i : first - i;
        const Sample here = function(s);
        s = root(function, target, s, inside.end, rising, s + (target - here.value) / here.slope);
        cuts.push_back(s);
    }
}

std::vector<GridPath::Stretch> GridPath::stretches() const {
    std::vector<Stretch> all;
    for (const Interval& inside : intervals_inside()) {
        std::vector<double> crossings;
        add_crossings(inside, true, crossings);
        const auto rows = static_cast<std::ptrdiff_t>(crossings.size());
        add_crossings(inside, false, crossings);
        std::inplace_merge(crossings.begin(), crossings.begin() + rows, crossings.end());

        Stretch stretch{inside.turn, {inside.begin}};
        for (const double s : crossings) {
            if (s - stretch.cuts.back() > same_place_m_ && inside.end - s > same_place_m_)
                stretch.cuts.push_back(s);
        }
        if (inside.end > inside.begin) stretch.cuts.push_back(inside.end);
        all.push_back(std::move(stretch));
    }
    return all;
}

}  // namespace relevo::lod
