#pragma once

#include <vector>

#include "ingest/affine.hpp"

namespace relevo::ingest {

/// Finds the windows of a grid that meet another one without looking at all: buckets of about a window's
/// size.
class ExtentIndex {
  public:
    ExtentIndex() = default;
    explicit ExtentIndex(std::vector<Window> windows);

    /// Indices of the windows that have posts in common with this one, in their order.
    std::vector<int> meeting(Window window) const;

  private:
    /// The buckets that a window reaches, as a window of the grid of buckets.
    Window buckets(Window window) const;

    std::vector<Window> windows_;
    Window bounds_;
    int bucket_columns_ = 1;  // posts
    int bucket_rows_ = 1;
    int across_ = 0;  // buckets
    int down_ = 0;
    std::vector<std::vector<int>> inside_;
};

/// The posts that two windows have in common; no columns or no rows where there are none.
Window common_part(Window a, Window b);

}  // namespace relevo::ingest
