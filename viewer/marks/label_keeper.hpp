#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "viewer/marks/map_labels.hpp"
#include "viewer/renderer.hpp"
#include "viewer/view_state.hpp"

namespace relevo::viewer {

/// The labels of the contours and of the graticule that a renderer's last picture had.
std::vector<MapLabel> labels_of(const Renderer& renderer, const lod::Terrain& terrain, const ViewState& state,
                                const lod::View& view);

/// The labels of a moving picture's contours and graticule: looked for ten times a second at most, and once
/// while neither the view nor the ground changes.
class LabelKeeper {
  public:
    /// \param ground_rests  all of the ground that the view wants is there
    const std::vector<MapLabel>& labels(const lod::Terrain& terrain, const Renderer& renderer,
                                        const ViewState& state, const lod::View& view, bool ground_rests);

  private:
    std::vector<MapLabel> labels_;
    std::string seen_;
    std::chrono::steady_clock::time_point made_{};
};

}  // namespace relevo::viewer
