#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "viewer/flight/flight_keys.hpp"
#include "viewer/flight/flight_path.hpp"
#include "viewer/flight/ground_layers.hpp"
#include "viewer/flight/layer_files.hpp"
#include "viewer/marks/marks.hpp"
#include "viewer/measure/measuring.hpp"
#include "viewer/ui/desk.hpp"
#include "viewer/ui/file_chooser.hpp"
#include "viewer/ui/hud.hpp"
#include "viewer/ui/number_box.hpp"
#include "viewer/view_state.hpp"

namespace relevo::viewer {

/// What the user asked for in panels: a command, and what was typed or chosen with it.
struct Wish {
    Command command = Command::none;
    std::string text = {};  ///< of go_to a place, of paste_view a view, of open_path and open_as a file
    FileUse use = {};       ///< of open_as
};

/// The tool bar, the side panel and the boxes that open over the ground. Sliders and choices change the view
/// at once; all else is a wish.
class Panels {
  public:
    /// Key frames of a path that is being made.
    struct KeyFrames {
        std::vector<FlightKey> keys;
        double seconds_between = 4;
    };

    /// \param line_m, plot_m  how far along the measured line the cursor is: on the ground; in the plot, to
    /// be set \pre between Ui::begin and end
    std::vector<Wish> draw(Desk& desk, ViewState& view, const HudContent& content, const std::string& scene,
                           KeyFrames& frames, Measuring& measuring, GroundLayers& layers,
                           const std::optional<double>& line_m, std::optional<double>& plot_m);

    /// Of the side panel as it is drawn; 0 while it is hidden.
    float panel_width(const Desk& desk) const;
    /// Adds the tool bar and the side panel. \pre as of draw
    void add_covered(const Desk& desk, Covered& covered) const;

    void show_go_to() { go_to_shown_ = go_to_fresh_ = true; }
    void complain_of_go_to(std::string why) { go_to_fault_ = std::move(why), go_to_shown_ = true; }
    void show_chooser() { chooser_.show(); }
    /// Asks what a file is to be opened as, the likelier first.
    void ask_use(std::filesystem::path file, std::vector<FileUse> uses);
    /// The answer to that by a key: a number, or Enter for the first. The key is then no other command.
    std::optional<Wish> answer(const Input::Key& key);
    /// Closes what is open over the ground; false where there was nothing.
    bool close();

    bool keys_shown = false;
    std::size_t chosen_overlay = 0;  ///< which one keys move
    Marks picture_marks;             ///< of large pictures

  private:
    Box side_box(const Desk& desk) const;
    void toolbar(Desk& desk, const HudContent& content, std::vector<Wish>& wishes);
    void side_panel(Desk& desk, ViewState& view, const HudContent& content, const std::string& scene,
                    KeyFrames& frames, Measuring& measuring, GroundLayers& layers,
                    const std::optional<double>& line_m, std::optional<double>& plot_m,
                    std::vector<Wish>& wishes);
    void places(Desk& desk, const std::string& scene, KeyFrames& frames, std::vector<Wish>& wishes);
    void sun(const Ui& ui, ViewState& view);
    void use_question(const Desk& desk, std::vector<Wish>& wishes);
    void go_to(const Ui& ui, std::vector<Wish>& wishes);

    FileChooser chooser_;
    NumberBox numbers_;
    std::filesystem::path asked_file_;  // what to open it as is asked; empty: nothing is
    std::vector<FileUse> asked_uses_;
    std::size_t measured_version_ = 0;  // of the shapes when the panel was last drawn
    bool go_to_shown_ = false;
    bool go_to_fresh_ = false;
    std::string go_to_text_;
    std::string go_to_fault_;
    std::string sun_text_;  // azimuth and elevation, or a time: what --sun takes
    std::string sun_fault_;
};

}  // namespace relevo::viewer
