#include "viewer/ui/settings.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace relevo::viewer {

namespace fs = std::filesystem;

void Settings::remember(const std::string& scene) {
    std::erase(recent, scene);
    recent.insert(recent.begin(), scene);
    if (recent.size() > kMostRecent) recent.resize(kMostRecent);
}

fs::path settings_file() {
    const char* config = std::getenv("XDG_CONFIG_HOME");
    if (config != nullptr && fs::path(config).is_absolute()) return fs::path(config) / "relevo/settings.json";
    const char* home = std::getenv("HOME");
    if (home != nullptr && *home != '\0') return fs::path(home) / ".config/relevo/settings.json";
    return {};
}

namespace {

/// Throws nlohmann's exceptions where a value is of another type.
Settings settings_of(const nlohmann::json& json) {
    Settings settings;
    settings.light = json.value("light", settings.light);
    const double scale = json.value("ui_scale", settings.ui_scale);
    if (scale >= 0.5 && scale <= 4) settings.ui_scale = scale;
    settings.units = json.value("units", settings.units);
    settings.panel_shown = json.value("panel_shown", settings.panel_shown);
    settings.recent = json.value("recent", settings.recent);
    if (settings.recent.size() > Settings::kMostRecent) settings.recent.resize(Settings::kMostRecent);
    for (const nlohmann::json& mark : json.value("bookmarks", nlohmann::json::array()))
        settings.bookmarks.push_back({mark.at("name"), mark.at("scene"), mark.at("view")});
    return settings;
}

nlohmann::json json_of(const Settings& settings) {
    nlohmann::json json = {{"light", settings.light},   {"ui_scale", settings.ui_scale},
                           {"units", settings.units},   {"panel_shown", settings.panel_shown},
                           {"recent", settings.recent}, {"bookmarks", nlohmann::json::array()}};
    for (const auto& [name, scene, view] : settings.bookmarks)
        json["bookmarks"].push_back({{"name", name}, {"scene", scene}, {"view", view}});
    return json;
}

}  // namespace

LoadedSettings load_settings(const fs::path& file) {
    std::error_code failed;
    if (file.empty() || !fs::exists(file, failed)) return {};
    std::ifstream stream(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (!stream) return {{}, fmt::format("{}: cannot be read; the usual settings serve", file.string())};
    try {
        return {settings_of(nlohmann::json::parse(text)), {}};
    } catch (const nlohmann::json::exception&) {
        return {{}, fmt::format("{}: these are no settings; the usual ones serve", file.string())};
    }
}

Result<void> save_settings(const Settings& settings, const fs::path& file) {
    if (file.empty())
        return Error{ErrorKind::input, "settings are not kept: neither XDG_CONFIG_HOME nor HOME is set"};
    std::error_code failed;
    fs::create_directories(file.parent_path(), failed);
    if (!load_settings(file).complaint.empty()) fs::rename(file, file.string() + ".broken", failed);
    const fs::path draft = file.string() + ".new";
    std::ofstream stream(draft, std::ios::binary);
    // Names of files may be of any bytes; JSON is UTF-8.
    stream << json_of(settings).dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
    stream.close();
    if (stream) fs::rename(draft, file, failed);
    if (!stream || failed) {
        fs::remove(draft, failed);
        return Error{ErrorKind::input, fmt::format("{}: settings cannot be written there", file.string())};
    }
    return {};
}

}  // namespace relevo::viewer
