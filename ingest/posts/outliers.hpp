#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "ingest/affine.hpp"
#include "lod/scene/post_mark.hpp"
#include "lod/scene/raster.hpp"

namespace relevo::ingest {

/// How far around a block its outliers depend on others, in posts.
inline constexpr int kOutlierHalo = 2;

/// A post that stands out of its surroundings as no ground does.
struct Outlier {
    int column = 0;
    int row = 0;
    float height = 0;  ///< metres
    float median = 0;  ///< of the valid posts among the 5 x 5 around it
};

/// The outliers of a scene: their number, and the largest ones.
struct Outliers {
    static constexpr std::size_t kMostListed = 100;

    std::uint64_t count = 0;
    std::vector<Outlier> largest;  ///< by |height - median|, then by row and column

    /// Adds those of another part; the order of adding makes no difference.
    void add(const Outliers& part);
};

/// The height that a post should have if it is an outlier: the median of the valid posts among the 5 x 5
/// around it, itself included. It is one where it is farther from the median than
///
///     100 m + 12 x MAD,
///
/// MAD being the median of the absolute differences from the median: a slope or a ridge has a large one and
/// is spared, one wrong post among 25 leaves it small. At least 9 of the 25 have to be valid.
std::optional<float> outlier_median(const lod::Raster<float>& heights,
                                    const lod::Raster<lod::PostMark>& marks, int column, int row);

/// Counts the outliers in a part of a raster.
/// \param heights, marks  of a block and kOutlierHalo posts around it, as far as the data goes
/// \param inside          the block in them
/// \param column, row     of the block in the scene, for the list
Outliers find_outliers(const lod::Raster<float>& heights, const lod::Raster<lod::PostMark>& marks,
                       Window inside, int column, int row);

/// Puts the median in place of outliers and marks them as filled. All are judged by the heights as given,
/// so that the order makes no difference. Parameters as above; what it found is returned.
Outliers despike(lod::Raster<float>& heights, lod::Raster<lod::PostMark>& marks, Window inside, int column,
                 int row);

}  // namespace relevo::ingest
