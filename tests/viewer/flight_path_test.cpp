#include "viewer/flight/flight_path.hpp"

#include <cmath>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "geo/geodesic.hpp"
#include "lod/view.hpp"
#include "tests/lod/scratch_scene.hpp"
#include "viewer/flight/flight_recorder.hpp"

namespace relevo::viewer {
namespace {

FlightKey key(double time_s, double lat, double lon, double H = 1000, double heading = 0, double pitch = -10,
              double roll = 0, double fov = 60) {
    using geo::Degrees;
    return {time_s,      {Degrees{lat}, Degrees{lon}}, {H}, Degrees{heading}, Degrees{pitch}, Degrees{roll},
            Degrees{fov}};
}

FlightPath path_of(std::vector<FlightKey> keys) {
    auto path = FlightPath::create(std::move(keys));
    if (!path) throw std::runtime_error(path.error().message);
    return *path;
}

geo::Ecef eye_of(const FlightKey& k) {
    return geo::to_ecef({k.place.lat, k.place.lon, {k.H.m}});
}

/// The camera's axes in space: what a picture depends on, whatever its angles are called.
glm::dmat3 axes_of(const FlightKey& k) {
    const lod::View view({.eye = {k.place.lat, k.place.lon, {k.H.m}},
                          .heading = k.heading,
                          .pitch = k.pitch,
                          .roll = k.roll,
                          .fov = k.fov});
    return {view.right(), view.up(), view.forward()};
}

double turn_between(const FlightKey& a, const FlightKey& b) {
    const glm::dmat3 x = axes_of(a);
    const glm::dmat3 y = axes_of(b);
    return std::max({glm::distance(x[0], y[0]), glm::distance(x[1], y[1]), glm::distance(x[2], y[2])});
}

/// Keys of a wild flight; consecutive ones are some kilometres apart.
std::vector<FlightKey> wild_keys(double lat, double lon, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto uniform = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random() >> 11) / 9007199254740992.0;
    };
    std::vector<FlightKey> keys;
    geo::LatLon place{geo::Degrees{lat}, geo::Degrees{lon}};
    double time = 0;
    for (int i = 0; i < 40; ++i) {
        keys.push_back(key(time, place.lat.value, place.lon.value, uniform(10, 5000), uniform(0, 360),
                           uniform(-90, 90), uniform(-40, 40), uniform(20, 100)));
        time += uniform(0.05, 3);
        if (i % 7 == 5) continue;  // rests, but for the height and the head
        place = geo::geodesic_destination(place, geo::Degrees{uniform(0, 360)}, uniform(10, 20e3));
    }
    return keys;
}

TEST(FlightPath, GoesThroughItsKeys) {
    for (const auto& [lat, lon] : {std::pair(37.0, -105.0), std::pair(-16.0, 179.99), std::pair(89.95, 10.0),
                                   std::pair(-89.99, 170.0)}) {
        const auto keys = wild_keys(lat, lon, 1);
        const FlightPath path = path_of(keys);
        EXPECT_EQ(path.begin_s(), 0);
        EXPECT_EQ(path.duration_s(), keys.back().time_s);
        for (const FlightKey& k : keys) {
            for (const double near : {0.0, -1e-9, 1e-9}) {
                const FlightKey there = path.at(k.time_s + near);
                EXPECT_LT(glm::length(eye_of(there) - eye_of(k)), 1e-3) << lat << " at " << k.time_s;
                EXPECT_LT(turn_between(there, k), 1e-6) << lat << " at " << k.time_s;
                EXPECT_NEAR(there.fov.value, k.fov.value, 1e-6);
            }
        }
        EXPECT_EQ(path.at(-5).H, keys.front().H);
        EXPECT_EQ(path.at(1e9).H, keys.back().H);
    }
}

// Continuous speeds: differences of 0.1 us before and after each key agree.
TEST(FlightPath, SpeedsAreContinuous) {
    for (const auto& [lat, lon] :
         {std::pair(37.0, -105.0), std::pair(10.0, 179.999), std::pair(89.9, 10.0)}) {
        const auto keys = wild_keys(lat, lon, 2);
        const FlightPath path = path_of(keys);
        const double dt = 1e-7;
        for (std::size_t i = 1; i + 1 < keys.size(); ++i) {
            const double t = keys[i].time_s;
            const glm::dvec3 before = (eye_of(path.at(t)) - eye_of(path.at(t - dt))) / dt;
            const glm::dvec3 after = (eye_of(path.at(t + dt)) - eye_of(path.at(t))) / dt;
            // What the acceleration and the last digits of places add.
            EXPECT_LT(glm::distance(before, after), 1 + 0.01 * glm::length(before)) << lat << " key " << i;
            const double turn_before = (path.at(t).pitch - path.at(t - dt).pitch).value / dt;
            const double turn_after = (path.at(t + dt).pitch - path.at(t).pitch).value / dt;
            EXPECT_NEAR(turn_before, turn_after, 0.1 + 0.01 * std::abs(turn_before)) << lat << " key " << i;
        }
    }
}

TEST(FlightPath, StaysBetweenTheValuesOfItsKeysAndRestsWhereTheyRest) {
    auto keys = wild_keys(45, 7, 3);
    keys.push_back(keys.back());
    keys.back().time_s += 30;
    keys.push_back(key(keys.back().time_s + 0.1, 45, 7, 9000));
    const FlightPath path = path_of(keys);
    for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
        for (double u = 0; u <= 1; u += 0.01) {
            const auto k = path.at(keys[i].time_s + u * (keys[i + 1].time_s - keys[i].time_s));
            const auto [low, high] = std::minmax(keys[i].H.m, keys[i + 1].H.m);
            EXPECT_GE(k.H.m, low - 1e-9);
            EXPECT_LE(k.H.m, high + 1e-9);
            const auto [down, up] = std::minmax(keys[i].pitch.value, keys[i + 1].pitch.value);
            EXPECT_GE(k.pitch.value, down - 1e-9);
            EXPECT_LE(k.pitch.value, up + 1e-9);
        }
    }
    const std::size_t rest = keys.size() - 3;
    for (double t = 0; t < 30; t += 0.7) {
        const FlightKey there = path.at(keys[rest].time_s + t);
        EXPECT_EQ(there.place.lat, keys[rest].place.lat);
        EXPECT_EQ(there.place.lon, keys[rest].place.lon);
        EXPECT_EQ(there.H, keys[rest].H);
    }
}

// Truth: Karney's geodesic between two keys of equal height.
TEST(FlightPath, FollowsTheEarthsCurveAcrossTheAntimeridianAndThePoles) {
    struct Case {
        double lat0, lon0, lat1, lon1;
    };
    for (const Case& c :
         {Case{10, 179.9, 10.1, -179.9}, Case{-10, -179.95, -10.1, 179.95}, Case{10, 179.9, 10.1, 180.1},
          Case{89.9, 0, 89.9, 180}, Case{-89.8, 40, -89.8, -130}, Case{0, -0.1, 0, 0.1}}) {
        const FlightPath path = path_of({key(0, c.lat0, c.lon0), key(10, c.lat1, c.lon1)});
        const geo::GeodesicPath line({geo::Degrees{c.lat0}, geo::Degrees{c.lon0}},
                                     {geo::Degrees{c.lat1}, geo::Degrees{c.lon1}});
        for (double t = 0; t <= 10; t += 0.5) {
            // Two keys: straight, at a steady speed. A chord of 20 km and its arc differ by 1e-7 of it.
            const FlightKey there = path.at(t);
            EXPECT_LT(geo::geodesic(line.at(line.length_m() * t / 10), there.place).length_m, 1)
                << c.lat0 << "," << c.lon0 << " at " << t;
            EXPECT_GE(there.place.lon.value, -180);
            EXPECT_LE(there.place.lon.value, 181);
        }
    }
}

TEST(FlightPath, AnglesGoTheShorterWay) {
    const FlightPath path = path_of({key(0, 5, 5, 100, 350, 0, 170), key(1, 5, 5, 100, 20, 0, -170)});
    EXPECT_NEAR(path.at(0.5).heading.value, 5, 1e-9);
    EXPECT_NEAR(geo::wrapped_360(path.at(0.5).roll).value, 180, 1e-9);
    for (double t = 0; t < 1; t += 0.05) {
        EXPECT_LE(std::abs(geo::wrapped_180(path.at(t).heading - geo::Degrees{5}).value), 15 + 1e-9);
    }
}

// Straight over the pole the heading flips from 0 to 180, and the camera does not turn.
TEST(FlightPath, TheCameraDoesNotTurnOverThePole) {
    for (const double side : {1.0, -1.0}) {
        const double towards = side > 0 ? 0 : 180;
        const FlightPath path =
            path_of({key(0, side * 89.8, 30, 500, towards), key(1, side * 89.9, 30, 500, towards),
                     key(2, side * 89.9, -150, 500, 180 - towards)});
        const glm::dmat3 first = axes_of(path.at(0));
        for (double t = 0; t <= 2; t += 0.01) {
            // By as much as the earth curves on these 33 km, 0.3 degrees.
            EXPECT_LT(glm::distance(axes_of(path.at(t))[2], first[2]), 0.006) << side << " at " << t;
        }
    }
}

TEST(FlightPath, TextReadsBackToTheLastBit) {
    const auto keys = wild_keys(-45.123456789, 100, 4);
    const FlightPath path = path_of(keys);
    const auto again = FlightPath::parse(path.to_text(), "it");
    ASSERT_TRUE(again) << again.error().message;
    ASSERT_EQ(again->keys().size(), keys.size());
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const FlightKey& a = keys[i];
        const FlightKey& b = again->keys()[i];
        EXPECT_TRUE(a.time_s == b.time_s && a.place.lat == b.place.lat && a.place.lon == b.place.lon &&
                    a.H == b.H && a.heading == b.heading && a.pitch == b.pitch && a.roll == b.roll &&
                    a.fov == b.fov)
            << i;
    }
    EXPECT_EQ(again->to_text(), path.to_text());
}

TEST(FlightPath, ReadsCommentsBlanksAndForeignLineEnds) {
    const auto path = FlightPath::parse(
        "# made by hand\n\n  relevo-flight 1  \r\n\t0 1 2 3 4 5 6 7 # the first\r\n#\n1.5\t+1 2 3e3 4 -5 6 "
        "70",
        "it");
    ASSERT_TRUE(path) << path.error().message;
    ASSERT_EQ(path->keys().size(), 2u);
    EXPECT_EQ(path->keys()[1].H.m, 3000);
    EXPECT_EQ(path->keys()[1].pitch.value, -5);
}

TEST(FlightPath, BadFilesAreNamedWithTheirLine) {
    const std::string head = "relevo-flight 1\n0 1 2 3 4 5 6 7\n";
    for (const auto& [text, what] :
         {std::pair<std::string, const char*>{"", "f:1: a flight file begins"},
          {"# nothing\n", "f:1: a flight file begins"},
          {"relevo-flight 2\n0 1 2 3 4 5 6 7\n", "f:1: a flight file begins"},
          {"0 1 2 3 4 5 6 7\n", "f:1: a flight file begins"},
          {"relevo-flight 1\n", "f:1: no key"},
          {head + "1 1 2 3 4 5 6\n", "f:3: a key has 8 numbers"},
          {head + "1 1 2 3 4 5 6 7 8\n", "f:3: a key has 8 numbers"},
          {head + "\n1 1 2 x 4 5 6 7\n", "f:4: \"x\" is not a number"},
          {head + "1 1 2 nan 4 5 6 7\n", "f:3: \"nan\" is not a number"},
          {head + "1 1,2 3 4 5 6 7 8\n", "f:3: \"1,2\" is not a number"},
          {head + "1 91 2 3 4 5 6 7\n", "f:3: latitude 91"},
          {head + "1 1 2 3 4 95 6 7\n", "f:3: pitch 95"},
          {head + "1 1 2 3 4 5 6 180\n", "f:3: fov 180"},
          {head + "0 1 2 3 4 5 6 7\n", "f:3: time 0 is not after"},
          {head + "-1 1 2 3 4 5 6 7\n", "f:3: time -1 is not after"},
          {head + "1 -1 -179 3 4 5 6 7\n", "f:3: more than 90 degrees"},
          {head + "1 1 2 3 4 5 6 7\nrelevo-flight 1\n", "f:4: \"relevo-flight\" is not a number"}}) {
        const auto path = FlightPath::parse(text, "f");
        ASSERT_FALSE(path) << text;
        EXPECT_EQ(path.error().kind, ErrorKind::input);
        EXPECT_EQ(path.error().message.substr(0, std::string(what).size()), what);
    }
    const auto none = FlightPath::load("/nonexistent/f");
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().kind, ErrorKind::input);
    EXPECT_FALSE(FlightPath::create({}));
}

TEST(FlightPath, AFileIsWrittenWholeOrNotAtAll) {
    const test::SceneFolder folder;
    const FlightPath path = path_of(wild_keys(1, 2, 5));
    ASSERT_TRUE(write_flight(path, folder / "a.flight"));
    const auto again = FlightPath::load(folder / "a.flight");
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(again->to_text(), path.to_text());
    EXPECT_FALSE(write_flight(path, folder / "no" / "a.flight"));
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()),
                            std::filesystem::directory_iterator()),
              1);
}

ViewState view_at(double lat, double lon, double H = 1000) {
    ViewState view;
    put(view, key(0, lat, lon, H));
    return view;
}

TEST(FlightRecorder, KeepsAKeyEveryTenthOfASecondWhileTheCameraMoves) {
    FlightRecorder recorder;
    const auto lat_at = [](double t) { return t < 1 ? 10 : t < 2 ? 10 + (t - 1) * 0.001 : 10.001; };
    for (double t = 0; t < 5; t += 1.0 / 60) recorder.see(view_at(lat_at(t), 20), t);
    const FlightPath path = recorder.finish();
    EXPECT_GE(path.keys().size(), 12u);
    EXPECT_LE(path.keys().size(), 15u);
    EXPECT_NEAR(path.duration_s(), 5, 0.02);
    for (double t = 0; t < 4.9; t += 0.01) {
        EXPECT_NEAR(path.at(t).place.lat.value, lat_at(t), 3e-5) << t;  // a frame's way is 1.7e-5
    }
    EXPECT_EQ(path.at(0.9).place.lat.value, 10) << "it rested";
    EXPECT_EQ(path.at(4).place.lat.value, path.at(3).place.lat.value) << "it rested";
}

TEST(FlightRecorder, ACameraThatNeverMovesIsOneRest) {
    FlightRecorder recorder;
    for (double t = 0; t < 3; t += 0.02) recorder.see(view_at(1, 2), t);
    const FlightPath path = recorder.finish();
    EXPECT_EQ(path.keys().size(), 2u);
    EXPECT_NEAR(path.duration_s(), 2.98, 0.011);
}

TEST(FlightRecorder, SlowFramesAreAllKeys) {
    FlightRecorder recorder;
    for (int i = 0; i < 10; ++i) recorder.see(view_at(1 + 0.01 * i, 2), 0.3 * i);
    EXPECT_EQ(recorder.finish().keys().size(), 10u);
}

TEST(FlightRecorder, WhatCameBeforeAJumpRoundTheEarthIsLeftOut) {
    FlightRecorder recorder;
    for (int i = 0; i < 5; ++i) recorder.see(view_at(1 + 0.01 * i, 2), 0.3 * i);
    for (int i = 5; i < 8; ++i) recorder.see(view_at(-1 - 0.01 * i, -170), 0.3 * i);
    const FlightPath path = recorder.finish();
    EXPECT_EQ(path.keys().size(), 3u);
    EXPECT_NEAR(path.begin_s(), 1.5, 1e-9);
}

}  // namespace
}  // namespace relevo::viewer
