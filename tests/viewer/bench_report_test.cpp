// What `relevo bench` makes of frames: quantiles, ratios, comparisons at equal error, plots and files. Frames
// are made up here, so that every figure is known.

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/lod/scratch_scene.hpp"
#include "viewer/bench/bench_summary.hpp"
#include "viewer/bench/plot.hpp"
#include "viewer/bench/result_folder.hpp"

namespace relevo::viewer {
namespace {

namespace fs = std::filesystem;

BenchFrame frame(int run, std::uint64_t triangles, double refine_ms, std::optional<double> error = {}) {
    BenchFrame f;
    f.run = run;
    f.triangles = triangles;
    f.vertices = triangles / 2;
    f.draw_calls = 2;
    f.refine_ms = refine_ms;
    f.upload_ms = 1;
    f.draw_ms = 10;
    f.resident_mib = 100 + run;
    if (error) f.error = lod::MeasuredError{*error, *error / 4, *error / 2, 900, 100, 0};
    return f;
}

BenchRow row(BenchMethod method, bool morph, double tau, std::vector<BenchFrame> frames) {
    return {{method, morph, tau, false}, std::move(frames), 0};
}

TEST(BenchSummary, QuantilesAreValuesThatOccurred) {
    std::vector<double> hundred(100);
    std::iota(hundred.begin(), hundred.end(), 1.0);
    std::reverse(hundred.begin(), hundred.end());
    const Quantiles q = quantiles_of(hundred);
    EXPECT_EQ(q.median, 50);
    EXPECT_EQ(q.p95, 95);
    EXPECT_EQ(q.p99, 99);
    EXPECT_EQ(q.mean, 50.5);
    EXPECT_EQ(quantiles_of({7}).p99, 7);
    EXPECT_EQ(quantiles_of({3, 1, 2}).median, 2);
    EXPECT_EQ(quantiles_of({}).median, 0);
}

TEST(BenchSummary, KnowsThatNodesHaveMoreToAVertex) {
    BenchResult result;
    result.rows = {row(BenchMethod::lstr, true, 1, {frame(0, 100, 4, 0.5)})};
    EXPECT_EQ(summarize(result)[0].mesh_bytes_per_vertex, 21 + 12 * 2);
}

TEST(BenchSummary, AddsUpErrorsOverFrames) {
    BenchResult result;
    result.rows = {row(BenchMethod::soar_bounded, false, 1,
                       {frame(0, 100, 4, 0.5), frame(0, 200, 6, 0.8), frame(1, 300, 5)})};
    result.rows[0].frames[1].jump = lod::SurfaceJump{0.3, 0.1, 50};
    const auto rows = summarize(result);
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(rows[0].frames, 3u);
    EXPECT_EQ(rows[0].triangles.median, 200);
    EXPECT_EQ(rows[0].frame_ms.median, 16);
    EXPECT_EQ(rows[0].resident_mib, 101);
    EXPECT_EQ(rows[0].mesh_bytes_per_vertex, 16 + 12 * 2);
    ASSERT_TRUE(rows[0].error && rows[0].jump);
    EXPECT_EQ(rows[0].error->max_px, 0.8);
    EXPECT_EQ(rows[0].error->p99_px, 0.4);
    EXPECT_NEAR(rows[0].error->rms_px, std::sqrt((0.125 * 0.125 + 0.2 * 0.2) / 2), 1e-12);
    EXPECT_EQ(rows[0].error->frames, 2u);
    EXPECT_EQ(rows[0].jump->max_px, 0.3);
    EXPECT_FALSE(rows[0].refine_to_textbook) << "there is no textbook in it";
}

// Ratios are taken within a run: a machine that is twice as slow in one of them changes nothing.
TEST(BenchSummary, RatiosToTheTextbookAreWithinRuns) {
    BenchResult result;
    result.rows = {
        row(BenchMethod::soar_bounded, false, 1, {frame(0, 200, 4), frame(1, 200, 8), frame(2, 200, 5)}),
        row(BenchMethod::textbook, false, 1, {frame(0, 100, 2), frame(1, 100, 4), frame(2, 100, 2)}),
        row(BenchMethod::textbook, false, 2, {frame(0, 50, 1), frame(1, 50, 1), frame(2, 50, 1)})};
    const auto rows = summarize(result);
    ASSERT_TRUE(rows[0].refine_to_textbook && rows[0].speed_to_textbook);
    EXPECT_DOUBLE_EQ(rows[0].refine_to_textbook->median, 2);
    EXPECT_DOUBLE_EQ(rows[0].refine_to_textbook->least, 2);
    EXPECT_DOUBLE_EQ(rows[0].refine_to_textbook->most, 2.5);
    EXPECT_DOUBLE_EQ(rows[0].speed_to_textbook->median, 1);
    EXPECT_DOUBLE_EQ(rows[0].speed_to_textbook->least, 0.8);
}

TEST(BenchSummary, ComparesAtEqualError) {
    // Triangles = 1000 / error^2 without the morph, on any taus; with it 1500 / error^2.
    BenchResult result;
    for (const double tau : {0.5, 1.0, 2.0, 4.0}) {
        const double off = 0.7 * tau;
        const double on = 0.6 * tau;
        result.rows.push_back(row(BenchMethod::soar_bounded, false, tau,
                                  {frame(0, static_cast<std::uint64_t>(1e8 / (off * off)), 2, off)}));
        result.rows.push_back(row(BenchMethod::soar_bounded, true, tau,
                                  {frame(0, static_cast<std::uint64_t>(1.5e8 / (on * on)), 3, on)}));
    }
    const auto rows = summarize(result);
    const auto at = at_error(rows, BenchMethod::soar_bounded, false, 1);
    ASSERT_TRUE(at);
    EXPECT_NEAR(at->triangles, 1e8, 1e4);
    EXPECT_NEAR(at->refine_ms, 2, 1e-9);
    EXPECT_FALSE(at_error(rows, BenchMethod::soar_bounded, false, 0.3)) << "finer than what was measured";
    EXPECT_FALSE(at_error(rows, BenchMethod::soar_bounded, false, 3));
    EXPECT_FALSE(at_error(rows, BenchMethod::textbook, false, 1));
    const auto prices = morph_prices(rows);
    ASSERT_EQ(prices.size(), 4u);
    EXPECT_NEAR(prices[1].triangles, 1.5 * 0.7 * 0.7 / 0.36, 1e-4);
    EXPECT_NEAR(prices[1].refine_ms, 1.5, 1e-9);
    EXPECT_NEAR(prices[1].frame_ms, 14.0 / 13, 1e-9);
    ASSERT_TRUE(prices[1].triangles_at_equal_error);
    EXPECT_NEAR(*prices[1].triangles_at_equal_error, 1.5, 1e-4);
    EXPECT_FALSE(prices[0].triangles_at_equal_error) << "0.3 px is finer than any without the morph";
}

TEST(BenchOptions, SettingsAreAllThatWasAskedFor) {
    BenchOptions options;
    options.taus = {1, 2};
    EXPECT_EQ(bench_settings(options).size(), 4u + 4 + 4 + 2 + 1);
    options.morphs = {true};
    const auto morphing = bench_settings(options);
    EXPECT_EQ(morphing.size(), 2u + 2 + 2 + 2 + 1);
    EXPECT_TRUE(morphing[0].morph);
    EXPECT_FALSE(morphing[6].morph) << "the textbook has none";
    options.budget.frame_ms = 33;
    const auto with_budget = bench_settings(options);
    EXPECT_EQ(with_budget.size(), morphing.size() + 1);
    EXPECT_TRUE(with_budget.back().by_budget);
    for (const BenchMethod method : options.methods)
        EXPECT_EQ(*parse_bench_method(to_string(method)), method);
    EXPECT_FALSE(parse_bench_method("soar"));
}

TEST(Plot, TicksHoldAllValues) {
    for (const auto& [low, high] : {std::pair(0.0, 1.0), std::pair(3.0, 3.0), std::pair(-7.0, 1234.5),
                                    std::pair(0.0, 0.00012), std::pair(5.0, 6e6)}) {
        const auto ticks = plot_ticks(low, high, false);
        EXPECT_LE(ticks.front(), low);
        EXPECT_GE(ticks.back(), high - 1e-9 * std::abs(high));
        EXPECT_GE(ticks.size(), 2u);
        EXPECT_LE(ticks.size(), 12u) << low << " " << high;
    }
    for (const auto& [low, high] : {std::pair(0.25, 16.0), std::pair(1.0, 1.0), std::pair(1.0, 10.0),
                                    std::pair(3e-5, 2e7), std::pair(0.3, 0.4)}) {
        const auto ticks = plot_ticks(low, high, true);
        EXPECT_LE(ticks.front(), low * (1 + 1e-9));
        EXPECT_GT(ticks.front(), low / 3);
        EXPECT_GE(ticks.back(), high);
        EXPECT_LT(ticks.back(), high * 3);
        EXPECT_GE(ticks.size(), 2u);
    }
}

TEST(Plot, PointsLieInTheFrameAndTextIsText) {
    const PlotSeries series{
        "a < b & \"c\"", "#123456", true, true, {{1, 10}, {10, 1000}, {0, 5}, {3, std::nan("")}}, {}};
    const std::string svg = line_plot({"x", true}, {"y", true}, {series});
    EXPECT_NE(svg.find("a &lt; b &amp; &quot;c&quot;"), std::string::npos);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
    const std::size_t line = svg.find("points=\"");
    double x0 = 0;
    double y0 = 0;
    double x1 = 0;
    double y1 = 0;
    ASSERT_EQ(std::sscanf(svg.c_str() + line, "points=\"%lf,%lf %lf,%lf \"", &x0, &y0, &x1, &y1), 4)
        << "two points, not four";
    EXPECT_LT(x0, x1);
    EXPECT_GT(y0, y1) << "up is more";
    const std::string empty = line_plot({"x", true}, {"y", false}, {});
    EXPECT_NE(empty.find("</svg>"), std::string::npos);
    EXPECT_NE(bar_plot("MiB", {{"soar", "red", 3, "3 MiB"}, {"none", "red", 0, "0"}}).find("3 MiB"),
              std::string::npos);
}

TEST(ResultFolder, AppearsWholeAndKeepsWhatIsNotItsOwn) {
    const test::SceneFolder folder;
    const fs::path target = folder / "out";
    EXPECT_TRUE(check_result_folder(target, false));
    ASSERT_TRUE(write_result_folder(target, {{"a", "1"}, {"b", "2"}}));
    EXPECT_EQ(test::contents(target / "a"), "1");
    EXPECT_FALSE(check_result_folder(target, false));
    EXPECT_TRUE(check_result_folder(target, true));
    test::replace(target / "mine", "stays");
    ASSERT_TRUE(write_result_folder(target.string() + "/", {{"a", "3"}}));
    EXPECT_EQ(test::contents(target / "a"), "3");
    EXPECT_EQ(test::contents(target / "b"), "2");
    EXPECT_EQ(test::contents(target / "mine"), "stays");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1)
        << "nothing unfinished is left";
    fs::create_directory(folder / "empty");
    EXPECT_TRUE(check_result_folder(folder / "empty", false));
    EXPECT_FALSE(check_result_folder(folder / "no" / "out", false));
    EXPECT_FALSE(check_result_folder(target / "mine", true)) << "a file";
    EXPECT_FALSE(write_result_folder(folder / "no" / "out", {{"a", "1"}}));
}

}  // namespace
}  // namespace relevo::viewer
