#pragma once

#include <functional>
#include <string>

#include <CLI/CLI.hpp>

#include "geo/position.hpp"
#include "geo/result.hpp"
#include "lod/lstr/chunk_builder.hpp"
#include "lod/scene/scene.hpp"
#include "lod/terrain.hpp"

namespace relevo::app {

/// What the chosen subcommand does once the command line is read. An error ends the program with its kind's
/// status.
using Action = std::function<Result<void>()>;

/// Options that every subcommand has.
struct Common {
    bool json = false;   ///< results as exactly one JSON object on stdout
    bool quiet = false;  ///< no progress and no notes on stderr
};
void add_common(CLI::App& command, Common& common);

// One file a subcommand; each adds it to the program and sets `action` when it is the chosen one.
void add_ingest(CLI::App& program, Action& action);
void add_info(CLI::App& program, Action& action);
void add_view(CLI::App& program, Action& action);
void add_render(CLI::App& program, Action& action);
void add_bench(CLI::App& program, Action& action);
void add_measure(CLI::App& program, Action& action);
void add_check(CLI::App& program, Action& action);
void add_chunks(CLI::App& program, Action& action);
void add_export(CLI::App& program, Action& action);

/// Makes a scene's chunks.bin, with a progress bar; Ctrl-C stops it, and it can be gone on with.
Result<void> make_chunks(const lod::Scene& scene, const lod::Terrain& terrain,
                         const lod::ChunkBuilding& building, const Common& common);

/// Gives a terrain its scene's chunks, which are made first where they are not there, with a progress bar.
Result<void> provide_chunks(const lod::Scene& scene, lod::Terrain& terrain, const Common& common);

/// A progress bar on stderr, for terminals only: call it with the part done, 0 to 1.
std::function<void(double)> progress_bar(const Common& common, std::string what);

}  // namespace relevo::app
