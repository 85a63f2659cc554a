#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geo/position.hpp"
#include "geo/result.hpp"
#include "ingest/source/source.hpp"

namespace relevo::ingest {

/// What looks wrong about a source's heights, for people: an extreme value that stands in many posts, far
/// from all others (an undeclared void), and ground that is higher than it can be there (another unit).
/// Judged by up to 64 windows of 64 x 64 posts, spread over the source; nothing is changed. \param where
/// somewhere in the source, for the height that ground can have Fails where the source cannot be read.
Result<std::vector<std::string>> suspicions(const Source& source,
                                            const std::optional<geo::LatLon>& where = {});

/// The suspicions about some sources, each with its source's name. Of many, about kMostSuspected evenly
/// chosen ones. What cannot be opened or read has none.
std::vector<std::string> suspicions_about(const std::vector<SourceRequest>& requests);
inline constexpr std::size_t kMostSuspected = 32;

/// The highest ground of the part of the world around a place, metres above the sea, rounded up: what no land
/// there exceeds. The whole earth's where no smaller part is known.
double highest_ground_m(const geo::LatLon& place);

}  // namespace relevo::ingest
