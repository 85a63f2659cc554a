#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "geo/result.hpp"

namespace relevo::viewer {

/// May results go into a folder of this name: is there none, or is it empty, or may they overwrite what is
/// there? Asked before hours of work. ErrorKind::usage.
Result<void> check_result_folder(const std::filesystem::path& folder, bool overwrite);

/// Writes files, by their names, into a folder that is made if need be. They are written beside it first and
/// appear, each of them whole, in the last moment; other files in the folder stay.
Result<void> write_result_folder(const std::filesystem::path& folder,
                                 const std::map<std::string, std::string>& files);

}  // namespace relevo::viewer
