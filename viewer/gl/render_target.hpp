#pragma once

#include "geo/result.hpp"
#include "viewer/gl/gl_object.hpp"
#include "viewer/picture.hpp"

namespace relevo::viewer {

/// What is drawn into: colour and reversed float depth, with 1, 4 or 8 samples a pixel. Where the driver has
/// fewer than 8, it draws at twice the width with 4 and averages. Its first row is the picture's upper one,
/// as in windows' memory: showing it copies rows, where OpenGL's own order would have each pixel turned over.
class RenderTarget {
  public:
    static Result<RenderTarget> create(int width, int height, int samples);

    int width() const { return width_; }
    int height() const { return height_; }
    int samples() const { return samples_; }

    /// Size of what is drawn into.
    int draw_width() const { return width_ * widening_; }
    /// How much wider than high a pixel of what is drawn into counts: 1 or 2.
    int widening() const { return widening_; }

    /// Makes it the place that is drawn into, and clears it: the colour, and depth 0, which is infinitely
    /// far.
    void begin(float red, float green, float blue) const;
    /// Averages the samples. After this it can be read and shown, and others draw in OpenGL's own order
    /// again.
    void resolve() const;

    /// Copies the picture into a larger one, its upper left corner at (x, y); parts outside are left out.
    void read_into(Picture& picture, int x, int y) const;
    /// Copies the picture into the window's own frame.
    void show() const;

  private:
    RenderTarget() = default;

    int width_ = 0;
    int height_ = 0;
    int samples_ = 1;
    int widening_ = 1;
    GlTexture shown_colour_;       // only with one sample
    GlRenderbuffer drawn_colour_;  // only with several
    GlRenderbuffer depth_;
    GlFramebuffer drawn_;
    GlRenderbuffer resolved_colour_;  // only with several samples
    GlFramebuffer resolved_;
    GlRenderbuffer narrow_colour_;  // only when widened
    GlFramebuffer narrow_;

    GlName finished() const;
};

}  // namespace relevo::viewer
