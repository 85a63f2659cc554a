#include "lod/measure/ground_legs.hpp"

#include <algorithm>

namespace relevo::lod {

double GroundLeg::slope(const GridPath& path, double s) const {
    const auto point = path.at(s, turn);
    const auto slope = cell->slope(point.grid);
    // At a pole columns have no width, and all of them the same height.
    const double east = slope.per_column == 0 ? 0 : slope.per_column * point.columns_per_m;
    return east + slope.per_row * point.rows_per_m;
}

std::optional<double> GroundLeg::extremum(const GridPath& path) const {
    double low = begin;
    double high = end;
    double slope_low = slope(path, low);
    double slope_high = slope(path, high);
    if (!(slope_low * slope_high < 0)) return {};
    for (int i = 0; i < 100 && high - low > 1e-9 * (end - begin); ++i) {
        double s = low + (high - low) * slope_low / (slope_low - slope_high);
        if (i % 3 == 2 || !(s > low && s < high)) s = low + 0.5 * (high - low);
        const double slope_here = slope(path, s);
        if (slope_here == 0) return s;
        if (slope_here * slope_low > 0) {
            low = s;
            slope_low = slope_here;
        } else {
            high = s;
            slope_high = slope_here;
        }
    }
    return low + 0.5 * (high - low);
}

Result<void> for_each_leg(HeightSampler& sampler, const GridPath& path,
                          const std::function<Result<bool>(const GroundLeg&)>& visit) {
    double done = 0;
    bool any = false;
    const auto pass_on = [&](const GroundLeg& leg) -> Result<bool> {
        any = true;
        done = leg.end;
        return visit(leg);
    };
    const auto gap_to = [&](double s) -> Result<bool> {
        if (s - done <= path.same_place_m()) return true;
        return pass_on({done, s, 0, {}, true});
    };
    const auto stretch_along = [&](const GridPath::Stretch& stretch) -> Result<bool> {
        if (const auto more = gap_to(stretch.cuts.front()); !more || !*more) return more;
        const std::size_t count = std::max<std::size_t>(stretch.cuts.size() - 1, 1);
        for (std::size_t i = 0; i < count; ++i) {
            const double begin = stretch.cuts[i];
            const double end = stretch.cuts[std::min(i + 1, stretch.cuts.size() - 1)];
            const auto cell = sampler.cell(path.at(begin + 0.5 * (end - begin), stretch.turn).grid);
            if (!cell) return cell.error();
            if (const auto more = pass_on({begin, end, stretch.turn, *cell, false}); !more || !*more)
                return more;
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
        if (const auto more = pass_on({0, path.length_m(), 0, {}, true}); !more) return more.error();
    }
    return {};
}

}  // namespace relevo::lod
