#define GLFW_INCLUDE_NONE  // keys alone
#include "viewer/ui/panels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "viewer/ui/layer_panel.hpp"
#include "viewer/ui/measure_panel.hpp"

namespace relevo::viewer {

namespace {

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoFocusOnAppearing;

void hint(const char* text) {
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", text);
}

/// A button that shows whether what it stands for is on.
bool tool_button(const char* name, bool on, const char* what) {
    if (on) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
    const bool pressed = ImGui::Button(name);
    if (on) ImGui::PopStyleColor();
    hint(what);
    ImGui::SameLine();
    return pressed;
}

const char* use_name(FileUse use) {
    switch (use) {
        case FileUse::elevation:
            return "heights, for a scene of its own";
        case FileUse::imagery:
            return "a picture over the ground";
        case FileUse::vectors:
            return "lines and points over the ground";
        case FileUse::measurements:
            break;
    }
    return "measurements, to be measured here";
}

void drawing(ViewState& view) {
    static constexpr std::array<std::pair<Layer, const char*>, 6> kLayers{{{Layer::hypsometric, "tints"},
                                                                           {Layer::hillshade, "hillshade"},
                                                                           {Layer::slope, "slope"},
                                                                           {Layer::aspect, "aspect"},
                                                                           {Layer::terrain, "terrain"},
                                                                           {Layer::lod, "levels"}}};
    for (std::size_t i = 0; i < kLayers.size(); ++i) {
        if (i % 3 != 0) ImGui::SameLine();
        if (ImGui::RadioButton(kLayers[i].second, view.layer == kLayers[i].first))
            view.layer = kLayers[i].first;
    }
    auto shading = static_cast<int>(view.shading);
    if (ImGui::Combo("light", &shading, "one sun\0multidirectional\0oblique\0combined\0"))
        view.shading = static_cast<Shading>(shading);
    hint("Of tints, hillshade and levels: from the sun, from four sides, or with the slope");
    ImGui::Checkbox("mesh", &view.wireframe);
    ImGui::SameLine();
    ImGui::Checkbox("morph", &view.morph);
    auto tau = static_cast<float>(view.tau_px);
    if (ImGui::SliderFloat("tau", &tau, 0.125f, 64, "%.3g px", ImGuiSliderFlags_Logarithmic))
        view.tau_px = static_cast<double>(tau);
    hint("No point of the picture is farther off than this.");
    auto times = static_cast<float>(view.exaggeration);
    if (ImGui::SliderFloat("heights x", &times, 0.25f, 16, "%.3g", ImGuiSliderFlags_Logarithmic))
        view.exaggeration = static_cast<double>(times);
    hint("Of the picture alone: what is measured stays true.");
    ImGui::Checkbox("haze", &view.haze.on);
    if (view.haze.on) {
        auto km = static_cast<float>(view.haze.visibility_km);
        ImGui::SameLine();
        if (ImGui::SliderFloat("##visibility", &km, 1, 2000, "seen %.4g km far",
                               ImGuiSliderFlags_Logarithmic))
            view.haze.visibility_km = std::max(static_cast<double>(km), 0.05);
        hint("How far a dark thing is just seen at the sea's level");
    }
    bool ocean = view.ocean.kind != OceanKind::off;
    if (ImGui::Checkbox("sea with waves", &ocean))
        view.ocean.kind = ocean ? OceanKind::automatic : OceanKind::off;
}

void mark_choices(Marks& marks) {
    ImGui::Separator();
    ImGui::TextDisabled("On large pictures (Ctrl P)");
    ImGui::Checkbox("legend", &marks.legend);
    ImGui::SameLine();
    ImGui::Checkbox("scale", &marks.scale);
    ImGui::SameLine();
    ImGui::Checkbox("north", &marks.north);
    ImGui::SameLine();
    ImGui::Checkbox("labels", &marks.labels);
}

}  // namespace

void Panels::sun(const Ui& ui, ViewState& view) {
    if (!ImGui::IsAnyItemActive()) sun_text_ = view.sun.text;
    ImGui::SetNextItemWidth(-ImGui::CalcTextSize("sun  ").x);
    const bool entered = ImGui::InputText("sun", &sun_text_, ImGuiInputTextFlags_EnterReturnsTrue);
    if (entered || ui.entered()) {
        const auto read = parse_sun(sun_text_);
        sun_fault_ = read ? "" : read.error().message;
        if (read) view.sun = *read;
    }
    hint("auto, AZIMUTH,ELEVATION or a time such as 2026-06-21T12:00:00Z; Enter");
    if (!sun_fault_.empty()) ImGui::TextWrapped("%s", sun_fault_.c_str());
}

bool Panels::close() {
    const bool was_open = go_to_shown_ || chooser_.shown() || keys_shown || !asked_file_.empty();
    asked_file_.clear();
    go_to_shown_ = keys_shown = false;
    chooser_.hide();
    return was_open;
}

float Panels::panel_width(const Desk& desk) const {
    if (!desk.panel_shown()) return 0;
    return std::min(20 * ImGui::GetFontSize(), 0.45f * ImGui::GetIO().DisplaySize.x);
}

Box Panels::side_box(const Desk& desk) const {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float letter = ImGui::GetFontSize();
    // The line at the bottom is left free.
    return {size.x - panel_width(desk), ImGui::GetFrameHeightWithSpacing() + letter, size.x,
            size.y - 4.2f * letter};
}

void Panels::add_covered(const Desk& desk, Covered& covered) const {
    covered.add({0, 0, ImGui::GetIO().DisplaySize.x,
                 ImGui::GetFrameHeightWithSpacing() + 2 * ImGui::GetStyle().WindowPadding.y});
    if (desk.panel_shown()) covered.add(side_box(desk));
}

void Panels::toolbar(Desk& desk, const HudContent& content, std::vector<Wish>& wishes) {
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize({ImGui::GetIO().DisplaySize.x, 0});
    ImGui::Begin("tools", nullptr, kFixed | ImGuiWindowFlags_AlwaysAutoResize);
    const auto button = [&](const char* name, Command command, const char* what, bool on = false) {
        if (tool_button(name, on, what)) wishes.push_back({command, {}});
    };
    button("Open", Command::open_file, "A scene, heights, a picture, lines or measurements (Ctrl O)");
    button("Go to", Command::go_to, "Coordinates in any form, or a view (G)");
    button("Whole", Command::whole_scene, "The whole scene (Home)");
    ImGui::TextDisabled("|");
    ImGui::SameLine();
    for (const auto& [name, command, what, on] : content.tools) button(name, command, what, on);
    ImGui::TextDisabled("|");
    ImGui::SameLine();
    button("Picture", Command::screenshot, "A screenshot (P); Ctrl P: four times as wide");
    button("Panel", Command::show_panel, "Layers, results, places (Tab)", desk.panel_shown());
    button("Keys", Command::show_keys, "All keys (F1)", keys_shown);
    ImGui::NewLine();
    ImGui::End();
}

void Panels::places(Desk& desk, const std::string& scene, KeyFrames& frames, std::vector<Wish>& wishes) {
    std::vector<Bookmark>& marks = desk.settings().bookmarks;
    ImGui::TextDisabled("Bookmarks");
    if (ImGui::Button("Add this view (B)")) wishes.push_back({Command::add_bookmark, {}});
    int gone = -1;
    for (std::size_t i = 0; i < marks.size(); ++i) {
        if (marks[i].scene != scene) continue;
        ImGui::PushID(static_cast<int>(i));
        if (ImGui::Button("go")) wishes.push_back({Command::paste_view, marks[i].view});
        ImGui::SameLine();
        ImGui::SetNextItemWidth(-3 * ImGui::GetFontSize());
        ImGui::InputText("##name", &marks[i].name);
        if (ImGui::IsItemDeactivatedAfterEdit()) desk.save();
        ImGui::SameLine();
        if (ImGui::Button("x")) gone = static_cast<int>(i);
        ImGui::PopID();
    }
    if (gone >= 0) {
        marks.erase(marks.begin() + gone);
        desk.save();
    }
    ImGui::Separator();
    ImGui::TextDisabled("A path by key frames");
    if (ImGui::Button("Add this view (K)")) wishes.push_back({Command::add_key_frame, {}});
    ImGui::SameLine();
    ImGui::Text("%d", static_cast<int>(frames.keys.size()));
    auto seconds = static_cast<float>(frames.seconds_between);
    if (ImGui::SliderFloat("s apart", &seconds, 0.5f, 30, "%.1f"))
        frames.seconds_between = static_cast<double>(seconds);
    if (ImGui::Button("Play (Shift K)")) wishes.push_back({Command::play_key_frames, {}});
    ImGui::SameLine();
    if (ImGui::Button("Clear")) frames.keys.clear();
}

void Panels::side_panel(Desk& desk, ViewState& view, const HudContent& content, const std::string& scene,
                        KeyFrames& frames, Measuring& measuring, GroundLayers& layers,
                        const std::optional<double>& line_m, std::optional<double>& plot_m,
                        std::vector<Wish>& wishes) {
    const Box box = side_box(desk);
    ImGui::SetNextWindowPos({box.left, box.top});
    ImGui::SetNextWindowSize({box.right - box.left, box.bottom - box.top});
    ImGui::Begin("panel", nullptr, kFixed & ~ImGuiWindowFlags_NoScrollbar);
    if (ImGui::BeginTabBar("tabs")) {
        if (ImGui::BeginTabItem("Layers")) {
            drawing(view);
            sun(desk.ui(), view);
            draw_layer_list(view.overlays, layers, chosen_overlay, wishes);
            mark_choices(picture_marks);
            ImGui::EndTabItem();
        }
        const bool measured =
            std::exchange(measured_version_, measuring.tool().version()) != measuring.tool().version();
        if (ImGui::BeginTabItem("Measure", nullptr, measured ? ImGuiTabItemFlags_SetSelected : 0)) {
            plot_m = draw_measure_panel(desk.ui(), measuring, numbers_, line_m, wishes);
            ImGui::EndTabItem();
        }
        if (ImGui::BeginTabItem("Places")) {
            places(desk, scene, frames, wishes);
            ImGui::EndTabItem();
        }
        if (ImGui::BeginTabItem("Data")) {
            for (const std::string& line : content.facts) ImGui::TextWrapped("%s", line.c_str());
            ImGui::Separator();
            if (ImGui::Button("Measure this picture's error (F8)"))
                wishes.push_back({Command::measure_error, {}});
            for (const std::string& line : content.error) ImGui::TextWrapped("%s", line.c_str());
            ImGui::EndTabItem();
        }
        if (ImGui::BeginTabItem("Look")) {
            bool light = desk.settings().light;
            if (ImGui::Checkbox("light (F10)", &light)) wishes.push_back({Command::light_or_dark, {}});
            for (const char* units : {"metric", "imperial", "nautical"}) {
                if (ImGui::RadioButton(units, desk.settings().units == units)) desk.settings().units = units;
            }
            auto scale = static_cast<float>(desk.settings().ui_scale);
            ImGui::SliderFloat("letters", &scale, 0, 4, scale < 0.5f ? "the screen's" : "x %.2f");
            desk.settings().ui_scale = scale < 0.5f ? 0 : static_cast<double>(scale);
            if (ImGui::IsItemDeactivatedAfterEdit()) desk.look_again();
            ImGui::EndTabItem();
        }
        ImGui::EndTabBar();
    }
    ImGui::End();
}

void Panels::ask_use(std::filesystem::path file, std::vector<FileUse> uses) {
    asked_file_ = std::move(file);
    asked_uses_ = std::move(uses);
}

std::optional<Wish> Panels::answer(const Input::Key& key) {
    if (asked_file_.empty() || key.control) return std::nullopt;
    const bool enter = key.number == GLFW_KEY_ENTER || key.number == GLFW_KEY_KP_ENTER;
    const auto which = static_cast<std::size_t>(enter ? 0 : key.number - GLFW_KEY_1);
    if ((!enter && key.number < GLFW_KEY_1) || which >= asked_uses_.size()) return std::nullopt;
    const Wish wish{Command::open_as, asked_file_.string(), asked_uses_[which]};
    asked_file_.clear();
    return wish;
}

void Panels::use_question(const Desk& desk, std::vector<Wish>& wishes) {
    if (asked_file_.empty()) return;
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * (size.x - panel_width(desk)), 0.4f * size.y}, ImGuiCond_Always,
                            {0.5f, 0.5f});
    ImGui::Begin("question", nullptr, kFixed | ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::Text("%s may be several things. Open it as", asked_file_.filename().string().c_str());
    std::optional<FileUse> use;
    for (std::size_t i = 0; i < asked_uses_.size(); ++i) {
        if (ImGui::Button(fmt::format("{}  {}", i + 1, use_name(asked_uses_[i])).c_str()))
            use = asked_uses_[i];
    }
    if (use) wishes.push_back({Command::open_as, asked_file_.string(), *use});
    if (ImGui::Button("Esc  nothing") || use) asked_file_.clear();
    ImGui::End();
}

void Panels::go_to(const Ui& ui, std::vector<Wish>& wishes) {
    if (!go_to_shown_) return;
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float letter = ImGui::GetFontSize();
    ImGui::SetNextWindowPos({0.5f * size.x, 5 * letter}, ImGuiCond_Always, {0.5f, 0});
    ImGui::Begin("Go to", &go_to_shown_,
                 ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove);
    ImGui::TextDisabled("37.58,-105.49   37d34'48\"N 105d29'24\"W   13N 456000 4159000   13SDB5600059000");
    if (go_to_fresh_) ImGui::SetKeyboardFocusHere();
    go_to_fresh_ = false;
    ImGui::SetNextItemWidth(-1);
    const bool entered = ImGui::InputText("##place", &go_to_text_, ImGuiInputTextFlags_EnterReturnsTrue);
    if (entered || ui.entered()) {
        go_to_fault_.clear();
        go_to_shown_ = false;
        wishes.push_back({Command::go_to, go_to_text_});
    }
    if (!go_to_fault_.empty()) {
        ImGui::PushTextWrapPos(32 * letter);
        ImGui::TextUnformatted(go_to_fault_.c_str());
        ImGui::PopTextWrapPos();
    }
    ImGui::End();
}

std::vector<Wish> Panels::draw(Desk& desk, ViewState& view, const HudContent& content,
                               const std::string& scene, KeyFrames& frames, Measuring& measuring,
                               GroundLayers& layers, const std::optional<double>& line_m,
                               std::optional<double>& plot_m) {
    std::vector<Wish> wishes;
    plot_m.reset();
    toolbar(desk, content, wishes);
    if (desk.panel_shown())
        side_panel(desk, view, content, scene, frames, measuring, layers, line_m, plot_m, wishes);
    go_to(desk.ui(), wishes);
    desk.draw_import();
    use_question(desk, wishes);
    if (const auto chosen = chooser_.draw(desk.ui()))
        wishes.push_back({Command::open_path, chosen->string()});
    return wishes;
}

}  // namespace relevo::viewer
