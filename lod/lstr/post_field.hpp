#pragma once

#include <array>
#include <vector>

#include <glm/vec3.hpp>

#include "geo/result.hpp"
#include "lod/scene/raster.hpp"
#include "lod/soar/diamond.hpp"
#include "lod/terrain.hpp"

namespace relevo::lod {

/// A corner of a mesh: a post of the padded grid and where it is, ECEF, metres, from the terrain's own
/// function of column, row and height: the same to the last bit wherever it is asked for.
struct PlacedPost {
    GridPoint at;
    float H = 0;
    glm::dvec3 position{0};
};
using PlacedTriangle = std::array<const PlacedPost*, 3>;

/// How far a post is from the triangle's point at the same grid coordinates, metres.
double error_at(const PlacedPost& post, const PlacedTriangle& triangle);

/// The posts of a square of the padded grid, or every 2^k-th of them: what triangles are judged by.
class PostField {
  public:
    /// \param first   of the square's posts, a multiple of its side
    /// \param cells   of its side, in posts of the padded grid
    /// \param stride  a power of two
    /// \param judges  else posts can be asked for, but not errors
    static Result<PostField> read(const Terrain& terrain, const GridPoint& first, int cells, int stride,
                                  bool judges = true);

    PlacedPost post(const GridPoint& at) const;
    float height(const GridPoint& at) const { return H_.samples()[index(at)]; }
    /// Of all posts, voids and padding filled.
    const Raster<float>& heights() const { return H_; }
    bool is_valid(const GridPoint& at) const { return valid_[index(at)] > 0; }

    /// How far valid posts of the square in a triangle or on its edges are from the triangle's point at the
    /// same grid coordinates: the largest distance, metres, or some distance greater than `enough`.
    double error(const PlacedTriangle& triangle, double enough) const;

    /// The same for an edge, where it crosses the edges of the finest mesh: what lies between posts is
    /// farthest off at a post or there, since both surfaces are flat everywhere else.
    double edge_error(const PlacedPost& a, const PlacedPost& b, double enough) const;

    /// Largest coordinate of a post from the square's middle, metres.
    double extent_m() const { return extent_m_; }
    /// Is any post valid?
    bool has_data() const { return has_data_; }
    /// The valid post that is farthest off, of those inside a square and no corners of the triangle.
    struct Worst {
        GridPoint at;
        double error_m = 0;
    };
    Worst worst(const PlacedTriangle& triangle, const GridPoint& first, int cells) const;

    const GridPoint& first() const { return first_; }
    int cells() const { return cells_; }
    int stride() const { return stride_; }

  private:
    PostField(const Terrain& terrain, const GridPoint& first, int cells, int stride);
    /// Calls visit(row, first column, posts) for each row of the square's posts in a triangle.
    template <class Visit>
    void for_each_run(const PlacedTriangle& triangle, const Visit& visit) const;
    /// Distance, squared, of a place on an edge from the one between two posts, counted in the field; 0 where
    /// one of them is not valid or not here.
    double off_squared(const glm::dvec3& drawn, int column, int row, int to_column, int to_row,
                       double part) const;
    Result<void> read_heights(const Pyramid& pyramid);
    /// Has the block any data in the square?
    bool take(const GridPoint& corner, int level, const BlockHeights& block);
    std::size_t index(const GridPoint& at) const {
        return static_cast<std::size_t>((at.row - first_.row) / stride_) * static_cast<std::size_t>(side_) +
               static_cast<std::size_t>((at.column - first_.column) / stride_);
    }

    const Terrain* terrain_;
    GridPoint first_;
    int cells_;
    int stride_;
    int side_;  // posts
    glm::dvec3 origin_{0};
    Raster<float> H_;
    std::vector<float> x_, y_, z_;  // from the origin, metres
    std::vector<float> valid_;      // 1 or 0
    bool has_data_ = false;
    double extent_m_ = 0;
};

}  // namespace relevo::lod
