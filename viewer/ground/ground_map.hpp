#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace relevo::viewer {

/// What the user says natural ground is made of: shares of grass, rock, gravel and snow, parts of 255, over
/// the data's grid from half a post before its first post to half a post after its last, row by row from the
/// first. What is left of 255 is as slope, height and class have it.
struct GroundMap {
    int columns = 0;
    int rows = 0;
    std::vector<std::array<std::uint8_t, 4>> shares;
};

}  // namespace relevo::viewer
