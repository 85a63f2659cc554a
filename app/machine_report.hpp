#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

namespace relevo::app {

/// What this machine has for a scene, and the sizes of caches that `--memory auto` takes from it.
struct MachineReport {
    nlohmann::json json;
    std::string text;  ///< for people: lines
};
MachineReport machine_report(const std::filesystem::path& scene);

}  // namespace relevo::app
