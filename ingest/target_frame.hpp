#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "geo/frame.hpp"
#include "geo/result.hpp"
#include "ingest/affine.hpp"
#include "ingest/frame_choice.hpp"
#include "ingest/grid_map.hpp"

namespace relevo::ingest {

/// A source whose posts are a geographic grid already: these of its posts, as they are.
struct OwnWindow {
    Window window;
    bool flip_columns = false;  ///< the source runs east to west
    bool flip_rows = false;     ///< the source runs south to north
};

/// The grid of a scene, and how it gets its heights.
struct Target {
    geo::GridFrame frame;
    std::optional<OwnWindow> own;  ///< else heights are resampled
    bool downsamples = false;      ///< its posts are farther apart than the source's
    std::vector<std::string> notes;
};

/// The geographic grid for a source.
///
/// A source on an axis-aligned grid of degrees, whose CRS agrees with WGS 84 to 0.001 of a step at a lattice
/// of its posts, keeps its own. Any other gets a grid whose steps are the source's own post spacing where
/// that is densest in longitude and in latitude (so that no post is lost), over the bounds of its outermost
/// posts. \param crs   the source's \param name  of the source, for messages
Result<Target> choose_target(const std::string& name, const Crs& crs, const Affine& posts, SourceMap& map,
                             const TargetRequest& request);

}  // namespace relevo::ingest
