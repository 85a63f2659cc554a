#pragma once

#include <optional>
#include <string>
#include <vector>

#include "viewer/flight_keys.hpp"
#include "viewer/flight_path.hpp"
#include "viewer/marks.hpp"
#include "viewer/measuring.hpp"
#include "viewer/ui/desk.hpp"
#include "viewer/ui/file_chooser.hpp"
#include "viewer/ui/hud.hpp"
#include "viewer/view_state.hpp"

namespace relevo::viewer {

/// What the user asked for in panels: a command, and what was typed or chosen with it.
struct Wish {
    Command command = Command::none;
    std::string text;  ///< of go_to a place, of paste_view a view
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
                           KeyFrames& frames, Measuring& measuring, const std::optional<double>& line_m,
                           std::optional<double>& plot_m);

    /// Of the side panel as it is drawn; 0 while it is hidden.
    float panel_width(const Desk& desk) const;

    void show_go_to() { go_to_shown_ = go_to_fresh_ = true; }
    void complain_of_go_to(std::string why) { go_to_fault_ = std::move(why), go_to_shown_ = true; }
    void show_chooser() { chooser_.show(); }
    /// Closes what is open over the ground; false where there was nothing.
    bool close();

    bool keys_shown = false;
    Marks picture_marks;  ///< of large pictures

  private:
    void toolbar(Desk& desk, const HudContent& content, std::vector<Wish>& wishes);
    void side_panel(Desk& desk, ViewState& view, const HudContent& content, const std::string& scene,
                    KeyFrames& frames, Measuring& measuring, const std::optional<double>& line_m,
                    std::optional<double>& plot_m, std::vector<Wish>& wishes);
    void places(Desk& desk, const std::string& scene, KeyFrames& frames, std::vector<Wish>& wishes);
    void sun(const Ui& ui, ViewState& view);
    void go_to(const Ui& ui, std::vector<Wish>& wishes);

    FileChooser chooser_;
    std::size_t measured_version_ = 0;  // of the shapes when the panel was last drawn
    bool go_to_shown_ = false;
    bool go_to_fresh_ = false;
    std::string go_to_text_;
    std::string go_to_fault_;
    std::string sun_text_;  // azimuth and elevation, or a time: what --sun takes
    std::string sun_fault_;
};

}  // namespace relevo::viewer
