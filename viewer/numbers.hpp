#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace relevo::viewer {

/// Reads finite numbers separated by commas, the whole text, in any locale; nothing where it is anything
/// else.
std::optional<std::vector<double>> parse_numbers(std::string_view text);

}  // namespace relevo::viewer
