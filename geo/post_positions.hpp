#pragma once

#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "geo/frame.hpp"
#include "geo/polar_positions.hpp"

namespace relevo::geo {

/// ECEF positions of a grid's posts without trigonometry. In a geographic grid from tables for rows and
/// columns, which cover the padded grid: two products a coordinate; agrees with GridFrame::ecef to 4 nm for
/// heights from -11 to 9 km (measured: 1.6 nm; the rounding of the tables and of the products). In a polar
/// one by PolarPositions.
class PostPositions {
  public:
    explicit PostPositions(const GridFrame& frame);

    /// What all posts of a row, or of a column, of a geographic grid have in common: at() is made of these.
    struct Row {
        double from_axis;  ///< distance of the ellipsoid from the earth's axis at this latitude, m
        double cos_lat;
        double z;  ///< of the ellipsoid, m
        double sin_lat;
    };
    struct Column {
        double cos_lon;
        double sin_lon;
    };
    /// \pre the grid is geographic
    const Row& row(int row) const { return rows_[static_cast<std::size_t>(row)]; }
    const Column& column(int column) const { return columns_[static_cast<std::size_t>(column)]; }

    /// ECEF, metres. \pre 0 <= column, row < padded_side
    glm::dvec3 at(int column, int row, double h_m) const {
        if (polar_) return polar_->at(column, row, h_m);
        const Row& r = rows_[static_cast<std::size_t>(row)];
        const Column& c = columns_[static_cast<std::size_t>(column)];
        const double from_axis = r.from_axis + h_m * r.cos_lat;
        return {from_axis * c.cos_lon, from_axis * c.sin_lon, r.z + h_m * r.sin_lat};
    }

    /// The ellipsoid's normal at a post: the direction in which its height counts.
    glm::dvec3 normal(int column, int row) const {
        if (polar_) return polar_->normal(column, row);
        const Row& r = rows_[static_cast<std::size_t>(row)];
        const Column& c = columns_[static_cast<std::size_t>(column)];
        return {r.cos_lat * c.cos_lon, r.cos_lat * c.sin_lon, r.sin_lat};
    }

    /// What a polar grid's positions come from; none for a geographic one.
    const PolarPositions* polar() const { return polar_ ? &*polar_ : nullptr; }

  private:
    std::optional<PolarPositions> polar_;
    std::vector<Row> rows_;
    std::vector<Column> columns_;
};

}  // namespace relevo::geo
