#include "viewer/gl/gl_context_egl.hpp"

#include <array>

#include <epoxy/egl.h>
#include <fmt/format.h>

#include "viewer/gl/gl_check.hpp"

namespace relevo::viewer {

struct OffscreenContext::State {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
};

void OffscreenContext::Release::operator()(State* state) const {
    if (state->display != EGL_NO_DISPLAY) {
        eglMakeCurrent(state->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (state->context != EGL_NO_CONTEXT) eglDestroyContext(state->display, state->context);
        eglTerminate(state->display);
    }
    delete state;
}

OffscreenContext::OffscreenContext(std::unique_ptr<State, Release> state) : state_(std::move(state)) {}

namespace {

Error no_context(const char* step) {
    return {
        ErrorKind::internal,
        fmt::format("no off-screen OpenGL: {} failed (EGL error 0x{:x}). Relevo needs OpenGL 4.5 by EGL's "
                    "surfaceless platform; Mesa has it (Debian: libegl-mesa0, libgl1-mesa-dri)",
                    step, eglGetError())};
}

}  // namespace

Result<OffscreenContext> OffscreenContext::create() {
    std::unique_ptr<State, Release> state(new State);
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
        return no_context("finding the platform EGL_MESA_platform_surfaceless");
    }
    state->display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (state->display == EGL_NO_DISPLAY) return no_context("eglGetPlatformDisplay");
    if (eglInitialize(state->display, nullptr, nullptr) == EGL_FALSE) {
        state->display = EGL_NO_DISPLAY;
        return no_context("eglInitialize");
    }
    if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) return no_context("eglBindAPI");
    const std::array<EGLint, 9> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                           4,
                                           EGL_CONTEXT_MINOR_VERSION,
                                           5,
                                           EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                           EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                           EGL_CONTEXT_OPENGL_DEBUG,
                                           EGL_TRUE,
                                           EGL_NONE};
    state->context = eglCreateContext(state->display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
    if (state->context == EGL_NO_CONTEXT) return no_context("making an OpenGL 4.5 core context");
    if (eglMakeCurrent(state->display, EGL_NO_SURFACE, EGL_NO_SURFACE, state->context) == EGL_FALSE) {
        return no_context("eglMakeCurrent");
    }
    if (auto done = prepare_gl(); !done) return done.error();
    return OffscreenContext(std::move(state));
}

}  // namespace relevo::viewer
