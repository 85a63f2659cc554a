#include "viewer/measure/measure_tool.hpp"

#include <gtest/gtest.h>

namespace relevo::viewer {
namespace {

using geo::Degrees;

geo::LatLon at(double lat, double lon) {
    return {Degrees{lat}, Degrees{lon}};
}

TEST(MeasureTool, ALineIsWholeWithTwoClicksAndTheThirdBeginsAnother) {
    MeasureTool tool;
    tool.add(at(1, 1));
    EXPECT_FALSE(is_measurable(tool.shapes()[0]));
    tool.add(at(2, 2));
    EXPECT_TRUE(is_measurable(tool.shapes()[0]));
    EXPECT_FALSE(tool.shapes()[0].open);
    tool.add(at(3, 3));
    ASSERT_EQ(tool.shapes().size(), 2u);
    EXPECT_EQ(tool.current(), 1u);
    EXPECT_EQ(tool.shapes()[0].measurement.vertices.size(), 2u);
}

TEST(MeasureTool, AnAreaIsWholeWhenItsUserSaysSo) {
    MeasureTool tool;
    tool.take(Tool::area);
    for (int i = 0; i < 5; ++i) tool.add(at(i, i * i));
    EXPECT_TRUE(tool.shapes()[0].open);
    tool.finish();
    EXPECT_FALSE(tool.shapes()[0].open);
    EXPECT_EQ(tool.shapes()[0].measurement.kind, lod::MeasurementKind::polygon);
    tool.add(at(9, 9));
    tool.add(at(8, 8));
    tool.finish();  // two corners are no area
    EXPECT_EQ(tool.shapes().size(), 1u);
}

TEST(MeasureTool, AnotherToolEndsWhatWasBegun) {
    MeasureTool tool;
    tool.take(Tool::path);
    tool.add(at(1, 1));
    tool.add(at(2, 2));
    tool.add(at(3, 3));
    tool.take(Tool::point);
    tool.add(at(4, 4));
    ASSERT_EQ(tool.shapes().size(), 2u);
    EXPECT_FALSE(tool.shapes()[0].open);
    EXPECT_FALSE(tool.shapes()[1].open);
    EXPECT_EQ(tool.shapes()[1].measurement.kind, lod::MeasurementKind::point);
}

TEST(MeasureTool, EveryStepIsUndoneAndDoneAgain) {
    MeasureTool tool;
    tool.take(Tool::path);
    std::vector<std::vector<Shape>> states{tool.shapes()};
    const auto did = [&] { states.push_back(tool.shapes()); };
    tool.add(at(1, 1)), did();
    tool.add(at(2, 2)), did();
    tool.add(at(3, 3)), did();
    tool.begin_move({0, 1});
    tool.move({0, 1}, at(5, 5));
    tool.move({0, 1}, at(6, 6)), did();  // one step, however many moves
    tool.finish(), did();
    tool.rename(0, "ridge"), did();
    tool.delete_vertex(), did();
    tool.delete_shape(0), did();
    const auto same = [](const std::vector<Shape>& a, const std::vector<Shape>& b) {
        if (a.size() != b.size()) return false;
        for (std::size_t i = 0; i < a.size(); ++i) {
            if (a[i].open != b[i].open || a[i].measurement.name != b[i].measurement.name) return false;
            const auto& p = a[i].measurement.vertices;
            const auto& q = b[i].measurement.vertices;
            if (p.size() != q.size()) return false;
            for (std::size_t k = 0; k < p.size(); ++k)
                if (p[k].lat != q[k].lat || p[k].lon != q[k].lon) return false;
        }
        return true;
    };
    for (std::size_t i = states.size() - 1; i-- > 0;) {
        EXPECT_TRUE(tool.undo());
        EXPECT_TRUE(same(tool.shapes(), states[i])) << i;
    }
    EXPECT_FALSE(tool.undo());
    for (std::size_t i = 1; i < states.size(); ++i) {
        EXPECT_TRUE(tool.redo());
        EXPECT_TRUE(same(tool.shapes(), states[i])) << i;
    }
    EXPECT_FALSE(tool.redo());
    tool.undo();
    tool.add(at(7, 7));
    EXPECT_FALSE(tool.redo()) << "what was undone is gone after a new step";
}

TEST(MeasureTool, DeletingTheLastVertexOfALineOpensItAgain) {
    MeasureTool tool;
    tool.add(at(1, 1));
    tool.add(at(2, 2));
    tool.delete_vertex();
    EXPECT_TRUE(tool.shapes()[0].open);
    tool.add(at(3, 3));
    ASSERT_EQ(tool.shapes().size(), 1u);
    EXPECT_EQ(tool.shapes()[0].measurement.vertices[1].lat.value, 3);
    tool.delete_vertex();
    tool.delete_vertex();
    EXPECT_TRUE(tool.shapes().empty());
    tool.delete_vertex();
    tool.finish();
    tool.clear();
}

TEST(MeasureTool, AnyVertexIsDeleted) {
    MeasureTool tool;
    tool.take(Tool::area);
    for (int i = 0; i < 4; ++i) tool.add(at(i, i * i));
    tool.finish();
    tool.delete_vertex({0, 1});
    ASSERT_EQ(tool.shapes()[0].measurement.vertices.size(), 3u);
    EXPECT_EQ(tool.shapes()[0].measurement.vertices[1].lat.value, 2);
    EXPECT_FALSE(tool.shapes()[0].open) << "it is an area still";
    tool.take(Tool::point);
    tool.delete_vertex({0, 0});
    EXPECT_TRUE(tool.shapes()[0].open) << "two corners are none";
    EXPECT_EQ(tool.tool(), Tool::area) << "the next click adds the third";
    EXPECT_TRUE(tool.undo());
    EXPECT_EQ(tool.shapes()[0].measurement.vertices.size(), 3u);
    EXPECT_TRUE(tool.undo());
    EXPECT_EQ(tool.shapes()[0].measurement.vertices.size(), 4u);
}

TEST(MeasureTool, AVertexIsPutIntoASideAndMovedInOneStep) {
    MeasureTool tool;
    tool.take(Tool::path);
    tool.add(at(1, 1));
    tool.add(at(3, 3));
    tool.begin_insert({0, 1}, at(2, 2));
    tool.move({0, 1}, at(2, 5));
    ASSERT_EQ(tool.shapes()[0].measurement.vertices.size(), 3u);
    EXPECT_EQ(tool.shapes()[0].measurement.vertices[1].lon.value, 5);
    EXPECT_TRUE(tool.undo());
    EXPECT_EQ(tool.shapes()[0].measurement.vertices.size(), 2u);
    // Between the last and the first of an area.
    tool.take(Tool::area);
    for (int i = 0; i < 3; ++i) tool.add(at(i, i * i));
    tool.begin_insert({1, 3}, at(7, 7));
    EXPECT_EQ(tool.shapes()[1].measurement.vertices.back().lat.value, 7);
}

TEST(MeasureTool, ChoicesAreUndoneAndServeTheNextOfTheirKind) {
    MeasureTool tool;
    tool.take(Tool::viewshed);
    tool.add(at(1, 1));
    EXPECT_FALSE(tool.shapes()[0].open);
    EXPECT_EQ(tool.shapes()[0].measurement.kind, lod::MeasurementKind::point);
    MeasureChoices choices = tool.shapes()[0].choices;
    choices.radius_m = 123;
    const auto version = tool.version();
    tool.choose(0, choices);
    EXPECT_GT(tool.version(), version);
    tool.add(at(2, 2));
    ASSERT_EQ(tool.shapes().size(), 2u);
    EXPECT_EQ(tool.shapes()[1].choices.radius_m, 123);
    tool.undo();
    tool.undo();
    EXPECT_EQ(tool.shapes()[0].choices.radius_m, 5000);
}

TEST(MeasureTool, WhatWasLoadedIsMeasuredAsWhatItIs) {
    MeasureTool tool;
    tool.insert_shapes({{"a", lod::MeasurementKind::point, {at(1, 1)}},
                        {"b", lod::MeasurementKind::path, {at(1, 1), at(2, 2)}},
                        {"c", lod::MeasurementKind::path, {at(1, 1), at(2, 2), at(3, 3)}},
                        {"d", lod::MeasurementKind::polygon, {at(1, 1), at(2, 2), at(3, 1)}}});
    ASSERT_EQ(tool.shapes().size(), 4u);
    EXPECT_EQ(tool.shapes()[1].tool, Tool::line);
    EXPECT_EQ(tool.shapes()[2].tool, Tool::path);
    EXPECT_EQ(tool.shapes()[3].tool, Tool::area);
    EXPECT_TRUE(tool.undo());
    EXPECT_TRUE(tool.shapes().empty());
}

}  // namespace
}  // namespace relevo::viewer
