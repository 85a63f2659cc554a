#include "viewer/flight/default_flight.hpp"

#include <cmath>
#include <ostream>

#include <gtest/gtest.h>

#include "tests/lod/scratch_scene.hpp"
#include "tests/lod/synthetic_terrain.hpp"

namespace relevo::viewer {
namespace {

struct Ground {
    const char* name;
    geo::GridFrame frame;
    double (*height)(int, int);

    friend std::ostream& operator<<(std::ostream& stream, const Ground& ground) {
        return stream << ground.name;
    }
};

double flat(int, int) {
    return 5;
}
double spike(int column, int row) {
    return column == 60 && row == 66 ? 8000 : 100;
}
double striped(int column, int row) {
    return row % 16 > 9 ? static_cast<double>(test::kVoid) : test::mountains(column, row);
}

class DefaultFlight : public testing::TestWithParam<Ground> {};

// It stays above the ground everywhere, at 60 frames a second, and comes near to it.
TEST_P(DefaultFlight, StaysAboveTheGroundAndComesNear) {
    const test::SceneFolder folder;
    test::SceneParts parts;
    parts.heights = test::make_heights(GetParam().frame, GetParam().height);
    parts.metrics = lod::build_metrics(GetParam().frame, {}, parts.heights);
    parts.info.frame = GetParam().frame;
    parts.info.vertical = {lod::VerticalDatum::ellipsoid, "WGS 84 ellipsoid", false};
    parts.info.height_min_m = 1e9;
    parts.info.height_max_m = -1e9;
    for (const float H : parts.heights.samples()) {
        ++(std::isnan(H) ? parts.info.void_posts : parts.info.valid_posts);
        if (std::isnan(H)) continue;
        parts.info.height_min_m = std::min(parts.info.height_min_m, static_cast<double>(H));
        parts.info.height_max_m = std::max(parts.info.height_max_m, static_cast<double>(H));
    }
    parts.info.resampling_method = "none";
    const auto written = test::write_scene(parts, folder / "a.relevo");
    ASSERT_TRUE(written) << written.error().message;
    const auto scene = lod::Scene::open(folder / "a.relevo");
    ASSERT_TRUE(scene) << scene.error().message;
    lod::HeightSampler sampler(*scene);
    const auto flight = default_flight(sampler);
    ASSERT_TRUE(flight) << flight.error().message;
    EXPECT_EQ(flight->duration_s(), 60);
    EXPECT_LT(flight->keys().front().place.lat.value, flight->at(25).place.lat.value) << "from the south";

    double lowest = 1e9;
    double highest = 0;
    for (double t = 0; t <= 60; t += 1.0 / 60) {
        const FlightKey key = flight->at(t);
        const auto ground = sampler.height(GetParam().frame.grid_position(key.place));
        ASSERT_TRUE(ground);
        if (!*ground) continue;
        lowest = std::min(lowest, key.H.m - **ground);
        highest = std::max(highest, key.H.m - **ground);
    }
    EXPECT_GT(lowest, 1) << "under the ground, or nearly";
    EXPECT_LT(lowest, 250);
    EXPECT_GT(highest, 3 * lowest);
    const auto again = FlightPath::parse(flight->to_text(), "it");
    EXPECT_TRUE(again);
}

INSTANTIATE_TEST_SUITE_P(
    Grounds, DefaultFlight,
    testing::Values(Ground{"flat", test::geographic_frame(65, 65), flat},
                    Ground{"mountains", test::geographic_frame(129, 100), test::mountains},
                    Ground{"narrow", test::geographic_frame(5, 120), test::mountains},
                    Ground{"spike", test::geographic_frame(129, 129), spike},
                    Ground{"voids", test::geographic_frame(129, 129), striped},
                    Ground{"polar", test::polar_frame(geo::FrameKind::ups_north, 101, 101, 100),
                           test::mountains},
                    Ground{"antimeridian", test::geographic_frame(65, 65, 10, 179.99), test::mountains}),
    [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace relevo::viewer
