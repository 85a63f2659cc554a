#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

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

/// Letters along a line that falls to the right by some degrees: dark ones around light ones.
void turned_text(ImDrawList& list, ImVec2 middle, double degrees, const std::string& what) {
    const ImVec2 size = ImGui::CalcTextSize(what.c_str());
    const ImVec2 corner(middle.x - 0.5f * size.x, middle.y - 0.5f * size.y);
    const int first = list.VtxBuffer.Size;
    for (const ImVec2& by : {ImVec2(-1, 0), ImVec2(1, 0), ImVec2(0, -1), ImVec2(0, 1)})
        list.AddText({corner.x + by.x, corner.y + by.y}, kDark, what.c_str());
    list.AddText(corner, kLight, what.c_str());
    const double angle = degrees * 3.14159265358979 / 180;
    const auto cosine = static_cast<float>(std::cos(angle));
    const auto sine = static_cast<float>(std::sin(angle));
    for (int i = first; i < list.VtxBuffer.Size; ++i) {
        ImVec2& at = list.VtxBuffer[i].pos;
        const float x = at.x - middle.x;
        const float y = at.y - middle.y;
        at = {middle.x + x * cosine - y * sine, middle.y + x * sine + y * cosine};
    }
}

/// Upright ones are moved into the picture, as letters may be larger than who placed them knows; of two that
/// touch the first stays, and those that panels would cover are left out.
void map_labels(ImDrawList& list, const std::vector<MapLabel>& labels, float ui_per_px,
                const Covered& covered) {
    const ImVec2 picture = ImGui::GetIO().DisplaySize;
    const float margin = 0.4f * ImGui::GetFontSize();
    std::vector<std::pair<ImVec2, float>> drawn;  // their middles and half their widths
    for (const MapLabel& map_label : labels) {
        const ImVec2 size = ImGui::CalcTextSize(map_label.text.c_str());
        const float reach = 0.5f * size.x + margin;
        ImVec2 at(static_cast<float>(map_label.pixel.x) * ui_per_px,
                  static_cast<float>(map_label.pixel.y) * ui_per_px);
        if (map_label.angle == 0 && picture.x > 2 * reach) at.x = std::clamp(at.x, reach, picture.x - reach);
        const bool touches = std::any_of(drawn.begin(), drawn.end(), [&](const auto& other) {
            return std::abs(other.first.x - at.x) < other.second + reach &&
                   std::abs(other.first.y - at.y) < 1.3f * size.y;
        });
        const float rise = std::abs(std::sin(static_cast<float>(map_label.angle) * 0.0174533f));
        const float height = 0.5f * size.y + rise * reach;
        if (touches || covered.touches({at.x - reach, at.y - height, at.x + reach, at.y + height})) continue;
        drawn.emplace_back(at, reach);
        turned_text(list, at, map_label.angle, map_label.text);
    }
}

/// The layer's colours with their values, in the lower left corner: as high as panels leave room for, which
/// it then covers itself.
void legend_bar(ImDrawList& list, const Legend& legend, Covered& covered) {
    const float letter = ImGui::GetFontSize();
    const float width = 0.9f * letter;
    const float left = 0.8f * letter;
    const float bottom = ImGui::GetIO().DisplaySize.y - 4 * letter;
    Box plate{left - 0.3f * letter, bottom - 12.8f * letter, left + 6.2f * letter, bottom + 0.6f * letter};
    plate.top = plate.bottom - covered.height_free(plate);
    const float height = bottom - plate.top - 1.8f * letter;
    if (height < 4 * letter) return;  // its numbers would touch
    covered.add(plate);
    list.AddRectFilled({plate.left, plate.top}, {plate.right, plate.bottom}, IM_COL32(13, 15, 20, 215), 4);
    const std::size_t steps = legend.colours.size();
    for (std::size_t i = 0; i < steps; ++i) {
        const auto& c = legend.colours[i];
        const float low = bottom - height * static_cast<float>(i) / static_cast<float>(steps);
        const float high = bottom - height * static_cast<float>(i + 1) / static_cast<float>(steps);
        list.AddRectFilled({left, high}, {left + width, low}, IM_COL32(c[0], c[1], c[2], 255));
    }
    for (const Legend::Mark& mark : legend.marks) {
        const float y = bottom - height * static_cast<float>(mark.at);
        list.AddLine({left + width, y}, {left + width + 4, y}, kLight, 1.5f);
        list.AddText({left + width + 7, y - 0.5f * letter}, kLight, mark.text.c_str());
    }
    const std::string title = legend.title + (legend.unit.empty() ? "" : ", " + legend.unit);
    list.AddText({left, bottom - height - 1.6f * letter}, kLight, title.c_str());
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
            label(list, {at->x, at->y - 1.3f * letter}, fmt::format("{}", i + 1));
    }
    if (shape.label.empty() || shape.line.empty()) return;
    const std::size_t middle = shape.vertices.size() > 1 ? shape.line.size() / 2 : 0;
    if (const auto at = place(middle)) label(list, {at->x, at->y - 1.3f * letter}, shape.label);
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
    compass(list, content.view.heading, content.panel_width);
    Covered covered = content.covered;
    if (content.legend) legend_bar(list, *content.legend, covered);
    map_labels(list, content.labels, ui_per_px, covered);
    if (content.middle_distance_m)
        scale_bar(list, *content.middle_distance_m, view, ui_per_px, content.panel_width);
}

}  // namespace relevo::viewer
