#pragma once

#include <functional>
#include <optional>

#include "lod/measure/grid_path.hpp"
#include "lod/measure/height_sampler.hpp"

namespace relevo::lod {

/// A line within one cell, or where it has no heights.
struct GroundLeg {
    double begin = 0;  ///< distance along the line, metres
    double end = 0;
    int turn = 0;                      ///< for GridPath::at
    std::optional<BilinearCell> cell;  ///< nothing: a void or outside
    bool outside = false;

    /// H, metres. \pre there is a cell; as below
    double height(const GridPath& path, double s) const { return cell->height(path.at(s, turn).grid); }

    /// dH/ds: rise of H for a metre of the ellipsoid.
    double slope(const GridPath& path, double s) const;

    /// Where the surface has its highest or lowest place inside the leg. Its height there is a quadratic of
    /// the distance, as far as the line is straight within one cell, so there is one at most, and the slope
    /// is next to linear.
    std::optional<double> extremum(const GridPath& path) const;
};

/// Goes along the whole line, leg by leg, until `visit` fails or says false. Legs join; a line of no length
/// is one leg.
Result<void> for_each_leg(HeightSampler& sampler, const GridPath& path,
                          const std::function<Result<bool>(const GroundLeg&)>& visit);

}  // namespace relevo::lod
