#pragma once

#include <string>
#include <string_view>

#include "geo/result.hpp"
#include "viewer/gl/gl_object.hpp"

namespace relevo::viewer {

/// A program from GLSL. `defines` come after the #version line, which is ours; the geometry shader may be
/// empty. The error holds the compiler's log.
struct ProgramSource {
    std::string_view name;  ///< for messages
    std::string defines;
    std::string_view common;  ///< put before each stage
    std::string_view vertex;
    std::string_view geometry;
    std::string_view fragment;
};
Result<GlProgram> build_program(const ProgramSource& source);

/// The text of a file of viewer/shaders, embedded at build time. \pre there is such a file
std::string_view shader_text(std::string_view file);

}  // namespace relevo::viewer
