#pragma once

#include <limits>
#include <vector>

#include <epoxy/gl.h>

#include "tests/bench/peers/flat_path.hpp"

namespace relevo::peers {

/// Reads back the depth of what is current: along the view direction, metres, from the upper left corner;
/// infinite where nothing was drawn.
/// \param from_0  what the projection makes of the near plane: 0 in Direct3D's manner, else -1
inline std::vector<double> read_depth(int width, int height, double near, double far, bool from_0) {
    const auto columns = static_cast<std::size_t>(width);
    std::vector<float> stored(columns * static_cast<std::size_t>(height));
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glReadPixels(0, 0, width, height, GL_DEPTH_COMPONENT, GL_FLOAT, stored.data());
    std::vector<double> depth(stored.size(), std::numeric_limits<double>::infinity());
    for (std::size_t k = 0; k < stored.size(); ++k) {
        if (stored[k] >= 1) continue;
        const double z = 2 * static_cast<double>(stored[k]) - 1;
        const std::size_t row =
            static_cast<std::size_t>(height) - 1 - k / columns;  // OpenGL's rows run upwards
        depth[row * columns + k % columns] =
            from_0 ? far * near / (far - z * (far - near)) : 2 * far * near / (far + near - z * (far - near));
    }
    return depth;
}

}  // namespace relevo::peers
