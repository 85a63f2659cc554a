#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "geo/result.hpp"
#include "lod/oracle.hpp"
#include "lod/scene/scene.hpp"
#include "lod/surface_jump.hpp"
#include "viewer/bench/bench_options.hpp"
#include "viewer/bench/machine.hpp"
#include "viewer/bench/ocean_bench.hpp"
#include "viewer/eye_height.hpp"
#include "viewer/flight/flight_path.hpp"

namespace relevo::viewer {

/// One frame of one row.
struct BenchFrame {
    int run = 0;
    double time_s = 0;  ///< along the flight
    double tau_px = 0;  ///< that it was drawn with; 0 of `full`
    std::uint64_t triangles = 0;
    std::uint64_t vertices = 0;
    int draw_calls = 0;
    double refine_ms = 0;             ///< making the mesh; of the textbook its own refinement alone
    double upload_ms = 0;             ///< handing it to OpenGL
    double draw_ms = 0;               ///< to the last pixel
    double resident_mib = 0;          ///< of the process
    double tiles_mib = 0;             ///< of that the terrain's tiles
    std::uint64_t pending_tiles = 0;  ///< wanted and not there; only where a frame does not wait for them
    std::optional<lod::MeasuredError> error;  ///< only where it was measured and something is in view
    std::optional<lod::SurfaceJump> jump;     ///< from this frame to one kJumpStepS later

    double frame_ms() const { return refine_ms + upload_ms + draw_ms; }
};

/// Between the two frames of a jump: what a screen of 30 Hz shows.
inline constexpr double kJumpStepS = 1.0 / 30;

struct BenchRow {
    BenchSetting setting;
    std::vector<BenchFrame> frames;  ///< of all runs, in order
    std::uint64_t frames_within_budget = 0;
};

/// A method that could not be run, and why.
struct BenchSkipped {
    BenchMethod method;
    std::string reason;
};

struct BenchResult {
    std::vector<BenchRow> rows;
    std::vector<BenchSkipped> skipped;
    OceanBench ocean;  ///< measured by itself (run_ocean_bench)
    Machine machine;
    double seconds = 0;  ///< that all of it took
};

/// Flies a path over a scene off-screen with every method and setting, and measures each frame. \param
/// progress  called with the part done, 0 to 1
Result<BenchResult> run_bench(const lod::Scene& scene, const EyeHeight& heights, const FlightPath& flight,
                              const BenchOptions& options, const std::function<void(double)>& progress);

}  // namespace relevo::viewer
