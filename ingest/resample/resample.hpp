#pragma once

#include <array>
#include <optional>
#include <string>

#include "ingest/affine.hpp"
#include "lod/scene/raster.hpp"

namespace relevo::ingest {

/// How heights between source posts are made.
enum class Resampling {
    cubic,  ///< Keys's cubic convolution, a = -1/2 (IEEE Trans. ASSP 29, 1981): exact for quadratics
    bilinear,
    nearest,
    average,  ///< mean over the area of a scene post
};
std::string to_string(Resampling method);
std::optional<Resampling> resampling_from(const std::string& name);

/// A part of a source in memory: heights in doubles, void = NaN. Places are in posts of the whole source.
struct SourcePart {
    Window window;
    lod::Raster<double> heights;
};

/// Half the size of the area that a scene post stands for, in source posts.
struct Footprint {
    double half_columns = 0.5;
    double half_rows = 0.5;
};

/// Weights of cubic convolution for the posts at -1, 0, 1, 2 for a place at t in [0, 1) after post 0.
std::array<double, 4> keys_weights(double t);

/// How far around a place its height may depend on the source, in posts.
int reach(Resampling method, Footprint footprint);

/// The height at a place of the source; NaN for void. The part must reach `reach` posts around it.
///
/// A place is void where its nearest source post is (where most of its area is, for average). Voids have no
/// part in heights: cubic takes 16 valid posts, else the valid ones of the 4 around the place are joined
/// linearly. A height is never outside the range of the posts that it is made of.
double resample(const SourcePart& part, Place place, Resampling method, Footprint footprint);

}  // namespace relevo::ingest
