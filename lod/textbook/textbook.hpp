#pragma once

#include <array>
#include <vector>

#include <glm/vec3.hpp>

#include "lod/scene/raster.hpp"
#include "lod/soar/diamond.hpp"
#include "lod/view.hpp"

namespace relevo::lod {

/// The yardstick: the refinement as the reference prints it (Lindstrom & Pascucci, sections 3.1 to 3.5). A
/// flat grid in metres, one record a post, row by row; the vertical midpoint error, spheres of vertices
/// alone, plain recursion with square roots, one triangle strip of indices, culling by the planes of the
/// view. Speeds are quoted as ratios to it; nothing but benchmarks draws with it. It stays as printed.
class Textbook {
  public:
    /// \param heights  2^n + 1 posts a side, no voids
    Textbook(const Raster<float>& heights, double spacing_x_m, double spacing_y_m);

    /// The strip for an eye in the grid's own coordinates (x east, y south from the first post, z up,
    /// metres).
    const std::vector<int>& refine(const glm::dvec3& eye, const std::array<glm::dvec3, 4>& planes,
                                   double lambda_px, double tau_px);

    /// Triangles of the strip that have an area.
    std::size_t triangles() const;

  private:
    struct Post {
        float z;
        float error;
        float radius;
    };

    glm::dvec3 position(int i) const;
    int index(const GridPoint& p) const { return p.row * side_ + p.column; }
    void build_errors();
    bool is_active(int i) const;
    bool is_visible(int i, unsigned& inside) const;
    void refine_part(int i, int j, int level);
    void refine_visible_part(int i, int j, int level, unsigned inside);
    void append(int v, int parity);
    std::array<int, 2> next(int i, int j, int level) const;

    int levels_;
    int side_;
    double spacing_x_;
    double spacing_y_;
    std::vector<Post> posts_;

    glm::dvec3 eye_{0};
    std::array<glm::dvec3, 4> planes_{};
    double reach_ = 0;
    std::vector<int> strip_;
    int parity_ = 0;
};

}  // namespace relevo::lod
