#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "geo/result.hpp"

namespace relevo::viewer {

/// A finished picture: 8 bits red, green, blue, row by row from the upper left corner.
struct Picture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;

    Picture() = default;
    Picture(int w, int h)
        : width(w), height(h), rgb(3 * static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}

    std::uint8_t* pixel(int x, int y) {
        return rgb.data() + 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                 static_cast<std::size_t>(x));
    }
    std::array<int, 3> at(int x, int y) const {
        const std::uint8_t* p = const_cast<Picture*>(this)->pixel(x, y);
        return {p[0], p[1], p[2]};
    }
};

/// Fails with ErrorKind::usage where a picture cannot be written to a file of this name, before anything is
/// drawn.
Result<void> check_picture_name(const std::filesystem::path& file);

/// What is written beside the pixels. All formats keep the description, PNG also the texts (tEXt chunks).
struct PictureNotes {
    std::string description;
    std::vector<std::pair<std::string, std::string>> texts = {};  ///< key, value
};

/// Writes PNG, JPEG or TIFF by the file's extension; the file appears when it is whole.
Result<void> write_picture(const Picture& picture, const std::filesystem::path& file,
                           const PictureNotes& notes);

}  // namespace relevo::viewer
