#pragma once

#include <utility>

namespace relevo::viewer {

/// What OpenGL calls a name: GLuint, without its headers.
using GlName = unsigned int;

enum class GlKind { buffer, framebuffer, program, query, renderbuffer, texture, vertex_array };

/// Makes an object of the kind by direct state access. \pre kind is neither program nor texture nor query,
/// which need more than a kind
GlName create_gl(GlKind kind);
GlName create_gl_texture(unsigned int target);
GlName create_gl_query(unsigned int target);
void destroy_gl(GlKind kind, GlName name);

/// Owns one OpenGL object. \pre destroyed while its context is current
template <GlKind kind>
class GlObject {
  public:
    GlObject() = default;
    explicit GlObject(GlName name) : name_(name) {}
    GlObject(GlObject&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    GlObject& operator=(GlObject&& other) noexcept {
        std::swap(name_, other.name_);
        return *this;
    }
    ~GlObject() {
        if (name_ != 0) destroy_gl(kind, name_);
    }

    static GlObject create() { return GlObject(create_gl(kind)); }

    GlName name() const { return name_; }
    explicit operator bool() const { return name_ != 0; }

  private:
    GlName name_ = 0;
};

using GlBuffer = GlObject<GlKind::buffer>;
using GlFramebuffer = GlObject<GlKind::framebuffer>;
using GlProgram = GlObject<GlKind::program>;
using GlQuery = GlObject<GlKind::query>;
using GlRenderbuffer = GlObject<GlKind::renderbuffer>;
using GlTexture = GlObject<GlKind::texture>;
using GlVertexArray = GlObject<GlKind::vertex_array>;

}  // namespace relevo::viewer
