#define GLFW_INCLUDE_NONE  // epoxy declares OpenGL
#include "viewer/window.hpp"

#include <algorithm>
#include <set>

#include <GLFW/glfw3.h>
#include <epoxy/gl.h>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "viewer/gl/gl_check.hpp"

namespace relevo::viewer {

namespace {

/// A button that went up within this many pixels of where it went down was a click, not a drag.
constexpr double kClickPx = 4;
constexpr double kDoubleClickS = 0.35;

std::string glfw_error() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text != nullptr ? text : "unknown reason";
}

Error no_window(const std::string& why) {
    return {
        ErrorKind::internal,
        fmt::format(
            "no window can be opened: {}. Where there is no display, \"relevo render\" draws pictures", why)};
}

}  // namespace

struct Window::State {
    GLFWwindow* window = nullptr;
    bool typing = false;
    std::set<int> commanding;  // keys that went down with Control, whose release may come after its own
    Input now;                 // what poll() gave
    Input gathered;            // what the callbacks have seen since

    struct Press {
        bool down = false;
        bool dragging = false;
        glm::dvec2 at{0};
    };
    Press left, right, middle;
    double last_click_s = -1;
    glm::dvec2 last_click_at{0};

    void cursor_moved(const glm::dvec2& to) {
        const auto drag = [&](Press& press, glm::dvec2& sum) {
            if (!press.down) return;
            if (!press.dragging && glm::distance(to, press.at) > kClickPx) press.dragging = true;
            if (press.dragging) sum += to - gathered.cursor;
        };
        drag(left, gathered.drag_left);
        drag(right, gathered.drag_right);
        drag(middle, gathered.drag_middle);
        gathered.cursor = to;
        gathered.cursor_inside = true;
        gathered.anything = true;
    }

    void button(int which, int action, int modifiers) {
        gathered.anything = true;
        // Shift and the left button do what the middle one does, which touchpads have not.
        if (which == GLFW_MOUSE_BUTTON_LEFT &&
            (action == GLFW_PRESS ? (modifiers & GLFW_MOD_SHIFT) != 0 : !left.down && middle.down))
            which = GLFW_MOUSE_BUTTON_MIDDLE;
        Press* press = which == GLFW_MOUSE_BUTTON_LEFT     ? &left
                       : which == GLFW_MOUSE_BUTTON_RIGHT  ? &right
                       : which == GLFW_MOUSE_BUTTON_MIDDLE ? &middle
                                                           : nullptr;
        if (press == nullptr) return;
        if (action == GLFW_PRESS) {
            *press = {true, false, gathered.cursor};
            if (press == &left) gathered.left_pressed_at = gathered.cursor;
            if (press == &right) gathered.right_pressed_at = gathered.cursor;
            if (press == &middle) gathered.middle_pressed_at = gathered.cursor;
        } else {
            const bool clicked = press->down && !press->dragging;
            if (clicked && press == &left) click(press->at);
            if (clicked && press == &right) gathered.right_clicks.push_back(press->at);
            press->down = false;
        }
    }

    void click(const glm::dvec2& at) {
        gathered.clicks.push_back(at);
        const double time_s = glfwGetTime();
        const bool second =
            time_s - last_click_s < kDoubleClickS && glm::distance(at, last_click_at) <= kClickPx;
        if (second) gathered.double_click = at;
        last_click_s = second ? -1 : time_s;
        last_click_at = at;
    }
};

void Window::Release::operator()(State* state) const {
    if (state->window != nullptr) glfwDestroyWindow(state->window);
    glfwTerminate();
    delete state;
}

Window::Window(std::unique_ptr<State, Release> state) : state_(std::move(state)) {}

Result<Window> Window::create(int width, int height, const std::string& title) {
    if (glfwInit() != GLFW_TRUE) return no_window(glfw_error());
    std::unique_ptr<State, Release> state(new State);
    glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_API);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, GLFW_TRUE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);  // the renderer has its own
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    state->window = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
    if (state->window == nullptr) return no_window(glfw_error() + " (OpenGL 4.5 is needed)");
    glfwMakeContextCurrent(state->window);
    glfwSwapInterval(1);
    if (auto done = prepare_gl(); !done) return done.error();

    glfwSetWindowUserPointer(state->window, state.get());
    glfwSetKeyCallback(state->window, [](GLFWwindow* window, int key, int, int action, int modifiers) {
        auto* to = static_cast<State*>(glfwGetWindowUserPointer(window));
        to->gathered.anything = true;
        if (action == GLFW_RELEASE) to->commanding.erase(key);
        if (action != GLFW_PRESS) return;
        const bool control = (modifiers & GLFW_MOD_CONTROL) != 0;
        if (control) to->commanding.insert(key);
        to->gathered.pressed.push_back({key, control, (modifiers & GLFW_MOD_SHIFT) != 0});
    });
    glfwSetCursorPosCallback(state->window, [](GLFWwindow* window, double x, double y) {
        auto* to = static_cast<State*>(glfwGetWindowUserPointer(window));
        int inside = 1;
        int pixels = 1;
        glfwGetWindowSize(window, &inside, nullptr);
        glfwGetFramebufferSize(window, &pixels, nullptr);
        to->cursor_moved(glm::dvec2(x, y) * (static_cast<double>(pixels) / std::max(inside, 1)));
    });
    glfwSetMouseButtonCallback(state->window, [](GLFWwindow* window, int button, int action, int modifiers) {
        static_cast<State*>(glfwGetWindowUserPointer(window))->button(button, action, modifiers);
    });
    glfwSetScrollCallback(state->window, [](GLFWwindow* window, double, double y) {
        auto* to = static_cast<State*>(glfwGetWindowUserPointer(window));
        to->gathered.wheel += y;
        to->gathered.anything = true;
    });
    glfwSetCursorEnterCallback(state->window, [](GLFWwindow* window, int entered) {
        auto* to = static_cast<State*>(glfwGetWindowUserPointer(window));
        to->gathered.cursor_inside = entered == GLFW_TRUE;
        to->gathered.anything = true;
    });
    glfwSetDropCallback(state->window, [](GLFWwindow* window, int count, const char** paths) {
        auto* to = static_cast<State*>(glfwGetWindowUserPointer(window));
        to->gathered.dropped.insert(to->gathered.dropped.end(), paths, paths + count);
        to->gathered.anything = true;
    });
    glfwSetFramebufferSizeCallback(state->window, [](GLFWwindow* window, int, int) {
        static_cast<State*>(glfwGetWindowUserPointer(window))->gathered.anything = true;
    });
    glfwSetWindowRefreshCallback(state->window, [](GLFWwindow* window) {
        static_cast<State*>(glfwGetWindowUserPointer(window))->gathered.anything = true;
    });
    return Window(std::move(state));
}

GLFWwindow* Window::handle() const {
    return state_->window;
}
bool Window::should_close() const {
    return glfwWindowShouldClose(state_->window) == GLFW_TRUE;
}
void Window::close() {
    glfwSetWindowShouldClose(state_->window, GLFW_TRUE);
}

glm::ivec2 Window::size() const {
    glm::ivec2 size{0};
    glfwGetFramebufferSize(state_->window, &size.x, &size.y);
    return size;
}

double Window::scale() const {
    float scale = 1;
    glfwGetWindowContentScale(state_->window, &scale, nullptr);
    return std::clamp(static_cast<double>(scale), 0.5, 8.0);
}

const Input& Window::poll(double wait_s) {
    if (wait_s > 0) {
        glfwWaitEventsTimeout(wait_s);
    } else {
        glfwPollEvents();
    }
    Input& gathered = state_->gathered;
    state_->now = gathered;
    state_->now.left_down = state_->left.down;
    Input fresh;
    fresh.cursor = gathered.cursor;
    fresh.cursor_inside = gathered.cursor_inside;
    gathered = fresh;
    return state_->now;
}

bool Window::held(int key) const {
    return !state_->typing && !state_->commanding.contains(key) &&
           glfwGetKey(state_->window, key) == GLFW_PRESS;
}

void Window::set_typing(bool typing) {
    state_->typing = typing;
}

std::string Window::clipboard() const {
    const char* text = glfwGetClipboardString(state_->window);
    return text != nullptr ? text : "";
}

void Window::set_title(const std::string& title) {
    glfwSetWindowTitle(state_->window, title.c_str());
}

void Window::set_clipboard(const std::string& text) {
    glfwSetClipboardString(state_->window, text.c_str());
}

Picture Window::read_back() const {
    const glm::ivec2 pixels = size();
    Picture picture(pixels.x, pixels.y);
    std::vector<std::uint8_t> row(4 * static_cast<std::size_t>(pixels.x));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    for (int y = 0; y < pixels.y; ++y) {
        glReadPixels(0, pixels.y - 1 - y, pixels.x, 1, GL_RGBA, GL_UNSIGNED_BYTE, row.data());
        for (int x = 0; x < pixels.x; ++x) std::copy_n(row.data() + 4 * x, 3, picture.pixel(x, y));
    }
    return picture;
}

void Window::show() {
    glfwSwapBuffers(state_->window);
}

}  // namespace relevo::viewer
