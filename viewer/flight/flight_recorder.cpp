#include "viewer/flight/flight_recorder.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace relevo::viewer {

namespace {

constexpr double kTimeStep = 1e-3;  // of the times that are written, s

double rounded(double value, double parts) {
    return std::round(value * parts) / parts;
}

FlightKey rounded(FlightKey key) {
    key.time_s = rounded(key.time_s, 1 / kTimeStep);
    key.place = {geo::Degrees{rounded(key.place.lat.value, 1e8)},
                 geo::Degrees{rounded(key.place.lon.value, 1e8)}};
    key.H.m = rounded(key.H.m, 1e3);
    for (geo::Degrees* angle : {&key.heading, &key.pitch, &key.roll, &key.fov})
        angle->value = rounded(angle->value, 1e4);
    key.fov.value = std::clamp(key.fov.value, 1e-4, 180 - 1e-4);  // an open range, also when rounded
    return key;
}

bool same_camera(const FlightKey& a, const FlightKey& b) {
    return a.place.lat == b.place.lat && a.place.lon == b.place.lon && a.H == b.H && a.heading == b.heading &&
           a.pitch == b.pitch && a.roll == b.roll && a.fov == b.fov;
}

}  // namespace

void FlightRecorder::see(const ViewState& view, double time_s) {
    const FlightKey now = rounded(key_of(view, time_s));
    // A jump to the other side of the earth is no flight: what came before it is left out.
    if (!keys_.empty() && !(joins(keys_.back(), now) && joins(last_.value_or(now), now))) keys_.clear();
    if (keys_.empty()) {
        keys_.push_back(now);
        last_.reset();
        return;
    }
    const FlightKey before = last_.value_or(keys_.back());
    if (now.time_s <= before.time_s) return;
    // Where a movement begins and where it ends is a key, whatever the step.
    const bool rested = same_camera(before, keys_.back());
    const bool rests = same_camera(before, now);
    if (rested != rests && before.time_s > keys_.back().time_s) keys_.push_back(before);
    last_ = now;
    if (!same_camera(now, keys_.back()) && now.time_s - keys_.back().time_s >= kStepS - kTimeStep) {
        keys_.push_back(now);
        last_.reset();
    }
}

FlightPath FlightRecorder::finish() const {
    assert(!keys_.empty());
    auto keys = keys_;
    if (last_) keys.push_back(*last_);
    return *FlightPath::create(std::move(keys));
}

}  // namespace relevo::viewer
