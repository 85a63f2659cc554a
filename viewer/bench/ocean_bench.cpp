#include "viewer/bench/ocean_bench.hpp"

#include "viewer/bench/ocean_stage.hpp"

namespace relevo::viewer {

void take_all_rows(OceanBenchOptions& options) {
    options.errors_px = {0.5, 1, 2, 4};
    options.eyes_m = {2, 50, 2000, 50000};
    options.gazes.assign(kOceanGazes.begin(), kOceanGazes.end());
}

Result<OceanBench> run_ocean_bench(const lod::Scene& scene, const EyeHeight& heights,
                                   const OceanBenchOptions& options,
                                   const std::function<void(double)>& progress) {
    OceanBench bench;
    if (options.look.kind == OceanKind::off || !ground_facts(scene.info()).has_sea) return bench;
    auto tiles = options.tiles;
    tiles.fade_s = 0;
    const auto terrain = lod::Terrain::open(scene, lod::ErrorMetric::bounded, tiles);
    if (!terrain) return terrain.error();
    bench.place = options.place;
    if (!bench.place) {
        const auto open = open_sea(*terrain->pyramid(), -deep_water_m(options.look));
        if (!open) return open.error();
        bench.place = *open;
        if (!bench.place) {
            bench.left_out = "no open sea was found; --ocean-at says where to measure";
            return bench;
        }
    }
    const auto stage = OceanStage::create(scene, *terrain, heights, options.width, options.height);
    if (!stage) return stage.error();

    std::vector<OceanKind> kinds(kOceanKinds.begin(), kOceanKinds.end());
    if (options.look.kind != OceanKind::automatic) kinds = {options.look.kind};
    const std::size_t all =
        kinds.size() * options.errors_px.size() * options.eyes_m.size() * options.gazes.size();
    for (const double eye_m : options.eyes_m) {
        for (const OceanGaze gaze : options.gazes) {
            for (const OceanKind kind : kinds) {
                for (const double error_px : options.errors_px) {
                    OceanSettings settings = options.look;
                    settings.kind = kind;
                    settings.error_px = error_px;
                    const OceanSight sight{.place = *bench.place, .eye_m = eye_m, .gaze = gaze};
                    const auto row = (*stage)->measure(sight, settings, options.frames);
                    if (!row) return row.error();
                    bench.rows.push_back(*row);
                    progress(static_cast<double>(bench.rows.size()) / static_cast<double>(all));
                }
            }
        }
    }
    return bench;
}

}  // namespace relevo::viewer
