#pragma once

#include <optional>
#include <vector>

#include "viewer/measure/measuring.hpp"
#include "viewer/ui/number_box.hpp"
#include "viewer/ui/panels.hpp"

namespace relevo::viewer {

/// The measured shapes with their results, and the profile of the current one. Gives the distance along it
/// that the cursor is at in the plot. \param marked_m  to be marked in the plot: where the cursor is on the
/// ground
/// \param numbers  of the panel \pre inside a window between Ui::begin and end
std::optional<double> draw_measure_panel(const Ui& ui, Measuring& measuring, NumberBox& numbers,
                                         const std::optional<double>& marked_m, std::vector<Wish>& wishes);

}  // namespace relevo::viewer
