#include "ingest/import.hpp"

#include <cmath>
#include <exception>
#include <utility>

#include <fmt/format.h>

#include "geo/geoid.hpp"
#include "ingest/operation.hpp"
#include "ingest/read_heights.hpp"
#include "ingest/refusal.hpp"
#include "ingest/resampling_error.hpp"
#include "ingest/surface_statistics.hpp"
#include "lod/scene/scene.hpp"
#include "lod/scene/scene_writer.hpp"
#include "lod/scene/sha256.hpp"
#include "lod/soar/metrics.hpp"
#include "lod/undulation_grid.hpp"

namespace relevo::ingest {
namespace {

// Parts of the work, of 1.
constexpr double kHeightsDone = 0.35;
constexpr double kErrorDone = 0.5;
constexpr double kMetricsDone = 0.9;

// Measured on real ground (docs/ingest.md). Memory: a post's height; a padded post's three codes and what
// building them takes; the program with its libraries and the geoid. Disk: compressed codes.
constexpr std::uint64_t kMemoryOfHeight = 4;
constexpr std::uint64_t kMemoryOfMetrics = 16;
constexpr std::uint64_t kMemoryOfProgram = std::uint64_t{64} << 20;
constexpr std::uint64_t kDiskOfMetrics = 4;

/// An opened source and all that is decided before its heights are read.
struct Prepared {
    Source source;
    Operation operation;
    Target target;
    Resampling method = Resampling::cubic;
    double middle_lon = 0;

    SourceMap source_map() const {
        SourceMap map{operation, source.crs(), source.posts(), source.columns(), source.rows()};
        map.set_middle_lon(middle_lon);
        return map;
    }
};

/// Places of the source in its CRS: a lattice with its corners.
std::vector<Place> places_of(const Source& source) {
    constexpr int kCount = 8;
    std::vector<Place> places;
    for (int j = 0; j <= kCount; ++j)
        for (int i = 0; i <= kCount; ++i)
            places.push_back(source.posts().at(
                {(source.columns() - 1) * i / double{kCount}, (source.rows() - 1) * j / double{kCount}}));
    return places;
}

Result<Prepared> prepare(const ImportOptions& options) {
    auto source = Source::open(options.source);
    if (!source) return source.error();
    auto operation = Operation::to_wgs84(source->crs(), places_of(*source));
    if (!operation)
        return operation.error().kind == ErrorKind::input
                   ? refusal(source->name(), operation.error().message, "")
                   : operation.error();
    SourceMap map{*operation, source->crs(), source->posts(), source->columns(), source->rows()};
    auto target = choose_target(source->name(), source->crs(), source->posts(), map, options.target);
    if (!target) return target.error();
    const Resampling automatic = target->downsamples ? Resampling::average : Resampling::cubic;
    return Prepared{std::move(*source), std::move(*operation), std::move(*target),
                    options.resampling.value_or(automatic), map.middle_lon()};
}

lod::SourceInfo describe(const Prepared& prepared) {
    const Source& source = prepared.source;
    lod::SourceInfo info;
    info.name = source.name();
    info.crs = source.crs().name();
    info.crs_wkt = source.crs().wkt();
    info.columns = source.columns();
    info.rows = source.rows();
    info.step_x = std::hypot(source.posts().x_column, source.posts().y_column);
    info.step_y = std::hypot(source.posts().x_row, source.posts().y_row);
    info.step_unit = source.crs().unit();
    info.operation = prepared.operation.name();
    info.operation_accuracy_m = prepared.operation.accuracy_m();
    info.operation_note = prepared.operation.note();
    return info;
}

std::vector<std::string> notes_of(const Prepared& prepared, const ImportOptions& options) {
    std::vector<std::string> notes = prepared.source.notes();
    notes.insert(notes.end(), prepared.target.notes.begin(), prepared.target.notes.end());
    if (prepared.target.own && options.resampling)
        notes.emplace_back("its own posts are kept: --resampling has nothing to do");
    if (prepared.source.value_type() == "Float64")
        notes.emplace_back("float64 heights are rounded to float32");
    return notes;
}

ImportPlan plan_of(const Prepared& prepared, const ImportOptions& options) {
    ImportPlan plan;
    plan.frame = prepared.target.frame;
    plan.posts = static_cast<std::uint64_t>(plan.frame.columns) * static_cast<std::uint64_t>(plan.frame.rows);
    const auto side = static_cast<std::uint64_t>(plan.frame.padded_side());
    plan.padded_posts = side * side;
    plan.keeps_own_posts = prepared.target.own.has_value();
    const std::uint64_t height_bytes = plan.keeps_own_posts && prepared.source.whole_metres() ? 2 : 4;
    plan.bytes_estimate = plan.posts * (height_bytes + kDiskOfMetrics);
    plan.memory_bytes =
        kMemoryOfProgram + plan.posts * kMemoryOfHeight + plan.padded_posts * kMemoryOfMetrics;
    plan.resampling = plan.keeps_own_posts ? "none" : to_string(prepared.method);
    plan.vertical = prepared.source.heights().reference;
    plan.source = describe(prepared);
    plan.notes = notes_of(prepared, options);
    return plan;
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

std::string joined(const std::vector<std::string>& notes) {
    return fmt::format("{}", fmt::join(notes, "; "));
}

/// Heights of the scene and how they compare with the source's, into `info`.
Result<lod::Raster<float>> heights_of(const Prepared& prepared, const ImportOptions& options,
                                      const Progress& progress, lod::SceneInfo& info) {
    const Source& source = prepared.source;
    const geo::GridFrame& frame = prepared.target.frame;
    if (prepared.target.own) {
        auto read = read_own_heights(source, *prepared.target.own, Stage{progress, 0, kErrorDone});
        if (!read) return read.error();
        info.resampling = read->rounding;
        info.resampling_method = "none";
        if (source.whole_metres() && fits_int16(read->heights)) info.height_type = lod::HeightType::int16;
        return std::move(read->heights);
    }
    const GridMap map{prepared.source_map(), frame};
    auto heights = warp_heights(source, map, frame, prepared.method, Stage{progress, 0, kHeightsDone});
    if (!heights) return heights;
    const auto error = resampling_error(source, map, frame, *heights, options.target.crop.has_value(),
                                        Stage{progress, kHeightsDone, kErrorDone});
    if (!error) return error.error();
    info.resampling = *error;
    info.resampling_method = to_string(prepared.method);
    return heights;
}

Result<void> write(lod::SceneWriter& writer, lod::SceneInfo info, const lod::Raster<float>& heights,
                   const lod::MetricRasters& metrics, const lod::UndulationGrid& undulations,
                   const Stage& stage) {
    if (auto done = writer.write_heights(heights, info.height_type, info.frame); !done) return done;
    if (!stage(0.3)) return interrupted();
    if (auto done = writer.write_metrics(metrics); !done) return done;
    if (!stage(0.8)) return interrupted();
    if (auto done = writer.write_undulations(undulations); !done) return done;
    if (!stage(0.9)) return interrupted();
    return writer.commit(std::move(info));
}

}  // namespace

Result<ImportPlan> plan_import(const ImportOptions& options) {
    const auto prepared = prepare(options);
    if (!prepared) return prepared.error();
    ImportPlan plan = plan_of(*prepared, options);
    if (!plan.source.operation_note.empty()) plan.notes.push_back(plan.source.operation_note);
    return plan;
}

Result<Imported> import_scene(const ImportOptions& options, const std::filesystem::path& scene,
                              bool overwrite, const Progress& progress) {
    const auto prepared = prepare(options);
    if (!prepared) return prepared.error();
    ImportPlan plan = plan_of(*prepared, options);
    const std::string& name = prepared->source.name();
    if (plan.padded_posts > options.max_posts)
        return refusal(
            name,
            fmt::format(
                "its grid of {} x {} posts is padded to {} posts and needs about {} MiB of memory; at "
                "most {} posts are allowed",
                plan.frame.columns, plan.frame.rows, plan.padded_posts, plan.memory_bytes >> 20,
                options.max_posts),
            "Take a part with --crop, make it coarser with --resolution, or raise --max-posts");
    auto writer = lod::SceneWriter::create(scene, overwrite);
    if (!writer) return writer.error();

    lod::SceneInfo info;
    info.frame = plan.frame;
    info.vertical = plan.vertical;
    const auto heights = heights_of(*prepared, options, progress, info);
    if (!heights) return heights.error();
    add_statistics(*heights, info);
    if (info.valid_posts == 0)
        return refusal(name, "all of it is void",
                       "Check --nodata and --crop, or whether it holds heights at all");
    note_strange_heights(info, plan.notes);
    if (plan.keeps_own_posts && info.resampling.max_m > 0)
        plan.notes.push_back(
            fmt::format("float32 rounds its heights by up to {:.2g} m", info.resampling.max_m));

    lod::UndulationGrid undulations;
    if (info.vertical.datum != lod::VerticalDatum::ellipsoid) {
        const auto geoid = geo::Geoid::egm96();
        if (!geoid) return geoid.error();
        undulations = lod::UndulationGrid{*geoid, info.frame};
    }
    const auto metrics = lod::build_metrics(info.frame, undulations, *heights);

    plan.source.notes = joined(plan.notes);
    if (!plan.source.operation_note.empty()) plan.notes.push_back(plan.source.operation_note);
    if (!prepared->source.file().empty()) {
        auto checksum = lod::sha256_of_file(prepared->source.file());
        if (!checksum) return checksum.error();
        plan.source.sha256 = std::move(*checksum);
    }
    info.sources.push_back(std::move(plan.source));
    if (auto done = write(*writer, info, *heights, metrics, undulations, Stage{progress, kMetricsDone, 1});
        !done)
        return done.error();
    if (progress) progress(1);

    const auto written = lod::Scene::open(scene);
    if (!written) return written.error();
    return Imported{written->info(), std::move(plan.notes)};
}

}  // namespace relevo::ingest
