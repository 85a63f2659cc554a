#pragma once

#include <string>
#include <string_view>

#include "geo/result.hpp"

namespace relevo::viewer {

/// Air between the eye and what it sees. It thins with height by 1/e every 8 km.
struct Haze {
    /// What `on` means: air that is clearer than any, for all that shall be said is how far things are.
    static constexpr double kClearKm = 586.8;

    bool on = true;
    /// How far a dark thing at the sea's level is just seen, that is at a contrast of 2 % (H. Koschmieder,
    /// "Theorie der horizontalen Sichtweite", 1924). 200 km is very clear mountain air, 20 km a fine day, 1
    /// km is where fog begins.
    double visibility_km = kClearKm;

    /// At the sea's level, 1/m: Koschmieder's ln(1 / 0.02) over the visibility. 0 where it is off.
    double extinction() const { return on ? 3.912 / (1000 * visibility_km) : 0; }

    friend bool operator==(const Haze&, const Haze&) = default;
};

/// Reads "on", "off" or a visibility in kilometres, 0.05 to 100 000.
Result<Haze> parse_haze(std::string_view text);

/// Parsing it gives the same haze, to the last bit.
std::string to_string(const Haze& haze);

}  // namespace relevo::viewer
