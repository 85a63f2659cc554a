#pragma once

#include "viewer/input.hpp"
#include "viewer/view_state.hpp"

namespace relevo::viewer {

/// What a key press asks for beyond a change of the view.
enum class KeyAction {
    none,
    show_keys,
    clear_ruler,
    copy_place,
    copy_view,
    screenshot,
    whole_scene,
    close,
};

/// Takes in one key: changes how the view is drawn, or says what else to do.
KeyAction press_key(ViewState& view, const Input::Key& key);

}  // namespace relevo::viewer
