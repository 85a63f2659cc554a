#pragma once

#include <string>
#include <vector>

#include "lod/scene/scene_info.hpp"

namespace relevo::viewer {

/// What a scene is, in lines for people: its grid, datum, errors and sources, and what is not known of it.
std::vector<std::string> scene_facts(const lod::SceneInfo& info);

}  // namespace relevo::viewer
