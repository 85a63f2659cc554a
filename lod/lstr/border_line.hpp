#pragma once

#include <vector>

#include "lod/lstr/post_field.hpp"

namespace relevo::lod {

/// The posts of a node's side that its level keeps, of those that the level below has there: the ends, the
/// middle, where two nodes of that level meet, and as many as hold the field's posts on the side within an
/// error. It is found from the side's own posts, so that both of the nodes that share it find the same.
/// (Douglas and Peucker 1973, with distances at the same grid coordinates.)
/// \param finer  what the level below has, from one end to the other
/// \return  for each of them, whether it is kept
std::vector<bool> border_line(const PostField& field, const std::vector<const PlacedPost*>& finer,
                              double error_m);

}  // namespace relevo::lod
