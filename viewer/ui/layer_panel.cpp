#include "viewer/ui/layer_panel.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>
#include <imgui.h>

#include "viewer/overlay/overlay_list.hpp"

namespace relevo::viewer {

namespace {

/// What is asked of the list while it is drawn, and done when it has been.
struct Asked {
    std::optional<std::size_t> off;
    std::optional<int> remove;  // a file
    std::size_t from = 0;
    int up = 0;
};

/// A file can be taken away; what a viewshed shows goes with its measurement.
bool is_removable(const Overlay& overlay, const Drapes& drapes) {
    return is_of_file(overlay) && static_cast<std::size_t>(overlay.file) < drapes.size() &&
           drapes[static_cast<std::size_t>(overlay.file)]->is_of_file();
}

void row_name(const Overlay& overlay, const GroundLayers& layers, std::size_t index, std::size_t& chosen,
              Asked& asked) {
    const bool removable = is_removable(overlay, layers.drapes());
    const float button = ImGui::GetFrameHeight() + ImGui::GetStyle().ItemSpacing.x;
    const std::string name = overlay_name(overlay, layers.drapes());
    ImGui::AlignTextToFramePadding();
    const float width = ImGui::GetContentRegionAvail().x - (removable ? 3 : 2) * button;
    if (ImGui::Selectable(name.c_str(), chosen == index, ImGuiSelectableFlags_AllowItemOverlap,
                          {std::max(width, 1.0f), ImGui::GetFontSize()}))
        chosen = index;
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s\ndrag to change the order", name.c_str());
    if (ImGui::BeginDragDropSource()) {
        ImGui::SetDragDropPayload("overlay", &index, sizeof(index));
        ImGui::TextUnformatted(name.c_str());
        ImGui::EndDragDropSource();
    }
    if (ImGui::BeginDragDropTarget()) {
        if (const ImGuiPayload* dropped = ImGui::AcceptDragDropPayload("overlay")) {
            asked.from = *static_cast<const std::size_t*>(dropped->Data);
            asked.up = static_cast<int>(index) - static_cast<int>(asked.from);
        }
        ImGui::EndDragDropTarget();
    }
    for (const int up : {1, -1}) {
        ImGui::SameLine();
        if (ImGui::ArrowButton(up > 0 ? "up" : "down", up > 0 ? ImGuiDir_Up : ImGuiDir_Down)) {
            asked.from = index;
            asked.up = up;
        }
    }
    if (!removable) return;
    ImGui::SameLine();
    if (ImGui::Button("x", {ImGui::GetFrameHeight(), 0})) asked.remove = overlay.file;
}

void row_settings(Overlay& overlay) {
    auto value = static_cast<float>(overlay.opacity);
    ImGui::SetNextItemWidth(-1);
    if (ImGui::SliderFloat("##opacity", &value, 0, 1, "opacity %.2f"))
        overlay.opacity = static_cast<double>(value);
    if (overlay.kind == Overlay::Kind::contours) {
        auto interval = static_cast<float>(overlay.interval_m);
        ImGui::SetNextItemWidth(6 * ImGui::GetFontSize());
        if (ImGui::InputFloat("m apart", &interval, 0, 0, interval == 0 ? "auto" : "%.6g"))
            overlay.interval_m = std::clamp(static_cast<double>(interval), 0.0, 10000.0);
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("0: what suits the view");
    }
    if (overlay.kind == Overlay::Kind::graticule) ImGui::Checkbox("UTM", &overlay.utm);
}

/// What is not drawn: a box to have it on top.
void off_row(Overlays& overlays, const Overlay& overlay, const GroundLayers& layers, Asked& asked) {
    bool on = false;
    if (ImGui::Checkbox(overlay_name(overlay, layers.drapes()).c_str(), &on) &&
        overlays.size() < kMostOverlays)
        overlays.push_back(overlay);
    if (!is_removable(overlay, layers.drapes())) return;
    ImGui::SameLine();
    if (ImGui::Button("x", {ImGui::GetFrameHeight(), 0})) asked.remove = overlay.file;
}

}  // namespace

std::string overlay_name(const Overlay& overlay, const Drapes& drapes) {
    if (overlay.kind == Overlay::Kind::contours) return "contours";
    if (overlay.kind == Overlay::Kind::graticule) return "graticule";
    if (static_cast<std::size_t>(overlay.file) >= drapes.size())
        return fmt::format("file {}: not here", overlay.file + 1);
    return drapes[static_cast<std::size_t>(overlay.file)]->name();
}

void draw_layer_list(Overlays& overlays, GroundLayers& layers, std::size_t& chosen,
                     std::vector<Wish>& wishes) {
    Asked asked;
    ImGui::Separator();
    ImGui::TextDisabled("over it, the uppermost first");
    for (std::size_t i = overlays.size(); i-- > 0;) {
        ImGui::PushID(static_cast<int>(i));
        bool on = true;
        if (ImGui::Checkbox("##on", &on)) asked.off = i;
        ImGui::SameLine();
        row_name(overlays[i], layers, i, chosen, asked);
        row_settings(overlays[i]);
        ImGui::PopID();
    }
    if (asked.off) overlays.erase(overlays.begin() + static_cast<std::ptrdiff_t>(*asked.off));
    if (asked.up != 0) chosen = move_overlay(overlays, asked.from, asked.up);
    for (const Overlay::Kind kind : {Overlay::Kind::contours, Overlay::Kind::graticule}) {
        if (find(overlays, kind) == nullptr) off_row(overlays, {.kind = kind}, layers, asked);
    }
    for (std::size_t file = 0; file < layers.drapes().size(); ++file) {
        const Overlay off{.kind = layers.drapes()[file]->line_colour().has_value() ? Overlay::Kind::vectors
                                                                                   : Overlay::Kind::imagery,
                          .file = static_cast<int>(file)};
        ImGui::PushID(static_cast<int>(file));
        if (index_of_file(overlays, off.file) == overlays.size()) off_row(overlays, off, layers, asked);
        ImGui::PopID();
    }
    if (asked.remove) layers.remove(*asked.remove);
    if (layers.opening()) ImGui::TextDisabled("opening a file...");
    if (ImGui::Button("Add a picture or lines... (Ctrl O)")) wishes.push_back({Command::open_file, {}});
}

}  // namespace relevo::viewer
