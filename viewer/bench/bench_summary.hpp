#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "viewer/bench/bench_run.hpp"

namespace relevo::viewer {

struct Quantiles {
    double median = 0;
    double p95 = 0;
    double p99 = 0;
    double mean = 0;
};
/// Quantiles are values that occurred: the smallest that the part does not exceed. All 0 for no values.
Quantiles quantiles_of(std::vector<double> values);

/// A ratio of medians, one a run: the median of them, the least and the most.
struct Ratio {
    double median = 0;
    double least = 0;
    double most = 0;
};

/// What a row's frames come to.
struct BenchSummary {
    BenchSetting setting;
    std::uint64_t frames = 0;
    Quantiles triangles, vertices, draw_calls, refine_ms, upload_ms, draw_ms, frame_ms, pending_tiles;
    double mesh_bytes_per_vertex = 0;  ///< vertex buffer and index buffer
    double resident_mib = 0;           ///< the most that the process had in RAM
    double tiles_mib = 0;              ///< the most that tiles took

    struct Error {
        double max_px = 0;
        double rms_px = 0;  ///< over all posts and pixels of all frames measured
        double p99_px = 0;  ///< the largest of the frames'
        std::uint64_t frames = 0;
        std::uint64_t uncovered_posts = 0;
    };
    std::optional<Error> error;

    struct Jump {
        double max_px = 0;
        double p99_px = 0;  ///< the largest of the frames'
        double median_of_max_px = 0;
        std::uint64_t pairs = 0;
    };
    std::optional<Jump> jump;

    struct Budget {
        double tau_median_px = 0;
        double tau_least_px = 0;
        double tau_most_px = 0;
        double frames_within = 0;  ///< part, 0 to 1
    };
    std::optional<Budget> budget;

    /// Median time of refinement, and triangles a second of refinement, over the textbook's at the same tau;
    /// nothing without it.
    std::optional<Ratio> refine_to_textbook;
    std::optional<Ratio> speed_to_textbook;
};
std::vector<BenchSummary> summarize(const BenchResult& result);

/// What the morph costs at a tau.
struct MorphPrice {
    BenchMethod method;
    double tau_px = 0;
    // With the morph over without it, medians: at the same tau ...
    double triangles = 0;
    double refine_ms = 0;
    double frame_ms = 0;
    /// ... and at the same largest measured error, the row without it interpolated between taus. Nothing
    /// where no two taus have this error between them.
    std::optional<double> triangles_at_equal_error;
    std::optional<double> frame_ms_at_equal_error;
};
std::vector<MorphPrice> morph_prices(std::span<const BenchSummary> rows);

/// What a series has at a largest measured error, between its taus: linear in the logarithms. Nothing beyond
/// its ends.
struct AtError {
    double triangles = 0;
    double refine_ms = 0;
    double frame_ms = 0;
};
std::optional<AtError> at_error(std::span<const BenchSummary> rows, BenchMethod method, bool morph,
                                double max_error_px);

}  // namespace relevo::viewer
