#pragma once

#include <map>
#include <optional>
#include <utility>

#include "geo/position.hpp"
#include "geo/result.hpp"
#include "lod/pyramid/pyramid.hpp"

namespace relevo::viewer {

/// A place to measure the sea at: the middle of the largest square of posts that are all sea, of some the one
/// that is nearest to the data's middle. Squares are looked for on the coarsest posts that have one of 16
/// cells a side, so that what lies between those posts (an islet) is not seen.
/// \param bed_m  squares whose bed is below that come first, of those posts
/// \return nothing where the sea is narrower than 16 posts
Result<std::optional<geo::LatLon>> open_sea(const lod::Pyramid& pyramid, double bed_m);

/// Where no land is near, by the posts themselves. Keeps in memory what it has read of them.
class OffShore {
  public:
    explicit OffShore(const lod::Pyramid& pyramid) : pyramid_(pyramid) {}

    /// Are all pages within 64 posts wholly sea? Beyond the data its edge goes on.
    bool at(geo::LatLon place);

  private:
    bool is_sea(int column, int row);

    const lod::Pyramid& pyramid_;
    std::map<std::pair<int, int>, bool> pages_;
};

}  // namespace relevo::viewer
