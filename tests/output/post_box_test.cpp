#include "output/post_box.hpp"

#include <cmath>
#include <random>

#include "tests/lod/measured_scene.hpp"
#include "tests/lod/synthetic_terrain.hpp"

namespace relevo::test {
namespace {

using Box = lod::BlockGrid::Box;

void expect_box(const Result<Box>& box, const Box& expected) {
    ASSERT_TRUE(box) << box.error().message;
    EXPECT_EQ(box->column, expected.column);
    EXPECT_EQ(box->row, expected.row);
    EXPECT_EQ(box->columns, expected.columns);
    EXPECT_EQ(box->rows, expected.rows);
}

TEST(PostBox, SnapsOutwards) {
    const auto frame = grid(10, 50, 0.1, 100, 80);
    expect_box(output::posts_around(frame, {11.01, 48.05, 12.04, 49.01}), {10, 9, 12, 12});
    // On posts, but for rounding, it is these.
    expect_box(output::posts_around(frame, {11, 48.1, 12.1, 49.1}), {10, 9, 12, 11});
    // Over the border it is the border.
    expect_box(output::posts_around(frame, {-20, -60, 10.25, 80}), {0, 0, 4, 80});
    expect_box(output::posts_around(frame, {-180, -90, 180, 90}), {0, 0, 100, 80});
    // In any turn of longitude.
    expect_box(output::posts_around(frame, {371.01, 48.05, 372.04, 49.01}), {10, 9, 12, 12});
}

TEST(PostBox, AcrossTheAntimeridian) {
    const auto frame = grid(175, 10, 0.5, 21, 21);
    expect_box(output::posts_around(frame, {179, 5, -179, 6}), {8, 8, 5, 3});
    expect_box(output::posts_around(frame, {-181, 5, -179, 6}), {8, 8, 5, 3});
    expect_box(output::posts_around(frame, {-178, 5, -177, 6}), {14, 8, 3, 3});
}

TEST(PostBox, RoundTheEarth) {
    const auto frame = grid(-180, 80, 1, 361, 161);
    expect_box(output::posts_around(frame, {-180, -80, 180, 80}), {0, 0, 361, 161});
    expect_box(output::posts_around(frame, {10, 0, 20, 10}), {190, 70, 11, 11});
    const auto seam = output::posts_around(frame, {170, 0, -170, 10});
    ASSERT_FALSE(seam);
    EXPECT_EQ(seam.error().kind, ErrorKind::usage);
}

TEST(PostBox, RefusesNonsense) {
    const auto frame = grid(10, 50, 0.1, 100, 80);
    for (const output::Bounds& bounds :
         {output::Bounds{11, 49, 12, 48}, output::Bounds{11, 48, 11, 49}, output::Bounds{30, 48, 31, 49},
          output::Bounds{11, 60, 12, 61}, output::Bounds{std::nan(""), 48, 12, 49},
          output::Bounds{11, 48, 12, 91}, output::Bounds{0, 48, 400, 49}}) {
        const auto box = output::posts_around(frame, bounds);
        ASSERT_FALSE(box) << bounds.west << ' ' << bounds.south << ' ' << bounds.east << ' ' << bounds.north;
        EXPECT_EQ(box.error().kind, ErrorKind::usage);
        EXPECT_NE(box.error().message.find("--bounds"), std::string::npos);
    }
}

/// Around a pole: random places of the area are in the box, and no side of it can be moved in.
TEST(PostBox, HoldsAnAreaAroundAPole) {
    std::mt19937 random(7);
    for (const auto kind : {geo::FrameKind::ups_north, geo::FrameKind::ups_south}) {
        const auto frame = polar_frame(kind, 401, 401, 5000);
        const double sign = kind == geo::FrameKind::ups_north ? 1 : -1;
        for (const auto& [west, width] :
             {std::pair{20.0, 30.0}, {-100.0, 250.0}, {170.0, 40.0}, {0.0, 360.0}}) {
            const double one = sign * 84;
            const double other = sign * 88;
            const auto box =
                output::posts_around(frame, {west, std::min(one, other), west + width, std::max(one, other)});
            ASSERT_TRUE(box) << box.error().message;
            geo::GridPosition least{1e9, 1e9};
            geo::GridPosition most{-1e9, -1e9};
            std::uniform_real_distribution<double> share(0, 1);
            for (int i = 0; i < 200000; ++i) {
                // The outer parallel and the two meridians: the borders.
                const bool along = i % 4 != 0;
                const double lon = west + (along || i % 8 == 0 ? share(random) : i % 16 == 4) * width;
                const double lat = along ? (i % 4 == 1 ? other : one) : one + share(random) * (other - one);
                const auto p = frame.grid_position({geo::Degrees{lat}, geo::Degrees{lon}});
                least = {std::min(least.column, p.column), std::min(least.row, p.row)};
                most = {std::max(most.column, p.column), std::max(most.row, p.row)};
            }
            EXPECT_LE(box->column, least.column);
            EXPECT_LE(box->row, least.row);
            EXPECT_GE(box->column + box->columns - 1, most.column);
            EXPECT_GE(box->row + box->rows - 1, most.row);
            EXPECT_GT(box->column + 1.01, least.column);
            EXPECT_GT(box->row + 1.01, least.row);
            EXPECT_LT(box->column + box->columns - 2.01, most.column);
            EXPECT_LT(box->row + box->rows - 2.01, most.row);
        }
    }
}

/// Over corners of blocks; and nothing but the blocks it touches is read: the others may be damaged.
TEST(PostBox, ReadsItsBlocksAlone) {
    const MeasuredScene made(grid(10, 50, 0.001, 1300, 700), rough);
    const Box box{500, 505, 30, 20};
    const auto heights = output::read_box(made.scene(), box);
    ASSERT_TRUE(heights) << heights.error().message;
    for (int row = 0; row < box.rows; ++row)
        for (int column = 0; column < box.columns; ++column)
            ASSERT_EQ(heights->at(column, row), made.heights().at(box.column + column, box.row + row));
    for (const lod::BlockInfo& block : made.scene().info().heights) {
        if (block.column < 2) continue;
        const auto file = made.scene().path() / block.file;
        std::filesystem::permissions(file, std::filesystem::perms::owner_write,
                                     std::filesystem::perm_options::add);
        replace(file, "damaged");
    }
    EXPECT_TRUE(output::read_box(made.scene(), box));
    const auto damaged = output::read_box(made.scene(), {1000, 0, 100, 100});
    ASSERT_FALSE(damaged);
    EXPECT_EQ(damaged.error().kind, ErrorKind::damaged);
}

}  // namespace
}  // namespace relevo::test
