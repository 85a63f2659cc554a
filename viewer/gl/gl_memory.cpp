#include "viewer/gl/gl_memory.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include <epoxy/gl.h>

namespace relevo::viewer {

bool gl_is_software() {
    const auto* text = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    const std::string_view renderer = text != nullptr ? text : "";
    return renderer.find("llvmpipe") != std::string_view::npos ||
           renderer.find("softpipe") != std::string_view::npos;
}

std::optional<std::uint64_t> free_graphics_memory() {
    // Software renderers tell of the machine's memory by the same extensions.
    if (gl_is_software()) return std::nullopt;
    GLint kibibytes = 0;
    if (epoxy_has_gl_extension("GL_NVX_gpu_memory_info")) {
        glGetIntegerv(GL_GPU_MEMORY_INFO_CURRENT_AVAILABLE_VIDMEM_NVX, &kibibytes);
    } else if (epoxy_has_gl_extension("GL_ATI_meminfo")) {
        std::array<GLint, 4> pool{};  // free; its largest block; the same of memory that is lent
        glGetIntegerv(GL_TEXTURE_FREE_MEMORY_ATI, pool.data());
        kibibytes = pool[0];
    }
    if (kibibytes <= 0) return std::nullopt;
    return static_cast<std::uint64_t>(kibibytes) << 10;
}

}  // namespace relevo::viewer
