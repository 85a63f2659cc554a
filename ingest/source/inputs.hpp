#pragma once

#include <string>
#include <vector>

#include "geo/result.hpp"

namespace relevo::ingest {

/// The elevation files that the INPUTs of a command stand for, in their order: `@LIST` for the lines of a
/// text file (blank ones and those that start with # aside), a folder for the rasters in it by name (those of
/// its own folders are not looked at), anything else for itself. A path in a list is relative to the working
/// folder, as in a shell, or else to the list's folder.
///
/// Fails where a list or folder cannot be read or yields nothing, and where a listed file does not exist.
Result<std::vector<std::string>> expand_inputs(const std::vector<std::string>& inputs);

}  // namespace relevo::ingest
