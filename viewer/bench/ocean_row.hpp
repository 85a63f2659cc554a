#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "viewer/ocean/ocean_probe.hpp"

namespace relevo::viewer {

inline constexpr std::array kOceanKinds{OceanKind::geoclipmap, OceanKind::radial, OceanKind::projected};

/// How the sea is looked at: straight down, 45 degrees down, with the horizon in the picture's middle.
enum class OceanGaze { down, slanted, horizon };
inline constexpr std::array kOceanGazes{OceanGaze::down, OceanGaze::slanted, OceanGaze::horizon};
std::string_view to_string(OceanGaze gaze);

/// What the sea of one picture costs, and how far it is off.
struct OceanRow {
    OceanKind kind = OceanKind::automatic;
    double asked_px = 1;  ///< OceanSettings::error_px, which the mesh's size follows from
    double eye_m = 0;
    OceanGaze gaze = OceanGaze::horizon;
    OceanFigures figures;  ///< but for its times
    double cpu_ms = 0;     ///< to choose what is drawn; median
    double gpu_ms = 0;     ///< to draw it, to its last pixel; median
    SeaError error;
    std::size_t holes = 0;
    Swimming swimming;  ///< of an eye that goes a hundredth of its height to the side and forward, the worse
};

}  // namespace relevo::viewer
