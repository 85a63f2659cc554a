#pragma once

#include <array>
#include <optional>

namespace relevo::ingest {

/// A place in a plane: in a grid (column, row; posts are at whole numbers) or in a CRS (x east or longitude,
/// y north or latitude, in the CRS's unit). Which one is said where it is used.
struct Place {
    double x = 0;
    double y = 0;
};

/// Where the posts of a raster lie in its CRS: x = x0 + x_column * column + x_row * row, y likewise.
struct Affine {
    double x0 = 0, x_column = 0, x_row = 0;
    double y0 = 0, y_column = 0, y_row = 0;

    /// From GDAL's geotransform, which places the outer corners of pixels: a post is the centre of its pixel.
    /// GDAL has applied the half pixel of pixel-is-point files already, so this is right for both kinds of
    /// raster.
    static Affine of_posts(const std::array<double, 6>& geotransform);

    Place at(Place post) const {
        return {x0 + x_column * post.x + x_row * post.y, y0 + y_column * post.x + y_row * post.y};
    }

    /// Nothing where the posts lie on a line or at a point, or a coefficient is not finite.
    std::optional<Affine> inverse() const;
};

/// A rectangle of posts of a grid.
struct Window {
    int column = 0;
    int row = 0;
    int columns = 0;
    int rows = 0;
};

/// A rectangle in a CRS. For longitudes east may be below west: it lies across the antimeridian.
struct Bounds {
    double west = 0;
    double south = 0;
    double east = 0;
    double north = 0;
};

}  // namespace relevo::ingest
