#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "geo/result.hpp"
#include "ingest/mosaic/mosaic.hpp"
#include "ingest/progress.hpp"
#include "ingest/sea/sea_classifier.hpp"
#include "lod/scene/scene_info.hpp"

namespace relevo::ingest {

/// What to import and how.
struct ImportOptions {
    MosaicRequest mosaic;
    SeaRequest sea;        ///< which posts are sea
    int fill_width = 0;    ///< voids up to this many posts wide are interpolated; 0: none
    bool despike = false;  ///< outliers become the median of the posts around them

    double max_height_error_m = 0;  ///< heights may be stored with this much loss (LERC); 0: none
    bool bounded_errors = true;     ///< else the incremental error alone is built: faster, and no bound

    /// Most memory to take, bytes. The scene does not depend on it.
    std::uint64_t memory_bytes = std::uint64_t{1} << 30;
    /// Largest padded grid: mesh coordinates have 16 bits.
    static constexpr std::uint64_t kMostPosts = std::uint64_t{32769} * 32769;
    std::uint64_t max_posts = kMostPosts;
};

/// What an import would make.
struct ImportPlan {
    geo::GridFrame frame;
    std::uint64_t posts = 0;         ///< of the data
    std::uint64_t padded_posts = 0;  ///< of the 2^n + 1 grid around it
    std::uint64_t bytes_estimate =
        0;  ///< on disk: within a factor of 3 for real ground, less where most is void
    std::uint64_t memory_bytes = 0;  ///< least that the import needs
    std::string resampling;          ///< as SceneInfo::resampling_method
    lod::VerticalReference vertical;
    std::vector<lod::SourceInfo> sources;  ///< without their checksums
    std::vector<std::string> notes;        ///< what was assumed or converted, for people
};

/// Opens and checks the sources and chooses the scene's grid; reads no heights and writes nothing.
Result<ImportPlan> plan_import(const ImportOptions& options);

struct Imported {
    lod::SceneInfo info;
    std::vector<std::string> notes;
};

/// How a scene comes to its place.
struct ImportPlace {
    std::filesystem::path scene;
    bool overwrite = false;
    bool resume = false;  ///< go on from what an import of the same sources with the same options has left
};

/// Imports the sources as the scene at a place. On failure a scene that was there is as it was. Where the
/// import is killed or fails (progress says stop, a full disk, a source that vanishes), finished blocks stay
/// in a hidden folder beside the place for `resume`, until the next import to this place.
Result<Imported> import_scene(const ImportOptions& options, const ImportPlace& place,
                              const Progress& progress = {});

}  // namespace relevo::ingest
