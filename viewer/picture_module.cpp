#include "viewer/picture_module.hpp"

#include <cstdio>
#include <exception>
#include <string>
#include <string_view>

#include <OpenImageIO/imageio.h>

namespace {

std::string write(const char* file, int width, int height, const std::uint8_t* rgb, const char* description,
                  const char* const* texts, std::size_t count) {
    auto output = OIIO::ImageOutput::create(file);
    if (!output) return OIIO::geterror();
    OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
    spec.attribute("ImageDescription", description);
    spec.attribute("Software", "relevo");
    if (std::string_view(output->format_name()) == "png") {
        for (std::size_t i = 0; i < count; ++i) spec.attribute(texts[2 * i], texts[2 * i + 1]);
    }
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("CompressionQuality", 95);
    if (!output->open(file, spec) || !output->write_image(OIIO::TypeDesc::UINT8, rgb) || !output->close()) {
        return output->geterror();
    }
    return {};
}

}  // namespace

extern "C" __attribute__((visibility("default"))) bool relevo_write_picture(
    const char* file, int width, int height, const std::uint8_t* rgb, const char* description,
    const char* const* texts, std::size_t count, char* reason, std::size_t reason_size) {
    // No exception may leave through a C interface.
    std::string why;
    try {
        why = write(file, width, height, rgb, description, texts, count);
    } catch (const std::exception& error) {
        why = error.what();
    }
    if (why.empty()) return true;
    std::snprintf(reason, reason_size, "%s", why.c_str());
    return false;
}
