#pragma once

#include <cstddef>
#include <cstdint>

namespace relevo::viewer {

/// The one function of the module that knows OpenImageIO. False on failure, with the reason, zero-terminated,
/// in `reason`. `texts` are `count` keys, each before its value. A C interface, because it is looked up by
/// name.
using WritePicture = bool (*)(const char* file, int width, int height, const std::uint8_t* rgb,
                              const char* description, const char* const* texts, std::size_t count,
                              char* reason, std::size_t reason_size);
inline constexpr const char* kWritePictureName = "relevo_write_picture";

}  // namespace relevo::viewer
