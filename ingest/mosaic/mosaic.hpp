#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geo/frame.hpp"
#include "geo/result.hpp"
#include "ingest/affine.hpp"
#include "ingest/mosaic/frame_choice.hpp"
#include "ingest/progress.hpp"
#include "ingest/resample/resample.hpp"
#include "ingest/source/source.hpp"
#include "lod/scene/post_mark.hpp"
#include "lod/scene/raster.hpp"
#include "lod/scene/scene_info.hpp"

namespace relevo::ingest {

/// Which source a post takes its height from where several have one.
enum class Priority {
    finest,  ///< the one with the closest posts; the first of the inputs among those
    order,   ///< the first of the inputs
};

/// Sources that are to become one grid.
struct MosaicRequest {
    std::vector<SourceRequest> sources;  ///< in order (expand_inputs gives the inputs)
    TargetRequest target;
    std::optional<Resampling>
        resampling;  ///< else cubic, or average where the scene is coarser than a source
    Priority priority = Priority::finest;
    double feather_m = 0;  ///< width of the blend inside a finer source's border, metres
    std::optional<lod::VerticalReference> datum;  ///< of the scene (vertical_reference_named); else the
                                                  ///< finest source's
    std::optional<std::filesystem::path> geoid;   ///< a grid for datums whose geoid is not here
};

/// A part of the mosaic. Void posts have the height NaN and the mark's class void; all others are land.
struct MosaicPosts {
    lod::Raster<float> heights;
    lod::Raster<lod::PostMark> marks;
};

/// Many elevation files as one grid of posts in one vertical datum.
class Mosaic {
  public:
    /// Opens and checks all sources and chooses the grid; reads no heights.
    static Result<Mosaic> open(const MosaicRequest& request);

    Mosaic(Mosaic&&) noexcept;
    Mosaic& operator=(Mosaic&&) noexcept;
    ~Mosaic();

    const geo::GridFrame& frame() const;
    const lod::VerticalReference& vertical() const;

    /// What is known of each source, without its checksum; a post's mark holds an index into this.
    std::vector<lod::SourceInfo> sources() const;
    /// The file of each source, for checksums; empty where it is not a plain file.
    std::vector<std::filesystem::path> files() const;
    /// Those, and what else GDAL reads the sources from: a change of any of them may change the scene.
    std::vector<std::filesystem::path> all_files() const;

    /// "none" where all posts are sources' own, else how heights between them are made.
    std::string resampling_method() const;
    /// Are all heights whole metres, as far as types tell? (Most then fit 16 bits.)
    bool fits_int16() const;
    /// What was assumed or converted, for people.
    std::vector<std::string> notes() const;

    /// The posts of a window of the frame. A post is the same whatever the window, and whatever other threads
    /// read at the same time. \pre the window lies in the frame
    Result<MosaicPosts> read(Window window) const;

    /// The most memory that one read of a block of SceneInfo::kBlockSide posts a side takes, bytes; GDAL's
    /// cache not counted.
    std::uint64_t memory_bytes() const;

    /// Heights of the finished scene in a window of its frame.
    using SceneHeights = std::function<Result<lod::Raster<float>>(Window)>;

    /// The scene's surface (bilinear between its posts, as measuring tools read it) against every valid
    /// source post. \param scene  called by several threads at once, for windows that lie in the frame
    Result<lod::ResamplingError> resampling_error(const SceneHeights& scene, const Stage& stage) const;

  private:
    struct State;
    explicit Mosaic(std::unique_ptr<State> state);

    std::unique_ptr<State> state_;
};

}  // namespace relevo::ingest
