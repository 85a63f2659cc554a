#pragma once

#include "lod/scene/scene.hpp"
#include "lod/terrain.hpp"
#include "viewer/eye_height.hpp"
#include "viewer/picture.hpp"
#include "viewer/view_state.hpp"

namespace relevo::viewer {

/// What a picture of a view says of itself (docs/viewer.md has the keys): the view's string as its
/// description, where the eye is and how it looks, and where on the ground the picture's corners and middle
/// are, read from the full data by rays (lod::pick_exactly). The same picture has the same notes: no date.
PictureNotes picture_notes(const lod::Scene& scene, const lod::Terrain& terrain, const EyeHeight& heights,
                           const ViewState& view, int width, int height);

}  // namespace relevo::viewer
