#include "viewer/ui/handle_marks.hpp"

#include <imgui.h>

namespace relevo::viewer {

void draw_handles(const Handles& handles, const lod::View& view) {
    constexpr ImU32 kDark = IM_COL32(10, 12, 16, 200);
    constexpr ImU32 kLight = IM_COL32(255, 255, 255, 255);
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const float ui_per_px = ImGui::GetIO().DisplaySize.x / static_cast<float>(view.camera().width);
    const auto ring = [&](const geo::Ecef& position, float radius, float width) {
        const glm::dvec3 offset = position - view.eye();
        if (!view.sees(offset)) return;
        const glm::dvec2 pixel = view.pixel(offset);
        const ImVec2 at(static_cast<float>(pixel.x) * ui_per_px, static_cast<float>(pixel.y) * ui_per_px);
        list.AddCircle(at, radius, kDark, 24, width + 2);
        list.AddCircle(at, radius, kLight, 24, width);
    };
    for (const geo::Ecef& middle : handles.middles) ring(middle, 3.5f, 1.5f);
    if (handles.chosen) ring(*handles.chosen, 8, 2);
    if (handles.hovered) ring(*handles.hovered, 10, 1.5f);
}

}  // namespace relevo::viewer
