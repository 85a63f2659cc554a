#pragma once

#include <cstddef>

#include "viewer/overlay/overlay.hpp"

// Changes of what is drawn over the ground, and in which order: the last of a list is uppermost.
namespace relevo::viewer {

/// Is it of one of the files that are draped?
bool is_of_file(const Overlay& overlay);
/// The one of a file; the list's size where it is not drawn.
std::size_t index_of_file(const Overlays& overlays, int file);

/// Puts imagery over imagery, and both under lines, unless the list has the same file already; vectors over
/// all imagery. Nothing happens where the list is full.
void put_in_place(Overlays& overlays, const Overlay& overlay);

/// Moves one up or down by so many places, as far as there are some; gives where it is then.
std::size_t move_overlay(Overlays& overlays, std::size_t index, int up);
/// One up; from the uppermost place to the lowest.
std::size_t raise_overlay(Overlays& overlays, std::size_t index);

/// Takes a file away: those after it have numbers that are one less.
void forget_file(Overlays& overlays, int file);

}  // namespace relevo::viewer
