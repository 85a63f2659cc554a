#pragma once

#include <array>
#include <utility>

namespace relevo::viewer {

/// What OpenGL calls a name: GLuint, without its headers.
using GlName = unsigned int;

enum class GlKind { buffer, framebuffer, program, query, renderbuffer, texture, vertex_array };
inline constexpr int kGlKinds = 7;

/// Makes an object of the kind by direct state access. \pre kind is neither program nor texture nor query,
/// which need more than a kind
GlName create_gl(GlKind kind);
GlName create_gl_texture(unsigned int target);
GlName create_gl_query(unsigned int target);
void destroy_gl(GlKind kind, GlName name);

/// How many objects of each kind GlObjects own now, in the order of GlKind: what a layer that is off must not
/// add to. Of the whole process, as contexts share none of them.
using GlCounts = std::array<int, kGlKinds>;
GlCounts gl_counts();
void count_gl(GlKind kind, int more);
const char* to_string(GlKind kind);

/// Owns one OpenGL object. \pre destroyed while its context is current
template <GlKind kind>
class GlObject {
  public:
    GlObject() = default;
    explicit GlObject(GlName name) : name_(name) {
        if (name != 0) count_gl(kind, 1);
    }
    GlObject(GlObject&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    GlObject& operator=(GlObject&& other) noexcept {
        std::swap(name_, other.name_);
        return *this;
    }
    ~GlObject() {
        if (name_ == 0) return;
        destroy_gl(kind, name_);
        count_gl(kind, -1);
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
