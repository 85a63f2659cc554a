#pragma once

#include <string>
#include <string_view>

#include "geo/result.hpp"

namespace relevo::viewer {

/// Asks the current context, which must be OpenGL 4.5 or newer, to keep its error messages for gl_check, and
/// sets what all of our drawing relies on: clip control for reversed depth.
Result<void> prepare_gl();

/// Fails where OpenGL reported an error since the last call. `doing` says what was tried, for the message.
Result<void> gl_check(std::string_view doing);

/// Waits until everything asked for is drawn.
void gl_finish();

/// "llvmpipe (LLVM 15.0.6, 256 bits), 4.5 (Core Profile) Mesa 22.3.6": what draws here.
std::string gl_description();

}  // namespace relevo::viewer
