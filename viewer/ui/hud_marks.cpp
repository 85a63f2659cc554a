#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <imgui.h>

#include "viewer/ui/hud.hpp"
#include "viewer/ui/map_marks.hpp"

namespace relevo::viewer {

namespace {

// Dark under light, so that marks read on snow and in shadow.
constexpr ImU32 kDark = IM_COL32(10, 12, 16, 200);
constexpr ImU32 kLight = IM_COL32(255, 255, 255, 255);
constexpr ImU32 kMeasure = IM_COL32(255, 214, 10, 255);

/// Where a position is in the picture, in the user interface's units. Nothing behind the eye: lines have gaps
/// there.
std::optional<ImVec2> in_picture(const geo::Ecef& position, const lod::View& view, float ui_per_px) {
    const glm::dvec3 offset = position - view.eye();
    if (!(view.depth(offset) > lod::View::kNearM)) return std::nullopt;
    const glm::dvec2 pixel = view.pixel(offset);
    if (std::abs(pixel.x) > 1e5 || std::abs(pixel.y) > 1e5) return std::nullopt;
    return ImVec2(static_cast<float>(pixel.x) * ui_per_px, static_cast<float>(pixel.y) * ui_per_px);
}

void shape_marks(ImDrawList& list, const DrawnShape& shape, const lod::View& view, float ui_per_px) {
    const auto place = [&](std::size_t i) { return in_picture(shape.line[i], view, ui_per_px); };
    const float letter = ImGui::GetFontSize();
    for (const auto& [colour, width] :
         {std::pair(kDark, shape.current ? 5.0f : 4.0f), std::pair(kMeasure, shape.current ? 2.5f : 1.5f)}) {
        for (std::size_t i = 1; i < shape.line.size(); ++i) {
            const auto from = place(i - 1);
            const auto to = place(i);
            if (from && to) list.AddLine(*from, *to, colour, width);
        }
    }
    for (std::size_t i = 0; i < shape.vertices.size(); ++i) {
        const auto at = place(shape.vertices[i]);
        if (!at) continue;
        list.AddCircleFilled(*at, shape.current ? 7.0f : 5.0f, kDark);
        list.AddCircleFilled(*at, shape.current ? 5.0f : 3.5f, kMeasure);
        if (shape.current && shape.vertices.size() > 1)
            draw_mark_plate(list, {at->x, at->y - 1.3f * letter}, fmt::format("{}", i + 1));
    }
    if (shape.label.empty() || shape.line.empty()) return;
    const std::size_t middle = shape.vertices.size() > 1 ? shape.line.size() / 2 : 0;
    if (const auto at = place(middle)) draw_mark_plate(list, {at->x, at->y - 1.3f * letter}, shape.label);
}

}  // namespace

void draw_marks(const HudContent& content, const std::vector<DrawnShape>& shapes,
                const std::optional<geo::Ecef>& pin, const lod::View& view) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const float ui_per_px = ImGui::GetIO().DisplaySize.x / static_cast<float>(view.camera().width);
    for (const DrawnShape& shape : shapes) shape_marks(list, shape, view, ui_per_px);
    if (pin) {
        if (const auto at = in_picture(*pin, view, ui_per_px)) {
            list.AddCircle(*at, 9, kDark, 24, 4);
            list.AddCircle(*at, 9, kLight, 24, 2);
        }
    }
    MapMarks marks{.legend = content.legend, .scale = {}, .north = true, .labels = content.labels};
    if (content.middle_distance_m)
        marks.scale = scale_bar(view, *content.middle_distance_m, 0.22 * view.camera().width);
    draw_map_marks(list, marks, view, ui_per_px,
                   {.top = ImGui::GetFrameHeightWithSpacing() + ImGui::GetStyle().WindowPadding.y,
                    .right = content.panel_width,
                    .bottom = 3 * ImGui::GetFontSize()},
                   content.covered);
}

}  // namespace relevo::viewer
