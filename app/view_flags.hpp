#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "geo/result.hpp"
#include "lod/cache_sizes.hpp"
#include "lod/scene/scene.hpp"
#include "lod/terrain.hpp"
#include "viewer/eye_height.hpp"
#include "viewer/frame_budget.hpp"
#include "viewer/marks/marks.hpp"
#include "viewer/view_state.hpp"

namespace relevo::app {

struct PictureSize {
    int width = 1280;
    int height = 720;
};

/// The flags that say what is seen: shared by the commands that draw.
struct ViewFlags {
    std::optional<std::string> at, eye, size, method, metric, morph, layer, shading, sun, haze, marks, ocean,
        wind, waves, ground_map, contours, graticule, ramp;
    std::vector<std::string> imagery, vectors;
    std::optional<double> heading, pitch, roll, fov, tau, exaggeration, time;
    bool wireframe = false;
    std::optional<int> samples;
    std::optional<std::uint64_t> memory;  ///< nothing: what fits the machine
};
/// Those of them that say how it is drawn, and not from where or by which method.
void add_picture_flags(CLI::App& command, ViewFlags& flags);
void add_view_flags(CLI::App& command, ViewFlags& flags);

/// How tiles are kept. The environment variable RELEVO_READ_DELAY_MS delays each read of them, to try how a
/// slow disk looks.
/// \param fade_s  in which what arrives comes in
Result<lod::TileStoreOptions> tile_options(const lod::CacheSizes& sizes, double fade_s);

/// --budget and --max-triangles: what a frame may cost.
struct BudgetFlags {
    std::optional<double> budget_ms;
    std::optional<std::uint64_t> max_triangles;
};
void add_budget_flags(CLI::App& command, BudgetFlags& flags);
void add_max_triangles_flag(CLI::App& command, BudgetFlags& flags);
Result<viewer::BudgetLimits> read_budget(const BudgetFlags& flags);

/// What the flags say: `base`, changed by --at, changed by the other flags. Values out of range are usage
/// errors.
Result<viewer::ViewState> read_view(const ViewFlags& flags, const viewer::ViewState& base);

/// Where neither --at nor --eye says where to look from, looks over the whole scene.
void place_view(viewer::ViewState& view, const ViewFlags& flags, const lod::Scene& scene,
                const lod::Terrain& terrain, const viewer::EyeHeight& heights, PictureSize size);

Result<PictureSize> read_size(const ViewFlags& flags, PictureSize base);

/// --marks. \param size  of the picture; in smaller ones than marks need they are refused
Result<viewer::Marks> read_marks(const ViewFlags& flags, PictureSize size);

/// 1, 4 or 8.
Result<int> read_samples(const ViewFlags& flags, int base);

}  // namespace relevo::app
