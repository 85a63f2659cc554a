#define GLFW_INCLUDE_NONE  // keys alone
#include "viewer/flight/flight_keys.hpp"

#include <algorithm>
#include <cmath>

#include <GLFW/glfw3.h>

namespace relevo::viewer {

namespace {

/// The next value of a scale that has `per_doubling` steps to a doubling, so that there and back is where one
/// was.
double stepped(double value, int by, double per_doubling, double least, double most) {
    const double step = std::round(std::log2(value) * per_doubling) + by;
    return std::clamp(std::exp2(step / per_doubling), least, most);
}

Command with_control(const Input::Key& key) {
    switch (key.number) {
        case GLFW_KEY_Q:
            return Command::close;
        case GLFW_KEY_O:
            return Command::open_file;
        case GLFW_KEY_G:
            return Command::go_to;
        case GLFW_KEY_C:
            return Command::copy_place;
        case GLFW_KEY_V:
            return Command::paste_view;
        case GLFW_KEY_Z:
            return key.shift ? Command::redo : Command::undo;
        case GLFW_KEY_Y:
            return Command::redo;
        case GLFW_KEY_S:
            return key.shift ? Command::save_viewshed : Command::save_measurements;
        case GLFW_KEY_P:
            return Command::large_screenshot;
        default:
            return Command::none;
    }
}

}  // namespace

Command press_key(ViewState& view, const Input::Key& key) {
    if (key.control) return with_control(key);
    switch (key.number) {
        case GLFW_KEY_EQUAL:
        case GLFW_KEY_KP_ADD:
            view.tau_px = stepped(view.tau_px, +1, 2, 0.125, 64);
            break;
        case GLFW_KEY_MINUS:
        case GLFW_KEY_KP_SUBTRACT:
            view.tau_px = stepped(view.tau_px, -1, 2, 0.125, 64);
            break;
        case GLFW_KEY_L:
            view.wireframe = !view.wireframe;
            break;
        case GLFW_KEY_M:
            view.morph = !view.morph;
            break;
        case GLFW_KEY_X:
            view.exaggeration = stepped(std::max(view.exaggeration, 0.25), +1, 2, 0.25, 16);
            break;
        case GLFW_KEY_Z:
            view.exaggeration = stepped(std::max(view.exaggeration, 0.25), -1, 2, 0.25, 16);
            break;
        case GLFW_KEY_1:
            view.layer = Layer::hypsometric;
            break;
        case GLFW_KEY_2:
            view.layer = Layer::hillshade;
            break;
        case GLFW_KEY_3:
            view.layer = Layer::slope;
            break;
        case GLFW_KEY_4:
            view.layer = Layer::lod;
            break;
        case GLFW_KEY_5:
            view.layer = Layer::terrain;
            break;
        case GLFW_KEY_O:
            return key.shift ? Command::raise_layer : Command::choose_layer;
        case GLFW_KEY_N:
            view.heading = view.roll = geo::Degrees{0};
            break;
        case GLFW_KEY_H:
            return Command::level;
        case GLFW_KEY_T:
            return Command::follow_ground;
        case GLFW_KEY_G:
            return Command::go_to;
        case GLFW_KEY_B:
            return Command::add_bookmark;
        case GLFW_KEY_R:
            return Command::record;
        case GLFW_KEY_K:
            return key.shift ? Command::play_key_frames : Command::add_key_frame;
        case GLFW_KEY_HOME:
            return Command::whole_scene;
        case GLFW_KEY_F1:
            return Command::show_keys;
        case GLFW_KEY_TAB:
            return Command::show_panel;
        case GLFW_KEY_F2:
            return Command::tool_point;
        case GLFW_KEY_F3:
            return Command::tool_line;
        case GLFW_KEY_F4:
            return Command::tool_path;
        case GLFW_KEY_F5:
            return Command::tool_area;
        case GLFW_KEY_F6:
            return Command::tool_sight;
        case GLFW_KEY_F7:
            return Command::tool_viewshed;
        case GLFW_KEY_F8:
            return Command::measure_error;
        case GLFW_KEY_F10:
            return Command::light_or_dark;
        case GLFW_KEY_F11:
            return Command::hide_all;
        case GLFW_KEY_ENTER:
        case GLFW_KEY_KP_ENTER:
            return Command::finish_shape;
        case GLFW_KEY_BACKSPACE:
        case GLFW_KEY_DELETE:
            return Command::delete_vertex;
        case GLFW_KEY_ESCAPE:
            return Command::clear;
        case GLFW_KEY_C:
            return Command::copy_place;
        case GLFW_KEY_V:
            return Command::copy_view;
        case GLFW_KEY_P:
        case GLFW_KEY_F12:
            return Command::screenshot;
        default:
            break;
    }
    return Command::none;
}

std::span<const KeyHelp> key_list() {
    static constexpr KeyHelp kKeys[] = {{"W S / up, down", "ahead, back"},
                                        {"A D / left, right", "left, right (arrows turn)"},
                                        {"E Q / page up, down", "up, down"},
                                        {"Shift", "four times as fast"},
                                        {"wheel", "speed"},
                                        {"left drag", "look around"},
                                        {"right drag", "go round the point under the cursor"},
                                        {"middle or Shift+left drag", "move the ground"},
                                        {"double click", "go there"},
                                        {"G", "go to a place"},
                                        {"N  H  Home", "north up, level, the whole scene"},
                                        {"T", "follow the ground"},
                                        {"F2 F3 F4", "measure a point, a line, a path"},
                                        {"F5 F6 F7", "an area, a line of sight, a viewshed"},
                                        {"click", "set a point; drag one to move it"},
                                        {"right click, Del on a point", "delete it"},
                                        {"drag a side's middle", "a new point there"},
                                        {"Enter  Esc  Del", "finish, clear, take back a point"},
                                        {"Ctrl Z, Y", "undo, redo"},
                                        {"Ctrl S  Ctrl Shift S", "save what is measured, the viewshed"},
                                        {"1 2 3 4 5", "tints, hillshade, slope, levels, terrain"},
                                        {"+ -  X Z", "tau; exaggeration"},
                                        {"L  M", "wireframe by level, morphing"},
                                        {"F8", "measure the picture's error"},
                                        {"C  V  Ctrl V", "copy place, copy view, paste view"},
                                        {"B", "bookmark this view"},
                                        {"R", "record a flight, stop"},
                                        {"K  Shift K", "add a key frame, play them"},
                                        {"P  Ctrl P", "screenshot, large picture"},
                                        {"O  Shift O", "choose a layer over the ground, raise it"},
                                        {"Ctrl O", "open a scene, heights, a picture, lines"},
                                        {"Tab F10 F11", "panel, light or dark, hide all"},
                                        {"F1  Ctrl Q", "this list, close"}};
    return kKeys;
}

}  // namespace relevo::viewer
