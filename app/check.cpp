#include <algorithm>
#include <filesystem>
#include <iostream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/command.hpp"
#include "lod/lstr/chunk_check.hpp"
#include "lod/lstr/chunk_file.hpp"
#include "lod/pyramid/scene_pyramid.hpp"
#include "lod/pyramid/whole_grid.hpp"
#include "lod/scene_check.hpp"

namespace relevo::app {

namespace {

using Json = nlohmann::ordered_json;

struct CheckOptions : Common {
    std::filesystem::path scene;
    int views = 20;
    std::uint64_t seed = 1;
    int width = 640;
    int height = 360;
    bool files_only = false;
};

Json to_json(const lod::ViewsCheck& check) {
    return {{"metric", check.metric == lod::ErrorMetric::bounded ? "bounded" : "incremental"},
            {"morph", check.morph},
            {"tau_px", check.tau_px},
            {"views", check.views},
            {"views_with_ground", check.views_with_ground},
            {"triangles_mean", check.triangles_mean},
            {"max_error_px", check.max_px},
            {"rms_error_px", check.rms_px},
            {"uncovered_posts", check.uncovered_posts},
            {"t_vertices", check.t_vertices},
            {"torn_posts", check.torn_posts}};
}

Result<void> damaged(const CheckOptions& options, std::string what) {
    return Error{ErrorKind::damaged, fmt::format("{}: {}. Import it again, or restore it from a copy.",
                                                 options.scene.string(), what)};
}

Result<void> check_files(const lod::Scene& scene, const CheckOptions& options, Json& report) {
    const std::vector<std::string> faults = scene.verify();
    const lod::SceneInfo& info = scene.info();
    std::size_t files = info.heights.size() + info.marks.size() + 1;
    for (const lod::LevelInfo& level : info.levels) files += level.heights.size() + level.vertices.size();
    report["files"] = files;
    report["damaged_files"] = faults;
    if (!options.json) {
        fmt::print("files: {}, damaged: {}\n", report["files"].dump(), faults.size());
        for (const std::string& fault : faults) fmt::print("  {}\n", fault);
    }
    if (!faults.empty())
        return damaged(options, fmt::format("{} damaged files, first {}", faults.size(), faults[0]));
    return {};
}

Result<void> check_nesting(const lod::Scene& scene, const CheckOptions& options, Json& report) {
    const auto pyramid = lod::ScenePyramid::open(scene);
    if (!pyramid) return pyramid.error();
    auto bounded = lod::gather_codes(*pyramid, lod::ErrorMetric::bounded);
    if (!bounded) return bounded.error();
    auto incremental = lod::gather_codes(*pyramid, lod::ErrorMetric::incremental);
    if (!incremental) return incremental.error();
    const std::uint64_t faults = lod::count_nesting_faults(
        scene.info().frame,
        {std::move(bounded->error), std::move(incremental->error), std::move(incremental->radius)});
    report["nesting_faults"] = faults;
    if (!options.json) fmt::print("vertices with an error or sphere smaller than a child's: {}\n", faults);
    if (faults > 0) return damaged(options, fmt::format("{} vertices are not nested", faults));
    return {};
}

/// Draws and judges views at several taus. The bounded metric must keep its promise; the incremental one
/// makes none and is shown for comparison.
Result<void> check_views(const lod::Scene& scene, const CheckOptions& options, Json& report) {
    if (!options.json) {
        fmt::print("{:>12} {:>6} {:>7} {:>10} {:>10} {:>10} {:>6} {:>6}\n", "metric", "morph", "tau px",
                   "triangles", "max px", "rms px", "holes", "cracks");
    }
    report["results"] = Json::array();
    bool kept = true;
    for (const auto metric : {lod::ErrorMetric::bounded, lod::ErrorMetric::incremental}) {
        if (metric == lod::ErrorMetric::bounded && !scene.info().bounded_errors) continue;
        const auto terrain = lod::Terrain::open(scene, metric, {.fade_s = 0});
        if (!terrain) return terrain.error();
        const auto cameras =
            lod::sample_views(*terrain, options.views, options.seed, options.width, options.height);
        const auto progress =
            progress_bar(options, metric == lod::ErrorMetric::bounded ? "bounded" : "incremental");
        double done = 0;
        for (const double tau : {0.5, 1.0, 2.0, 4.0}) {
            for (const bool morph : {false, true}) {
                const auto checked = lod::check_views(*terrain, metric, cameras, tau, morph);
                if (!checked) return checked.error();
                const lod::ViewsCheck& check = *checked;
                report["results"].push_back(to_json(check));
                if (!options.json) {
                    fmt::print("{:>12} {:>6} {:>7} {:>10.0f} {:>10.3f} {:>10.3f} {:>6} {:>6}\n",
                               metric == lod::ErrorMetric::bounded ? "bounded" : "incremental",
                               morph ? "on" : "off", tau, check.triangles_mean, check.max_px, check.rms_px,
                               check.uncovered_posts, check.t_vertices + check.torn_posts);
                }
                const bool whole =
                    check.uncovered_posts == 0 && check.t_vertices == 0 && check.torn_posts == 0;
                kept = kept && whole && (metric == lod::ErrorMetric::incremental || check.max_px <= tau);
                progress(done += 0.125);
            }
        }
    }
    if (!kept) return damaged(options, "a view is drawn with a larger error than tau, a hole or a crack");
    return {};
}

/// The quadtree of `--lod lstr`, where there is one.
Result<void> check_quadtree(const lod::Scene& scene, const CheckOptions& options, Json& report) {
    if (!lod::ChunkFile::is_there(scene)) return {};
    const auto terrain = lod::Terrain::open(scene, lod::ErrorMetric::bounded, {});
    if (!terrain) return terrain.error();
    const auto chunks = lod::ChunkFile::open(scene, *terrain);
    if (!chunks) return chunks.error();
    const std::vector<std::string> faults = lod::check_chunks(*chunks, progress_bar(options, "chunks"));
    report["chunks"] = chunks->index().size();
    report["chunk_faults"] = faults;
    if (!options.json) {
        fmt::print("nodes of the quadtree: {}, faults: {}\n", chunks->index().size(), faults.size());
        for (const std::string& fault : faults) fmt::print("  {}\n", fault);
    }
    if (!faults.empty()) {
        return Error{ErrorKind::damaged,
                     fmt::format("{}; delete the file, and it is made anew", faults.front())};
    }
    return {};
}

Result<void> check(const CheckOptions& options) {
    const auto scene = lod::Scene::open(options.scene);
    if (!scene) return scene.error();
    Json report = {{"scene", options.scene.filename().string()}};
    Result<void> outcome = check_files(*scene, options, report);
    if (outcome) outcome = check_quadtree(*scene, options, report);
    if (outcome && !options.files_only) outcome = check_nesting(*scene, options, report);
    if (outcome && !options.files_only && scene->info().valid_posts > 0) {
        outcome = check_views(*scene, options, report);
    }
    report["ok"] = static_cast<bool>(outcome);
    if (options.json) std::cout << report.dump(2) << '\n';
    return outcome;
}

}  // namespace

void add_check(CLI::App& program, Action& action) {
    auto options = std::make_shared<CheckOptions>();
    CLI::App* command = program.add_subcommand(
        "check", "Verify a scene: checksums, nesting, and the measured error of meshes on a set of views");
    command->add_option("SCENE", options->scene, "The scene's folder")->required();
    command->add_option("--views", options->views, "Views to draw and measure")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    command->add_option("--seed", options->seed, "Other views")->capture_default_str();
    command->add_flag("--files-only", options->files_only, "Checksums alone");
    command->footer("Example: relevo check fuji.relevo --views 50");
    add_common(*command, *options);
    command->callback([options, &action] { action = [options] { return check(*options); }; });
}

}  // namespace relevo::app
