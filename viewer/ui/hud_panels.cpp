#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <imgui.h>

#include "viewer/ui/hud.hpp"

namespace relevo::viewer {

namespace {

enum class Corner { upper_left, bottom, middle };

/// A panel of lines that is as large as its text, and takes neither clicks nor keys.
class Panel {
  public:
    Panel(const char* name, Corner corner) {
        const ImVec2 size = ImGui::GetIO().DisplaySize;
        const float margin = 0.5f * ImGui::GetFontSize();
        // Below the tool bar.
        ImVec2 at(margin, margin + ImGui::GetFrameHeightWithSpacing() + ImGui::GetStyle().WindowPadding.y);
        ImVec2 pivot(0, 0);
        switch (corner) {
            case Corner::upper_left:
                break;
            case Corner::bottom:
                at = {0.5f * size.x, size.y - margin}, pivot = {0.5f, 1};
                break;
            case Corner::middle:
                at = {0.5f * size.x, 0.5f * size.y}, pivot = {0.5f, 0.5f};
                break;
        }
        begin(name, at, pivot);
    }
    Panel(const char* name, ImVec2 upper_left) { begin(name, upper_left, {0, 0}); }
    Panel(const Panel&) = delete;
    Panel& operator=(const Panel&) = delete;
    ~Panel() { ImGui::End(); }

    void line(const std::string& text) { ImGui::TextUnformatted(text.data(), text.data() + text.size()); }

    /// What it covers: as large as it was in the last frame.
    Box box() const {
        const ImVec2 at = ImGui::GetWindowPos();
        const ImVec2 size = ImGui::GetWindowSize();
        return {at.x, at.y, at.x + size.x, at.y + size.y};
    }

  private:
    void begin(const char* name, ImVec2 at, ImVec2 pivot) {
        ImGui::SetNextWindowPos(at, ImGuiCond_Always, pivot);
        ImGui::Begin(name, nullptr,
                     ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                         ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoSavedSettings |
                         ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav);
    }
};

std::string eye_text(geo::OrthometricHeight H, const lod::VerticalReference& vertical) {
    if (vertical.datum == lod::VerticalDatum::ellipsoid) return fmt::format("h {:.1f} m", H.m);
    return fmt::format("H {:.1f} m {}", H.m, vertical.name);
}

std::string tau_text(const HudContent& content) {
    if (!content.tau_reached_px) return fmt::format("tau {:.3g} px", content.view.tau_px);
    return fmt::format("tau {:.2f} px of {:.3g} by {}", *content.tau_reached_px, content.view.tau_px,
                       content.tau_limit);
}

Box view_panel(const HudContent& content) {
    const ViewState& view = content.view;
    Panel panel("view", Corner::upper_left);
    panel.line(place_text(view.place));
    panel.line(
        fmt::format("eye {}", eye_text(view.H, *content.vertical)) +
        (content.above_ground_m ? fmt::format(", {:.1f} m above ground", *content.above_ground_m) : ""));
    panel.line(fmt::format("heading {:.1f}\u00b0  pitch {:.1f}\u00b0", view.heading.value, view.pitch.value));
    panel.line(fmt::format("speed {:.{}f} m/s", content.speed_m_s, content.speed_m_s < 10 ? 1 : 0));
    ImGui::Separator();
    panel.line(fmt::format("{} triangles", content.triangles));
    panel.line(view.method == Method::full
                   ? std::string("full data")
                   : fmt::format("{}, morph {}", tau_text(content), view.morph ? "on" : "off"));
    panel.line(fmt::format("{:.1f} ms a frame", content.frame_ms));
    if (content.playing) panel.line("recorded flight; any key stops it");
    if (content.recording) panel.line("recording");
    if (content.following) panel.line("following the ground");
    if (content.pending > 0) panel.line(fmt::format("loading {}", content.pending));
    if (view.exaggeration != 1) panel.line(fmt::format("heights x {:.3g}", view.exaggeration));
    if (view.layer != Layer::hypsometric) panel.line(std::string(to_string(view.layer)));
    return panel.box();
}

Box cursor_panel(const HudContent& content) {
    Panel panel("cursor", Corner::bottom);
    if (!content.message.empty()) panel.line(content.message);
    if (!content.cursor) {
        panel.line("no ground under the cursor        F1: keys");
        return panel.box();
    }
    panel.line(fmt::format("{}   {}{}", place_text(content.cursor->place),
                           heights_text(*content.cursor, *content.vertical),
                           content.cursor_is_preview ? "   (preview: finer ground is coming)" : ""));
    return panel.box();
}

/// Says that the picture is not what was asked for, and why. Nothing where it is. Beside the view's panel and
/// short of the side panel and the compass where there is room for that, else below the view's panel.
std::optional<Box> banner(const HudContent& content, const Box& view) {
    std::string what;
    if (content.tau_reached_px)
        what = fmt::format("coarser than asked: {:.2f} px, not {:.3g}, by {}", *content.tau_reached_px,
                           content.view.tau_px, content.tau_limit);
    if (content.pending > 0)
        what += fmt::format("{}{} pieces of the ground are coming", what.empty() ? "not yet whole: " : "; ",
                            content.pending);
    if (what.empty()) return std::nullopt;
    const float letter = ImGui::GetFontSize();
    const float width = ImGui::CalcTextSize(what.c_str()).x + 2 * ImGui::GetStyle().WindowPadding.x;
    const float right = ImGui::GetIO().DisplaySize.x - content.panel_width - 6.5f * letter;
    const float beside = std::max(view.right + 0.5f * letter, 0.5f * (right - width));
    const bool fits = beside + width < right;
    Panel panel("banner", fits ? ImVec2(beside, view.top) : ImVec2(view.left, view.bottom + 0.5f * letter));
    panel.line(what);
    return panel.box();
}

void keys_panel() {
    ImGui::SetNextWindowBgAlpha(0.92f);
    Panel panel("keys", Corner::middle);
    ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit);
    for (const KeyHelp& key : key_list()) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(key.keys);
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(key.what);
    }
    ImGui::EndTable();
}

}  // namespace

std::string place_text(geo::LatLon place) {
    const double lon = geo::wrapped_180(place.lon).value;
    return fmt::format("{:.6f}\u00b0 {}  {:.6f}\u00b0 {}", std::abs(place.lat.value),
                       place.lat.value < 0 ? "S" : "N", std::abs(lon), lon < 0 ? "W" : "E");
}

std::string heights_text(const lod::PointMeasurement& point, const lod::VerticalReference& vertical) {
    if (point.kind == lod::PointClass::outside) return "outside the data";
    if (!point.H) return "no data (void)";
    const char* assumed = vertical.assumed ? " (assumed)" : "";
    if (vertical.datum == lod::VerticalDatum::ellipsoid) {
        return fmt::format("h {:.2f} m above the WGS 84 ellipsoid{}", point.H->m, assumed);
    }
    const std::string h =
        point.h ? fmt::format("h {:.2f} m", point.h->m) : std::string("h unknown: no geoid for it here");
    return fmt::format("H {:.2f} m {}{}   {}", point.H->m, vertical.name, assumed, h);
}

Covered draw_panels(const HudContent& content) {
    Covered covered;
    const Box view = view_panel(content);
    covered.add(view);
    covered.add(cursor_panel(content));
    if (const auto box = banner(content, view)) covered.add(*box);
    if (content.keys_shown) keys_panel();
    return covered;
}

}  // namespace relevo::viewer
