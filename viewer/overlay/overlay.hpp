#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geo/result.hpp"

namespace relevo::viewer {

/// Something that is drawn over the ground's layer.
struct Overlay {
    enum class Kind {
        contours,   ///< lines of equal height
        graticule,  ///< lines of latitude and longitude, or of a UTM zone's grid
        imagery,    ///< a picture
        vectors,    ///< lines and points of a file
    };
    Kind kind = Kind::contours;
    double opacity = 1;     ///< 0 to 1
    double interval_m = 0;  ///< of contours; 0: what suits the view
    bool utm = false;       ///< of a graticule: a UTM grid instead of latitudes and longitudes
    int file = 0;           ///< of imagery and vectors: which of the files that were given, from 0

    friend bool operator==(const Overlay&, const Overlay&) = default;
};

/// From the lowest to the uppermost.
using Overlays = std::vector<Overlay>;
inline constexpr std::size_t kMostOverlays = 8;

/// "none", or such as "imagery:0:0.5,contours:auto:1,graticule:utm:0.7": kind, what of it, opacity. Parsing
/// it gives the same overlays, to the last bit.
std::string to_string(const Overlays& overlays);
Result<Overlays> parse_overlays(std::string_view text);

/// Of --contours: "auto" or metres, and an opacity, "20,0.5".
Result<Overlay> parse_contours(std::string_view text);

/// Of --graticule: "auto", "latlon" or "utm", and an opacity; nothing for "off".
Result<std::optional<Overlay>> parse_graticule(std::string_view text);

/// The first of a kind; null where there is none.
const Overlay* find(const Overlays& overlays, Overlay::Kind kind);

}  // namespace relevo::viewer
