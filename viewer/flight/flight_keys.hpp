#pragma once

#include <span>

#include "viewer/input.hpp"
#include "viewer/view_state.hpp"

namespace relevo::viewer {

/// What a key or a button asks for beyond a change of how the view is drawn.
enum class Command {
    none,
    open_file,     ///< asks which one
    open_path,     ///< a file or folder that is named
    open_as,       ///< likewise, and as what
    choose_layer,  ///< the next one down of what is over the ground
    raise_layer,   ///< the chosen one by one; the uppermost becomes the lowest
    show_keys,
    show_panel,
    hide_all,  ///< panels and read-outs: the ground alone
    light_or_dark,
    go_to,
    add_bookmark,
    copy_place,
    copy_view,
    paste_view,
    whole_scene,
    level,
    follow_ground,
    record,  ///< begins; the second time ends and writes
    add_key_frame,
    play_key_frames,
    measure_error,
    screenshot,
    large_screenshot,
    undo,
    redo,
    finish_shape,
    delete_vertex,
    clear,  ///< what is being measured; else closes what is open
    save_measurements,
    tool_line,
    tool_point,
    tool_path,
    tool_area,
    tool_sight,
    tool_viewshed,
    save_viewshed,
    close,
};

/// Takes in one key: changes how the view is drawn, or says what else to do.
Command press_key(ViewState& view, const Input::Key& key);

/// A line of the list of keys.
struct KeyHelp {
    const char* keys;
    const char* what;
};
std::span<const KeyHelp> key_list();

}  // namespace relevo::viewer
