#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geo/result.hpp"
#include "ingest/progress.hpp"
#include "ingest/resample.hpp"
#include "ingest/source.hpp"
#include "ingest/target_frame.hpp"
#include "lod/scene/scene_info.hpp"

namespace relevo::ingest {

/// What to import and how.
struct ImportOptions {
    SourceRequest source;
    TargetRequest target;
    std::optional<Resampling>
        resampling;  ///< else cubic, or average where the scene is coarser than the source

    /// Largest padded grid: all of it is in memory (docs/ingest.md).
    static constexpr std::uint64_t kMostPosts = std::uint64_t{16385} * 16385;
    std::uint64_t max_posts = kMostPosts;
};

/// What an import would make.
struct ImportPlan {
    geo::GridFrame frame;
    std::uint64_t posts = 0;         ///< of the data
    std::uint64_t padded_posts = 0;  ///< of the 2^n + 1 grid around it
    std::uint64_t bytes_estimate =
        0;  ///< on disk: within a factor of 3 for real ground, less where most is void
    std::uint64_t memory_bytes = 0;  ///< while importing, roughly
    bool keeps_own_posts = false;
    std::string resampling;  ///< as SceneInfo::resampling_method
    lod::VerticalReference vertical;
    lod::SourceInfo source;          ///< without its checksum
    std::vector<std::string> notes;  ///< what was assumed or converted, for people
};

/// Opens and checks the source and chooses the scene's grid; reads no heights and writes nothing.
Result<ImportPlan> plan_import(const ImportOptions& options);

struct Imported {
    lod::SceneInfo info;
    std::vector<std::string> notes;
};

/// Imports a source as the scene at a path. On failure, and where progress says stop, nothing is left behind
/// and a scene that was there is as it was.
Result<Imported> import_scene(const ImportOptions& options, const std::filesystem::path& scene,
                              bool overwrite, const Progress& progress = {});

}  // namespace relevo::ingest
