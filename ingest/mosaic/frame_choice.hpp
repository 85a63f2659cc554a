#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "geo/frame.hpp"
#include "geo/result.hpp"
#include "ingest/affine.hpp"
#include "ingest/mosaic/grid_map.hpp"

namespace relevo::ingest {

/// What a scene's grid runs along.
enum class FrameChoice {
    automatic,   ///< UPS where the middle of the data is beyond 75 degrees or a pole is inside, else
                 ///< geographic
    geographic,  ///< equal steps of longitude and latitude
    ups,         ///< equal steps of easting and northing around the nearer pole
};

struct TargetRequest {
    FrameChoice frame = FrameChoice::automatic;
    std::optional<Bounds> crop;  ///< degrees, whatever the frame
    /// Steps of longitude and latitude in degrees; of easting and northing in metres for UPS.
    std::optional<std::pair<double, double>> resolution;
};

/// Posts on one lattice that go into a scene: of a source, or of several that have it in common.
struct PostGrid {
    const Crs* crs = nullptr;
    Affine posts;
    SourceMap map;                 ///< of all of it
    std::vector<SourceMap> parts;  ///< of each source
    double spacing_m = 0;          ///< mean distance between posts on the ground
};

/// A grid's posts that are the scene's: at a scene post (c, r) the post (column + c, row + r), or minus where
/// it runs the other way; which may lie outside of it.
struct OwnPosts {
    int column = 0;
    int row = 0;
    bool flip_columns = false;
    bool flip_rows = false;

    /// The grid's posts for a window of the scene.
    Window of(Window scene) const {
        return {flip_columns ? column - (scene.column + scene.columns - 1) : column + scene.column,
                flip_rows ? row - (scene.row + scene.rows - 1) : row + scene.row, scene.columns, scene.rows};
    }
};

/// The grid of a scene, and how it gets the heights of each of the grids that it is made of.
struct ChosenFrame {
    struct Use {
        std::optional<OwnPosts> own;  ///< else heights are resampled
        bool downsamples = false;     ///< the scene's posts are farther apart
    };
    geo::GridFrame frame;
    std::vector<Use> uses;
    std::vector<std::string> notes;
};

/// The frame for some grids of posts: over the union of what they cover (longitudes continuous, wherever they
/// cross the antimeridian), with the steps of the finest.
///
/// Where the finest (or one with steps within 2 % of its) is itself an axis-aligned grid in the plane of the
/// frame, to 0.001 of a step, the frame is its lattice, and every grid on that keeps its own posts. Else
/// steps are the finest's own post spacing where that is densest in either axis, so that no post is lost, and
/// the frame ends on the bounds of the outermost posts. All round the earth the first column comes again as
/// the last. \param name  of the data, for messages
Result<ChosenFrame> choose_frame(const std::string& name, std::vector<PostGrid> grids,
                                 const TargetRequest& request);

}  // namespace relevo::ingest
