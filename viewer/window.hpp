#pragma once

#include <memory>
#include <string>

#include "geo/result.hpp"
#include "viewer/input.hpp"
#include "viewer/picture.hpp"

struct GLFWwindow;

namespace relevo::viewer {

/// A window with an OpenGL 4.5 core context, current in the thread that made it. One at a time.
class Window {
  public:
    /// \param width, height  of its inside, in the screen's coordinates
    static Result<Window> create(int width, int height, const std::string& title);

    GLFWwindow* handle() const;
    bool should_close() const;
    void close();

    /// Of the picture, pixels; 0 while the window is an icon.
    glm::ivec2 size() const;
    /// How many pixels a user-interface pixel takes on this screen: 1, 1.5, 2, ...
    double scale() const;

    /// Takes in what happened; with a wait, sleeps until something does or the time is over. Seconds.
    const Input& poll(double wait_s);
    /// Is a key down, and was so without Control? With it keys are commands.
    bool held(int key) const;
    /// While something is being typed in no key counts as held.
    void set_typing(bool typing);

    void set_title(const std::string& title);
    /// Empty where there is no text.
    std::string clipboard() const;
    void set_clipboard(const std::string& text);
    /// The picture that is about to be shown.
    Picture read_back() const;
    void show();

  private:
    struct State;
    struct Release {
        void operator()(State* state) const;
    };
    explicit Window(std::unique_ptr<State, Release> state);
    std::unique_ptr<State, Release> state_;
};

}  // namespace relevo::viewer
