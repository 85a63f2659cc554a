#include "ingest/affine.hpp"

#include <cmath>

namespace relevo::ingest {

Affine Affine::of_posts(const std::array<double, 6>& g) {
    Affine posts;
    // Sums of two where there is no rotation: the north-up case stays free of needless rounding.
    posts.x0 = g[0] + 0.5 * g[1] + 0.5 * g[2];
    posts.y0 = g[3] + 0.5 * g[5] + 0.5 * g[4];
    posts.x_column = g[1];
    posts.x_row = g[2];
    posts.y_column = g[4];
    posts.y_row = g[5];
    return posts;
}

std::optional<Affine> Affine::inverse() const {
    const double determinant = x_column * y_row - x_row * y_column;
    if (!std::isfinite(determinant) || determinant == 0 || !std::isfinite(x0) || !std::isfinite(y0))
        return {};
    Affine inverted;
    inverted.x_column = y_row / determinant;
    inverted.x_row = -x_row / determinant;
    inverted.y_column = -y_column / determinant;
    inverted.y_row = x_column / determinant;
    inverted.x0 = -(inverted.x_column * x0 + inverted.x_row * y0);
    inverted.y0 = -(inverted.y_column * x0 + inverted.y_row * y0);
    return inverted;
}

}  // namespace relevo::ingest
