#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "viewer/ui/hud.hpp"

namespace relevo::viewer {

namespace {

// Dark under light, so that marks read on snow and in shadow.
constexpr ImU32 kDark = IM_COL32(10, 12, 16, 200);
constexpr ImU32 kLight = IM_COL32(255, 255, 255, 255);
constexpr ImU32 kNorth = IM_COL32(235, 64, 52, 255);
constexpr ImU32 kMeasure = IM_COL32(255, 214, 10, 255);

void text(ImDrawList& list, ImVec2 middle, const std::string& what) {
    const ImVec2 size = ImGui::CalcTextSize(what.c_str());
    const ImVec2 at(std::round(middle.x - 0.5f * size.x), std::round(middle.y - 0.5f * size.y));
    list.AddText({at.x + 1, at.y + 1}, kDark, what.c_str());
    list.AddText(at, kLight, what.c_str());
}

/// On a dark plate: over the ground there is no telling what is below.
void label(ImDrawList& list, ImVec2 middle, const std::string& what) {
    const ImVec2 size = ImGui::CalcTextSize(what.c_str());
    const float margin = 0.3f * ImGui::GetFontSize();
    list.AddRectFilled({middle.x - 0.5f * size.x - margin, middle.y - 0.5f * size.y},
                       {middle.x + 0.5f * size.x + margin, middle.y + 0.5f * size.y}, kDark, margin);
    text(list, middle, what);
}

/// A rose in the upper right corner: its needle points north, up is where the eye looks.
void compass(ImDrawList& list, geo::Degrees heading, float panel_width) {
    const float letter = ImGui::GetFontSize();
    const float radius = 2.2f * letter;
    const float toolbar = ImGui::GetFrameHeightWithSpacing() + ImGui::GetStyle().WindowPadding.y;
    const ImVec2 middle(ImGui::GetIO().DisplaySize.x - panel_width - radius - letter,
                        toolbar + radius + letter);
    list.AddCircleFilled(middle, radius, IM_COL32(13, 15, 20, 150), 48);
    list.AddCircle(middle, radius, kLight, 48, 1.5f);
    const auto at = [&](double degrees, float part) {
        const double angle = (degrees - heading.value) * 3.14159265358979 / 180;
        return ImVec2(middle.x + part * radius * static_cast<float>(std::sin(angle)),
                      middle.y - part * radius * static_cast<float>(std::cos(angle)));
    };
    for (int tick = 0; tick < 360; tick += 30) list.AddLine(at(tick, 0.9f), at(tick, 1), kLight, 1.5f);
    list.AddTriangleFilled(at(0, 0.62f), at(90, 0.14f), at(-90, 0.14f), kNorth);
    list.AddTriangleFilled(at(180, 0.62f), at(-90, 0.14f), at(90, 0.14f), kLight);
    text(list, at(0, 0.78f), "N");
    text(list, {middle.x, middle.y + radius + 0.7f * letter},
         fmt::format("{:03.0f}\u00b0", std::fmod(std::round(heading.value), 360)));
}

/// The largest of 1, 2, 5, 10, ... that is no more than this.
double round_length(double most) {
    const double power = std::pow(10.0, std::floor(std::log10(most)));
    for (const double step : {5.0, 2.0}) {
        if (step * power <= most) return step * power;
    }
    return power;
}

/// A bar as long as that many metres across the view at the distance of the picture's middle.
void scale_bar(ImDrawList& list, double distance_m, const lod::View& view, float ui_per_px,
               float panel_width) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float letter = ImGui::GetFontSize();
    const double metres_per_ui = distance_m / (view.focal_px() * static_cast<double>(ui_per_px));
    const double metres = round_length(metres_per_ui * 0.22 * static_cast<double>(size.x));
    const auto length = static_cast<float>(metres / metres_per_ui);
    const float right = size.x - panel_width - letter;
    const float y = size.y - 6.5f * letter;
    for (const auto& [colour, width] : {std::pair(kDark, 5.0f), std::pair(kLight, 2.0f)}) {
        list.AddLine({right - length, y}, {right, y}, colour, width);
        for (const float x : {right - length, right}) list.AddLine({x, y - 5}, {x, y + 5}, colour, width);
    }
    const std::string what =
        metres < 1000 ? fmt::format("{:g} m", metres) : fmt::format("{:g} km", metres / 1000);
    text(list, {right - 0.5f * length, y - 0.9f * letter}, what);
    const double km = distance_m / 1000;
    text(list, {right - 0.5f * length, y + 0.9f * letter},
         km < 1 ? fmt::format("at {:.0f} m", distance_m) : fmt::format("at {:.3g} km", km));
}

void ruler_marks(ImDrawList& list, const Ruler& ruler, const std::vector<geo::Ecef>& line,
                 const lod::View& view, float ui_per_px) {
    // A point behind the eye has no place in the picture: the line has gaps there.
    const auto in_picture = [&](const geo::Ecef& position) -> std::optional<ImVec2> {
        const glm::dvec3 offset = position - view.eye();
        if (!(view.depth(offset) > lod::View::kNearM)) return std::nullopt;
        const glm::dvec2 pixel = view.pixel(offset);
        if (std::abs(pixel.x) > 1e5 || std::abs(pixel.y) > 1e5) return std::nullopt;
        return ImVec2(static_cast<float>(pixel.x) * ui_per_px, static_cast<float>(pixel.y) * ui_per_px);
    };
    if (line.empty()) return;
    for (const auto& [colour, width] : {std::pair(kDark, 5.0f), std::pair(kMeasure, 2.5f)}) {
        for (std::size_t i = 1; i < line.size(); ++i) {
            const auto from = in_picture(line[i - 1]);
            const auto to = in_picture(line[i]);
            if (from && to) list.AddLine(*from, *to, colour, width);
        }
    }
    const std::size_t ends = ruler.points().size();
    for (std::size_t i = 0; i < ends; ++i) {
        const auto at = in_picture(i == 0 ? line.front() : line.back());
        if (!at) continue;
        list.AddCircleFilled(*at, 7, kDark);
        list.AddCircleFilled(*at, 5, kMeasure);
        label(list, {at->x, at->y - 1.3f * ImGui::GetFontSize()}, fmt::format("{}", i + 1));
    }
    if (const auto measured = ruler.line()) {
        if (const auto at = in_picture(line[line.size() / 2])) {
            label(list, {at->x, at->y - 1.3f * ImGui::GetFontSize()}, length_text(measured->length_m));
        }
    }
}

}  // namespace

void draw_marks(const HudContent& content, const Ruler& ruler, const std::vector<geo::Ecef>& ruler_line,
                const lod::View& view) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const float ui_per_px = ImGui::GetIO().DisplaySize.x / static_cast<float>(view.camera().width);
    ruler_marks(list, ruler, ruler_line, view, ui_per_px);
    compass(list, content.view.heading, content.panel_width);
    if (content.middle_distance_m)
        scale_bar(list, *content.middle_distance_m, view, ui_per_px, content.panel_width);
}

}  // namespace relevo::viewer
