#include "ingest/resample/resample.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace relevo::ingest {
namespace {

constexpr double kVoid = std::numeric_limits<double>::quiet_NaN();
constexpr int kSide = 12;

/// kSide x kSide posts with a ring of voids around them, as the warp hands parts over.
SourcePart part_of(const std::function<double(int, int)>& height, int ring = 3) {
    SourcePart part{{-ring, -ring, kSide + 2 * ring, kSide + 2 * ring}, {}};
    part.heights = lod::Raster<double>{part.window.columns, part.window.rows, kVoid};
    for (int r = 0; r < kSide; ++r)
        for (int c = 0; c < kSide; ++c) part.heights.at(c + ring, r + ring) = height(c, r);
    return part;
}

double plane(double c, double r) {
    return 7 + 3.5 * c - 2.25 * r;
}

TEST(Resample, PlanesStayPlanes) {
    const auto part = part_of([](int c, int r) { return plane(c, r); });
    std::mt19937 random{1};
    std::uniform_real_distribution<double> inside{0, kSide - 1.0};
    for (const auto method : {Resampling::cubic, Resampling::bilinear})
        for (int i = 0; i < 1000; ++i) {
            const Place p{inside(random), inside(random)};
            EXPECT_NEAR(resample(part, p, method, {}), plane(p.x, p.y), 1e-12);
        }
}

TEST(Resample, CubicIsExactForQuadratics) {
    const auto f = [](double c, double r) { return 1000 + 5 * c * c + 40 * c - 3 * c * r + 2 * r * r; };
    const auto part = part_of([&](int c, int r) { return f(c, r); });
    std::mt19937 random{2};
    std::uniform_real_distribution<double> inside{1, kSide - 2.0};
    for (int i = 0; i < 1000; ++i) {
        const Place p{inside(random), inside(random)};
        EXPECT_NEAR(resample(part, p, Resampling::cubic, {}), f(p.x, p.y), 1e-9);
    }
}

TEST(Resample, AtAPostItIsThePost) {
    std::mt19937 random{3};
    std::uniform_real_distribution<double> any{-100, 100};
    const auto part = part_of([&](int, int) { return any(random); });
    for (const auto method :
         {Resampling::cubic, Resampling::bilinear, Resampling::nearest, Resampling::average})
        for (int r = 0; r < kSide; ++r)
            for (int c = 0; c < kSide; ++c)
                EXPECT_NEAR(resample(part, {double(c), double(r)}, method, {}), part.heights.at(c + 3, r + 3),
                            1e-13);
}

// The oracle scans the posts that a method may take: its range, its voids, and the class of the nearest post.
TEST(Resample, VoidsNeverBleedAndDecideTheClass) {
    std::mt19937 random{4};
    std::uniform_real_distribution<double> any{0, 1000};
    std::uniform_real_distribution<double> around{-0.5, kSide - 0.5};
    for (int round = 0; round < 20; ++round) {
        std::bernoulli_distribution is_void{0.05 * round};
        const auto part = part_of([&](int, int) { return is_void(random) ? kVoid : any(random); });
        const auto post = [&](int c, int r) { return part.heights.at(c + 3, r + 3); };
        for (int i = 0; i < 500; ++i) {
            const Place p{around(random), around(random)};
            const bool valid = !std::isnan(
                post(static_cast<int>(std::floor(p.x + 0.5)), static_cast<int>(std::floor(p.y + 0.5))));
            double lowest = 1e9;
            double highest = -1e9;
            for (int r = static_cast<int>(std::floor(p.y)) - 1; r <= static_cast<int>(std::floor(p.y)) + 2;
                 ++r)
                for (int c = static_cast<int>(std::floor(p.x)) - 1;
                     c <= static_cast<int>(std::floor(p.x)) + 2; ++c)
                    if (!std::isnan(post(c, r))) {
                        lowest = std::min(lowest, post(c, r));
                        highest = std::max(highest, post(c, r));
                    }
            for (const auto method : {Resampling::cubic, Resampling::bilinear, Resampling::nearest}) {
                const double height = resample(part, p, method, {});
                ASSERT_EQ(!std::isnan(height), valid) << p.x << " " << p.y;
                if (valid) {
                    ASSERT_GE(height, lowest);
                    ASSERT_LE(height, highest);
                }
            }
        }
    }
}

TEST(Resample, BesideAVoidAPlaneIsStillAPlane) {
    auto part = part_of([](int c, int r) { return plane(c, r); });
    part.heights.at(5 + 3, 5 + 3) = kVoid;
    for (const Place p : {Place{4.3, 4.4}, {5.9, 4.0}, {4.2, 5.7}, {6.3, 6.6}})
        EXPECT_NEAR(resample(part, p, Resampling::cubic, {}), plane(p.x, p.y), 1e-12) << p.x << " " << p.y;
}

TEST(Resample, AverageIsTheMeanOverTheArea) {
    const auto part = part_of([](int c, int r) { return 10.0 * c + r; });
    // 2 x 2 posts, exactly: (3, 4), (4, 4), (3, 5), (4, 5).
    EXPECT_NEAR(resample(part, {3.5, 4.5}, Resampling::average, {1, 1}), 39.5, 1e-12);
    // 2 posts wide around a post: halves of its neighbours.
    EXPECT_NEAR(resample(part, {3, 4}, Resampling::average, {1, 0.5}), 34, 1e-12);
}

TEST(Resample, AverageIsVoidWhereMostOfTheAreaIs) {
    auto part = part_of([](int, int) { return 5.0; });
    part.heights.at(3 + 3, 4 + 3) = kVoid;
    EXPECT_EQ(resample(part, {3.5, 4.5}, Resampling::average, {1, 1}), 5);  // 3 of 4 are valid
    part.heights.at(4 + 3, 4 + 3) = kVoid;
    part.heights.at(4 + 3, 5 + 3) = kVoid;
    EXPECT_TRUE(std::isnan(resample(part, {3.5, 4.5}, Resampling::average, {1, 1})));
}

TEST(Resample, NamesRoundTrip) {
    for (const auto method :
         {Resampling::cubic, Resampling::bilinear, Resampling::nearest, Resampling::average})
        EXPECT_EQ(resampling_from(to_string(method)), method);
    EXPECT_FALSE(resampling_from("lanczos"));
}

}  // namespace
}  // namespace relevo::ingest
