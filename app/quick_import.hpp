#pragma once

#include <filesystem>
#include <functional>

#include "geo/result.hpp"

namespace relevo::app {

/// Can the file be imported by what it says itself? Reads no heights.
Result<void> check_importable(const std::filesystem::path& file);

/// Imports an elevation file by what it says itself, as the scene NAME.relevo beside it, or where nothing can
/// be written there in $XDG_DATA_HOME/relevo (~/.local/share/relevo). A scene that is there already is taken
/// as it is. Gives the scene's place. \param progress  told the part done; false stops it
Result<std::filesystem::path> quick_import(const std::filesystem::path& file,
                                           const std::function<bool(double)>& progress);

}  // namespace relevo::app
