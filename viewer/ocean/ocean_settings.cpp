#include "viewer/ocean/ocean_settings.hpp"

#include <array>
#include <utility>

#include <fmt/format.h>

#include "viewer/numbers.hpp"

namespace relevo::viewer {

namespace {

constexpr double kStrongestWind = 40;

constexpr std::array<std::pair<OceanKind, std::string_view>, 5> kKinds{{{OceanKind::automatic, "auto"},
                                                                        {OceanKind::geoclipmap, "geoclipmap"},
                                                                        {OceanKind::radial, "radial"},
                                                                        {OceanKind::projected, "projected"},
                                                                        {OceanKind::off, "off"}}};

}  // namespace

std::string_view to_string(OceanKind kind) {
    for (const auto& [known, name] : kKinds) {
        if (known == kind) return name;
    }
    return "";
}

Result<OceanKind> parse_ocean(std::string_view text) {
    for (const auto& [known, name] : kKinds) {
        if (name == text) return known;
    }
    return Error{ErrorKind::usage,
                 fmt::format("\"{}\" is no ocean: auto, geoclipmap, radial, projected or off", text)};
}

Result<lod::Wind> parse_wind(std::string_view text) {
    lod::Wind wind = OceanSettings{}.wind;
    const auto numbers = parse_numbers(text);
    if (!numbers || numbers->empty() || numbers->size() > 2 || !(numbers->front() >= 0) ||
        !(numbers->front() <= kStrongestWind)) {
        return Error{ErrorKind::usage,
                     fmt::format("\"{}\" is no wind: SPEED,FROM in metres a second, 0 to {}, and degrees",
                                 text, kStrongestWind)};
    }
    wind.speed_m_s = numbers->front();
    if (numbers->size() == 2) wind.from = geo::wrapped_360(geo::Degrees{numbers->back()});
    return wind;
}

}  // namespace relevo::viewer
