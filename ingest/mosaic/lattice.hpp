#pragma once

#include <optional>

#include "ingest/affine.hpp"

namespace relevo::ingest {

/// How far posts may be from those of a lattice to be the same: the tolerance of all positions.
inline constexpr double kLatticeTolerance = 1e-3;

/// The window that a raster's posts are in a lattice, where all of them are posts of it: the same steps, and
/// an offset by whole steps, within kLatticeTolerance at every corner. \pre the lattice has an inverse
std::optional<Window> window_in(const Affine& lattice, const Affine& posts, int columns, int rows);

}  // namespace relevo::ingest
