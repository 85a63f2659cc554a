#include "lod/measure/profile.hpp"

#include <array>
#include <cassert>
#include <cmath>

#include "lod/measure/ground_legs.hpp"
#include "lod/measure/known_undulation.hpp"

namespace relevo::lod {
namespace {

/// Makes a profile leg by leg.
class Tracer {
  public:
    explicit Tracer(HeightSampler& sampler) : sampler_(sampler) { out_.vertices_m = {0}; }

    Result<void> go(geo::LatLon from, geo::LatLon to) {
        const GridPath path(sampler_.scene().info().frame, from, to);
        const auto done =
            for_each_leg(sampler_, path, [&](const GroundLeg& leg) { return visit(path, leg); });
        start_ += path.length_m();
        out_.vertices_m.push_back(start_);
        return done;
    }

    Profile finish() {
        if (out_.measured_m > 0) {
            out_.mean_H_m = integral_ / out_.measured_m;
            out_.mean_slope = rises_ / out_.measured_m;
        }
        return std::move(out_);
    }

  private:
    Result<bool> visit(const GridPath& path, const GroundLeg& leg) {
        auto& samples = out_.samples;
        const bool goes_on = !samples.empty() && samples.back().H_m.has_value() == leg.cell.has_value();
        if (goes_on && !leg.cell && leg.end > leg.begin) samples.pop_back();  // one gap, not two
        if (!goes_on) {
            if (const auto added = add(path, leg, leg.begin); !added) return added;
        }
        if (!leg.cell) add_gap(leg);
        if (leg.end <= leg.begin) return true;
        const auto middle = leg.cell ? leg.extremum(path) : std::nullopt;
        if (middle) {
            if (const auto added = add(path, leg, *middle); !added) return added;
        }
        if (leg.cell) add_figures(path, leg, middle.value_or(leg.end));
        return add(path, leg, leg.end);
    }

    /// A sample: by the sampler, so that a profile and a point agree; a cell with heights has them on its
    /// edges too.
    Result<bool> add(const GridPath& path, const GroundLeg& leg, double s) {
        const auto point = path.at(s, leg.turn);
        ProfileSample sample{start_ + s, point.place, {}, {}};
        if (leg.cell) {
            const auto H = sampler_.height(point.grid);
            if (!H) return H.error();
            sample.H_m = *H ? **H : leg.cell->height(point.grid);
            if (const auto N = known_undulation(sampler_.scene(), point.place))
                sample.h_m = *sample.H_m + N->m;
            note(out_.lowest, -1, {*sample.H_m, sample.distance_m, sample.place});
            note(out_.highest, 1, {*sample.H_m, sample.distance_m, sample.place});
        }
        out_.samples.push_back(sample);
        return true;
    }

    void add_gap(const GroundLeg& leg) {
        auto& gaps = out_.gaps;
        const double from = start_ + leg.begin;
        const double to = start_ + leg.end;
        if (!gaps.empty() && gaps.back().outside == leg.outside && from - gaps.back().to_m < 1e-6) {
            gaps.back().to_m = to;
        } else {
            gaps.push_back({from, to, leg.outside});
        }
    }

    void add_figures(const GridPath& path, const GroundLeg& leg, double middle) {
        const double length = leg.end - leg.begin;
        const double off = std::sqrt(0.6);
        for (const auto& [place, weight] : {std::pair{-off, 5.0}, std::pair{0.0, 8.0}, std::pair{off, 5.0}})
            integral_ += weight / 18 * length * leg.height(path, leg.begin + 0.5 * (1 + place) * length);
        out_.measured_m += length;
        // H is monotone between these; slopes are extreme at the leg's ends.
        const double last = leg.height(path, leg.end);
        const double first = leg.height(path, leg.begin);
        const double turn = leg.height(path, middle);
        rises_ += std::abs(turn - first) + std::abs(last - turn);
        for (const double s : {leg.begin, leg.end}) {
            const double slope = leg.slope(path, s);
            const Profile::Extreme here{slope, start_ + s, path.at(s, leg.turn).place};
            if (slope > 0) note(out_.steepest_up, 1, here);
            if (slope < 0) note(out_.steepest_down, -1, here);
        }
    }

    static void note(std::optional<Profile::Extreme>& extreme, double sign, const Profile::Extreme& here) {
        if (!extreme || sign * here.value > sign * extreme->value) extreme = here;
    }

    HeightSampler& sampler_;
    Profile out_;
    double start_ = 0;     // of the line being traced
    double integral_ = 0;  // of H
    double rises_ = 0;     // climb and descent
};

}  // namespace

Result<Profile> measure_profile(HeightSampler& sampler, std::span<const geo::LatLon> path) {
    assert(path.size() >= 2);
    Tracer tracer(sampler);
    for (std::size_t i = 1; i < path.size(); ++i) {
        if (const auto done = tracer.go(path[i - 1], path[i]); !done) return done.error();
    }
    return tracer.finish();
}

Result<std::vector<ProfileSample>> profile(HeightSampler& sampler, geo::LatLon from, geo::LatLon to) {
    auto whole = measure_profile(sampler, std::array{from, to});
    if (!whole) return whole.error();
    return std::move(whole->samples);
}

}  // namespace relevo::lod
