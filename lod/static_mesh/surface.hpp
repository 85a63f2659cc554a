#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "geo/post_positions.hpp"
#include "lod/scene/raster.hpp"
#include "lod/static_mesh/grid_triangle.hpp"
#include "lod/undulation_grid.hpp"

namespace relevo::lod {

// How far a triangle is from the ground, at the posts that it covers. Two ways to compare the two at the same
// place of the grid: by height alone, or by distance in space.

/// Heights above the grid's plane: for meshes in the coordinates of the grid, or of a map.
class HeightSurface {
  public:
    /// \param heights  void = NaN; must outlive this
    explicit HeightSurface(const Raster<float>& heights) : heights_(heights) {}

    /// A triangle's plane, |heights of the plane - heights of posts|. Everything is multiplied by the
    /// triangle's doubled area, so that heights and products of them with whole numbers stay exact in double:
    /// a plane of such heights has no error at all.
    class Plane {
      public:
        Plane(const HeightSurface& surface, const PostTriangle& t);

        /// Error at a post of the triangle, metres.
        double at(int column, int row) const {
            return std::abs(scaled(heights_.row(row), column, row)) / area_;
        }
        /// Has a post of a row's [first, last] an error greater than that?
        bool exceeds(int row, int first, int last, double error_m) const;

      private:
        double scaled(const float* H, int column, int row) const {
            return area_ * (static_cast<double>(H[column]) - H_) - dx_ * (column - column_) -
                   dy_ * (row - row_);
        }

        const Raster<float>& heights_;
        int column_;  // of the first corner
        int row_;
        double H_;
        double area_;  // doubled
        double dx_;    // rise a column times area_
        double dy_;
    };

    /// The error in the middle of an edge that runs through a post.
    double middle_error(const GridPoint& a, const GridPoint& b, const GridPoint& middle) const {
        return std::abs(0.5 * (height(a) + height(b)) - height(middle));
    }

    const Raster<float>& heights() const { return heights_; }

  private:
    double height(const GridPoint& p) const { return static_cast<double>(heights_.at(p.column, p.row)); }

    const Raster<float>& heights_;
};

/// Positions on the curved earth: for meshes in ECEF or a local frame, whose triangles are flat in space.
class SpaceSurface {
  public:
    /// \param heights  H of the posts of the frame that begin at (column, row); void = NaN; must outlive this
    SpaceSurface(const Raster<float>& heights, const geo::GridFrame& frame, UndulationGrid undulations,
                 int column, int row)
        : heights_(heights),
          positions_(frame),
          undulations_(std::move(undulations)),
          column_(column),
          row_(row) {}

    /// ECEF, metres.
    glm::dvec3 position(int column, int row) const {
        const double H = static_cast<double>(heights_.at(column, row));
        return positions_.at(column_ + column, row_ + row, H + undulations_.at(column_ + column, row_ + row));
    }

    class Plane {
      public:
        Plane(const SpaceSurface& surface, const PostTriangle& t);
        double at(int column, int row) const { return glm::length(offset(column, row)); }
        bool exceeds(int row, int first, int last, double error_m) const;

      private:
        glm::dvec3 offset(int column, int row) const {
            return surface_.position(column, row) - p_ - dx_ * static_cast<double>(column - column_) -
                   dy_ * static_cast<double>(row - row_);
        }

        const SpaceSurface& surface_;
        int column_;
        int row_;
        glm::dvec3 p_;
        glm::dvec3 dx_;  // a column to the east
        glm::dvec3 dy_;
    };

    double middle_error(const GridPoint& a, const GridPoint& b, const GridPoint& middle) const {
        return glm::length(0.5 * (position(a.column, a.row) + position(b.column, b.row)) -
                           position(middle.column, middle.row));
    }

    const Raster<float>& heights() const { return heights_; }

  private:
    const Raster<float>& heights_;
    geo::PostPositions positions_;
    UndulationGrid undulations_;
    int column_;
    int row_;
};

}  // namespace relevo::lod
