#pragma once

#include <string>
#include <string_view>

#include "geo/result.hpp"

namespace relevo::viewer {

/// What is drawn over a picture for who reads it as a map.
struct Marks {
    bool legend = false;  ///< of the layer's colours, where these are values
    bool scale = false;   ///< a bar
    bool north = false;   ///< an arrow in a rose
    bool labels = false;  ///< of contours and the graticule

    bool any() const { return legend || scale || north || labels; }
    friend bool operator==(const Marks&, const Marks&) = default;
};

/// Reads "all", "none", or some of "legend,scale,north,labels".
Result<Marks> parse_marks(std::string_view text);
std::string to_string(const Marks& marks);

/// Pictures with marks are no smaller: there the marks would lie over each other.
inline constexpr int kLeastMarkedWidth = 320;
inline constexpr int kLeastMarkedHeight = 240;

/// How many times as large as in a window of 1280 x 720 marks are in a picture; never smaller.
double marks_scale(int width, int height);

}  // namespace relevo::viewer
