#pragma once

#include <CLI/CLI.hpp>

#include "app/view_flags.hpp"
#include "viewer/ground/drape.hpp"

namespace relevo::app {

/// --imagery and --vectors.
void add_drape_flags(CLI::App& command, ViewFlags& flags);

/// Opens their files for a scene's grid, and puts them under the view's lines, imagery first, in the order in
/// which they were given, unless the view says where they are. None of them is read yet but to see that it is
/// what it should be.
Result<viewer::Drapes> read_drapes(const ViewFlags& flags, const geo::GridFrame& frame,
                                   viewer::ViewState& view);

}  // namespace relevo::app
