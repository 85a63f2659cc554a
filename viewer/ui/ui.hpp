#pragma once

#include <memory>

#include "geo/result.hpp"
#include "viewer/window.hpp"

namespace relevo::viewer {

/// Dear ImGui over a window: between begin and end, its functions draw. One at a time.
class Ui {
  public:
    /// \param scale  of letters and everything else; 1 is for screens of 96 dots an inch
    static Result<Ui> create(const Window& window, double scale);

    void begin();
    /// Draws what was said since begin() into the window's frame.
    void end();

  private:
    struct Release {
        void operator()(int* started) const;
    };
    explicit Ui(std::unique_ptr<int, Release> started);
    std::unique_ptr<int, Release> started_;
};

}  // namespace relevo::viewer
