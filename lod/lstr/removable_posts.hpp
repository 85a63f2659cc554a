#pragma once

#include "lod/scene/raster.hpp"
#include "lod/static_mesh/post_set.hpp"

namespace relevo::lod {

/// How a post is compared with the eight around it.
enum class RemovalTest {
    pairs,  ///< with the mean of each of the four pairs that face each other
    mean,   ///< with the mean of all eight: fewer operations
};

/// The posts that no more than the margin, metres, sets off from those around them: the filter of the LSTR
/// (section 4.1.1 of the reference). Posts on the border never are, nor those with a void (NaN) around them.
/// Runs on all cores.
PostSet removable_posts(const Raster<float>& heights, float margin_m, RemovalTest test);

/// A margin as the reference has it: so many percent of the range of the heights.
float margin_of_range(const Raster<float>& heights, double percent);

}  // namespace relevo::lod
