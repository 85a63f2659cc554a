#pragma once

#include "lod/scene/scene_info.hpp"
#include "lod/view.hpp"
#include "viewer/eye_height.hpp"
#include "viewer/view_state.hpp"

namespace relevo::viewer {

/// The camera of a view in a picture of a size.
lod::Camera camera_of(const ViewState& view, const EyeHeight& heights, int width, int height);

/// Puts a view's eye where a camera's is.
void set_eye(ViewState& view, const EyeHeight& heights, const geo::Geodetic& eye);

/// A view from a distance towards a place on the ground, from the side that it is looked at from now, and by
/// at least 15 degrees from above. Roll is left.
void look_at(ViewState& view, const EyeHeight& heights, const geo::Geodetic& target, double distance_m);

/// A view from the south over all of the data, looking down by 30 degrees at its middle, whatever its size:
/// as near as shows every corner of the data at its lowest and highest.
void look_over(ViewState& view, const lod::Terrain& terrain, const lod::SceneInfo& info,
               const EyeHeight& heights, int width, int height);

}  // namespace relevo::viewer
