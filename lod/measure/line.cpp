#include "lod/measure/line.hpp"

#include <algorithm>
#include <cmath>

#include "lod/measure/grid_path.hpp"

namespace relevo::lod {
namespace {

/// The line within one cell, or between two cells with heights.
struct Leg {
    double begin = 0;
    double end = 0;
    int turn = 0;
    std::optional<BilinearCell> cell;  ///< nothing: a void or outside

    double height(const GridPath& path, double s) const { return cell->height(path.at(s, turn).grid); }

    /// dH/ds.
    double slope(const GridPath& path, double s) const {
        const auto point = path.at(s, turn);
        const auto slope = cell->slope(point.grid);
        // At a pole columns have no width, and all of them the same height.
        const double east = slope.per_column == 0 ? 0 : slope.per_column * point.columns_per_m;
        return east + slope.per_row * point.rows_per_m;
    }
};

/// Goes along the whole line, leg by leg, until `visit(leg)` fails or says false.
template <class Visit>
Result<void> for_each_leg(HeightSampler& sampler, const GridPath& path, const Visit& visit) {
    double done = 0;
    bool any = false;
    const auto pass_on = [&](const Leg& leg) -> Result<bool> {
        any = true;
        done = leg.end;
        return visit(leg);
    };
    const auto gap_to = [&](double s) -> Result<bool> {
        if (s - done <= path.same_place_m()) return true;
        return pass_on({done, s, 0, {}});
    };
    const auto stretch_along = [&](const GridPath::Stretch& stretch) -> Result<bool> {
        if (const auto more = gap_to(stretch.cuts.front()); !more || !*more) return more;
        const std::size_t count = std::max<std::size_t>(stretch.cuts.size() - 1, 1);
        for (std::size_t i = 0; i < count; ++i) {
            const double begin = stretch.cuts[i];
            const double end = stretch.cuts[std::min(i + 1, stretch.cuts.size() - 1)];
            const auto cell = sampler.cell(path.at(begin + 0.5 * (end - begin), stretch.turn).grid);
            if (!cell) return cell.error();
            if (const auto more = pass_on({begin, end, stretch.turn, *cell}); !more || !*more) return more;
        }
        return true;
    };
    for (const GridPath::Stretch& stretch : path.stretches()) {
        const auto more = stretch_along(stretch);
        if (!more) return more.error();
        if (!*more) return {};
    }
    if (const auto more = gap_to(path.length_m()); !more) return more.error();
    if (!any) {  // no length, and outside
        if (const auto more = pass_on({0, path.length_m(), 0, {}}); !more) return more.error();
    }
    return {};
}

/// Where the surface has its highest or lowest place inside a leg. Its height there is a quadratic of the
/// distance, as far as the line is straight within one cell, so there is one at most, and the slope is next
/// to linear.
std::optional<double> extremum(const GridPath& path, const Leg& leg) {
    double low = leg.begin;
    double high = leg.end;
    double slope_low = leg.slope(path, low);
    double slope_high = leg.slope(path, high);
    if (!(slope_low * slope_high < 0)) return {};
    for (int i = 0; i < 100 && high - low > 1e-9 * (leg.end - leg.begin); ++i) {
        double s = low + (high - low) * slope_low / (slope_low - slope_high);
        if (i % 3 == 2 || !(s > low && s < high)) s = low + 0.5 * (high - low);
        const double slope = leg.slope(path, s);
        if (slope == 0) return s;
        if (slope * slope_low > 0) {
            low = s;
            slope_low = slope;
        } else {
            high = s;
            slope_high = slope;
        }
    }
    return low + 0.5 * (high - low);
}

/// Integral of sqrt(k^2 + p^2) over a distance in which p goes evenly from p0 to p1.
double arc_length(double distance, double k, double p0, double p1) {
    const auto element = [k](double p) { return std::hypot(k, p); };
    if (std::abs(p1 - p0) < 1e-4 * k)  // Simpson; the closed form would lose digits
        return distance * (element(p0) + 4 * element(0.5 * (p0 + p1)) + element(p1)) / 6;
    const auto primitive = [&](double p) { return 0.5 * (p * element(p) + k * k * std::asinh(p / k)); };
    return distance * (primitive(p1) - primitive(p0)) / (p1 - p0);
}

/// Length over the ground from one distance to another within a leg.
double ground_length(const GridPath& path, const Leg& leg, const Scene& scene, double begin, double end) {
    // In steps so short that a geodesic is straight in the grid and N is even; and so low that it is no
    // matter where in the step the surface is steep: 10 m of height are 1.6e-6 of k.
    constexpr double kLongestStep = 5000;
    constexpr double kHighestStep = 10;
    const auto undulation = [&](geo::LatLon place) {
        return scene.geoid() == nullptr ? 0 : scene.geoid()->undulation(place).m;
    };
    const double rise = leg.height(path, end) - leg.height(path, begin);
    const int steps =
        static_cast<int>(std::ceil(std::max((end - begin) / kLongestStep, std::abs(rise) / kHighestStep)));
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double s0 = begin + (end - begin) * i / steps;
        const double s1 = begin + (end - begin) * (i + 1) / steps;
        const auto point0 = path.at(s0, leg.turn);
        const auto point1 = path.at(s1, leg.turn);
        const double N0 = undulation(point0.place);
        const double N1 = undulation(point1.place);
        const double h0 = leg.cell->height(point0.grid) + N0;
        const double h1 = leg.cell->height(point1.grid) + N1;
        const double p0 = leg.slope(path, s0) + (N1 - N0) / (s1 - s0);
        const double p1 = leg.slope(path, s1) + (N1 - N0) / (s1 - s0);
        const double mean_h = 0.5 * (h0 + h1) + (p0 - p1) * (s1 - s0) / 12;  // of a quadratic
        const double k = 1 + mean_h * 0.5 * (point0.curvature_per_m + point1.curvature_per_m);
        sum += arc_length(s1 - s0, k, p0, p1);
    }
    return sum;
}

}  // namespace

Result<std::vector<ProfileSample>> profile(HeightSampler& sampler, geo::LatLon from, geo::LatLon to) {
    const GridPath path(sampler.scene().info().frame, from, to);
    std::vector<ProfileSample> samples;
    const auto visit = [&](const Leg& leg) -> Result<bool> {
        // By the sampler, so that a profile and a point agree; a cell with heights has them on its edges too.
        const auto add = [&](double s) -> Result<bool> {
            const auto point = path.at(s, leg.turn);
            ProfileSample sample{s, point.place, {}};
            if (leg.cell) {
                const auto H = sampler.height(point.grid);
                if (!H) return H.error();
                sample.H_m = *H ? **H : leg.cell->height(point.grid);
            }
            samples.push_back(sample);
            return true;
        };
        const bool goes_on = !samples.empty() && samples.back().H_m.has_value() == leg.cell.has_value();
        if (goes_on && !leg.cell) samples.pop_back();  // one gap, not two
        if (!goes_on) {
            if (const auto added = add(leg.begin); !added) return added;
        }
        if (leg.end <= leg.begin) return true;
        if (leg.cell) {
            if (const auto s = extremum(path, leg)) {
                if (const auto added = add(*s); !added) return added;
            }
        }
        return add(leg.end);
    };
    if (const auto done = for_each_leg(sampler, path, visit); !done) return done.error();
    return samples;
}

Result<LineMeasurement> measure_line(HeightSampler& sampler, geo::LatLon from, geo::LatLon to) {
    const GridPath path(sampler.scene().info().frame, from, to);
    double surface = 0;
    double climb = 0;
    double descent = 0;
    bool whole = true;
    const auto visit = [&](const Leg& leg) -> Result<bool> {
        whole = leg.cell.has_value();
        if (!whole) return false;
        const auto add = [&](double begin, double end) {
            if (end <= begin) return;
            surface += ground_length(path, leg, sampler.scene(), begin, end);
            const double rise = leg.height(path, end) - leg.height(path, begin);
            (rise > 0 ? climb : descent) += std::abs(rise);
        };
        const double middle = extremum(path, leg).value_or(leg.end);
        add(leg.begin, middle);
        add(middle, leg.end);
        return true;
    };
    if (const auto done = for_each_leg(sampler, path, visit); !done) return done.error();

    LineMeasurement line;
    line.geodesic = geo::geodesic(from, to);
    if (whole) {
        line.surface_m = surface;
        line.climb_m = climb;
        line.descent_m = descent;
    }
    return line;
}

}  // namespace relevo::lod
