#include "viewer/gl/gl_object.hpp"

#include <atomic>
#include <cassert>

#include <epoxy/gl.h>

namespace relevo::viewer {

namespace {

std::array<std::atomic<int>, kGlKinds> counts;

}  // namespace

GlCounts gl_counts() {
    GlCounts now{};
    for (std::size_t i = 0; i < now.size(); ++i) now[i] = counts[i];
    return now;
}

void count_gl(GlKind kind, int more) {
    counts[static_cast<std::size_t>(kind)] += more;
}

const char* to_string(GlKind kind) {
    switch (kind) {
        case GlKind::buffer:
            return "buffers";
        case GlKind::framebuffer:
            return "framebuffers";
        case GlKind::program:
            return "programs";
        case GlKind::query:
            return "queries";
        case GlKind::renderbuffer:
            return "renderbuffers";
        case GlKind::texture:
            return "textures";
        case GlKind::vertex_array:
            break;
    }
    return "vertex_arrays";
}

GlName create_gl(GlKind kind) {
    GLuint name = 0;
    switch (kind) {
        case GlKind::buffer:
            glCreateBuffers(1, &name);
            break;
        case GlKind::framebuffer:
            glCreateFramebuffers(1, &name);
            break;
        case GlKind::renderbuffer:
            glCreateRenderbuffers(1, &name);
            break;
        case GlKind::vertex_array:
            glCreateVertexArrays(1, &name);
            break;
        case GlKind::program:
        case GlKind::query:
        case GlKind::texture:
            assert(false);
            break;
    }
    return name;
}

GlName create_gl_texture(unsigned int target) {
    GLuint name = 0;
    glCreateTextures(target, 1, &name);
    return name;
}

GlName create_gl_query(unsigned int target) {
    GLuint name = 0;
    glCreateQueries(target, 1, &name);
    return name;
}

void destroy_gl(GlKind kind, GlName name) {
    switch (kind) {
        case GlKind::buffer:
            glDeleteBuffers(1, &name);
            break;
        case GlKind::framebuffer:
            glDeleteFramebuffers(1, &name);
            break;
        case GlKind::program:
            glDeleteProgram(name);
            break;
        case GlKind::query:
            glDeleteQueries(1, &name);
            break;
        case GlKind::renderbuffer:
            glDeleteRenderbuffers(1, &name);
            break;
        case GlKind::texture:
            glDeleteTextures(1, &name);
            break;
        case GlKind::vertex_array:
            glDeleteVertexArrays(1, &name);
            break;
    }
}

}  // namespace relevo::viewer
