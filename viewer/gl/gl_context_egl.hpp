#pragma once

#include <memory>

#include "geo/result.hpp"

namespace relevo::viewer {

/// An OpenGL 4.5 core context without a window or a display, by EGL's surfaceless platform; current in the
/// thread that made it until it is destroyed.
class OffscreenContext {
  public:
    static Result<OffscreenContext> create();

  private:
    struct State;
    struct Release {
        void operator()(State* state) const;
    };
    explicit OffscreenContext(std::unique_ptr<State, Release> state);
    std::unique_ptr<State, Release> state_;
};

}  // namespace relevo::viewer
