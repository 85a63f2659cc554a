#pragma once

#include <cstdint>

#include "ingest/posts/outliers.hpp"
#include "ingest/progress.hpp"
#include "ingest/sea/sea_classifier.hpp"
#include "lod/scene/draft_posts.hpp"

namespace relevo::ingest {

/// What becomes of posts between the sources and the scene.
struct PostChanges {
    bool despike = false;       ///< outliers become the median of their surroundings
    int fill_width = 0;         ///< voids up to this many posts wide are filled; 0: none
    bool whole_metres = false;  ///< heights of filled posts are rounded: the scene stores integers

    bool any() const { return despike || fill_width > 0; }
};

/// The first pass over the sources' posts: counts outliers, replaces them and fills voids as asked, and shows
/// the result to the classifier of the sea.
/// \param cleaned  where the result goes; blocks that are there already stay
/// \return the outliers of `raw`
Result<Outliers> clean_posts(const lod::DraftPosts& raw, const PostChanges& changes, lod::DraftPosts& cleaned,
                             SeaClassifier& sea, const Stage& stage);

/// One block of the second pass, after sea.decide(): with its classes and a bed under sea that has no
/// heights. From any thread.
Result<lod::Posts> classified_block(const lod::DraftPosts& cleaned, const geo::GridFrame& frame,
                                    const SeaClassifier& sea, int block_column, int block_row);

}  // namespace relevo::ingest
