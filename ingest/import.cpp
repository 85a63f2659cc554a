#include "ingest/import.hpp"

#include <utility>

#include "ingest/import_plan.hpp"
#include "ingest/job.hpp"
#include "ingest/refusal.hpp"
#include "ingest/scene_import.hpp"
#include "lod/scene/scene.hpp"
#include "lod/scene/scene_writer.hpp"

namespace relevo::ingest {
namespace {

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
        const auto outcome = SceneImport(*mosaic, options, type, files).run(*writer, plan, progress);
        if (!outcome) return stopped(outcome.error(), *writer);
        if (*outcome == SceneImport::Outcome::done) break;
        if (*outcome == SceneImport::Outcome::all_void)
            return refusal(inputs_named(plan), "all of it is void",
                           "Check --nodata and --crop, or whether it holds heights at all");
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
