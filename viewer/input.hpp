#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

namespace relevo::viewer {

/// What the window's user did since the last frame. Positions are in pixels of the picture, (0, 0) upper
/// left.
struct Input {
    struct Key {
        int number = 0;        ///< GLFW's
        bool control = false;  ///< held with it
        bool shift = false;    ///< likewise
    };

    std::vector<Key> pressed;  ///< in order
    glm::dvec2 cursor{0};
    bool cursor_inside = false;
    glm::dvec2 drag_left{0};  ///< of the cursor while the button was down and no longer a click
    glm::dvec2 drag_right{0};
    glm::dvec2 drag_middle{0};
    std::optional<glm::dvec2> left_pressed_at;   ///< where the left button went down
    bool left_down = false;                      ///< still
    std::optional<glm::dvec2> right_pressed_at;  ///< likewise
    std::optional<glm::dvec2> middle_pressed_at;
    std::vector<glm::dvec2> clicks;          ///< of the left button: down and up again in one place
    std::vector<glm::dvec2> right_clicks;    ///< likewise of the right one
    std::optional<glm::dvec2> double_click;  ///< the second of two clicks, which is in `clicks` too
    std::vector<std::string> dropped;        ///< files and folders
    double wheel = 0;                        ///< turns, up is positive
    bool anything = false;                   ///< any event at all
};

}  // namespace relevo::viewer
