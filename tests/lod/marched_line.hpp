#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include <glm/geometric.hpp>

#include "lod/measure/line.hpp"
#include "lod/measure/profile.hpp"
#include "tests/lod/measured_scene.hpp"

namespace relevo::test {

using lod::LineMeasurement;
using lod::ProfileSample;

struct Ends {
    geo::LatLon from;
    geo::LatLon to;
};

/// Ground figures by marching along the line: a polyline in space, heights by brute force, a step halved
/// again and again while the ground in its middle is not straight to 0.01 mm (so that corners and peaks are
/// not cut).
struct Marched {
    double surface_m = 0;
    double climb_m = 0;
    double descent_m = 0;
    bool whole = true;
};

class March {
  public:
    March(const MeasuredScene& scene, Ends ends) : scene_(scene), path_(ends.from, ends.to) {}

    Marched sum(int steps) {
        Step last = at(0);
        for (int i = 1; i <= steps && sum_.whole; ++i) {
            const Step next = at(path_.length_m() * i / steps);
            go(last, next, 30);
            last = next;
        }
        return sum_;
    }

  private:
    struct Step {
        double distance = 0;
        double H = 0;
        geo::Ecef position;
    };

    Step at(double distance) const {
        const geo::LatLon place = path_.at(distance);
        const auto H = static_cast<double>(scene_.brute_height(place));
        const geo::Geoid* const geoid = scene_.scene().geoid();
        const double h = H + (geoid == nullptr ? 0 : geoid->undulation(place).m);
        return {distance, H, geo::to_ecef({place.lat, place.lon, geo::EllipsoidalHeight{h}})};
    }

    void go(const Step& from, const Step& to, int depth) {
        if (std::isnan(from.H) || std::isnan(to.H)) {
            sum_.whole = false;
            return;
        }
        const Step middle = at(0.5 * (from.distance + to.distance));
        if (std::abs(middle.H - 0.5 * (from.H + to.H)) > 1e-5 && depth > 0) {
            go(from, middle, depth - 1);
            go(middle, to, depth - 1);
            return;
        }
        sum_.surface_m +=
            glm::length(middle.position - from.position) + glm::length(to.position - middle.position);
        for (const double rise : {middle.H - from.H, to.H - middle.H})
            (rise > 0 ? sum_.climb_m : sum_.descent_m) += std::abs(rise);
    }

    const MeasuredScene& scene_;
    geo::GeodesicPath path_;
    Marched sum_;
};

inline LineMeasurement measure(MeasuredScene& scene, Ends ends) {
    const auto line = lod::measure_line(scene.sampler(), ends.from, ends.to);
    EXPECT_TRUE(line) << line.error().message;
    return line ? *line : LineMeasurement{};
}

inline std::vector<ProfileSample> profile_of(MeasuredScene& scene, Ends ends) {
    const auto samples = lod::profile(scene.sampler(), ends.from, ends.to);
    EXPECT_TRUE(samples) << samples.error().message;
    return samples ? *samples : std::vector<ProfileSample>{};
}

/// The measured line equals the marched one, and the profile has no peak between its samples.
inline void expect_right(MeasuredScene& scene, Ends ends, int steps, double surface_tolerance,
                         double climb_tolerance) {
    const auto line = measure(scene, ends);
    const auto marched = March(scene, ends).sum(steps);
    EXPECT_NEAR(line.geodesic.length_m, geo::geodesic(ends.from, ends.to).length_m, 1e-8);
    EXPECT_EQ(line.surface_m.has_value(), marched.whole);
    EXPECT_EQ(line.climb_m.has_value(), marched.whole);
    if (!line.surface_m || !marched.whole) return;
    EXPECT_NEAR(*line.surface_m / marched.surface_m, 1, surface_tolerance);
    EXPECT_NEAR(*line.climb_m, marched.climb_m, climb_tolerance);
    EXPECT_NEAR(*line.descent_m, marched.descent_m, climb_tolerance);

    // Backwards it is the same, with climb for descent.
    const auto back = measure(scene, {ends.to, ends.from});
    ASSERT_TRUE(back.surface_m);
    EXPECT_NEAR(*back.surface_m / *line.surface_m, 1, 1e-8);
    EXPECT_NEAR(*back.climb_m, *line.descent_m, 1e-6 * (1 + *line.descent_m));
    EXPECT_NEAR(*back.descent_m, *line.climb_m, 1e-6 * (1 + *line.climb_m));

    double climb = 0;
    const auto samples = profile_of(scene, ends);
    for (std::size_t i = 1; i < samples.size(); ++i) {
        ASSERT_TRUE(samples[i].H_m && samples[i - 1].H_m);
        EXPECT_GE(samples[i].distance_m, samples[i - 1].distance_m);
        climb += std::max(0.0, *samples[i].H_m - *samples[i - 1].H_m);
    }
    EXPECT_NEAR(climb, *line.climb_m, 1e-4 + 1e-6 * climb);
    EXPECT_EQ(samples.front().distance_m, 0);
    EXPECT_NEAR(samples.back().distance_m, line.geodesic.length_m, 1e-6);
}

}  // namespace relevo::test
