#pragma once

#include <filesystem>
#include <optional>

#include "geo/result.hpp"
#include "ingest/import.hpp"
#include "lod/lstr/chunk_making.hpp"
#include "lod/lstr/removable_posts.hpp"
#include "lod/scene/scene.hpp"

namespace relevo::ingest {

/// Makes what the LSTR draws, for programs that use the library: a height map becomes a scene with its
/// chunks.bin. The class LSTRGen of the reference (its table 7) has the same three steps; viewing is
/// viewer/lstr_viewer.hpp.
///
///     auto generator = LstrGenerator::load_height_map("fuji.tif", "fuji.relevo");
///     if (generator) auto done = generator->generate();
class LstrGenerator {
  public:
    /// Imports elevation files, of any format, CRS and size that `relevo ingest` takes, as the scene at a
    /// place. The reference reads raw files of 16 bits: SourceRequest::raw says how such a file is laid out.
    static Result<LstrGenerator> load_height_map(const ImportOptions& options, const ImportPlace& place,
                                                 const Progress& progress = {});

    /// One file that says all of itself, whose scene replaces one that is at the place.
    static Result<LstrGenerator> load_height_map(const std::filesystem::path& file,
                                                 const std::filesystem::path& scene);

    /// The height map of a scene that is there.
    static Result<LstrGenerator> open(const std::filesystem::path& scene);

    /// The posts of the scene that the reference's filter finds: those that no more than so many percent of
    /// the range of heights set off from the posts around them. Needs 4 bytes a post for all heights.
    ///
    /// It is for looking at, and for meshes of one's own: generate() asks the filter itself, node by node,
    /// and keeps to its margin whatever the filter finds.
    Result<lod::PostSet> simplify(double percent, lod::RemovalTest test = lod::RemovalTest::pairs) const;

    /// How generate() simplifies.
    struct Simplification {
        std::optional<double> margin_m = {};  ///< of the finest level; none: what suits the screen
        lod::RemovalTest test = lod::RemovalTest::pairs;
    };

    /// Makes the scene's chunks.bin, in place of another. What an earlier call had done when it was stopped
    /// is gone on with. Fails with ErrorKind::input where the file cannot be written, or was stopped.
    Result<void> generate(
        const Simplification& by, const lod::ChunkProgress& progress = [](double) { return true; }) const;

    /// The same, by what suits the screen; nothing where the file is there.
    Result<void> generate() const;

    const lod::Scene& scene() const { return scene_; }

  private:
    explicit LstrGenerator(lod::Scene scene) : scene_(std::move(scene)) {}

    lod::Scene scene_;
};

}  // namespace relevo::ingest
