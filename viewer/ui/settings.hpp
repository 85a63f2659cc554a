#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "geo/result.hpp"

namespace relevo::viewer {

/// A view that its user gave a name to.
struct Bookmark {
    std::string name;
    std::string scene;  ///< where it is on the disk
    std::string view;   ///< as parse_view_state reads it
    friend bool operator==(const Bookmark&, const Bookmark&) = default;
};

/// What the window keeps from one day to the next.
struct Settings {
    bool light = false;   ///< dark letters on light panels
    double ui_scale = 0;  ///< of letters and marks, 0.5 to 4; 0: what the screen says
    std::string units = "metric";
    bool panel_shown = true;
    std::vector<std::string> recent;  ///< scenes, the newest first
    std::vector<Bookmark> bookmarks;
    friend bool operator==(const Settings&, const Settings&) = default;

    static constexpr std::size_t kMostRecent = 12;
    /// Puts a scene first among the recent ones.
    void remember(const std::string& scene);
};

/// $XDG_CONFIG_HOME/relevo/settings.json, or the same in ~/.config; empty where the system names neither.
std::filesystem::path settings_file();

/// The settings in a file, and what was wrong with it: then they are the usual ones. No file is no fault.
struct LoadedSettings {
    Settings settings;
    std::string complaint;
};
LoadedSettings load_settings(const std::filesystem::path& file);

/// Writes settings; the file is whole at any time. One that cannot be read as settings is kept beside it, as
/// settings.json.broken.
Result<void> save_settings(const Settings& settings, const std::filesystem::path& file);

}  // namespace relevo::viewer
