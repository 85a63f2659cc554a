#include "lod/static_mesh/surface.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace relevo::lod {

HeightSurface::Plane::Plane(const HeightSurface& surface, const PostTriangle& t)
    : heights_(surface.heights_),
      column_(t[0].column),
      row_(t[0].row),
      H_(surface.height(t[0])),
      area_(static_cast<double>(turn(t[0], t[1], t[2]))) {
    const double b = surface.height(t[1]) - H_;
    const double c = surface.height(t[2]) - H_;
    dx_ = c * (t[1].row - row_) - b * (t[2].row - row_);
    dy_ = b * (t[2].column - column_) - c * (t[1].column - column_);
}

bool HeightSurface::Plane::exceeds(int row, int first, int last, double error_m) const {
    // Some posts at a time, without a branch between them.
    constexpr int kStride = 32;
    const float* H = heights_.row(row);
    // Rounded down unless the product is exact, so that no quotient by the area (at) exceeds the error.
    constexpr double kDown = 1 - 0x1p-52;
    const double limit =
        error_m * area_ * (std::has_single_bit(static_cast<std::uint64_t>(area_)) ? 1 : kDown);
    for (int start = first; start <= last; start += kStride) {
        const int end = std::min(start + kStride - 1, last);
        int over = 0;
        for (int column = start; column <= end; ++column)
            over |= static_cast<int>(std::abs(scaled(H, column, row)) > limit);
        if (over != 0) return true;
    }
    return false;
}

SpaceSurface::Plane::Plane(const SpaceSurface& surface, const PostTriangle& t)
    : surface_(surface), column_(t[0].column), row_(t[0].row), p_(surface.position(t[0].column, t[0].row)) {
    const glm::dvec3 b = surface.position(t[1].column, t[1].row) - p_;
    const glm::dvec3 c = surface.position(t[2].column, t[2].row) - p_;
    const double area = static_cast<double>(turn(t[0], t[1], t[2]));
    dx_ = (c * static_cast<double>(t[1].row - row_) - b * static_cast<double>(t[2].row - row_)) / area;
    dy_ = (b * static_cast<double>(t[2].column - column_) - c * static_cast<double>(t[1].column - column_)) /
          area;
}

bool SpaceSurface::Plane::exceeds(int row, int first, int last, double error_m) const {
    for (int column = first; column <= last; ++column) {
        const glm::dvec3 d = offset(column, row);
        if (glm::dot(d, d) > error_m * error_m) return true;
    }
    return false;
}

}  // namespace relevo::lod
