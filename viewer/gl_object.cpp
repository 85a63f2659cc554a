#include "viewer/gl_object.hpp"

#include <cassert>

#include <epoxy/gl.h>

namespace relevo::viewer {

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
