#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "ingest/source/source.hpp"

namespace relevo::app {

/// The flags of `ingest` that say what is in a file and how far it is trusted.
struct SourceFlags {
    std::optional<int> band;
    std::optional<std::string> variable;
    std::string raw;
    std::string encoding;
    bool allow_remote = false;
    std::vector<std::string> allow_paths;

    void add_to(CLI::App& command);
    /// Writes what was given into a request. \pre the command line has been parsed
    void apply(ingest::SourceRequest& request) const;
};

}  // namespace relevo::app
