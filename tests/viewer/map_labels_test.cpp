// Labels of contours: on their lines, along them, and apart from each other. Truth is the terrain's own
// formula.

#include "viewer/marks/map_labels.hpp"

#include <chrono>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lod/soar/pick.hpp"
#include "tests/viewer/studio.hpp"
#include "viewer/marks/legend.hpp"

namespace relevo::test {
namespace {

using viewer::Layer;

void bring_in(const lod::Terrain& terrain, const lod::View& view) {
    lod::Refiner refiner(terrain);
    must(refiner.refine_whole(view, {.tau_px = 1}));
}

double height_at(const lod::Terrain& terrain, const lod::View& view, const glm::dvec2& pixel) {
    const auto hit = lod::pick_exactly(terrain, view.eye(), view.ray(pixel));
    if (!hit) return std::nan("");
    return geo::to_geodetic({view.eye().m + hit->distance_m * view.ray(pixel)}).h.m;
}

TEST(ContourLabels, LieOnTheirLinesAndAlongThem) {
    const auto frame = geographic_frame(513, 513);
    const auto terrain = make_terrain(frame, make_heights(frame, [](int column, int row) {
                                          return 1500 + 700 * std::sin(column / 60.0) * std::cos(row / 45.0);
                                      }));
    for (const double pitch : {-90.0, -35.0, -15.0}) {
        auto camera =
            above_looking_down(terrain, 256, pitch == -90 ? 256 : 400, pitch == -90 ? 9000 : 2500, 1280, 720);
        camera.pitch.value = pitch;
        camera.fov.value = 60;
        const lod::View view(camera);
        bring_in(terrain, view);
        const double interval = 50;
        const auto labels = viewer::contour_labels(terrain, view, interval);
        EXPECT_GT(labels.size(), 4U) << pitch;
        for (std::size_t i = 0; i < labels.size(); ++i) {
            const auto& label = labels[i];
            const double said = std::stod(label.text);
            EXPECT_EQ(std::remainder(said, 5 * interval), 0) << label.text;
            // Along the line by 5 pixels: the height stays the same but for the line's bend; across it does
            // not.
            const double a = label.angle * 3.14159265358979 / 180;
            const glm::dvec2 along(5 * std::cos(a), 5 * std::sin(a));
            const glm::dvec2 across(-along.y, along.x);
            const double here = height_at(terrain, view, label.pixel);
            const double growth = std::abs(height_at(terrain, view, label.pixel + across) -
                                           height_at(terrain, view, label.pixel - across)) /
                                  10;
            EXPECT_NEAR(here, said, std::max(1.5 * growth, 0.5))
                << pitch << " " << label.pixel.x << " " << label.pixel.y;
            const double along_growth = std::abs(height_at(terrain, view, label.pixel + along) -
                                                 height_at(terrain, view, label.pixel - along)) /
                                        10;
            EXPECT_LT(along_growth, 0.5 * growth + 0.05) << pitch;
            EXPECT_LE(std::abs(label.angle), 90);
            for (std::size_t k = 0; k < i; ++k)
                EXPECT_GE(glm::distance(labels[k].pixel, label.pixel), 180) << label.text;
        }
        const auto start = std::chrono::steady_clock::now();
        constexpr int kTimes = 10;
        for (int i = 0; i < kTimes; ++i)
            ASSERT_EQ(viewer::contour_labels(terrain, view, interval).size(), labels.size());
        const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
        fmt::print("[ labels ] pitch {}: {} labels in {:.2f} ms\n", pitch, labels.size(),
                   took.count() / kTimes);
    }
}

TEST(ContourLabels, ThereAreNoneInTheSkyOnPlainsOrWhereLinesCrowd) {
    const auto frame = geographic_frame(129, 129);
    const auto flat = make_terrain(frame, make_heights(frame, [](int, int) { return 500.0; }));
    auto camera = above_looking_down(flat, 64, 64, 1000, 1280, 720);
    bring_in(flat, lod::View(camera));
    EXPECT_TRUE(viewer::contour_labels(flat, lod::View(camera), 100).empty());
    camera.pitch.value = 60;
    EXPECT_TRUE(viewer::contour_labels(flat, lod::View(camera), 100).empty());
    const auto steep =
        make_terrain(frame, make_heights(frame, [](int column, int) { return 60.0 * column; }));
    camera = above_looking_down(steep, 64, 64, 1000, 1280, 720);
    bring_in(steep, lod::View(camera));
    EXPECT_TRUE(viewer::contour_labels(steep, lod::View(camera), 1).empty());
    EXPECT_FALSE(viewer::contour_labels(steep, lod::View(camera), 20).empty());
}

TEST(Legend, HasRoundHeightsInOrderAndTheLayersColours) {
    const viewer::HeightSpan span{-120, 2870, 0};
    const auto made = viewer::legend(Layer::hypsometric, span, true);
    ASSERT_TRUE(made);
    EXPECT_EQ(made->unit, "m");
    ASSERT_GE(made->marks.size(), 3U);
    for (std::size_t i = 0; i < made->marks.size(); ++i) {
        const auto& mark = made->marks[i];
        EXPECT_NEAR(span.low + mark.at * (span.high - span.low), std::stod(mark.text), 1e-6);
        if (i == 0) continue;
        EXPECT_GT(mark.at, made->marks[i - 1].at);
    }
    EXPECT_EQ(made->colours.front(), viewer::sea_ramp(span).front());
    EXPECT_EQ(made->colours.back(), viewer::colour_ramp(Layer::hypsometric, span).back());
    EXPECT_EQ(viewer::legend(Layer::slope, span, false)->marks.back().text, "60");
    EXPECT_TRUE(viewer::legend(Layer::aspect, span, false)->cyclic);
    EXPECT_FALSE(viewer::legend(Layer::terrain, span, true));
    EXPECT_EQ(viewer::legend(Layer::hypsometric, {5, 5, 5}, false)->marks.size(), 1U);
}

}  // namespace
}  // namespace relevo::test
