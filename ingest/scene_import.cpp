#include "ingest/scene_import.hpp"

#include <optional>
#include <utility>

#include <fmt/format.h>
#include <gdal_priv.h>

#include "ingest/import_passes.hpp"
#include "ingest/import_plan.hpp"
#include "ingest/posts/post_passes.hpp"
#include "ingest/refusal.hpp"
#include "ingest/scene_geoid.hpp"
#include "ingest/source/zip_archive.hpp"
#include "lod/scene/parallel_blocks.hpp"
#include "lod/scene/sha256.hpp"

namespace relevo::ingest {
namespace {

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

/// Heights and checksums are of the same files only if none of these was changed meanwhile.
Result<void> check_unchanged(const std::vector<FileState>& before, const std::vector<FileState>& now) {
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (before[i] != now.at(i))
            return refusal(before[i].path.filename().string(),
                           "it was changed, or it went away, while it was read", "Import it again");
    }
    return {};
}

}  // namespace

SceneImport::SceneImport(const Mosaic& mosaic, const ImportOptions& options, lod::HeightType type,
                         const std::vector<FileState>& files)
    : mosaic_(mosaic), options_(options), files_(files), memory_(memory_of(mosaic, options)) {
    info_.frame = mosaic.frame();
    info_.vertical = mosaic.vertical();
    info_.height_type = type;
    info_.max_height_error_m = options.max_height_error_m;
    info_.bounded_errors = options.bounded_errors;
    info_.resampling_method = mosaic.resampling_method();
    info_.sources = mosaic.sources();
}

Result<SceneImport::Outcome> SceneImport::run(lod::SceneWriter& writer, ImportPlan& plan,
                                              const Progress& progress) {
    GDALSetCacheMax64(static_cast<GIntBig>(memory_.gdal_cache));
    const lod::HeightCoding coding{info_.height_type, options_.max_height_error_m};
    auto posts = writer.posts(info_.frame, coding, cache_of_a_draft());
    if (!posts) return posts.error();
    lod::MeshHeights fill(info_.frame);
    const auto made = make_posts(writer, *posts, fill, Stage{progress, 0, 0.5});
    if (!made || *made != Outcome::done) return made;

    const auto undulations = write_geoid(mosaic_, options_, writer, info_.vertical, plan.notes);
    if (!undulations) return undulations.error();
    const bool outliers_are_left = !options_.despike && options_.fill_width == 0;
    if (auto done = measure_posts(*posts, fill, *undulations, writer, outliers_are_left, info_,
                                  Stage{progress, 0.5, 0.85});
        !done)
        return done.error();
    if (info_.valid_posts == 0) return Outcome::all_void;
    if (auto done = compare_with_sources(*posts, Stage{progress, 0.85, 0.95}); !done) return done.error();
    write_notes(plan);
    if (auto sound = check_archives(); !sound) return sound.error();
    if (auto done = add_checksums(); !done) return done.error();
    if (auto same = check_unchanged(files_, states_of(mosaic_.all_files())); !same) return same.error();
    if (progress && !progress(0.97)) return interrupted();
    if (auto done = writer.commit(std::move(info_)); !done) return done.error();
    return Outcome::done;
}

std::uint64_t SceneImport::cache_of_a_draft() const {
    constexpr int kDrafts = 3;  // raw, cleaned, the scene's own
    return memory_.posts_cache / kDrafts;
}

Result<SceneImport::Outcome> SceneImport::make_posts(const lod::SceneWriter& writer, lod::DraftPosts& posts,
                                                     lod::MeshHeights& fill, const Stage& stage) {
    const geo::GridFrame& frame = info_.frame;
    SeaRequest request = options_.sea;
    request.zero_is_sea_level = info_.vertical.datum != lod::VerticalDatum::ellipsoid;
    auto sea = SeaClassifier::create(frame, request);
    if (!sea) return sea.error();
    const lod::HeightType type = info_.height_type;
    const PostChanges changes{options_.despike, options_.fill_width, type == lod::HeightType::int16};

    const lod::HeightCoding exact{type, 0};
    auto raw = writer.draft("raw", frame, exact, cache_of_a_draft());
    if (!raw) return raw.error();
    const Progress whole = [&stage](double done) { return stage(done); };
    SeaClassifier* const sees_raw = !changes.any() && sea->needs_blocks() ? &*sea : nullptr;
    const auto copied = copy_posts(mosaic_, type, *raw, sees_raw, Stage{whole, 0, 0.6});
    if (!copied) return copied.error();
    if (*copied == Copied::too_wide_for_int16) return Outcome::too_wide_for_int16;
    std::optional<lod::DraftPosts> cleaned;
    if (changes.any()) {
        auto draft = writer.draft("cleaned", frame, exact, cache_of_a_draft());
        if (!draft) return draft.error();
        cleaned.emplace(*std::move(draft));
        const auto outliers = clean_posts(*raw, changes, *cleaned, *sea, Stage{whole, 0.6, 0.8});
        if (!outliers) return outliers.error();
        list_outliers(*outliers, info_);
    }
    info_.sea = sea->decide();
    if (auto done = finish_posts(cleaned ? *cleaned : *raw, frame, *sea, posts, fill, Stage{whole, 0.8, 1});
        !done)
        return done.error();
    return Outcome::done;
}

/// The resampling error: of the scene's surface against the sources' own posts.
Result<void> SceneImport::compare_with_sources(const lod::DraftPosts& posts, const Stage& stage) {
    const auto scene_heights = [&](Window w) -> Result<lod::Raster<float>> {
        auto part = posts.read({w.column, w.row, w.columns, w.rows});
        if (!part) return part.error();
        return std::move(part->heights);
    };
    const auto error = mosaic_.resampling_error(scene_heights, stage);
    if (!error) return error.error();
    info_.resampling = *error;
    return {};
}

void SceneImport::write_notes(ImportPlan& plan) {
    std::vector<std::string>& notes = plan.notes;
    if (info_.sea.rule == lod::SeaInfo::Rule::low_border || info_.sea.low_areas_land > 0)
        notes.push_back("sea: " + info_.sea.text);
    note_strange_heights(info_, notes);
    if (info_.resampling_method == "none" && info_.resampling.max_m > 0 && options_.max_height_error_m == 0)
        notes.push_back(fmt::format("float32 rounds its heights by up to {:.2g} m", info_.resampling.max_m));
    if (info_.sources.size() == 1) {
        info_.sources[0].notes = fmt::format("{}", fmt::join(notes, "; "));
    } else {
        info_.notes = notes;
    }
}

Result<void> SceneImport::check_archives() const {
    const auto& sources = options_.mosaic.sources;
    return lod::for_each_block(static_cast<int>(sources.size()), [&](int i) {
        return check_archive(sources[static_cast<std::size_t>(i)].input);
    });
}

Result<void> SceneImport::add_checksums() {
    const auto files = mosaic_.files();
    return lod::for_each_block(static_cast<int>(files.size()), [&](int i) -> Result<void> {
        const auto& file = files[static_cast<std::size_t>(i)];
        if (file.empty()) return {};
        auto checksum = lod::sha256_of_file(file);
        if (!checksum) return checksum.error();
        info_.sources[static_cast<std::size_t>(i)].sha256 = std::move(*checksum);
        return {};
    });
}

}  // namespace relevo::ingest
