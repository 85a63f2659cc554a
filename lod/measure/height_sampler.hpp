#pragma once

#include <list>
#include <optional>
#include <unordered_map>

#include "geo/frame.hpp"
#include "lod/scene/scene.hpp"

namespace relevo::lod {

/// The surface between four neighbouring posts: bilinear in grid coordinates, H in metres.
struct BilinearCell {
    int column = 0;  ///< of its north-west post
    int row = 0;
    double nw = 0;
    double ne = 0;
    double sw = 0;
    double se = 0;

    double height(geo::GridPosition place) const {
        const double u = place.column - column;
        const double v = place.row - row;
        const double north = nw + u * (ne - nw);
        const double south = sw + u * (se - sw);
        return north + v * (south - north);
    }

    /// Rise of the surface a column to the east and a row to the south.
    struct Slope {
        double per_column = 0;
        double per_row = 0;
    };
    Slope slope(geo::GridPosition place) const {
        const double u = place.column - column;
        const double v = place.row - row;
        return {(ne - nw) + v * ((se - sw) - (ne - nw)), (sw - nw) + u * ((se - ne) - (sw - nw))};
    }
};

/// What is known of a place besides its height.
struct PlaceMarks {
    PostMark nearest;       ///< of the nearest post: its class, and the source it came from
    bool filled = false;    ///< a post that the height is made of was interpolated over a void
    bool modelled = false;  ///< one is of a sea bed that was made up
};

/// The one way to read a height between posts, for every measuring tool: bilinear in grid coordinates over
/// the full data, and exactly the post within 1e-6 of one. A cell with a void corner is void; so is an edge
/// with a void end. Keeps the blocks read last.
class HeightSampler {
  public:
    static constexpr double kPostTolerance = 1e-6;

    /// The scene must outlive the sampler.
    explicit HeightSampler(const Scene& scene) : scene_(scene) {}

    const Scene& scene() const { return scene_; }

    /// H of a post, metres; nothing for a void. \pre inside the data
    Result<std::optional<double>> post(int column, int row);

    /// H at a place, metres; nothing for a void or outside.
    Result<std::optional<double>> height(geo::GridPosition place);

    /// The surface around a place; nothing for a void or outside. Within 1e-6 of a row or a column it is that
    /// edge's surface (both its sides have the same height), within 1e-6 of a post it is the post's.
    Result<std::optional<BilinearCell>> cell(geo::GridPosition place);

    /// Marks at a place; nothing where it has no height.
    Result<std::optional<PlaceMarks>> marks(geo::GridPosition place);

    /// Is the place within the data's rectangle (or within 1e-6 of it)?
    bool inside(geo::GridPosition place) const;

  private:
    static constexpr std::size_t kMaxBlocks = 64;  // 64 MiB of heights

    struct CachedBlock {
        Raster<float> heights;
        std::optional<Raster<PostMark>> marks;  // read when first asked for
        std::list<std::uint64_t>::iterator age;
    };

    /// Between the last column and the first of data all round the earth, which are the same place to half a
    /// step: the nearer of them.
    geo::GridPosition on_seam(geo::GridPosition place) const;

    /// The block of a post, read if need be.
    Result<CachedBlock*> block(int block_column, int block_row);
    Result<PostMark> mark(int column, int row);

    const Scene& scene_;
    std::unordered_map<std::uint64_t, CachedBlock> blocks_;
    std::list<std::uint64_t> ages_;  // newest first
};

}  // namespace relevo::lod
