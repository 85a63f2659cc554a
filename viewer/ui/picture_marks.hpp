#pragma once

#include <memory>

#include "geo/result.hpp"
#include "lod/view.hpp"
#include "viewer/gl/gl_object.hpp"
#include "viewer/picture.hpp"
#include "viewer/ui/map_marks.hpp"

struct ImGuiContext;

namespace relevo::viewer {

/// Draws marks into finished pictures, with Dear ImGui in a context of its own: the same code as in the
/// window, drawn by the same OpenGL.
class PictureMarks {
  public:
    /// \param scale  how many times as large as in a window (marks_scale)
    /// \pre an OpenGL context is current, the same until this goes
    static Result<PictureMarks> create(double scale);

    double scale() const { return scale_; }

    /// Over a whole picture at once, though it is drawn in tiles of bounded memory. Lengths in `marks` are
    /// pixels of the picture.
    Result<void> draw(const MapMarks& marks, const lod::View& view, Picture& picture);

  private:
    struct Release {
        void operator()(ImGuiContext* context) const;
    };
    PictureMarks() = default;

    double scale_ = 1;
    std::unique_ptr<ImGuiContext, Release> context_;
    GlRenderbuffer colour_;
    GlFramebuffer drawn_;
};

}  // namespace relevo::viewer
