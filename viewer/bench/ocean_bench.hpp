#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "geo/position.hpp"
#include "geo/result.hpp"
#include "lod/scene/scene.hpp"
#include "lod/tiles/tile_store.hpp"
#include "viewer/bench/ocean_row.hpp"
#include "viewer/eye_height.hpp"

namespace relevo::viewer {

struct OceanBenchOptions {
    int width = 1280;
    int height = 720;
    OceanSettings look;                ///< waves; automatic: all three meshes; off: nothing is measured
    std::optional<geo::LatLon> place;  ///< none: open_sea()
    std::vector<double> errors_px{1, 4};
    std::vector<double> eyes_m{2, 50, 2000};
    std::vector<OceanGaze> gazes{OceanGaze::slanted, OceanGaze::horizon};
    int frames = 3;  ///< that are timed of each row
    lod::TileStoreOptions tiles;
};
/// All that the command knows, instead of the usual ones.
void take_all_rows(OceanBenchOptions& options);

struct OceanBench {
    std::optional<geo::LatLon> place;  ///< where it was measured
    std::string left_out;              ///< why it was not, where there is sea
    std::vector<OceanRow> rows;
};
/// Nothing of a scene without sea. \param progress  called with the part done, 0 to 1
Result<OceanBench> run_ocean_bench(const lod::Scene& scene, const EyeHeight& heights,
                                   const OceanBenchOptions& options,
                                   const std::function<void(double)>& progress);

/// A list of rows. Errors that could not be measured are null.
nlohmann::json ocean_json(const OceanBench& ocean);
/// One line a row, after a line of names.
std::string ocean_csv(const OceanBench& ocean);
/// A part of the page: a plot and a table; empty where nothing was measured.
std::string ocean_page_part(const OceanBench& ocean);
/// A table for a terminal; likewise.
std::string ocean_text(const OceanBench& ocean);

}  // namespace relevo::viewer
