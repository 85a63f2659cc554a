#include "viewer/flight/default_flight.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "geo/geodesic.hpp"

namespace relevo::viewer {

namespace {

constexpr double kGlideS = 25;
constexpr double kLowS = 10;
constexpr double kTurnS = 10;
constexpr double kClimbS = 15;

double smooth(double u) {
    return u * u * (3 - 2 * u);
}

double rounded(double value, double parts) {
    return std::round(value * parts) / parts;
}

/// What the flight is made to: metres.
struct Scale {
    double start_above;  ///< the ground, at first
    double low_above;    ///< near the ground
    double glide;        ///< along the ground, from the start to where it is low
    double climb;        ///< from there in the end
};

Scale scale_of(const lod::SceneInfo& info) {
    const geo::GridFrame& frame = info.frame;
    const auto spacing = frame.spacing({0.5 * (frame.columns - 1), 0.5 * (frame.rows - 1)});
    const double high = spacing.row_m * (frame.rows - 1);
    const double side = std::max(std::min(spacing.column_m * (frame.columns - 1), high), 1.0);
    const double relief = std::max(info.height_max_m - info.height_min_m, 0.0);
    Scale scale{};
    scale.start_above = 0.5 * relief + 0.05 * side;
    scale.low_above = std::min(10 + 0.02 * relief, 0.2 * scale.start_above);
    scale.glide = std::min(0.6 * high, 5e6);
    scale.climb = 0.3 * scale.glide;
    return scale;
}

/// A camera before it is known how high it has to be.
struct Step {
    double time_s;
    geo::LatLon place;
    double above;  ///< the ground
    double heading;
    double pitch;
};

std::vector<Step> steps_of(const Scale& scale, geo::LatLon middle) {
    const double fall = scale.low_above / scale.start_above;
    const auto between = [](double from, double to, double u) { return from + (to - from) * u; };
    std::vector<Step> steps;
    for (double t = 0; t < kGlideS; ++t) {
        const double left = std::pow(fall, t / kGlideS);
        // What is left of the way falls like the height, but to nothing.
        const double way = scale.glide * (left - fall) / (1 - fall);
        steps.push_back({t, geo::geodesic_destination(middle, geo::Degrees{180}, way),
                         scale.start_above * left, 0, between(-22, -6, t / kGlideS)});
    }
    // Low: as fast as its height a second, more or less. Then a half turn to the right.
    geo::LatLon place = middle;
    double heading = 0;
    for (double t = 0; t < kLowS + kTurnS; ++t) {
        steps.push_back({kGlideS + t, place, scale.low_above, heading, -6});
        if (t >= kLowS) heading += 180 / kTurnS;
        place = geo::geodesic_destination(place, geo::Degrees{heading}, scale.low_above);
    }
    const geo::LatLon turned = place;
    for (double t = 0; t <= kClimbS; ++t) {
        const double grown = std::pow(1 / fall, t / kClimbS);
        const double way = scale.climb * (grown - 1) / (1 / fall - 1);
        steps.push_back({kGlideS + kLowS + kTurnS + t,
                         geo::geodesic_destination(turned, geo::Degrees{180}, way),
                         0.7 * scale.low_above * grown + 0.3 * scale.low_above, 180,
                         between(-6, -25, smooth(t / kClimbS))});
    }
    return steps;
}

}  // namespace

Result<FlightPath> default_flight(lod::HeightSampler& sampler) {
    const lod::SceneInfo& info = sampler.scene().info();
    const geo::GridFrame& frame = info.frame;
    const Scale scale = scale_of(info);
    const auto steps = steps_of(scale, frame.lat_lon({0.5 * (frame.columns - 1), 0.5 * (frame.rows - 1)}));

    // The ground under each step and half way to the next. Outside and over voids it goes on as it was.
    double ground = info.height_min_m;
    std::vector<double> grounds;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        double highest = -1e9;
        const geo::LatLon& here = steps[i].place;
        const geo::LatLon& there = steps[std::min(i + 1, steps.size() - 1)].place;
        const double way = geo::geodesic(here, there).length_m;
        const geo::Degrees azimuth = geo::geodesic(here, there).azimuth1;
        for (int k = 0; k < 8; ++k) {
            const auto H =
                sampler.height(frame.grid_position(geo::geodesic_destination(here, azimuth, way * k / 8)));
            if (!H) return H.error();
            if (*H) ground = **H;
            highest = std::max(highest, ground);
        }
        grounds.push_back(highest);
    }
    const double low_ground = grounds[static_cast<std::size_t>(kGlideS)];
    std::vector<FlightKey> keys;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        // Over what is before and behind, so that it is over all of it on the way: heights run between keys'.
        const double under =
            std::max({grounds[i], grounds[i == 0 ? 0 : i - 1], grounds[std::min(i + 1, grounds.size() - 1)]});
        const Step& step = steps[i];
        // Low over the ground it follows it; elsewhere only what is in the way lifts it.
        const bool low = step.time_s >= kGlideS && step.time_s <= kGlideS + kLowS + kTurnS;
        const double H =
            low ? under + step.above
                : std::max(low_ground + step.above, under + 0.5 * scale.low_above + 0.05 * step.above);
        using geo::Degrees;
        keys.push_back({.time_s = step.time_s,
                        .place = {Degrees{rounded(step.place.lat.value, 1e6)},
                                  Degrees{rounded(step.place.lon.value, 1e6)}},
                        .H = {rounded(H, 10)},
                        .heading = Degrees{rounded(step.heading, 10)},
                        .pitch = Degrees{rounded(step.pitch, 100)},
                        .roll = Degrees{0},
                        .fov = Degrees{60}});
    }
    return FlightPath::create(std::move(keys));
}

}  // namespace relevo::viewer
