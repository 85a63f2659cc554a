#include "viewer/ui/measure_panel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

namespace relevo::viewer {

namespace {

/// Heights over the distance along a path, as wide as the window. Gaps stay gaps.
std::optional<double> draw_profile(const std::vector<lod::ProfileSample>& samples,
                                   const std::optional<double>& marked_m) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const lod::ProfileSample& sample : samples) {
        if (!sample.H_m) continue;
        low = std::min(low, *sample.H_m);
        high = std::max(high, *sample.H_m);
    }
    if (!(low <= high)) {
        ImGui::TextUnformatted("no heights along it");
        return std::nullopt;
    }
    const float letter = ImGui::GetFontSize();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 size(ImGui::GetContentRegionAvail().x, 9 * letter);
    ImGui::InvisibleButton("profile", size);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImU32 ink = ImGui::GetColorU32(ImGuiCol_Text);
    const ImU32 faint = ImGui::GetColorU32(ImGuiCol_TextDisabled);
    const ImU32 line = ImGui::GetColorU32(ImGuiCol_PlotHistogram);
    list.AddRectFilled(corner, {corner.x + size.x, corner.y + size.y}, ImGui::GetColorU32(ImGuiCol_FrameBg));

    const double length = std::max(samples.back().distance_m, 1e-9);
    const double span = std::max(high - low, 1e-3);
    const float margin = 1.1f * letter;
    const auto at = [&](double distance, double H) {
        return ImVec2(
            corner.x + static_cast<float>(distance / length) * size.x,
            corner.y + size.y - margin - static_cast<float>((H - low) / span) * (size.y - 2 * margin));
    };
    for (std::size_t i = 1; i < samples.size(); ++i) {
        const lod::ProfileSample& a = samples[i - 1];
        const lod::ProfileSample& b = samples[i];
        if (a.H_m && b.H_m) list.AddLine(at(a.distance_m, *a.H_m), at(b.distance_m, *b.H_m), line, 1.5f);
    }
    list.AddText({corner.x + 3, corner.y}, faint, fmt::format("{:.1f} m", high).c_str());
    list.AddText({corner.x + 3, corner.y + size.y - letter}, faint, fmt::format("{:.1f} m", low).c_str());

    std::optional<double> under_cursor;
    if (ImGui::IsItemHovered())
        under_cursor = length * static_cast<double>((ImGui::GetIO().MousePos.x - corner.x) / size.x);
    const std::optional<double> shown = under_cursor ? under_cursor : marked_m;
    if (!shown) {
        ImGui::TextDisabled("what the cursor is at");
        return under_cursor;
    }
    const auto after = std::lower_bound(
        samples.begin(), samples.end(), *shown,
        [](const lod::ProfileSample& sample, double distance) { return sample.distance_m < distance; });
    const lod::ProfileSample& sample = after == samples.end() ? samples.back() : *after;
    const float x = at(*shown, low).x;
    list.AddLine({x, corner.y}, {x, corner.y + size.y}, ink, 1);
    ImGui::TextUnformatted(
        fmt::format("after {:.0f} m: {}", *shown,
                    sample.H_m ? fmt::format("H {:.1f} m", *sample.H_m) : std::string("no height"))
            .c_str());
    return under_cursor;
}

/// What a shape depends on besides its places, where it has become something else.
std::optional<MeasureChoices> draw_choices(const Ui& ui, NumberBox& numbers, const Shape& shape,
                                           const ShapeResult* result) {
    MeasureChoices choices = shape.choices;
    bool changed = false;
    if (shape.tool == Tool::area) {
        using Kind = lod::Plane::Kind;
        ImGui::TextDisabled("volume above and below its");
        for (const Kind kind : {Kind::lowest, Kind::border, Kind::mean}) {
            if (ImGui::RadioButton(lod::to_string(lod::Plane{kind, 0}).c_str(), choices.plane.kind == kind)) {
                choices.plane.kind = kind;
                changed = true;
            }
            ImGui::SameLine();
        }
        ImGui::NewLine();
        if (ImGui::RadioButton("at", choices.plane.kind == Kind::given)) {
            choices.plane.kind = Kind::given;
            if (result != nullptr) choices.plane.H_m = result->json.value("plane_H_m", choices.plane.H_m);
            changed = true;
        }
        ImGui::SameLine();
        if (numbers.draw(ui, "m H", choices.plane.H_m, -1e5, 1e5)) {
            choices.plane.kind = Kind::given;
            changed = true;
        }
    }
    if (shape.tool == Tool::sight || shape.tool == Tool::viewshed) {
        lod::Looking& looking = choices.looking;
        changed |= numbers.draw(ui, "m, eye's height", looking.eye_height_m, 0, 1e5);
        changed |= numbers.draw(ui, "m, target's height", looking.target_height_m, 0, 1e5);
        changed |= numbers.draw(ui, "refraction", looking.refraction, -1, 0.99);
    }
    if (shape.tool == Tool::viewshed) changed |= numbers.draw(ui, "m, radius", choices.radius_m, 1, 1e6);
    if (!changed || choices == shape.choices) return std::nullopt;
    return choices;
}

/// How far the measuring of a shape is, with a way to stop it.
void draw_progress(ShapeResults& results, const Shape& shape) {
    const auto progress = results.progress(shape);
    if (!progress) {
        ImGui::TextDisabled("%s", is_measurable(shape) ? "to be measured" : "click on");
        return;
    }
    const auto done = static_cast<float>(*progress);
    ImGui::ProgressBar(done, {-5 * ImGui::GetFontSize(), 0}, fmt::format("{:.0f} %", 100 * done).c_str());
    ImGui::SameLine();
    if (ImGui::Button("Stop")) results.cancel();
}

}  // namespace

std::optional<double> draw_measure_panel(const Ui& ui, Measuring& measuring, NumberBox& numbers,
                                         const std::optional<double>& marked_m, std::vector<Wish>& wishes) {
    MeasureTool& tool = measuring.tool();
    if (tool.shapes().empty()) {
        ImGui::TextWrapped(
            "Click on the ground: F2 a point, F3 a line, F4 a path, F5 an area, F6 a line of sight, F7 a "
            "viewshed.");
        return std::nullopt;
    }
    std::optional<std::size_t> gone;
    for (std::size_t i = 0; i < tool.shapes().size(); ++i) {
        const Shape& shape = tool.shapes()[i];
        ImGui::PushID(static_cast<int>(i));
        const bool current = tool.current() == i;
        if (ImGui::RadioButton("##current", current)) tool.select(i);
        ImGui::SameLine();
        ImGui::SetNextItemWidth(-2.2f * ImGui::GetFontSize());
        std::string name = shape.measurement.name;
        if (ImGui::InputText("##name", &name, ImGuiInputTextFlags_EnterReturnsTrue)) tool.rename(i, name);
        ImGui::SameLine();
        if (ImGui::Button("x")) gone = i;
        ImGui::PopID();
    }
    if (gone) tool.delete_shape(*gone);
    if (ImGui::Button("Undo")) wishes.push_back({Command::undo, {}});
    ImGui::SameLine();
    if (ImGui::Button("Finish")) wishes.push_back({Command::finish_shape, {}});
    ImGui::SameLine();
    if (ImGui::Button("Save")) wishes.push_back({Command::save_measurements, {}});
    ImGui::Separator();
    if (!tool.current()) return std::nullopt;
    const Shape& shape = tool.shapes()[*tool.current()];
    const ShapeResult* result = measuring.results().find(shape);
    if (const auto chosen = draw_choices(ui, numbers, shape, result)) {
        tool.choose(*tool.current(), *chosen);
        return std::nullopt;  // from the next frame on it is measured
    }
    if (result == nullptr) {
        draw_progress(measuring.results(), shape);
        return std::nullopt;
    }
    if (result->stopped) {
        ImGui::TextDisabled("stopped");
        ImGui::SameLine();
        if (ImGui::Button("Measure")) measuring.results().forget(shape);
        return std::nullopt;
    }
    for (const std::string& line : result->lines) ImGui::TextWrapped("%s", line.c_str());
    if (result->viewshed) {
        ImGui::TextDisabled("green: seen; dark: hidden; yellow: unknown");
        if (ImGui::Button("Save as GeoTIFF (Ctrl Shift S)")) wishes.push_back({Command::save_viewshed, {}});
    }
    if (!result->profile || result->profile->samples.size() < 2) return std::nullopt;
    return draw_profile(result->profile->samples, marked_m);
}

}  // namespace relevo::viewer
