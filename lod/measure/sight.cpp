#include "lod/measure/sight.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "lod/measure/ground_legs.hpp"
#include "lod/measure/sight_line.hpp"

namespace relevo::lod {
namespace {

/// The ground along a line of sight, seen from it.
class GroundInSight {
  public:
    GroundInSight(const Scene& scene, const GridPath& path, const SightLine& sight)
        : scene_(scene), path_(path), sight_(sight) {}

    /// Clearances of a leg: at its ends and, where the line is nearest or farthest, between them.
    void add(const GroundLeg& leg) {
        if (!leg.cell) {
            unknown_m += leg.end - leg.begin;
            return;
        }
        n_begin_ = undulation(leg, leg.begin);
        n_end_ = undulation(leg, leg.end);
        note(leg, leg.begin);
        if (leg.end <= leg.begin) return;
        // The clearance is next to a parabola of the distance: golden steps are not needed.
        double s = turning(leg, leg.begin, leg.end);
        for (int i = 0; i < 3 && s > leg.begin && s < leg.end; ++i) {
            const double reach = 0.02 * std::min(s - leg.begin, leg.end - s);
            if (reach < 1e-6) break;
            s = std::clamp(turning(leg, s - reach, s + reach), leg.begin, leg.end);
        }
        if (s > leg.begin && s < leg.end) note(leg, s);
        note(leg, leg.end);
    }

    double unknown_m = 0;
    std::optional<SightMeasurement::Place> first_blocked;
    std::optional<SightMeasurement::Place> worst;

    /// The least clearance between the ends' own rises.
    std::optional<SightMeasurement::Place> least() const {
        std::size_t first = 0;
        std::size_t last = seen_.size();
        while (first + 1 < last && seen_[first + 1].clearance_m > seen_[first].clearance_m) ++first;
        while (last > first + 1 && seen_[last - 2].clearance_m > seen_[last - 1].clearance_m) --last;
        if (last < first + 3) return {};
        return *std::min_element(seen_.begin() + static_cast<std::ptrdiff_t>(first) + 1,
                                 seen_.begin() + static_cast<std::ptrdiff_t>(last) - 1,
                                 [](const auto& a, const auto& b) { return a.clearance_m < b.clearance_m; });
    }

  private:
    double undulation(const GroundLeg& leg, double s) const {
        return scene_.geoid() == nullptr ? 0 : scene_.geoid()->undulation(path_.at(s, leg.turn).place).m;
    }

    double clearance(const GroundLeg& leg, double s) const {
        const double part = leg.end > leg.begin ? (s - leg.begin) / (leg.end - leg.begin) : 0;
        const double N = n_begin_ + part * (n_end_ - n_begin_);
        return sight_.height(s) - leg.height(path_, s) - N;
    }

    /// Where the parabola through three places of [a, b] turns; b where it does not between them.
    double turning(const GroundLeg& leg, double a, double b) const {
        const double half = 0.5 * (b - a);
        const double middle = clearance(leg, a + half);
        const double low = clearance(leg, a) - middle;
        const double high = clearance(leg, b) - middle;
        const double curve = low + high;
        if (curve == 0) return b;
        return a + half + 0.5 * half * (low - high) / curve;
    }

    void note(const GroundLeg& leg, double s) {
        const auto at = [&](double where, double clear) {
            const auto point = path_.at(where, leg.turn);
            return SightMeasurement::Place{where, point.place, leg.cell->height(point.grid), clear};
        };
        const SightMeasurement::Place here = at(s, clearance(leg, s));
        if (here.clearance_m < -kSightTolerance) {
            if (!first_blocked) {
                // From clear to blocked; where a void ends in the ground, its border.
                double clear = seen_.empty() ? leg.begin : std::max(leg.begin, seen_.back().distance_m);
                double blocked = s;
                for (int i = 0; i < 60 && clearance(leg, clear) >= 0 && blocked - clear > 1e-9; ++i) {
                    const double middle = 0.5 * (clear + blocked);
                    (clearance(leg, middle) < 0 ? blocked : clear) = middle;
                }
                first_blocked = at(blocked, clearance(leg, blocked));
            }
            if (!worst || here.clearance_m < worst->clearance_m) worst = here;
        }
        seen_.push_back(here);
    }

    const Scene& scene_;
    const GridPath& path_;
    const SightLine& sight_;
    double n_begin_ = 0;
    double n_end_ = 0;
    std::vector<SightMeasurement::Place> seen_;
};

}  // namespace

Result<void> check(const Looking& looking) {
    const auto height = [](double m) { return std::isfinite(m) && m >= 0 && m <= 1e6; };
    if (!height(looking.eye_height_m) || !height(looking.target_height_m))
        return Error{ErrorKind::usage, "heights of eye and target are metres above the ground, 0 to 1000000"};
    if (!(looking.refraction >= -1 && looking.refraction < 1))
        return Error{ErrorKind::usage, fmt::format("a refraction coefficient is from -1 to below 1 (0.13 by "
                                                   "day over land, 0 without air), not {}",
                                                   looking.refraction)};
    return {};
}

Result<SightMeasurement> measure_sight(HeightSampler& sampler, geo::LatLon eye, geo::LatLon target,
                                       const Looking& looking) {
    if (const auto good = check(looking); !good) return good.error();
    const Scene& scene = sampler.scene();
    const geo::GridFrame& frame = scene.info().frame;
    SightMeasurement measured;
    measured.geodesic = geo::geodesic(eye, target);
    constexpr double kFarthest = 5e6;
    if (measured.geodesic.length_m > kFarthest)
        return Error{ErrorKind::usage,
                     "eye and target are more than 5000 km apart: no air lets one see so far"};

    const auto eye_ground = sampler.height(frame.grid_position(eye));
    if (!eye_ground) return eye_ground.error();
    const auto target_ground = sampler.height(frame.grid_position(target));
    if (!target_ground) return target_ground.error();
    if (*eye_ground) measured.eye_H_m = **eye_ground + looking.eye_height_m;
    if (*target_ground) measured.target_H_m = **target_ground + looking.target_height_m;
    if (!measured.eye_H_m || !measured.target_H_m) {
        measured.unknown_m = measured.geodesic.length_m;
        return measured;
    }
    const auto h = [&](double H, geo::LatLon place) {
        return H + (scene.geoid() == nullptr ? 0 : scene.geoid()->undulation(place).m);
    };
    const SightLine sight(measured.geodesic.length_m, mean_curvature(geo::GeodesicPath(eye, target)),
                          looking.refraction, h(*measured.eye_H_m, eye), h(*measured.target_H_m, target));
    const GridPath path(frame, eye, target);
    GroundInSight ground(scene, path, sight);
    const auto done = for_each_leg(sampler, path, [&](const GroundLeg& leg) -> Result<bool> {
        ground.add(leg);
        return true;
    });
    if (!done) return done.error();
    measured.unknown_m = ground.unknown_m;
    measured.first_blocked = ground.first_blocked;
    measured.worst = ground.worst;
    if (ground.first_blocked) {
        measured.visible = false;
    } else {
        measured.least_clearance = ground.least();
        if (ground.unknown_m <= path.same_place_m()) measured.visible = true;
    }
    return measured;
}

}  // namespace relevo::lod
