// Which pages a picture wants, against every post that it sees.

#include "viewer/ground/wanted_pages.hpp"

#include <cmath>
#include <random>
#include <set>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/lod/synthetic_terrain.hpp"

namespace relevo::test {
namespace {

using viewer::Page;

constexpr viewer::GroundFacts kFacts{.lowest_m = -100, .highest_m = 2000, .lowest_land_m = -100};

struct Place {
    explicit Place(const geo::GridFrame& grid)
        : frame(grid), positions(frame), bounds(frame, positions, undulations, kFacts) {}
    Place(const Place&) = delete;
    Place& operator=(const Place&) = delete;

    int top() const { return std::max(frame.levels() - 8, 0); }

    viewer::WantedPages wanted(const lod::View& view, const viewer::PicturePart& part, double exaggeration,
                               std::size_t most = 100000, const std::set<Page>& damaged = {}) const {
        return viewer::wanted_pages(viewer::Sight(view, part), bounds, frame, top(), exaggeration, most,
                                    [&](const Page& page) { return damaged.count(page) != 0; });
    }

    geo::GridFrame frame;
    geo::PostPositions positions;
    lod::UndulationGrid undulations;
    viewer::PageBounds bounds;
};

const std::vector<geo::GridFrame> kFrames{
    geographic_frame(3000, 1700),
    geographic_frame(257, 258),
    geographic_frame(40, 900, 70),
    {geo::FrameKind::geographic, -180, 90, 360.0 / 4320, 360.0 / 4320, 4321, 2161},
    polar_frame(geo::FrameKind::ups_north, 1500, 1100, 2000, 1e5, -2e5),
};

Page page_at(int column, int row, int level) {
    return {level, column >> (level + 8), row >> (level + 8)};
}

TEST(PageBounds, HoldTheWholePage) {
    for (const auto& frame : kFrames) {
        const Place place(frame);
        for (int level = 0; level <= place.top(); ++level) {
            for (const auto& [c, r] : {std::pair(0, 0), std::pair(1, 0), std::pair(2, 3)}) {
                const Page page{level, c, r};
                if (!viewer::has_data(page, frame)) continue;
                for (const double e : {1.0, 5.0}) {
                    const auto sphere = place.bounds.of(page, e);
                    const int side = 256 << level;
                    const int stride = std::max(side / 61, 1);
                    double farthest = 0;
                    double spacing = 0;
                    for (int row = r * side; row <= std::min((r + 1) * side, frame.rows - 1); row += stride) {
                        for (int column = c * side; column <= std::min((c + 1) * side, frame.columns - 1);
                             column += stride) {
                            const geo::GridPosition at{double(column), double(row)};
                            for (const double H : {kFacts.lowest_m, kFacts.highest_m}) {
                                const auto p = frame.ecef(at, {e * H});
                                farthest = std::max(farthest, glm::distance(p.m, sphere.centre));
                            }
                            const auto apart = frame.spacing(at);
                            spacing = std::max(spacing, std::min(apart.column_m, apart.row_m));
                        }
                    }
                    EXPECT_LE(farthest, sphere.radius_m);
                    EXPECT_LT(sphere.radius_m, 1.6 * farthest + 1);
                    EXPECT_NEAR(sphere.spacing_m, spacing, 0.05 * spacing);
                }
            }
        }
    }
}

/// Each page once, after its parent.
void expect_closed(const viewer::WantedPages& wanted, int top) {
    ASSERT_FALSE(wanted.pages.empty());
    EXPECT_EQ(wanted.pages.front(), (Page{top, 0, 0}));
    std::set<Page> seen;
    for (const Page& page : wanted.pages) {
        const Page parent{page.level + 1, page.column / 2, page.row / 2};
        EXPECT_TRUE(page.level == top || seen.count(parent) != 0)
            << page.level << " " << page.column << " " << page.row;
        EXPECT_TRUE(seen.insert(page).second);
    }
}

lod::Camera random_camera(const geo::GridFrame& frame, std::mt19937& random) {
    const auto any = [&](double low, double high) {
        return std::uniform_real_distribution<>(low, high)(random);
    };
    const auto place = frame.lat_lon({any(0, frame.columns - 1), any(0, frame.rows - 1)});
    return {.eye = {place.lat, place.lon, {std::exp(any(4, 15))}},
            .heading = geo::Degrees{any(0, 360)},
            .pitch = geo::Degrees{any(-90, 10)},
            .roll = geo::Degrees{any(-40, 40)},
            .fov = geo::Degrees{any(2, 120)},
            .width = 800,
            .height = 500};
}

// For every post in the part: a page of the level whose posts are the next finer than its pixels.
TEST(WantedPages, AreFineEnoughForEveryPost) {
    constexpr unsigned kSeed = 11;
    std::mt19937 random(kSeed);
    int seen = 0;
    for (const auto& frame : kFrames) {
        const Place place(frame);
        for (int i = 0; i < 12; ++i) {
            const lod::View view(random_camera(frame, random));
            const viewer::PicturePart part =
                i % 2 == 0 ? viewer::PicturePart{0, 0, 800, 500} : viewer::PicturePart{500, 50, 130, 260};
            const double e = i % 3 == 0 ? 4 : 1;
            const auto wanted = place.wanted(view, part, e);
            EXPECT_TRUE(wanted.complete);
            expect_closed(wanted, place.top());
            const std::set<Page> pages(wanted.pages.begin(), wanted.pages.end());
            for (int row = 0; row < frame.rows - 1; row += 13) {
                for (int column = 0; column < frame.columns - 1; column += 13) {
                    const geo::GridPosition at{double(column), double(row)};
                    const double H = kFacts.lowest_m + 2100 * noise(column, row);
                    const glm::dvec3 offset = frame.ecef(at, {e * H}).m - view.eye().m;
                    if (!view.sees(offset)) continue;
                    const auto pixel = view.pixel(offset);
                    if (pixel.x < part.x || pixel.x > part.x + part.width || pixel.y < part.y ||
                        pixel.y > part.y + part.height)
                        continue;
                    const auto apart = frame.spacing(at);
                    const double pixel_posts =
                        view.depth(offset) / view.focal_px() / std::min(apart.column_m, apart.row_m);
                    const double exact = std::log2(pixel_posts) - 0.8;
                    const int level =
                        std::clamp(static_cast<int>(std::floor(std::min(exact, 99.0))), 0, place.top());
                    EXPECT_TRUE(pages.count(page_at(column, row, level)))
                        << column << " " << row << " level " << level << " seed " << kSeed;
                    ++seen;
                }
            }
        }
    }
    EXPECT_GT(seen, 10000);
}

TEST(WantedPages, AreFewFromFarAndOnlyWhatIsInView) {
    const Place place(geographic_frame(16385, 16385));
    lod::Camera camera{.eye = {geo::Degrees{33.7}, geo::Degrees{140.3}, {3000}},
                       .heading = geo::Degrees{0},
                       .pitch = geo::Degrees{-90},
                       .roll = {},
                       .fov = geo::Degrees{50},
                       .width = 1280,
                       .height = 720};
    const auto wanted = [&] {
        const lod::View view(camera);
        return place.wanted(view, {0, 0, 1280, 720}, 1).pages.size();
    };
    EXPECT_LT(wanted(), 60u);
    camera.pitch.value = -10;
    EXPECT_LT(wanted(), 400u);
    camera.pitch.value = 60;
    EXPECT_LT(wanted(), 30u);  // the sky: what the spheres of the coarsest cannot tell
    camera.eye.h.m = 5e6;
    camera.pitch.value = -90;
    EXPECT_LT(wanted(), 20u);
}

TEST(WantedPages, TakeTheMostUrgentWhereThereIsNoRoomForAll) {
    const Place place(geographic_frame(3000, 1700));
    const lod::View view(
        {.eye = above(make_terrain(geographic_frame(3, 3), lod::Raster<float>(3, 3)), 0, 0, 500),
         .heading = geo::Degrees{120},
         .pitch = geo::Degrees{-20},
         .roll = {},
         .fov = geo::Degrees{60},
         .width = 1280,
         .height = 720});
    const auto all = place.wanted(view, {0, 0, 1280, 720}, 1);
    ASSERT_TRUE(all.complete);
    ASSERT_GT(all.pages.size(), 12u);
    for (const std::size_t most : {std::size_t{1}, std::size_t{7}, all.pages.size() - 1, all.pages.size()}) {
        const auto some = place.wanted(view, {0, 0, 1280, 720}, 1, most);
        EXPECT_EQ(some.complete, most == all.pages.size());
        ASSERT_EQ(some.pages.size(), most);
        EXPECT_TRUE(std::equal(some.pages.begin(), some.pages.end(), all.pages.begin()));
    }
}

TEST(WantedPages, LeaveOutWhatIsDamagedAndBelow) {
    const Place place(geographic_frame(3000, 1700));
    const lod::View view({.eye = {geo::Degrees{35.8}, geo::Degrees{138.4}, {4000}},
                          .heading = {},
                          .pitch = geo::Degrees{-90},
                          .roll = {},
                          .fov = geo::Degrees{120},
                          .width = 1280,
                          .height = 720});
    const Page broken{1, 2, 1};
    EXPECT_FALSE(place.wanted(view, {0, 0, 1280, 720}, 1).damaged);
    const auto wanted = place.wanted(view, {0, 0, 1280, 720}, 1, 1000, {broken});
    EXPECT_TRUE(wanted.damaged);
    expect_closed(wanted, place.top());
    for (const Page& page : wanted.pages) {
        EXPECT_NE(page, broken);
        EXPECT_FALSE(page.level == 0 && page.column / 2 == 2 && page.row / 2 == 1);
    }
}

}  // namespace
}  // namespace relevo::test
