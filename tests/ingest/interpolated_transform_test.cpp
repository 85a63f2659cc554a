#include "ingest/resample/interpolated_transform.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "ingest/mosaic/grid_map.hpp"

namespace relevo::ingest {
namespace {

/// Largest distance between interpolated and exact positions, over every post.
double largest_error(const ExactTransform& exact, Window window) {
    const auto places = transform_posts(exact, window);
    double largest = 0;
    for (int r = 0; r < window.rows; ++r)
        for (int c = 0; c < window.columns; ++c) {
            Place truth{static_cast<double>(window.column + c), static_cast<double>(window.row + r)};
            exact({&truth, 1});
            const Place p = places.at(c, r);
            const double distance = std::hypot(p.x - truth.x, p.y - truth.y);
            if (std::isnan(truth.x)) {
                EXPECT_TRUE(std::isnan(p.x));
            } else {
                EXPECT_FALSE(std::isnan(distance)) << c << " " << r;
                largest = std::max(largest, distance);
            }
        }
    return largest;
}

ExactTransform each(Place (*f)(Place)) {
    return [f](std::span<Place> places) {
        for (Place& p : places) p = f(p);
    };
}

TEST(TransformPosts, WithinTheToleranceEverywhere) {
    const Window all{0, 0, 200, 150};
    EXPECT_LE(largest_error(each([](Place p) {
                                return Place{2 * p.x - p.y + 5, p.x + 3 * p.y};
                            }),
                            all),
              1e-11);
    EXPECT_LE(largest_error(each([](Place p) {
                                return Place{p.x * p.x * 1e-4, p.y + p.x * p.y * 1e-4};
                            }),
                            all),
              1e-3);
    EXPECT_LE(largest_error(each([](Place p) {
                                return Place{std::sin(p.x * 0.05) * 9, std::cos(p.y * 0.3)};
                            }),
                            all),
              1e-3);
    EXPECT_LE(largest_error(each([](Place p) {
                                return Place{std::exp(p.x * 0.03), std::exp(p.y * 0.05)};
                            }),
                            all),
              1e-3);
}

// A datum grid's border is a jump: cells shrink to single posts there, where nothing is interpolated.
TEST(TransformPosts, ExactAtJumpsAndBesideUndefinedPlaces) {
    const Window all{0, 0, 130, 70};
    EXPECT_LE(largest_error(each([](Place p) { return Place{p.x + (p.x > 33.3 ? 4 : 0), p.y}; }), all), 1e-3);
    EXPECT_LE(largest_error(each([](Place p) {
                                return p.x + p.y > 100 ? Place{std::nan(""), std::nan("")} : Place{p.x, p.y};
                            }),
                            all),
              1e-3);
}

TEST(TransformPosts, ShapesOfTheWindow) {
    const auto curve = each([](Place p) { return Place{p.x * p.x * 1e-3, p.y * p.y * 1e-3}; });
    for (const Window w :
         {Window{0, 0, 1, 1}, {64, 128, 1, 100}, {0, 64, 100, 1}, {0, 0, 2, 2}, {0, 0, 65, 64}})
        EXPECT_LE(largest_error(curve, w), 1e-3) << w.columns << " x " << w.rows;
}

TEST(TransformPosts, CostsFewExactPositionsWhereTheMapIsSmooth) {
    std::size_t count = 0;
    transform_posts(
        [&](std::span<Place> places) {
            count += places.size();
            for (Place& p : places) p.x += 1e-9 * p.x * p.x;
        },
        {0, 0, 512, 512});
    EXPECT_LE(count, 64U * 10);  // 64 tiles, 4 corners and 5 checks each
}

// The maps that matter: scene posts to source posts and back, of real projections, against PROJ at every
// post.
TEST(TransformPosts, RealProjections) {
    struct Case {
        const char* crs;
        double x, y, step;
    };
    for (const Case& c : {Case{"EPSG:32632", 611217, 110644, 92.45},
                          {"EPSG:32633", 200000, 8800000, 30},
                          {"EPSG:3031", 1000000, 1000000, 5000},
                          {"EPSG:2154", 700000, 6600000, 25},
                          {"EPSG:3857", 15000000, 8000000, 500},
                          {"EPSG:26710", 557805, 5122005, 30}}) {
        const auto crs = Crs::parse(c.crs);
        ASSERT_TRUE(crs);
        constexpr int kSide = 300;
        Affine posts;
        posts.x0 = c.x;
        posts.y0 = c.y;
        posts.x_column = c.step;
        posts.y_row = -c.step;
        const std::vector<Place> sample{posts.at({0, 0}), posts.at({kSide, kSide})};
        const auto operation = Operation::to_wgs84(*crs, sample);
        ASSERT_TRUE(operation) << c.crs;
        const SourceMap map{*operation, *crs, posts, kSide, kSide};
        EXPECT_LE(largest_error(
                      [&](std::span<Place> places) {
                          map.to_lon_lat(places);
                          for (Place& p : places) p = {p.x / c.step * 100000, p.y / c.step * 100000};
                      },
                      {0, 0, kSide, kSide}),
                  kPositionTolerance)
            << c.crs;
    }
}

}  // namespace
}  // namespace relevo::ingest
