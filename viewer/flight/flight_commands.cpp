#include "viewer/flight/flight_commands.hpp"

#include <fmt/format.h>

#include "geo/coordinate_text.hpp"
#include "viewer/camera.hpp"
#include "viewer/flight/flight_files.hpp"
#include "viewer/flight/travel.hpp"
#include "viewer/measure/tool_list.hpp"
#include "viewer/overlay/overlay_list.hpp"
#include "viewer/ui/layer_panel.hpp"

namespace relevo::viewer {

namespace {

void copy(FlightState& flight, const char* what, const std::string& text) {
    flight.desk.window().set_clipboard(text);
    flight.options.say(fmt::format("{} {}", what, text));
    flight.tell(fmt::format("copied the {}", what));
}

void copy_place(FlightState& flight) {
    if (!flight.cursor) return flight.tell("no ground under the cursor to copy");
    std::string text = geo::to_decimal_degrees(flight.cursor->place);
    if (flight.cursor->H) text += fmt::format(", {:.3f}", flight.cursor->H->m);
    copy(flight, "coordinates", text);
}

void take_tool(FlightState& flight, Command command) {
    for (const ToolChoice& choice : kTools) {
        if (choice.command != command) continue;
        flight.measuring.tool().take(choice.tool);
        flight.tell(fmt::format("{}: {}", choice.name, choice.what));
    }
}

/// The next one down, from the lowest to the uppermost.
void choose_layer(FlightState& flight) {
    const Overlays& overlays = flight.view.overlays;
    std::size_t& chosen = flight.panels.chosen_overlay;
    if (overlays.empty()) return flight.tell("nothing lies over the ground");
    chosen = chosen == 0 || chosen >= overlays.size() ? overlays.size() - 1 : chosen - 1;
    flight.tell(fmt::format("{}: {} from above of {}; Shift O raises it",
                            overlay_name(overlays[chosen], flight.ground.drapes), overlays.size() - chosen,
                            overlays.size()));
}

}  // namespace

void obey(FlightState& flight, const Wish& wish, int width, int height) {
    Desk& desk = flight.desk;
    Panels& panels = flight.panels;
    ViewState& view = flight.view;
    MeasureTool& tool = flight.measuring.tool();
    switch (wish.command) {
        case Command::none:
            break;
        case Command::open_file:
            panels.show_chooser();
            break;
        case Command::open_path:
            open_path(flight, wish.text);
            break;
        case Command::open_as:
            open_as(flight, wish.text, wish.use);
            break;
        case Command::choose_layer:
            choose_layer(flight);
            break;
        case Command::raise_layer:
            panels.chosen_overlay = raise_overlay(view.overlays, panels.chosen_overlay);
            break;
        case Command::show_keys:
            panels.keys_shown = !panels.keys_shown;
            break;
        case Command::show_panel:
            desk.show_panel(!desk.panel_shown());
            break;
        case Command::hide_all:
            flight.hidden = !flight.hidden;
            break;
        case Command::light_or_dark:
            desk.settings().light = !desk.settings().light;
            desk.look_again();
            break;
        case Command::go_to:
            go_to(flight, wish.text);
            break;
        case Command::add_bookmark:
            add_bookmark(flight);
            break;
        case Command::copy_place:
            copy_place(flight);
            break;
        case Command::copy_view:
            copy(flight, "view", to_string(view));
            break;
        case Command::paste_view:
            go_to_view(flight, wish.text.empty() ? desk.window().clipboard() : wish.text);
            break;
        case Command::whole_scene:
            look_over(view, flight.terrain, flight.scene.info(), flight.heights, width, height);
            break;
        case Command::level:
            view.pitch = view.roll = geo::Degrees{0};
            break;
        case Command::follow_ground:
            flight.tell(flight.motion.controls().toggle_following(view) ? "following the ground"
                                                                        : "not following the ground");
            break;
        case Command::record:
            toggle_recording(flight);
            break;
        case Command::add_key_frame:
            flight.key_frames.keys.push_back(key_of(view, 0));
            flight.tell(fmt::format("key frame {}", flight.key_frames.keys.size()));
            break;
        case Command::play_key_frames:
            play_key_frames(flight);
            break;
        case Command::measure_error:
            if (flight.drawn)
                flight.error.begin(flight.terrain, *flight.drawn, flight.mesh(), view.exaggeration,
                                   view.tau_px);
            flight.tell("measuring the picture's error...");
            break;
        case Command::screenshot:
            flight.screenshot_wanted = true;
            break;
        case Command::large_screenshot:
            take_large_picture(flight, width, height);
            break;
        case Command::clear:
            // What is open over the ground, else what takes its time, else all that is measured.
            if (panels.close()) break;
            if (flight.measuring.busy()) {
                flight.measuring.results().cancel();
                break;
            }
            tool.clear();
            break;
        case Command::close:
            desk.window().close();
            break;
        case Command::undo:
            if (!tool.undo()) flight.tell("nothing to undo");
            break;
        case Command::redo:
            if (!tool.redo()) flight.tell("nothing to do again");
            break;
        case Command::finish_shape:
            tool.finish();
            break;
        case Command::delete_vertex:
            flight.measuring.delete_vertex();
            break;
        case Command::save_measurements:
            save_measurements(flight);
            break;
        case Command::save_viewshed:
            save_viewshed(flight);
            break;
        case Command::tool_point:
        case Command::tool_line:
        case Command::tool_path:
        case Command::tool_area:
        case Command::tool_sight:
        case Command::tool_viewshed:
            take_tool(flight, wish.command);
            break;
    }
}

}  // namespace relevo::viewer
