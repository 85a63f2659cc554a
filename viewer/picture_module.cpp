#include "viewer/picture_module.hpp"

#include <cstdio>
#include <exception>
#include <string>

#include <OpenImageIO/imageio.h>

namespace {

std::string write(const char* file, int width, int height, const std::uint8_t* rgb, const char* description) {
    auto output = OIIO::ImageOutput::create(file);
    if (!output) return OIIO::geterror();
    OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
    spec.attribute("ImageDescription", description);
    spec.attribute("Software", "relevo");
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("CompressionQuality", 95);
    if (!output->open(file, spec) || !output->write_image(OIIO::TypeDesc::UINT8, rgb) || !output->close()) {
        return output->geterror();
    }
    return {};
}

}  // namespace

extern "C" __attribute__((visibility("default"))) bool relevo_write_picture(
    const char* file, int width, int height, const std::uint8_t* rgb, const char* description, char* reason,
    std::size_t reason_size) {
    // No exception may leave through a C interface.
    std::string why;
    try {
        why = write(file, width, height, rgb, description);
    } catch (const std::exception& error) {
        why = error.what();
    }
    if (why.empty()) return true;
    std::snprintf(reason, reason_size, "%s", why.c_str());
    return false;
}
