#pragma once

#include <functional>
#include <vector>

#include "lod/ocean/waves.hpp"

namespace relevo::lod {

/// How far apart a mesh's vertices may be where the sea is some distance from the eye, so that what is drawn
/// differs from waves and curvature by a given number of pixels at most, by a bound for what meshes are off
/// the waves (wave_error.hpp, wave_map_error.hpp).
class SeaSpacing {
  public:
    /// \param focal_px  pixels of a metre of height a metre away (height_px of sea_view.hpp)
    SeaSpacing(const Waves& waves, double focal_px, double error_px, double radius_m);
    /// \param bound_m    the bound, metres, of a spacing
    /// \param longest_m  a mesh of this spacing draws nothing of the waves; 0: a still sea
    SeaSpacing(const std::function<double(double)>& bound_m, double longest_m, double focal_px,
               double error_px, double radius_m);

    /// Metres; grows with the distance, less than it.
    double at(double distance_m) const;

    /// Is the whole of the waves, from such a distance on, less than the error? Then only the earth's
    /// curvature is left to be drawn.
    bool flat_from(double distance_m) const;

    double error_px() const { return error_px_; }
    double focal_px() const { return focal_px_; }

  private:
    double focal_px_;
    double error_px_;
    double radius_m_;
    /// Of spacings that grow by kStep each, the largest error of this one and all finer ones, metres.
    std::vector<double> errors_;
};

}  // namespace relevo::lod
