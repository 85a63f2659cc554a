#include "viewer/gl/gl_check.hpp"

#include <epoxy/gl.h>
#include <fmt/format.h>

namespace relevo::viewer {

namespace {

// The messages of the thread's current context. OpenGL's callback has no other place to leave them: a context
// belongs to a thread, and so do its errors.
thread_local std::string first_message;

void GLAPIENTRY keep_message(GLenum, GLenum type, GLuint, GLenum severity, GLsizei, const GLchar* text,
                             const void*) {
    if (type != GL_DEBUG_TYPE_ERROR || severity == GL_DEBUG_SEVERITY_NOTIFICATION) return;
    if (first_message.empty()) first_message = text;
}

const char* error_name(GLenum error) {
    switch (error) {
        case GL_INVALID_ENUM:
            return "invalid enum";
        case GL_INVALID_VALUE:
            return "invalid value";
        case GL_INVALID_OPERATION:
            return "invalid operation";
        case GL_INVALID_FRAMEBUFFER_OPERATION:
            return "invalid framebuffer operation";
        case GL_OUT_OF_MEMORY:
            return "out of memory";
        default:
            return "unknown error";
    }
}

}  // namespace

Result<void> prepare_gl() {
    first_message.clear();
    if (epoxy_gl_version() < 45) {
        const auto* version = reinterpret_cast<const char*>(glGetString(GL_VERSION));
        return Error{ErrorKind::internal,
                     fmt::format("OpenGL 4.5 is needed, and this machine's driver offers {}",
                                 version != nullptr ? version : "none")};
    }
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(keep_message, nullptr);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    return gl_check("preparing OpenGL");
}

Result<void> gl_check(std::string_view doing) {
    GLenum error = glGetError();
    const std::string message = std::exchange(first_message, {});
    if (error == GL_NO_ERROR && message.empty()) return {};
    const char* name = error == GL_NO_ERROR ? "debug message" : error_name(error);
    // A lost context reports for ever: take what is queued, not all that comes.
    for (int i = 0; i < 16 && error != GL_NO_ERROR; ++i) error = glGetError();
    return Error{ErrorKind::internal, fmt::format("OpenGL failed while {}: {}{}{}", doing, name,
                                                  message.empty() ? "" : ": ", message)};
}

void gl_finish() {
    glFinish();
}

std::string gl_description() {
    const auto* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    const auto* version = reinterpret_cast<const char*>(glGetString(GL_VERSION));
    return fmt::format("{}, {}", renderer != nullptr ? renderer : "unknown",
                       version != nullptr ? version : "unknown");
}

}  // namespace relevo::viewer
