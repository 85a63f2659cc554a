#include "viewer/ui/map_marks.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <imgui.h>

namespace relevo::viewer {

namespace {

constexpr ImU32 kDark = IM_COL32(10, 12, 16, 200);
constexpr ImU32 kPlate = IM_COL32(13, 15, 20, 215);
constexpr ImU32 kLight = IM_COL32(255, 255, 255, 255);
constexpr ImU32 kNorth = IM_COL32(235, 64, 52, 255);

/// Dark letters around light ones, along a line that falls to the right by some degrees.
void rimmed_text(ImDrawList& list, const ImVec2& middle, double degrees, const std::string& what) {
    const ImVec2 size = ImGui::CalcTextSize(what.c_str());
    const ImVec2 corner(middle.x - 0.5f * size.x, middle.y - 0.5f * size.y);
    const int first = list.VtxBuffer.Size;
    for (const ImVec2& by : {ImVec2(-1, 0), ImVec2(1, 0), ImVec2(0, -1), ImVec2(0, 1), ImVec2(-0.7f, -0.7f),
                             ImVec2(0.7f, -0.7f), ImVec2(-0.7f, 0.7f), ImVec2(0.7f, 0.7f)})
        list.AddText({corner.x + by.x, corner.y + by.y}, kDark, what.c_str());
    list.AddText(corner, kLight, what.c_str());
    if (degrees == 0) return;
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

void plate(ImDrawList& list, const Box& box) {
    list.AddRectFilled({box.left, box.top}, {box.right, box.bottom}, kPlate, 4);
}

/// Upright ones are moved into the picture, as letters may be larger than who placed them knows; of two that
/// touch the first stays, and none lies on what is covered.
void map_labels(ImDrawList& list, const std::vector<MapLabel>& labels, float units_per_px,
                const Covered& covered) {
    const ImVec2 picture = ImGui::GetIO().DisplaySize;
    const float margin = 0.4f * ImGui::GetFontSize();
    std::vector<std::pair<ImVec2, float>> drawn;  // their middles and half their widths
    for (const MapLabel& map_label : labels) {
        const ImVec2 size = ImGui::CalcTextSize(map_label.text.c_str());
        const float reach = 0.5f * size.x + margin;
        ImVec2 at(static_cast<float>(map_label.pixel.x) * units_per_px,
                  static_cast<float>(map_label.pixel.y) * units_per_px);
        if (map_label.angle == 0 && picture.x > 2 * reach) at.x = std::clamp(at.x, reach, picture.x - reach);
        const bool touches = std::any_of(drawn.begin(), drawn.end(), [&](const auto& other) {
            return std::abs(other.first.x - at.x) < other.second + reach &&
                   std::abs(other.first.y - at.y) < 1.3f * size.y;
        });
        const float rise = std::abs(std::sin(static_cast<float>(map_label.angle) * 0.0174533f));
        const float half_height = 0.6f * size.y + rise * reach;
        if (touches || covered.touches({at.x - reach, at.y - half_height, at.x + reach, at.y + half_height}))
            continue;
        drawn.emplace_back(at, reach);
        rimmed_text(list, at, map_label.angle, map_label.text);
    }
}

void legend_bar(ImDrawList& list, const Legend& legend, const MarkMargins& margins, Covered& covered) {
    constexpr std::size_t kSteps = 256;
    const float letter = ImGui::GetFontSize();
    const float width = 0.9f * letter;
    const float left = 0.8f * letter;
    const float bottom = ImGui::GetIO().DisplaySize.y - margins.bottom - 1.2f * letter;
    const std::string title = legend.title + (legend.unit.empty() ? "" : ", " + legend.unit);
    float text_width = ImGui::CalcTextSize(title.c_str()).x;
    for (const Legend::Mark& mark : legend.marks)
        text_width = std::max(text_width, width + 7 + ImGui::CalcTextSize(mark.text.c_str()).x);
    Box box{left - 0.4f * letter, bottom - 13 * letter, left + text_width + 0.4f * letter,
            bottom + 0.8f * letter};
    box.top = box.bottom - covered.height_free(box);
    const float height = bottom - box.top - 2 * letter;
    if (height < 4 * letter) return;  // its numbers would touch
    covered.add(box);
    plate(list, box);
    for (std::size_t i = 0; i < kSteps; ++i) {
        const auto& c = legend.colours[i * (legend.colours.size() - 1) / (kSteps - 1)];
        const float low = bottom - height * static_cast<float>(i) / kSteps;
        const float high = bottom - height * static_cast<float>(i + 1) / kSteps;
        list.AddRectFilled({left, high}, {left + width, low}, IM_COL32(c[0], c[1], c[2], 255));
    }
    for (const Legend::Mark& mark : legend.marks) {
        const float y = bottom - height * static_cast<float>(mark.at);
        list.AddLine({left + width, y}, {left + width + 4, y}, kLight, 1.5f);
        list.AddText({left + width + 7, y - 0.5f * letter}, kLight, mark.text.c_str());
    }
    list.AddText({left, bottom - height - 1.75f * letter}, kLight, title.c_str());
}

void compass(ImDrawList& list, geo::Degrees up, const MarkMargins& margins, Covered& covered) {
    const float letter = ImGui::GetFontSize();
    const float radius = 2.2f * letter;
    const ImVec2 middle(ImGui::GetIO().DisplaySize.x - margins.right - radius - letter,
                        margins.top + radius + letter);
    const auto at = [&](double degrees, float part) {
        const double angle = (degrees - up.value) * 3.14159265358979 / 180;
        return ImVec2(middle.x + part * radius * static_cast<float>(std::sin(angle)),
                      middle.y - part * radius * static_cast<float>(std::cos(angle)));
    };
    list.AddCircleFilled(middle, radius + 1, kPlate, 64);
    list.AddCircle(middle, radius, kLight, 64, 1.5f);
    for (int tick = 0; tick < 360; tick += 30) list.AddLine(at(tick, 0.9f), at(tick, 1), kLight, 1.5f);
    list.AddTriangleFilled(at(0, 0.62f), at(90, 0.14f), at(-90, 0.14f), kNorth);
    list.AddTriangleFilled(at(180, 0.62f), at(-90, 0.14f), at(90, 0.14f), kLight);
    draw_mark_text(list, at(0, 0.78f), "N");
    draw_mark_text(list, {middle.x, middle.y + radius + 0.8f * letter},
                   fmt::format("{:03.0f}\u00b0", std::fmod(std::round(up.value), 360)));
    covered.add({middle.x - radius, middle.y - radius, middle.x + radius, middle.y + radius + 1.5f * letter});
}

void bar(ImDrawList& list, const ScaleBar& scale, float units_per_px, const MarkMargins& margins,
         Covered& covered) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float letter = ImGui::GetFontSize();
    const auto length = static_cast<float>(scale.length_px) * units_per_px;
    const std::string metres = scale.metres < 1000 ? fmt::format("{:g} m", scale.metres)
                                                   : fmt::format("{:g} km", scale.metres / 1000);
    const double km = scale.distance_m / 1000;
    const std::string where =
        km < 1 ? fmt::format("at {:.0f} m", scale.distance_m) : fmt::format("at {:.3g} km", km);
    const float text_width =
        std::max(ImGui::CalcTextSize(metres.c_str()).x, ImGui::CalcTextSize(where.c_str()).x);
    const float half = 0.5f * std::max(length, text_width);
    const ImVec2 middle(size.x - margins.right - 1.5f * letter - half,
                        size.y - margins.bottom - 2.2f * letter);
    const Box box{middle.x - half - 0.7f * letter, middle.y - 1.6f * letter, middle.x + half + 0.7f * letter,
                  middle.y + 1.6f * letter};
    covered.add(box);
    plate(list, box);
    const float left = middle.x - 0.5f * length;
    const float right = middle.x + 0.5f * length;
    list.AddLine({left, middle.y}, {right, middle.y}, kLight, 2);
    // Their outer edges are the bar's ends.
    list.AddRectFilled({left, middle.y - 5}, {left + 2, middle.y + 5}, kLight);
    list.AddRectFilled({right - 2, middle.y - 5}, {right, middle.y + 5}, kLight);
    draw_mark_text(list, {middle.x, middle.y - 0.9f * letter}, metres);
    draw_mark_text(list, {middle.x, middle.y + 0.9f * letter}, where);
}

}  // namespace

geo::Degrees up_azimuth(const lod::View& view) {
    const lod::Camera& camera = view.camera();
    const geo::EnuFrame here(camera.eye);
    const double east = glm::dot(view.right(), here.east());
    const double north = glm::dot(view.right(), here.north());
    if (std::hypot(east, north) < 0.1) return geo::wrapped_360(camera.heading);  // the head lies on its side
    return geo::wrapped_360(geo::Degrees::from_radians(std::atan2(east, north)) - geo::Degrees{90});
}

void draw_mark_text(ImDrawList& list, const ImVec2& middle, const std::string& what) {
    const ImVec2 size = ImGui::CalcTextSize(what.c_str());
    rimmed_text(list,
                {std::round(middle.x - 0.5f * size.x) + 0.5f * size.x,
                 std::round(middle.y - 0.5f * size.y) + 0.5f * size.y},
                0, what);
}

void draw_mark_plate(ImDrawList& list, const ImVec2& middle, const std::string& what) {
    const ImVec2 size = ImGui::CalcTextSize(what.c_str());
    const float margin = 0.3f * ImGui::GetFontSize();
    list.AddRectFilled({middle.x - 0.5f * size.x - margin, middle.y - 0.5f * size.y},
                       {middle.x + 0.5f * size.x + margin, middle.y + 0.5f * size.y}, kDark, margin);
    draw_mark_text(list, middle, what);
}

void draw_map_marks(ImDrawList& list, const MapMarks& marks, const lod::View& view, float units_per_px,
                    const MarkMargins& margins, Covered covered) {
    if (marks.north) compass(list, up_azimuth(view), margins, covered);
    if (marks.legend) legend_bar(list, *marks.legend, margins, covered);
    if (marks.scale) bar(list, *marks.scale, units_per_px, margins, covered);
    map_labels(list, marks.labels, units_per_px, covered);
}

}  // namespace relevo::viewer
