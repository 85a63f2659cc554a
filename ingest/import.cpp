#include "ingest/import.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <gdal_priv.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "ingest/import_passes.hpp"
#include "ingest/job.hpp"
#include "ingest/memory_budget.hpp"
#include "ingest/post_passes.hpp"
#include "ingest/refusal.hpp"
#include "ingest/suspicions.hpp"
#include "ingest/vertical_datum.hpp"
#include "lod/scene/parallel_blocks.hpp"
#include "lod/scene/scene.hpp"
#include "lod/scene/scene_writer.hpp"
#include "lod/scene/sha256.hpp"
#include "lod/undulation_grid.hpp"

namespace relevo::ingest {
namespace {

constexpr std::uint64_t kDiskOfMetrics = 1;  // bytes a post, rounded up (docs/performance.md)

int threads() {
    return tbb::this_task_arena::max_concurrency();
}

ImportPlan plan_of(const Mosaic& mosaic, const ImportOptions& options) {
    ImportPlan plan;
    plan.frame = mosaic.frame();
    plan.posts = static_cast<std::uint64_t>(plan.frame.columns) * static_cast<std::uint64_t>(plan.frame.rows);
    const auto side = static_cast<std::uint64_t>(plan.frame.padded_side());
    plan.padded_posts = side * side;
    const std::uint64_t height_bytes = mosaic.fits_int16() ? 2 : 4;
    plan.bytes_estimate = plan.posts * (height_bytes + kDiskOfMetrics);
    plan.memory_bytes =
        divide_memory(options.memory_bytes, plan.frame, mosaic.memory_bytes(), threads()).least;
    plan.resampling = mosaic.resampling_method();
    plan.vertical = mosaic.vertical();
    plan.sources = mosaic.sources();
    plan.notes = mosaic.notes();
    if (plan.resampling == "none" && options.mosaic.resampling)
        plan.notes.emplace_back("its own posts are kept: --resampling has nothing to do");
    for (const auto& source : plan.sources) {
        if (!source.operation_note.empty()) plan.notes.push_back(source.operation_note);
    }
    const auto suspected = suspicions_about(options.mosaic.sources);
    plan.notes.insert(plan.notes.end(), suspected.begin(), suspected.end());
    return plan;
}

std::string inputs_named(const ImportPlan& plan) {
    return plan.sources.size() == 1 ? plan.sources[0].name
                                    : fmt::format("the {} sources", plan.sources.size());
}

Result<void> check_size(const ImportPlan& plan, const ImportOptions& options) {
    if (plan.padded_posts > std::min(options.max_posts, ImportOptions::kMostPosts))
        return refusal(
            inputs_named(plan),
            fmt::format("the grid of {} x {} posts is padded to {} posts; at most {} are allowed",
                        plan.frame.columns, plan.frame.rows, plan.padded_posts,
                        std::min(options.max_posts, ImportOptions::kMostPosts)),
            options.max_posts < ImportOptions::kMostPosts
                ? "Take a part with --crop, make it coarser with --resolution, or raise --max-posts"
                : "Take a part with --crop, or make it coarser with --resolution");
    if (plan.memory_bytes > options.memory_bytes)
        return Error{ErrorKind::usage,
                     fmt::format("an import of {} x {} posts needs at least {} MiB of memory: raise --memory",
                                 plan.frame.columns, plan.frame.rows, (plan.memory_bytes >> 20) + 1)};
    return {};
}

/// Heights outside of what the earth has: most often a void that the file does not declare, or another unit.
void note_strange_heights(const lod::SceneInfo& info, std::vector<std::string>& notes) {
    constexpr double kLowest = -11100;  // the Challenger Deep is at -10 935 m
    constexpr double kHighest = 9000;
    if (info.height_min_m >= kLowest && info.height_max_m <= kHighest) return;
    notes.push_back(
        fmt::format("heights run from {:.6g} to {:.6g} m, which the earth has not: voids may be undeclared "
                    "(--nodata) or the unit another (--height-scale)",
                    info.height_min_m, info.height_max_m));
}

/// The geoid under the meshes: of the scene's datum, or EGM96 where that has none here, which is then said.
Result<std::optional<geo::Geoid>> geoid_under(const Mosaic& mosaic, const ImportOptions& options,
                                              lod::VerticalReference& vertical,
                                              std::vector<std::string>& notes) {
    if (mosaic.vertical().datum == lod::VerticalDatum::other) {
        auto own = geoid_of(mosaic.vertical(), options.mosaic.geoid);
        vertical.geoid_known = own && own->has_value();
        if (vertical.geoid_known) return own;
        notes.push_back(fmt::format("pictures put {} on EGM96; h and N stay unknown ({})", vertical.name,
                                    own ? "it has no geoid" : own.error().message));
    }
    if (mosaic.vertical().datum == lod::VerticalDatum::ellipsoid) return std::optional<geo::Geoid>{};
    auto egm96 = geo::Geoid::egm96();
    if (!egm96) return egm96.error();
    return std::optional(*std::move(egm96));
}

/// What the scene keeps of it: nodes around the padded grid.
geo::GeoidNodes nodes_under(const geo::Geoid& geoid, const geo::GridFrame& frame) {
    geo::GridFrame padded = frame;
    padded.columns = padded.rows = frame.padded_side();
    return geoid.nodes_around(padded.extent());
}

/// Writes the scene's geoid, and makes of what was written the undulations of its posts: a reader's are the
/// same.
Result<lod::UndulationGrid> write_geoid(const Mosaic& mosaic, const ImportOptions& options,
                                        lod::SceneWriter& writer, lod::VerticalReference& vertical,
                                        std::vector<std::string>& notes) {
    const auto geoid = geoid_under(mosaic, options, vertical, notes);
    if (!geoid) return geoid.error();
    if (!geoid->has_value()) return lod::UndulationGrid{};
    const geo::GeoidNodes nodes = nodes_under(**geoid, mosaic.frame());
    auto kept = geo::Geoid::from_nodes(nodes, "the scene's geoid");
    if (!kept) return kept.error();
    if (auto done = writer.write_geoid(nodes); !done) return done.error();
    return lod::UndulationGrid{std::make_shared<const geo::Geoid>(*std::move(kept)), mosaic.frame()};
}

/// Heights and checksums are of the same files only if none of these was changed meanwhile.
Result<void> check_unchanged(const std::vector<FileState>& before, const std::vector<FileState>& now) {
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (before[i] != now.at(i))
            return refusal(before[i].path.filename().string(),
                           "it was changed, or it went away, while it was read", "Import it again");
    }
    return {};
}

Result<void> add_checksums(const Mosaic& mosaic, lod::SceneInfo& info) {
    const auto files = mosaic.files();
    return lod::for_each_block(static_cast<int>(files.size()), [&](int i) -> Result<void> {
        const auto& file = files[static_cast<std::size_t>(i)];
        if (file.empty()) return {};
        auto checksum = lod::sha256_of_file(file);
        if (!checksum) return checksum.error();
        info.sources[static_cast<std::size_t>(i)].sha256 = std::move(*checksum);
        return {};
    });
}

/// From the sources' posts to the scene's: drafts of the former, despiked and filled as asked, then with
/// classes.
Result<Copied> make_posts(const Mosaic& mosaic, const ImportOptions& options, lod::HeightType type,
                          const lod::SceneWriter& writer, std::uint64_t cache_bytes, lod::DraftPosts& posts,
                          lod::MeshHeights& fill, lod::SceneInfo& info, const Stage& stage) {
    const geo::GridFrame& frame = mosaic.frame();
    SeaRequest request = options.sea;
    request.zero_is_sea_level = mosaic.vertical().datum != lod::VerticalDatum::ellipsoid;
    auto sea = SeaClassifier::create(frame, request);
    if (!sea) return sea.error();
    const PostChanges changes{options.despike, options.fill_width, type == lod::HeightType::int16};

    const lod::HeightCoding exact{type, 0};
    auto raw = writer.draft("raw", frame, exact, cache_bytes);
    if (!raw) return raw.error();
    const auto part = [&](double from, double to) {
        return [&stage, from, to](double done) { return stage(from + (to - from) * done); };
    };
    const Progress reading = part(0, 0.6);
    const Progress cleaning = part(0.6, 0.8);
    const Progress finishing = part(0.8, 1);
    SeaClassifier* const sees_raw = !changes.any() && sea->needs_blocks() ? &*sea : nullptr;
    auto copied = copy_posts(mosaic, type, *raw, sees_raw, Stage{reading, 0, 1});
    if (!copied || *copied == Copied::too_wide_for_int16) return copied;
    std::optional<lod::DraftPosts> cleaned;
    if (changes.any()) {
        auto draft = writer.draft("cleaned", frame, exact, cache_bytes);
        if (!draft) return draft.error();
        cleaned.emplace(std::move(*draft));
    }
    if (cleaned) {
        const auto outliers = clean_posts(*raw, changes, *cleaned, *sea, Stage{cleaning, 0, 1});
        if (!outliers) return outliers.error();
        list_outliers(*outliers, info);
    }
    info.sea = sea->decide();
    if (auto done = finish_posts(cleaned ? *cleaned : *raw, frame, *sea, posts, fill, Stage{finishing, 0, 1});
        !done)
        return done.error();
    return Copied::all;
}

/// What shows only when the heights have been read.
struct Findings {
    bool too_wide = false;  ///< a whole number does not fit int16: to be begun again
    bool all_void = false;
};

/// All steps of an import in their order; the scene is in its place at the end.
Result<void> run(const Mosaic& mosaic, const ImportOptions& options, lod::HeightType type,
                 const std::vector<FileState>& files, lod::SceneWriter& writer, const Progress& progress,
                 ImportPlan& plan, Findings& found) {
    const MemoryBudget memory =
        divide_memory(options.memory_bytes, mosaic.frame(), mosaic.memory_bytes(), threads());
    GDALSetCacheMax64(static_cast<GIntBig>(memory.gdal_cache));
    const lod::HeightCoding coding{type, options.max_height_error_m};

    auto posts = writer.posts(mosaic.frame(), coding, memory.posts_cache / 3);
    if (!posts) return posts.error();
    lod::MeshHeights fill(mosaic.frame());
    lod::SceneInfo info;
    auto copied = make_posts(mosaic, options, type, writer, memory.posts_cache / 3, *posts, fill, info,
                             Stage{progress, 0, 0.5});
    if (!copied) return copied.error();
    found.too_wide = *copied == Copied::too_wide_for_int16;
    if (found.too_wide) return {};
    const bool say_sea = info.sea.rule == lod::SeaInfo::Rule::low_border || info.sea.low_areas_land > 0;
    if (say_sea) plan.notes.push_back("sea: " + info.sea.text);

    info.frame = mosaic.frame();
    info.vertical = mosaic.vertical();
    info.height_type = type;
    info.max_height_error_m = options.max_height_error_m;
    info.bounded_errors = options.bounded_errors;
    info.resampling_method = plan.resampling;
    info.sources = plan.sources;
    const auto undulations = write_geoid(mosaic, options, writer, info.vertical, plan.notes);
    if (!undulations) return undulations.error();
    if (auto done =
            measure_posts(*posts, fill, *undulations, writer, !options.despike && options.fill_width == 0,
                          info, Stage{progress, 0.5, 0.85});
        !done)
        return done;
    found.all_void = info.valid_posts == 0;
    if (found.all_void)
        return refusal(inputs_named(plan), "all of it is void",
                       "Check --nodata and --crop, or whether it holds heights at all");
    const auto scene_heights = [&](Window w) -> Result<lod::Raster<float>> {
        auto part = posts->read({w.column, w.row, w.columns, w.rows});
        if (!part) return part.error();
        return std::move(part->heights);
    };
    const auto error = mosaic.resampling_error(scene_heights, Stage{progress, 0.85, 0.95});
    if (!error) return error.error();
    info.resampling = *error;

    note_strange_heights(info, plan.notes);
    if (plan.resampling == "none" && info.resampling.max_m > 0 && options.max_height_error_m == 0)
        plan.notes.push_back(
            fmt::format("float32 rounds its heights by up to {:.2g} m", info.resampling.max_m));
    if (info.sources.size() == 1) {
        info.sources[0].notes = fmt::format("{}", fmt::join(plan.notes, "; "));
    } else {
        info.notes = plan.notes;
    }
    if (auto done = add_checksums(mosaic, info); !done) return done;
    if (auto same = check_unchanged(files, states_of(mosaic.all_files())); !same) return same;
    if (progress && !progress(0.97)) return interrupted();
    return writer.commit(std::move(info));
}

/// What is finished stays for --resume, if anything is.
Error stopped(Error error, lod::SceneWriter& writer) {
    if (!writer.has_blocks()) return error;
    writer.keep_for_resume();
    error.message += ". What is finished is kept: the same command with --resume goes on from there";
    return error;
}

}  // namespace

Result<ImportPlan> plan_import(const ImportOptions& options) {
    const auto mosaic = Mosaic::open(options.mosaic);
    if (!mosaic) return mosaic.error();
    return plan_of(*mosaic, options);
}

Result<Imported> import_scene(const ImportOptions& options, const ImportPlace& place,
                              const Progress& progress) {
    const auto mosaic = Mosaic::open(options.mosaic);
    if (!mosaic) return mosaic.error();
    ImportPlan plan = plan_of(*mosaic, options);
    if (auto fits = check_size(plan, options); !fits) return fits.error();

    const auto files = states_of(mosaic->all_files());
    // That whole numbers do not fit int16 may have been found by the run that is to be resumed.
    constexpr auto kFloat = lod::HeightType::float32;
    const bool as_float =
        !mosaic->fits_int16() ||
        (place.resume && lod::ScenePlace::can_resume(place.scene, job_text(options, files, kFloat)));
    auto type = as_float ? kFloat : lod::HeightType::int16;
    bool anew = false;
    for (;;) {
        auto writer = lod::SceneWriter::create(
            place.scene, {place.overwrite, place.resume, job_text(options, files, type)});
        if (!writer) return writer.error();
        anew = place.resume && !writer->resumed();
        Findings found;
        const auto done = run(*mosaic, options, type, files, *writer, progress, plan, found);
        if (!done) return found.all_void ? done.error() : stopped(done.error(), *writer);
        if (!found.too_wide) break;
        type = kFloat;
    }
    if (progress) progress(1);
    if (anew)
        plan.notes.emplace_back(
            "there was nothing to resume (or of other inputs, options or versions): begun anew");
    const auto written = lod::Scene::open(place.scene);
    if (!written) return written.error();
    return Imported{written->info(), std::move(plan.notes)};
}

}  // namespace relevo::ingest
