#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lod/view.hpp"
#include "viewer/marks/legend.hpp"
#include "viewer/marks/map_labels.hpp"
#include "viewer/marks/scale_bar.hpp"
#include "viewer/ui/free_area.hpp"

struct ImDrawList;
struct ImVec2;

namespace relevo::viewer {

/// The marks of a map: the same in the window and in pictures. Lengths are in ImGui's units, of which a
/// window has one a pixel and a large picture fewer.
struct MapMarks {
    std::optional<Legend> legend;
    std::optional<ScaleBar> scale;
    bool north = false;
    std::vector<MapLabel> labels;
};

/// What panels cover of the picture's edges.
struct MarkMargins {
    float top = 0;
    float right = 0;
    float bottom = 0;
};

/// How far up in a picture is turned from north, clockwise: the heading, and straight down also the roll.
geo::Degrees up_azimuth(const lod::View& view);

/// The rose in the upper right corner, the bar in the lower right, the legend in the lower left. \pre between
/// ImGui::NewFrame and Render
/// \param units_per_px  of `marks`, whose lengths are in the view's pixels
/// \param covered  labels keep off it, and the legend is as high as it leaves room for
void draw_map_marks(ImDrawList& list, const MapMarks& marks, const lod::View& view, float units_per_px,
                    const MarkMargins& margins = {}, Covered covered = {});

/// Light letters with a dark rim: they read on snow and in shadow.
void draw_mark_text(ImDrawList& list, const ImVec2& middle, const std::string& what);
/// The same on a dark plate.
void draw_mark_plate(ImDrawList& list, const ImVec2& middle, const std::string& what);

}  // namespace relevo::viewer
