#include "viewer/gl/render_target.hpp"

#include <algorithm>
#include <array>
#include <cassert>

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "viewer/gl/gl_check.hpp"

namespace relevo::viewer {

namespace {

GlRenderbuffer renderbuffer(GLenum format, int samples, int width, int height) {
    auto buffer = GlRenderbuffer::create();
    glNamedRenderbufferStorageMultisample(buffer.name(), samples == 1 ? 0 : samples, format, width, height);
    return buffer;
}

/// Colour in the order that windows have: showing is then no more than copying, which a software renderer
/// does six times as fast as converting. Only OpenGL's older call leaves the order to who fills it.
GlTexture window_colour(int width, int height) {
    GlTexture made(create_gl_texture(GL_TEXTURE_2D));
    glBindTexture(GL_TEXTURE_2D, made.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, width, height, 0, GL_BGRA, GL_UNSIGNED_BYTE, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    glBindTexture(GL_TEXTURE_2D, 0);
    return made;
}

GlFramebuffer framebuffer(const GlRenderbuffer& colour, const GlRenderbuffer* depth) {
    auto made = GlFramebuffer::create();
    glNamedFramebufferRenderbuffer(made.name(), GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour.name());
    if (depth != nullptr) {
        glNamedFramebufferRenderbuffer(made.name(), GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth->name());
    }
    return made;
}

bool complete(const GlFramebuffer& made) {
    return glCheckNamedFramebufferStatus(made.name(), GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

}  // namespace

Result<RenderTarget> RenderTarget::create(int width, int height, int samples) {
    assert(width > 0 && height > 0 && (samples == 1 || samples == 4 || samples == 8));
    GLint most = 1;
    glGetIntegerv(GL_MAX_SAMPLES, &most);
    RenderTarget made;
    made.width_ = width;
    made.height_ = height;
    made.samples_ = samples;
    made.widening_ = samples == 8 && most < 8 ? 2 : 1;
    const int drawn_samples = samples / made.widening_;
    const int drawn_width = made.draw_width();

    made.depth_ = renderbuffer(GL_DEPTH_COMPONENT32F, drawn_samples, drawn_width, height);
    if (drawn_samples == 1) {
        made.shown_colour_ = window_colour(width, height);
        made.drawn_ = GlFramebuffer::create();
        glNamedFramebufferTexture(made.drawn_.name(), GL_COLOR_ATTACHMENT0, made.shown_colour_.name(), 0);
        glNamedFramebufferRenderbuffer(made.drawn_.name(), GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                       made.depth_.name());
    } else {
        made.drawn_colour_ = renderbuffer(GL_RGBA8, drawn_samples, drawn_width, height);
        made.drawn_ = framebuffer(made.drawn_colour_, &made.depth_);
    }
    bool whole = complete(made.drawn_);
    if (drawn_samples > 1) {
        made.resolved_colour_ = renderbuffer(GL_RGBA8, 1, drawn_width, height);
        made.resolved_ = framebuffer(made.resolved_colour_, nullptr);
        whole = whole && complete(made.resolved_);
    }
    if (made.widening_ > 1) {
        made.narrow_colour_ = renderbuffer(GL_RGBA8, 1, width, height);
        made.narrow_ = framebuffer(made.narrow_colour_, nullptr);
        whole = whole && complete(made.narrow_);
    }
    if (auto done = gl_check(fmt::format("making a {} x {} picture with {} samples", width, height, samples));
        !done) {
        return done.error();
    }
    if (!whole) {
        return Error{
            ErrorKind::internal,
            fmt::format("OpenGL cannot draw into a {} x {} picture with {} samples", width, height, samples)};
    }
    return made;
}

void RenderTarget::begin(float red, float green, float blue) const {
    glBindFramebuffer(GL_FRAMEBUFFER, drawn_.name());
    glViewport(0, 0, draw_width(), height_);
    glClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
    glDisable(GL_SCISSOR_TEST);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_TRUE);
    const std::array<GLfloat, 4> colour{red, green, blue, 1};
    const GLfloat infinitely_far = 0;
    glClearNamedFramebufferfv(drawn_.name(), GL_COLOR, 0, colour.data());
    glClearNamedFramebufferfv(drawn_.name(), GL_DEPTH, 0, &infinitely_far);
}

void RenderTarget::resolve() const {
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    if (!resolved_) return;
    glBlitNamedFramebuffer(drawn_.name(), resolved_.name(), 0, 0, draw_width(), height_, 0, 0, draw_width(),
                           height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    if (!narrow_) return;
    // Halving with a linear filter takes each pixel from the middle between two: their plain average.
    glBlitNamedFramebuffer(resolved_.name(), narrow_.name(), 0, 0, draw_width(), height_, 0, 0, width_,
                           height_, GL_COLOR_BUFFER_BIT, GL_LINEAR);
}

GlName RenderTarget::finished() const {
    if (narrow_) return narrow_.name();
    return resolved_ ? resolved_.name() : drawn_.name();
}

void RenderTarget::read_into(Picture& picture, int x, int y) const {
    std::vector<std::uint8_t> pixels(4 * static_cast<std::size_t>(width_) *
                                     static_cast<std::size_t>(height_));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, finished());
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    const int columns = std::min(width_, picture.width - x);
    const int rows = std::min(height_, picture.height - y);
    for (int row = 0; row < rows; ++row) {
        const std::uint8_t* from =
            pixels.data() + 4 * static_cast<std::size_t>(width_) * static_cast<std::size_t>(row);
        std::uint8_t* to = picture.pixel(x, y + row);
        for (int column = 0; column < columns; ++column, from += 4, to += 3) std::copy_n(from, 3, to);
    }
}

void RenderTarget::show() const {
    // The window's rows run upwards.
    glBlitNamedFramebuffer(finished(), 0, 0, 0, width_, height_, 0, height_, width_, 0, GL_COLOR_BUFFER_BIT,
                           GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, width_, height_);
}

}  // namespace relevo::viewer
