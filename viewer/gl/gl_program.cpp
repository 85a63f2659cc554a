#include "viewer/gl/gl_program.hpp"

#include <array>

#include <epoxy/gl.h>
#include <fmt/format.h>

namespace relevo::viewer {

namespace {

/// A compiled shader on its way into a program.
class Shader {
  public:
    explicit Shader(GLenum stage) : name_(glCreateShader(stage)) {}
    Shader(const Shader&) = delete;
    Shader& operator=(const Shader&) = delete;
    ~Shader() { glDeleteShader(name_); }

    Result<void> compile(const ProgramSource& source, std::string_view text) {
        const std::string head = "#version 450 core\n" + source.defines;
        const std::array<std::string_view, 3> parts{head, source.common, text};
        std::array<const GLchar*, 3> strings{};
        std::array<GLint, 3> lengths{};
        for (std::size_t i = 0; i < parts.size(); ++i) {
            strings[i] = parts[i].empty() ? "" : parts[i].data();  // OpenGL takes no null
            lengths[i] = static_cast<GLint>(parts[i].size());
        }
        glShaderSource(name_, static_cast<GLsizei>(parts.size()), strings.data(), lengths.data());
        glCompileShader(name_);
        GLint done = GL_FALSE;
        glGetShaderiv(name_, GL_COMPILE_STATUS, &done);
        if (done == GL_TRUE) return {};
        std::string log(4096, '\0');
        GLsizei length = 0;
        glGetShaderInfoLog(name_, static_cast<GLsizei>(log.size()), &length, log.data());
        log.resize(static_cast<std::size_t>(length));
        return Error{ErrorKind::internal,
                     fmt::format("the shader \"{}\" does not compile: {}", source.name, log)};
    }

    GLuint name() const { return name_; }

  private:
    GLuint name_;
};

}  // namespace

Result<GlProgram> build_program(const ProgramSource& source) {
    Shader vertex(GL_VERTEX_SHADER);
    Shader geometry(GL_GEOMETRY_SHADER);
    Shader fragment(GL_FRAGMENT_SHADER);
    GlProgram program(glCreateProgram());
    if (auto done = vertex.compile(source, source.vertex); !done) return done.error();
    if (auto done = fragment.compile(source, source.fragment); !done) return done.error();
    glAttachShader(program.name(), vertex.name());
    glAttachShader(program.name(), fragment.name());
    if (!source.geometry.empty()) {
        if (auto done = geometry.compile(source, source.geometry); !done) return done.error();
        glAttachShader(program.name(), geometry.name());
    }
    glLinkProgram(program.name());
    GLint done = GL_FALSE;
    glGetProgramiv(program.name(), GL_LINK_STATUS, &done);
    if (done != GL_TRUE) {
        std::string log(4096, '\0');
        GLsizei length = 0;
        glGetProgramInfoLog(program.name(), static_cast<GLsizei>(log.size()), &length, log.data());
        log.resize(static_cast<std::size_t>(length));
        return Error{ErrorKind::internal,
                     fmt::format("the program \"{}\" does not link: {}", source.name, log)};
    }
    return program;
}

}  // namespace relevo::viewer
