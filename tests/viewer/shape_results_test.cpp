// What is measured in the background for the window, and that nobody waits for what is no longer wanted.
#include <chrono>
#include <cmath>
#include <thread>

#include <gtest/gtest.h>

#include "lod/measure/results.hpp"
#include "tests/lod/measured_scene.hpp"
#include "viewer/measure/shape_result.hpp"

namespace relevo::viewer {
namespace {

using Clock = std::chrono::steady_clock;
using test::grid;
using test::MeasuredScene;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// So rough that a viewshed takes long.
MeasuredScene& rough_ground() {
    static MeasuredScene scene(grid(8, 46, 1.0 / 3600, 1101, 1101), [](int column, int row) {
        return 500 + 80 * std::sin(0.11 * column) * std::cos(0.07 * row) + 20 * std::sin(0.9 * column + row);
    });
    return scene;
}

Shape viewshed(double radius_m, geo::GridPosition at = {550, 550}) {
    Shape shape;
    shape.tool = Tool::viewshed;
    shape.measurement = {"v", lod::MeasurementKind::point, {rough_ground().frame().lat_lon(at)}};
    shape.choices.radius_m = radius_m;
    shape.choices.looking.eye_height_m = 200;
    shape.open = false;
    return shape;
}

Shape large_area() {
    Shape shape;
    shape.tool = Tool::area;
    shape.measurement.kind = lod::MeasurementKind::polygon;
    for (int i = 0; i < 720; ++i) {  // many sides: each cell at the edge is clipped
        const double angle = 2 * 3.14159265358979 * i / 720;
        const double radius = 480 + 60 * std::sin(40 * angle);
        shape.measurement.vertices.push_back(
            rough_ground().frame().lat_lon({550 + radius * std::cos(angle), 550 + radius * std::sin(angle)}));
    }
    shape.open = false;
    return shape;
}

constexpr double kAll = 11000;

void work(ShapeResults& results, const std::vector<Shape>& shapes) {
    do {
        results.update(shapes, geo::UnitSystem::metric);
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    } while (results.busy());
}

/// Until some of it is done, but not much.
void begin(ShapeResults& results, const Shape& shape) {
    results.update({shape}, geo::UnitSystem::metric);
    while (results.progress(shape).value_or(1) < 0.02)
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
}

TEST(ShapeResults, AViewshedIsThatOfTheLibrary) {
    ShapeResults results(rough_ground().scene());
    const Shape shape = viewshed(2000);
    work(results, {shape});
    const ShapeResult* result = results.find(shape);
    ASSERT_NE(result, nullptr);
    ASSERT_TRUE(result->viewshed);
    const lod::ViewshedRequest request{shape.choices.looking, 2000, {}};
    const auto shed =
        lod::measure_viewshed(rough_ground().sampler(), shape.measurement.vertices.front(), request);
    ASSERT_TRUE(shed);
    EXPECT_EQ(result->json, lod::results_of(*shed, request));
    EXPECT_EQ(result->viewshed->visible_posts, shed->visible_posts);
    EXPECT_GT(shed->visible_posts, 100u);
    EXPECT_GT(shed->hidden_posts, 100u);
}

TEST(ShapeResults, AnAreaHasThePlaneThatWasChosen) {
    ShapeResults results(rough_ground().scene());
    Shape shape = large_area();
    shape.choices.plane = {lod::Plane::Kind::given, 510};
    Shape mean = shape;
    mean.choices.plane.kind = lod::Plane::Kind::mean;
    work(results, {shape, mean});
    ASSERT_NE(results.find(shape), nullptr);
    EXPECT_EQ(results.find(shape)->json["plane_H_m"], 510);
    EXPECT_NEAR(results.find(mean)->json["volume_above_m3"].get<double>() /
                    results.find(mean)->json["volume_below_m3"].get<double>(),
                1, 1e-9);
}

/// How long a measurement takes when nobody stops it.
double whole_s(const Shape& shape) {
    ShapeResults results(rough_ground().scene());
    const auto start = Clock::now();
    work(results, {shape});
    EXPECT_FALSE(results.find(shape)->stopped);
    return seconds_since(start);
}

TEST(ShapeResults, ClosingStopsWhatIsBeingMeasured) {
    for (const Shape& shape : {viewshed(kAll), large_area()}) {
        const double whole = whole_s(shape);
        auto results = std::make_unique<ShapeResults>(rough_ground().scene());
        results->update({shape}, geo::UnitSystem::metric);
        while (results->busy() && results->progress(shape) == 0.0)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        const auto start = Clock::now();
        results.reset();
        EXPECT_LT(seconds_since(start), 0.6 * whole + 0.05) << "the whole takes " << whole << " s";
    }
}

TEST(ShapeResults, WhatIsDeletedOrChangedIsNotWaitedFor) {
    const double whole = whole_s(viewshed(kAll));
    ShapeResults results(rough_ground().scene());
    begin(results, viewshed(kAll));
    const auto start = Clock::now();
    work(results, {});
    EXPECT_LT(seconds_since(start), 0.5 * whole);
    EXPECT_EQ(results.find(viewshed(kAll)), nullptr);

    begin(results, viewshed(kAll));
    const Shape moved = viewshed(kAll, {551, 550});
    results.update({moved}, geo::UnitSystem::metric);
    const auto changed = Clock::now();
    while (!results.progress(moved) && seconds_since(changed) < 10) {
        results.update({moved}, geo::UnitSystem::metric);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    EXPECT_LT(seconds_since(changed), 0.5 * whole) << "the new one has begun";
}

TEST(ShapeResults, AUserStopsOneAndBeginsItAgain) {
    ShapeResults results(rough_ground().scene());
    const Shape shape = viewshed(kAll);
    begin(results, shape);
    results.cancel();
    work(results, {shape});
    ASSERT_NE(results.find(shape), nullptr);
    EXPECT_TRUE(results.find(shape)->stopped);
    EXPECT_FALSE(results.find(shape)->viewshed);
    results.update({shape}, geo::UnitSystem::metric);
    EXPECT_FALSE(results.busy()) << "it does not begin by itself";
    results.forget(shape);
    results.update({shape}, geo::UnitSystem::metric);
    EXPECT_TRUE(results.busy());
}

TEST(ShapeResults, WhatCannotBeMeasuredSaysWhy) {
    ShapeResults results(rough_ground().scene());
    const Shape outside = viewshed(1000, {-50, -50});
    work(results, {outside});
    ASSERT_NE(results.find(outside), nullptr);
    ASSERT_EQ(results.find(outside)->lines.size(), 1u);
    EXPECT_NE(results.find(outside)->lines[0].find("outside"), std::string::npos);
}

}  // namespace
}  // namespace relevo::viewer
