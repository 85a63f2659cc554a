#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "geo/result.hpp"
#include "viewer/flight/layer_files.hpp"
#include "viewer/ui/background_import.hpp"
#include "viewer/ui/settings.hpp"
#include "viewer/ui/ui.hpp"
#include "viewer/window.hpp"

namespace relevo::viewer {

struct DeskOptions {
    int width = 1280;
    int height = 720;
    double ui_scale = 0;                  ///< of letters and marks; 0: the settings', or what the screen says
    std::filesystem::path settings = {};  ///< where they are kept; empty: nowhere
    SceneMaker make_scene;
    decltype(LayerFiles::uses_of) uses_of = {};  ///< what files may be; empty: all are elevation
};

/// The window, its user interface and settings, and what goes on from one scene to the next: the import of an
/// elevation file, and which scene is to be opened after this one.
class Desk {
  public:
    static Result<Desk> create(const DeskOptions& options);

    Window& window() { return window_; }
    Ui& ui() { return ui_; }
    Settings& settings() { return settings_; }
    const Settings& settings() const { return settings_; }

    /// The side panel: as it was left, but for windows that have no room beside it.
    bool panel_shown() const { return panel_shown_; }
    void show_panel(bool shown) { panel_shown_ = settings_.panel_shown = shown; }

    /// Light or dark, and how large, as the settings have become: from the next frame on.
    void look_again() { look_changed_ = true; }

    /// A frame of the user interface.
    void begin(const Input& input);
    void end() { ui_.end(); }

    /// Does what a user expects of a path that was dropped or chosen: a scene (its folder, or a file in it)
    /// is opened next, anything else is imported in the background and then opened.
    void open(const std::filesystem::path& path);

    /// Looks after the import: what came of it is opened next, or said. To be called once a frame.
    void see_to_import();
    const BackgroundImport* import() const { return import_.get(); }

    /// What is to be opened next, once.
    std::optional<std::filesystem::path> take_next() { return std::exchange(next_, std::nullopt); }
    bool has_next() const { return next_.has_value(); }

    /// Shows a line for some seconds.
    void tell(std::string message);
    const std::string& message() const { return message_; }
    /// Has the line just gone? Then the picture is to be drawn again.
    bool message_expired();

    /// \pre between Ui::begin and end: the import's progress, with a button to cancel it.
    void draw_import();

    /// Writes the settings; what goes wrong is told.
    void save();

  private:
    void apply_look();
    Desk(Window window, Ui ui, Settings settings, const DeskOptions& options);

    Window window_;
    Ui ui_;
    Settings settings_;
    DeskOptions options_;
    std::unique_ptr<BackgroundImport> import_;
    std::optional<std::filesystem::path> next_;
    bool look_changed_ = true;
    bool panel_shown_ = true;
    std::string message_;
    std::chrono::steady_clock::time_point message_since_;
};

/// Shows the window without a scene, until there is one to open: the recent ones, a way to choose a file, the
/// progress of an import. Nothing: it was closed.
Result<std::optional<std::filesystem::path>> choose_scene(Desk& desk);

/// The scene that a path belongs to: the folder itself, or the one that a file is in; nothing where there is
/// none.
std::optional<std::filesystem::path> scene_at(const std::filesystem::path& path);

}  // namespace relevo::viewer
