#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "ingest/mosaic/frame_choice.hpp"

namespace relevo::ingest {
namespace {

struct Grid {
    std::string crs;
    Affine posts;
    int columns;
    int rows;
};

Affine north_up(double x0, double y0, double step_x, double step_y) {
    Affine posts;
    posts.x0 = x0;
    posts.y0 = y0;
    posts.x_column = step_x;
    posts.y_row = -step_y;
    return posts;
}

/// One grid as the frame is chosen for it.
struct OneTarget {
    geo::GridFrame frame;
    std::optional<OwnPosts> own;
    bool downsamples = false;
    std::vector<std::string> notes;
};

/// A grid's target, with the map for checks.
struct Chosen {
    Result<Crs> crs;
    Result<Operation> operation;
    std::unique_ptr<SourceMap> map;
    Result<OneTarget> target;
};

Chosen choose(const Grid& grid, const TargetRequest& request = {}) {
    Chosen chosen{Crs::parse(grid.crs), Error{}, nullptr, Error{}};
    EXPECT_TRUE(chosen.crs) << grid.crs;
    std::vector<Place> places;
    for (const double r : {0.0, 0.5, 1.0})
        for (const double c : {0.0, 0.5, 1.0})
            places.push_back(grid.posts.at({c * (grid.columns - 1), r * (grid.rows - 1)}));
    chosen.operation = Operation::to_wgs84(*chosen.crs, places);
    EXPECT_TRUE(chosen.operation) << grid.crs;
    chosen.map =
        std::make_unique<SourceMap>(*chosen.operation, *chosen.crs, grid.posts, grid.columns, grid.rows);
    const auto frame =
        choose_frame("test", {{&*chosen.crs, grid.posts, *chosen.map, {*chosen.map}, 1}}, request);
    if (frame)
        chosen.target = OneTarget{frame->frame, frame->uses[0].own, frame->uses[0].downsamples, frame->notes};
    else
        chosen.target = frame.error();
    return chosen;
}

TEST(TargetFrame, GeographicGridsKeepTheirPosts) {
    const double step = 1.0 / 1200;
    const auto chosen = choose({"EPSG:4326", north_up(86 + step / 3, 28.1, step, step), 1201, 801});
    ASSERT_TRUE(chosen.target) << chosen.target.error().message;
    ASSERT_TRUE(chosen.target->own);
    const auto& frame = chosen.target->frame;
    EXPECT_EQ(frame.west, 86 + step / 3);  // bit for bit
    EXPECT_EQ(frame.north, 28.1);
    EXPECT_EQ(frame.step_x, step);
    EXPECT_EQ(frame.step_y, step);
    EXPECT_EQ(frame.columns, 1201);
    EXPECT_EQ(frame.rows, 801);
    EXPECT_FALSE(chosen.target->own->flip_rows);
    EXPECT_TRUE(chosen.target->notes.empty());
}

TEST(TargetFrame, SouthUpAndWestwardGridsAreFlipped) {
    Affine posts = north_up(10, 50, -0.01, -0.02);  // columns run west from 10, rows north from 50
    const auto chosen = choose({"EPSG:4326", posts, 100, 50});
    ASSERT_TRUE(chosen.target);
    ASSERT_TRUE(chosen.target->own);
    EXPECT_TRUE(chosen.target->own->flip_rows);
    EXPECT_TRUE(chosen.target->own->flip_columns);
    EXPECT_NEAR(chosen.target->frame.west, 10 - 0.99, 1e-12);
    EXPECT_NEAR(chosen.target->frame.north, 50 + 0.98, 1e-12);
}

TEST(TargetFrame, LongitudesInAnyTurn) {
    const auto east = choose({"EPSG:4326", north_up(190, 10, 0.1, 0.1), 30, 20});
    ASSERT_TRUE(east.target && east.target->own);
    EXPECT_NEAR(east.target->frame.west, -170, 1e-12);
    const auto across = choose({"EPSG:4326", north_up(179, 10, 0.1, 0.1), 30, 20});
    ASSERT_TRUE(across.target && across.target->own);
    EXPECT_EQ(across.target->frame.west, 179);
    const auto whole = choose({"EPSG:4326", north_up(0, 90, 1, 1), 360, 181});
    ASSERT_TRUE(whole.target && whole.target->own);
    EXPECT_EQ(whole.target->frame.west, 0);
    EXPECT_EQ(whole.target->frame.columns, 361);  // the first column comes again
    const auto closed = choose({"EPSG:4326", north_up(-180, 90, 1, 1), 361, 181});
    ASSERT_TRUE(closed.target && closed.target->own);
    EXPECT_EQ(closed.target->frame.columns, 361);
    const auto twice = choose({"EPSG:4326", north_up(-180, 90, 1, 1), 400, 181});
    EXPECT_FALSE(twice.target);
}

TEST(TargetFrame, DatumsWithinAThousandthOfAStepKeepTheirPosts) {
    const auto etrs89 = choose({"EPSG:4258", north_up(10, 50, 0.001, 0.001), 100, 100});
    ASSERT_TRUE(etrs89.target);
    EXPECT_TRUE(etrs89.target->own);
    const auto nad27 = choose({"EPSG:4267", north_up(-100, 40, 0.001, 0.001), 100, 100});
    ASSERT_TRUE(nad27.target);
    EXPECT_FALSE(nad27.target->own);
}

TEST(TargetFrame, CropKeepsPosts) {
    TargetRequest request;
    request.crop = Bounds{10.0249, 49.9, 10.0601, 49.95};
    for (const bool south_up : {false, true}) {
        const Affine posts = south_up ? north_up(10, 49, 0.01, -0.01) : north_up(10, 50, 0.01, 0.01);
        const auto chosen = choose({"EPSG:4326", posts, 101, 101}, request);
        ASSERT_TRUE(chosen.target);
        ASSERT_TRUE(chosen.target->own);
        EXPECT_NEAR(chosen.target->frame.west, 10.03, 1e-12);
        EXPECT_NEAR(chosen.target->frame.north, 49.95, 1e-12);
        EXPECT_EQ(chosen.target->frame.columns, 4);
        EXPECT_EQ(chosen.target->frame.rows, 6);
        EXPECT_EQ(chosen.target->own->of({0, 0, 4, 6}).column, 3);
        EXPECT_EQ(chosen.target->own->of({0, 0, 4, 6}).row, south_up ? 90 : 5);
    }
    request.crop = Bounds{20, 49.9, 21, 49.95};
    const auto outside = choose({"EPSG:4326", north_up(10, 50, 0.01, 0.01), 101, 101}, request);
    ASSERT_FALSE(outside.target);
    EXPECT_NE(outside.target.error().message.find("It covers"), std::string::npos);
}

TEST(TargetFrame, CropAcrossTheAntimeridian) {
    TargetRequest request;
    request.crop = Bounds{179.5, -5, -179.5, 5};
    const auto chosen = choose({"EPSG:4326", north_up(0, 90, 0.5, 0.5), 720, 361}, request);
    ASSERT_TRUE(chosen.target) << chosen.target.error().message;
    EXPECT_EQ(chosen.target->frame.west, 179.5);
    EXPECT_EQ(chosen.target->frame.columns, 3);
}

// Truth: every source post's neighbours, one by one, are at least a scene step away in one direction at
// least, and the scene holds every source post.
TEST(TargetFrame, NoSourcePostIsLost) {
    Affine rotated = north_up(500000, 5200000, 30, 30);
    rotated.x_row = 18;
    rotated.y_column = 18;
    rotated.x_column = 24;
    rotated.y_row = -24;
    for (const Grid& grid : {Grid{"EPSG:32632", north_up(700000, 8000000, 30, 30), 200, 150},
                             Grid{"EPSG:32632", rotated, 180, 90},
                             Grid{"EPSG:3031", north_up(1000000, 1500000, 5000, 5000), 100, 100},
                             Grid{"EPSG:3857", north_up(0, 9000000, 1000, 1000), 100, 400},
                             Grid{"EPSG:4267", north_up(-100, 40, 0.001, 0.002), 100, 100}}) {
        const auto chosen = choose(grid);
        ASSERT_TRUE(chosen.target) << grid.crs;
        ASSERT_FALSE(chosen.target->own) << grid.crs;
        EXPECT_FALSE(chosen.target->downsamples);
        const GridMap map{*chosen.map, chosen.target->frame};
        for (int r = 0; r + 1 < grid.rows; ++r)
            for (int c = 0; c + 1 < grid.columns; ++c) {
                Place p[3] = {{double(c), double(r)}, {c + 1.0, double(r)}, {double(c), r + 1.0}};
                map.to_scene(p);
                ASSERT_GE(p[0].x, -1e-3) << grid.crs;
                ASSERT_GE(p[0].y, -1e-3);
                ASSERT_LE(p[0].x, chosen.target->frame.columns - 1 + 1e-3);
                ASSERT_LE(p[0].y, chosen.target->frame.rows - 1 + 1e-3);
                for (int i = 1; i < 3; ++i) {
                    // A scene step is at most a source post in any direction.
                    const double distance = std::hypot(p[i].x - p[0].x, p[i].y - p[0].y);
                    ASSERT_GE(distance, 0.999) << grid.crs << " " << c << " " << r;
                }
            }
    }
}

TEST(TargetFrame, UtmAcrossTheAntimeridianIsOnePiece) {
    for (const char* crs : {"EPSG:32660", "EPSG:32601"}) {
        const bool west = std::string{crs} == "EPSG:32660";
        // 180 degrees lies 334 km from the zone's middle at the equator.
        const auto chosen = choose({crs, north_up(west ? 820000 : 160000, 1000000, 100, 100), 400, 100});
        ASSERT_TRUE(chosen.target) << chosen.target.error().message;
        const auto& frame = chosen.target->frame;
        EXPECT_LT(frame.columns, 500) << crs;
        EXPECT_GT(frame.west, 179) << crs;
        EXPECT_GT(frame.west + frame.step_x * (frame.columns - 1), 180) << crs;
    }
}

TEST(TargetFrame, APoleInsideTakesUpsAndItsSurroundingsNeedNot) {
    const Grid antarctica{"EPSG:3031", north_up(-3000000, 3000000, 50000, 50000), 121, 121};
    EXPECT_EQ(choose(antarctica).target->frame.kind, geo::FrameKind::ups_south);
    TargetRequest geographic;
    geographic.frame = FrameChoice::geographic;
    const auto all = choose(antarctica, geographic);
    ASSERT_FALSE(all.target);
    EXPECT_EQ(all.target.error().kind, ErrorKind::input);
    EXPECT_NE(all.target.error().message.find("--crop"), std::string::npos);
    TargetRequest request;
    request.crop = Bounds{-70, -84, -55, -72};
    EXPECT_EQ(choose(antarctica, request).target->frame.kind, geo::FrameKind::ups_south);
    request.frame = FrameChoice::geographic;
    const auto part = choose(antarctica, request);
    ASSERT_TRUE(part.target) << part.target.error().message;
    EXPECT_NEAR(part.target->frame.west, -70, 1e-9);
    EXPECT_NEAR(part.target->frame.north, -72, 1e-9);
}

TEST(TargetFrame, ResolutionIsTakenAsGiven) {
    TargetRequest request;
    request.resolution = {0.02, 0.03};
    const auto chosen = choose({"EPSG:4326", north_up(10, 50, 0.01, 0.01), 101, 101}, request);
    ASSERT_TRUE(chosen.target);
    EXPECT_FALSE(chosen.target->own);
    EXPECT_TRUE(chosen.target->downsamples);
    EXPECT_EQ(chosen.target->frame.step_x, 0.02);
    EXPECT_EQ(chosen.target->frame.step_y, 0.03);
    EXPECT_EQ(chosen.target->frame.columns, 51);
    EXPECT_EQ(chosen.target->frame.rows, 35);  // the last row lies beyond the data
    request.resolution = {0.01, 0.01};
    const auto same = choose({"EPSG:4326", north_up(10, 50, 0.01, 0.01), 101, 101}, request);
    ASSERT_TRUE(same.target);
    EXPECT_TRUE(same.target->own);
}

TEST(TargetFrame, LatitudesBeyondAPoleAreRefused) {
    const auto chosen = choose({"EPSG:4326", north_up(0, 100, 1, 1), 20, 40});
    EXPECT_FALSE(chosen.target);
}

}  // namespace
}  // namespace relevo::ingest
