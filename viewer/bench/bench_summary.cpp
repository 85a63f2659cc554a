#include "viewer/bench/bench_summary.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "viewer/ground/node_buffers.hpp"

namespace relevo::viewer {

namespace {

template <class Value>
std::vector<double> values_of(const BenchRow& row, Value&& value, std::optional<int> run = {}) {
    std::vector<double> values;
    for (const BenchFrame& frame : row.frames) {
        if (!run || frame.run == *run) values.push_back(static_cast<double>(value(frame)));
    }
    return values;
}

double median_of(std::vector<double> values) {
    return quantiles_of(std::move(values)).median;
}

std::optional<BenchSummary::Error> error_of(const BenchRow& row) {
    BenchSummary::Error error;
    double squares = 0;
    double samples = 0;
    for (const BenchFrame& frame : row.frames) {
        if (!frame.error) continue;
        const auto count = static_cast<double>(frame.error->posts + frame.error->pixels);
        squares += frame.error->rms_px * frame.error->rms_px * count;
        samples += count;
        error.max_px = std::max(error.max_px, frame.error->max_px);
        error.p99_px = std::max(error.p99_px, frame.error->p99_px);
        error.uncovered_posts += frame.error->uncovered_posts;
        ++error.frames;
    }
    if (error.frames == 0) return std::nullopt;
    error.rms_px = samples > 0 ? std::sqrt(squares / samples) : 0;
    return error;
}

std::optional<BenchSummary::Jump> jump_of(const BenchRow& row) {
    BenchSummary::Jump jump;
    std::vector<double> largest;
    for (const BenchFrame& frame : row.frames) {
        if (!frame.jump) continue;
        largest.push_back(frame.jump->max_px);
        jump.p99_px = std::max(jump.p99_px, frame.jump->p99_px);
    }
    if (largest.empty()) return std::nullopt;
    jump.pairs = largest.size();
    jump.max_px = *std::max_element(largest.begin(), largest.end());
    jump.median_of_max_px = median_of(largest);
    return jump;
}

BenchSummary summary_of(const BenchRow& row) {
    BenchSummary summary;
    summary.setting = row.setting;
    summary.frames = row.frames.size();
    const auto quantiles = [&](auto value) { return quantiles_of(values_of(row, value)); };
    summary.triangles = quantiles([](const BenchFrame& f) { return f.triangles; });
    summary.vertices = quantiles([](const BenchFrame& f) { return f.vertices; });
    summary.draw_calls = quantiles([](const BenchFrame& f) { return f.draw_calls; });
    summary.refine_ms = quantiles([](const BenchFrame& f) { return f.refine_ms; });
    summary.upload_ms = quantiles([](const BenchFrame& f) { return f.upload_ms; });
    summary.draw_ms = quantiles([](const BenchFrame& f) { return f.draw_ms; });
    summary.frame_ms = quantiles([](const BenchFrame& f) { return f.frame_ms(); });
    summary.pending_tiles = quantiles([](const BenchFrame& f) { return f.pending_tiles; });
    if (summary.vertices.mean > 0) {
        const std::size_t vertex_bytes =
            row.setting.method == BenchMethod::lstr ? NodeBuffers::kVertexBytes : sizeof(lod::MeshVertex);
        summary.mesh_bytes_per_vertex = static_cast<double>(vertex_bytes) + 3 * sizeof(std::uint32_t) *
                                                                                summary.triangles.mean /
                                                                                summary.vertices.mean;
    }
    for (const BenchFrame& frame : row.frames) {
        summary.resident_mib = std::max(summary.resident_mib, frame.resident_mib);
        summary.tiles_mib = std::max(summary.tiles_mib, frame.tiles_mib);
    }
    summary.error = error_of(row);
    summary.jump = jump_of(row);
    if (row.setting.by_budget) {
        const auto taus = values_of(row, [](const BenchFrame& f) { return f.tau_px; });
        const auto [least, most] = std::minmax_element(taus.begin(), taus.end());
        summary.budget = {median_of(taus), *least, *most,
                          static_cast<double>(row.frames_within_budget) / static_cast<double>(taus.size())};
    }
    return summary;
}

Ratio ratio_of(std::vector<double> ratios) {
    const auto [least, most] = std::minmax_element(ratios.begin(), ratios.end());
    return {median_of(ratios), *least, *most};
}

void compare_with_textbook(const BenchResult& result, std::vector<BenchSummary>& summaries) {
    const auto refine = [](const BenchFrame& f) { return f.refine_ms; };
    const auto speed = [](const BenchFrame& f) {
        return static_cast<double>(f.triangles) / std::max(f.refine_ms, 1e-6);
    };
    for (std::size_t i = 0; i < summaries.size(); ++i) {
        const BenchRow& row = result.rows[i];
        if (row.setting.by_budget || !has_morph(row.setting.method)) continue;
        const auto yardstick = std::find_if(result.rows.begin(), result.rows.end(), [&](const BenchRow& r) {
            return r.setting.method == BenchMethod::textbook && r.setting.tau_px == row.setting.tau_px;
        });
        if (yardstick == result.rows.end()) continue;
        std::vector<double> times;
        std::vector<double> speeds;
        for (int run = 0; run <= row.frames.back().run; ++run) {
            const auto median_in_run = [&](const BenchRow& r, auto value) {
                return std::max(median_of(values_of(r, value, run)), 1e-9);
            };
            times.push_back(median_in_run(row, refine) / median_in_run(*yardstick, refine));
            speeds.push_back(median_in_run(row, speed) / median_in_run(*yardstick, speed));
        }
        summaries[i].refine_to_textbook = ratio_of(std::move(times));
        summaries[i].speed_to_textbook = ratio_of(std::move(speeds));
    }
}

}  // namespace

Quantiles quantiles_of(std::vector<double> values) {
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    const auto at = [&](double part) {
        const auto rank = static_cast<std::size_t>(std::ceil(part * static_cast<double>(values.size())));
        return values[std::max<std::size_t>(rank, 1) - 1];
    };
    const double sum = std::accumulate(values.begin(), values.end(), 0.0);
    return {at(0.5), at(0.95), at(0.99), sum / static_cast<double>(values.size())};
}

std::vector<BenchSummary> summarize(const BenchResult& result) {
    std::vector<BenchSummary> summaries;
    for (const BenchRow& row : result.rows) summaries.push_back(summary_of(row));
    compare_with_textbook(result, summaries);
    return summaries;
}

std::optional<AtError> at_error(std::span<const BenchSummary> rows, BenchMethod method, bool morph,
                                double max_error_px) {
    std::vector<const BenchSummary*> series;
    for (const BenchSummary& row : rows) {
        if (row.setting.method == method && row.setting.morph == morph && !row.setting.by_budget &&
            row.error && row.error->max_px > 0) {
            series.push_back(&row);
        }
    }
    std::sort(series.begin(), series.end(), [](const BenchSummary* a, const BenchSummary* b) {
        return a->error->max_px < b->error->max_px;
    });
    for (std::size_t i = 0; i + 1 < series.size(); ++i) {
        const BenchSummary& a = *series[i];
        const BenchSummary& b = *series[i + 1];
        if (!(a.error->max_px <= max_error_px && max_error_px <= b.error->max_px)) continue;
        const double width = std::log(b.error->max_px / a.error->max_px);
        const double part = width > 0 ? std::log(max_error_px / a.error->max_px) / width : 0;
        const auto between = [&](double from, double to) {
            return std::exp(std::lerp(std::log(std::max(from, 1e-9)), std::log(std::max(to, 1e-9)), part));
        };
        return AtError{between(a.triangles.median, b.triangles.median),
                       between(a.refine_ms.median, b.refine_ms.median),
                       between(a.frame_ms.median, b.frame_ms.median)};
    }
    return std::nullopt;
}

std::vector<MorphPrice> morph_prices(std::span<const BenchSummary> rows) {
    std::vector<MorphPrice> prices;
    for (const BenchSummary& on : rows) {
        if (!on.setting.morph || on.setting.by_budget) continue;
        const auto off = std::find_if(rows.begin(), rows.end(), [&](const BenchSummary& row) {
            return row.setting == BenchSetting{on.setting.method, false, on.setting.tau_px, false};
        });
        if (off == rows.end()) continue;
        const auto ratio = [](double a, double b) { return b > 0 ? a / b : 1; };
        MorphPrice price{on.setting.method,
                         *on.setting.tau_px,
                         ratio(on.triangles.median, off->triangles.median),
                         ratio(on.refine_ms.median, off->refine_ms.median),
                         ratio(on.frame_ms.median, off->frame_ms.median),
                         {},
                         {}};
        if (on.error) {
            if (const auto equal = at_error(rows, on.setting.method, false, on.error->max_px)) {
                price.triangles_at_equal_error = ratio(on.triangles.median, equal->triangles);
                price.frame_ms_at_equal_error = ratio(on.frame_ms.median, equal->frame_ms);
            }
        }
        prices.push_back(price);
    }
    return prices;
}

}  // namespace relevo::viewer
