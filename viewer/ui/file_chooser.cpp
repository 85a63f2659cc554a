#include "viewer/ui/file_chooser.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <tuple>

#include <imgui.h>
#include <imgui_stdlib.h>

#include "viewer/ui/desk.hpp"

namespace relevo::viewer {

namespace fs = std::filesystem;

namespace {

/// Endings of the files that people have; others can be typed.
constexpr std::array<const char*, 32> kEndings{
    ".tif",  ".tiff", ".hgt", ".asc", ".vrt",      ".img", ".dem", ".dt0", ".dt1", ".dt2",  ".nc",
    ".flt",  ".bil",  ".zip", ".jp2", ".adf",      ".png", ".jpg", ".gpx", ".shp", ".gpkg", ".geojson",
    ".json", ".kml",  ".kmz", ".fgb", ".topojson", ".gml", ".csv", ".dxf", ".tab", ".mif"};

bool looks_openable(const fs::path& file) {
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end();
}

}  // namespace

std::vector<ChooserEntry> openable_in(const fs::path& folder) {
    std::vector<ChooserEntry> entries;
    std::error_code failed;
    for (fs::directory_iterator at(folder, failed), end; !failed && at != end; at.increment(failed)) {
        const std::string name = at->path().filename().string();
        std::error_code hidden;
        if (name.starts_with('.')) continue;
        if (at->is_directory(hidden)) {
            const bool is_scene = fs::is_regular_file(at->path() / "scene.json", hidden);
            entries.push_back({is_scene ? ChooserEntry::Kind::scene : ChooserEntry::Kind::folder, name});
        } else if (looks_openable(at->path())) {
            entries.push_back({ChooserEntry::Kind::file, name});
        }
    }
    std::sort(entries.begin(), entries.end(), [](const ChooserEntry& a, const ChooserEntry& b) {
        return std::tie(a.kind, a.name) < std::tie(b.kind, b.name);
    });
    return entries;
}

void FileChooser::enter(const fs::path& folder) {
    folder_ = folder;
    entries_ = openable_in(folder);
}

void FileChooser::show() {
    std::error_code failed;
    if (folder_.empty()) folder_ = fs::current_path(failed);
    enter(folder_);
    typed_.clear();
    shown_ = fresh_ = true;
}

std::optional<fs::path> FileChooser::draw(const Ui& ui) {
    if (!shown_) return std::nullopt;
    std::optional<fs::path> chosen;
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float letter = ImGui::GetFontSize();
    ImGui::SetNextWindowPos({0.5f * size.x, 0.5f * size.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(40 * letter, 0.9f * size.x), std::min(30 * letter, 0.8f * size.y)});
    ImGui::Begin("Open a scene, heights, a picture or lines", &shown_,
                 ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoResize |
                     ImGuiWindowFlags_NoMove);
    ImGui::TextUnformatted(folder_.string().c_str());
    ImGui::SetNextItemWidth(-1);
    if (fresh_) ImGui::SetKeyboardFocusHere();
    fresh_ = false;
    const bool entered =
        ImGui::InputTextWithHint("##path", "or type a path", &typed_, ImGuiInputTextFlags_EnterReturnsTrue);
    if (entered || ui.entered()) {
        chosen = folder_ / typed_;  // the path itself where it is absolute
    }
    ImGui::BeginChild("entries", {0, 0}, true);
    std::optional<fs::path> into;
    if (folder_.has_parent_path() && ImGui::Selectable("..")) into = folder_.parent_path();
    for (const ChooserEntry& entry : entries_) {
        const char* mark = entry.kind == ChooserEntry::Kind::folder  ? "/"
                           : entry.kind == ChooserEntry::Kind::scene ? "   scene"
                                                                     : "";
        if (!ImGui::Selectable((entry.name + mark).c_str())) continue;
        if (entry.kind == ChooserEntry::Kind::folder) {
            into = folder_ / entry.name;
        } else {
            chosen = folder_ / entry.name;
        }
    }
    if (entries_.empty()) ImGui::TextDisabled("nothing here that can be opened");
    ImGui::EndChild();
    ImGui::End();
    std::error_code failed;
    if (chosen && !scene_at(*chosen) && fs::is_directory(*chosen, failed)) {
        into = std::exchange(chosen, std::nullopt)->lexically_normal();
        typed_.clear();
    }
    if (into) enter(*into);
    if (chosen) shown_ = false;
    return chosen;
}

}  // namespace relevo::viewer
