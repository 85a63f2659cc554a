#include "viewer/sun_setting.hpp"

#include <fmt/format.h>

#include "viewer/numbers.hpp"

namespace relevo::viewer {

Result<SunSetting> parse_sun(std::string_view text) {
    SunSetting setting;
    setting.text = text;
    if (text == "auto") return setting;
    if (const auto angles = parse_numbers(text); angles && angles->size() == 2) {
        const auto [azimuth, elevation] = std::pair((*angles)[0], (*angles)[1]);
        if (azimuth < -360 || azimuth > 360 || elevation < -90 || elevation > 90) {
            return Error{ErrorKind::usage,
                         fmt::format("sun \"{}\": azimuth -360 to 360, elevation -90 to 90 degrees", text)};
        }
        setting.kind = SunSetting::Kind::direction;
        setting.direction = {geo::Degrees{azimuth}, geo::Degrees{elevation}};
        return setting;
    }
    const auto day = geo::parse_iso_time(text);
    if (!day) {
        return Error{ErrorKind::usage,
                     fmt::format("sun \"{}\": expected auto, AZIMUTH,ELEVATION in degrees, or a time such as "
                                 "2026-06-21T12:00:00Z ({})",
                                 text, day.error().message)};
    }
    setting.kind = SunSetting::Kind::time;
    setting.julian_day = *day;
    return setting;
}

geo::SunDirection sun_at(const SunSetting& setting, geo::LatLon place) {
    return setting.kind == SunSetting::Kind::time ? geo::sun_at(place, setting.julian_day)
                                                  : setting.direction;
}

}  // namespace relevo::viewer
