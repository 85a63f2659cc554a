#pragma once

#include <cstdint>
#include <optional>

namespace relevo::viewer {

/// Does OpenGL run on the processor, in its memory?
bool gl_is_software();

/// Free memory of the graphics card, bytes, by GL_NVX_gpu_memory_info or GL_ATI_meminfo; nothing where the
/// driver tells neither, or OpenGL is software. \pre a context is current
std::optional<std::uint64_t> free_graphics_memory();

}  // namespace relevo::viewer
