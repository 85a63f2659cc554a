#define GLFW_INCLUDE_NONE  // keys alone
#include "viewer/flight_keys.hpp"

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

}  // namespace

KeyAction press_key(ViewState& view, const Input::Key& key) {
    if (key.control && key.number == GLFW_KEY_Q) return KeyAction::close;
    if (key.control && key.number != GLFW_KEY_C) return KeyAction::none;
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
        case GLFW_KEY_N:
            view.heading = view.roll = geo::Degrees{0};
            break;
        case GLFW_KEY_HOME:
            return KeyAction::whole_scene;
        case GLFW_KEY_F1:
            return KeyAction::show_keys;
        case GLFW_KEY_ESCAPE:
            return KeyAction::clear_ruler;
        case GLFW_KEY_C:
            return KeyAction::copy_place;
        case GLFW_KEY_V:
            return KeyAction::copy_view;
        case GLFW_KEY_P:
        case GLFW_KEY_F12:
            return KeyAction::screenshot;
        default:
            break;
    }
    return KeyAction::none;
}

}  // namespace relevo::viewer
