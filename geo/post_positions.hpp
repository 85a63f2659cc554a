#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "geo/frame.hpp"

namespace relevo::geo {

/// ECEF positions of a grid's posts from tables for rows and columns: two products a coordinate and no
/// trigonometry. Agrees with GridFrame::ecef to 4 nm for heights from -11 to 9 km (measured: 1.6 nm; the
/// rounding of the tables and of the products). The tables cover the padded grid.
class PostPositions {
  public:
    explicit PostPositions(const GridFrame& frame);

    /// ECEF, metres. \pre 0 <= column, row < padded_side
    glm::dvec3 at(int column, int row, double h_m) const {
        const Row& r = rows_[static_cast<std::size_t>(row)];
        const Column& c = columns_[static_cast<std::size_t>(column)];
        const double from_axis = r.from_axis + h_m * r.cos_lat;
        return {from_axis * c.cos_lon, from_axis * c.sin_lon, r.z + h_m * r.sin_lat};
    }

    /// The ellipsoid's normal at a post: the direction in which its height counts.
    glm::dvec3 normal(int column, int row) const {
        const Row& r = rows_[static_cast<std::size_t>(row)];
        const Column& c = columns_[static_cast<std::size_t>(column)];
        return {r.cos_lat * c.cos_lon, r.cos_lat * c.sin_lon, r.sin_lat};
    }

  private:
    struct Row {
        double from_axis;  // distance of the ellipsoid from the earth's axis at this latitude, m
        double cos_lat;
        double z;  // of the ellipsoid, m
        double sin_lat;
    };
    struct Column {
        double cos_lon;
        double sin_lon;
    };
    std::vector<Row> rows_;
    std::vector<Column> columns_;
};

}  // namespace relevo::geo
