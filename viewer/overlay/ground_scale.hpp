#pragma once

#include "lod/terrain.hpp"
#include "lod/view.hpp"

namespace relevo::viewer {

/// The smallest of ... 0.5, 1, 2, 5, 10, 20, 50 ... that is no less. \pre least > 0
double round_step(double least);

/// How large things on the ground are in a view, for choosing intervals of lines.
class GroundScale {
  public:
    /// Reads the coarsest block of the terrain, which must outlive this.
    explicit GroundScale(const lod::Terrain& terrain);

    /// Metres that a pixel has where the ground is as far away as it is below the eye. The ground is the
    /// mean of what is about as far around as the eye is high: while one flies over ridges and valleys the
    /// scale stays nearly the same.
    double pixel_m(const lod::View& view, double exaggeration) const;

  private:
    double mean_height(geo::GridPosition at, double eye_m) const;

    const lod::Terrain* terrain_;
    lod::Raster<float> heights_;  // empty where they cannot be read
    double posts_apart_ = 1;      // of the terrain, between two of them
};

/// Metres between contour lines where nobody says it: 50 where a pixel is 5 to 8 m. On a slope of 1 in 2 they
/// are some 12 to 30 pixels apart seen from above.
double contour_interval(double pixel_m);

}  // namespace relevo::viewer
