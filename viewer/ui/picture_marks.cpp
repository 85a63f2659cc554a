#include "viewer/ui/picture_marks.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>
#include <imgui.h>

#include "viewer/gl/gl_check.hpp"
#include "viewer/ui/font.hpp"

namespace relevo::viewer {

namespace {

constexpr int kTile = 1024;

/// Makes a context ImGui's current one, and the one before that again.
class InContext {
  public:
    explicit InContext(ImGuiContext* context) : before_(ImGui::GetCurrentContext()) {
        ImGui::SetCurrentContext(context);
    }
    InContext(const InContext&) = delete;
    InContext& operator=(const InContext&) = delete;
    ~InContext() { ImGui::SetCurrentContext(before_); }

  private:
    ImGuiContext* before_;
};

/// Lays a tile of colours that are multiplied by their opacity over a part of a picture. The tile's rows run
/// upwards.
void lay_over(const std::vector<std::uint8_t>& tile, Picture& picture, int left, int top) {
    const int columns = std::min(kTile, picture.width - left);
    const int rows = std::min(kTile, picture.height - top);
    for (int row = 0; row < rows; ++row) {
        const std::uint8_t* from =
            tile.data() + 4 * static_cast<std::size_t>(kTile) * static_cast<std::size_t>(kTile - 1 - row);
        std::uint8_t* to = picture.pixel(left, top + row);
        for (int column = 0; column < columns; ++column, from += 4, to += 3) {
            if (from[3] == 0) continue;
            for (int i = 0; i < 3; ++i) {
                const int below = (to[i] * (255 - from[3]) + 127) / 255;
                to[i] = static_cast<std::uint8_t>(std::min(from[i] + below, 255));
            }
        }
    }
}

}  // namespace

void PictureMarks::Release::operator()(ImGuiContext* context) const {
    // The context that was current may be this one.
    ImGuiContext* before = ImGui::GetCurrentContext();
    ImGui::SetCurrentContext(context);
    if (ImGui::GetIO().BackendRendererUserData != nullptr) ImGui_ImplOpenGL3_Shutdown();
    ImGui::SetCurrentContext(before == context ? nullptr : before);
    ImGui::DestroyContext(context);
}

Result<PictureMarks> PictureMarks::create(double scale) {
    PictureMarks made;
    made.scale_ = scale;
    IMGUI_CHECKVERSION();
    ImGuiContext* before = ImGui::GetCurrentContext();
    made.context_.reset(ImGui::CreateContext());
    ImGui::SetCurrentContext(before);
    const InContext in(made.context_.get());
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    add_font(*io.Fonts, static_cast<float>(scale));
    io.FontGlobalScale = static_cast<float>(1 / scale);
    if (!ImGui_ImplOpenGL3_Init("#version 450 core"))
        return Error{ErrorKind::internal, "marks cannot be drawn with this OpenGL"};
    made.colour_ = GlRenderbuffer::create();
    glNamedRenderbufferStorage(made.colour_.name(), GL_RGBA8, kTile, kTile);
    made.drawn_ = GlFramebuffer::create();
    glNamedFramebufferRenderbuffer(made.drawn_.name(), GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                   made.colour_.name());
    if (auto done = gl_check("preparing to draw marks"); !done) return done.error();
    return made;
}

Result<void> PictureMarks::draw(const MapMarks& marks, const lod::View& view, Picture& picture) {
    const InContext in(context_.get());
    const auto scale = static_cast<float>(scale_);
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(picture.width) / scale, static_cast<float>(picture.height) / scale};
    io.DisplayFramebufferScale = {scale, scale};
    io.DeltaTime = 1;
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    draw_map_marks(*ImGui::GetBackgroundDrawList(), marks, view, 1 / scale);
    ImGui::Render();
    ImDrawData& drawn = *ImGui::GetDrawData();

    std::vector<std::uint8_t> tile(4 * static_cast<std::size_t>(kTile) * kTile);
    glBindFramebuffer(GL_FRAMEBUFFER, drawn_.name());
    for (int top = 0; top < picture.height; top += kTile) {
        for (int left = 0; left < picture.width; left += kTile) {
            drawn.DisplayPos = {static_cast<float>(left) / scale, static_cast<float>(top) / scale};
            drawn.DisplaySize = {kTile / scale, kTile / scale};
            const std::array<GLfloat, 4> nothing{0, 0, 0, 0};
            glDisable(GL_SCISSOR_TEST);
            glClearNamedFramebufferfv(drawn_.name(), GL_COLOR, 0, nothing.data());
            ImGui_ImplOpenGL3_RenderDrawData(&drawn);
            glPixelStorei(GL_PACK_ALIGNMENT, 4);
            glReadPixels(0, 0, kTile, kTile, GL_RGBA, GL_UNSIGNED_BYTE, tile.data());
            lay_over(tile, picture, left, top);
        }
    }
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    return gl_check("drawing marks");
}

}  // namespace relevo::viewer
