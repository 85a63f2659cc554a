#pragma once

#include <memory>

#include "geo/result.hpp"
#include "viewer/window.hpp"

namespace relevo::viewer {

/// Dear ImGui over a window: between begin and end, its functions draw. One at a time.
class Ui {
  public:
    static Result<Ui> create(const Window& window);

    /// \param scale  of letters and everything else; 1 is for screens of 96 dots an inch
    /// \param light  dark letters on light panels; else light ones on dark panels
    /// \pre not between begin() and end()
    void set_look(double scale, bool light);

    /// Is the mouse over a panel, or was it pressed there? The ground then does not have it.
    bool has_mouse() const;
    /// Is something being typed in?
    bool has_keys() const;

    /// \param input  what happened since the last frame
    void begin(const Input& input);
    /// Was Enter pressed in the line of text that was just drawn? Dear ImGui does not see a key that goes
    /// down and up within a frame, and frames may be long.
    bool entered() const;
    /// Draws what was said since begin() into the window's frame.
    void end();

  private:
    struct Release {
        void operator()(int* started) const;
    };
    explicit Ui(std::unique_ptr<int, Release> started);
    std::unique_ptr<int, Release> started_;
    bool begun_ = false;  // any frame
    bool enter_pressed_ = false;
};

}  // namespace relevo::viewer
