#include "geo/sun.hpp"

#include <array>
#include <chrono>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>

namespace relevo::geo {
namespace {

constexpr double kJ2000 = 2451545.0;      // Julian day of 2000-01-01 12:00
constexpr double kUnixEpoch = 2440587.5;  // of 1970-01-01 00:00

/// Reads from the front of a text, piece by piece.
class Scanner {
  public:
    explicit Scanner(std::string_view text) : rest_(text) {}

    bool done() const { return rest_.empty(); }

    bool take(char c) {
        if (rest_.empty() || rest_.front() != c) return false;
        rest_.remove_prefix(1);
        return true;
    }

    /// Exactly so many digits.
    std::optional<int> digits(std::size_t count) {
        if (rest_.size() < count) return {};
        int value = 0;
        for (const char c : rest_.substr(0, count)) {
            if (c < '0' || c > '9') return {};
            value = 10 * value + (c - '0');
        }
        rest_.remove_prefix(count);
        return value;
    }

    /// The digits after a decimal point, as a fraction.
    std::optional<double> fraction() {
        double value = 0;
        double place = 0.1;
        bool any = false;
        for (; !rest_.empty() && rest_.front() >= '0' && rest_.front() <= '9';
             rest_.remove_prefix(1), place /= 10) {
            value += place * (rest_.front() - '0');
            any = true;
        }
        if (!any) return {};
        return value;
    }

  private:
    std::string_view rest_;
};

/// YYYY-MM-DD, as days since 1970-01-01.
std::optional<double> scan_date(Scanner& in) {
    const auto year = in.digits(4);
    if (!year || !in.take('-')) return {};
    const auto month = in.digits(2);
    if (!month || !in.take('-')) return {};
    const auto day = in.digits(2);
    if (!day) return {};
    const std::chrono::year_month_day date{std::chrono::year{*year},
                                           std::chrono::month{static_cast<unsigned>(*month)},
                                           std::chrono::day{static_cast<unsigned>(*day)}};
    if (!date.ok()) return {};
    return static_cast<double>(std::chrono::sys_days{date}.time_since_epoch().count());
}

/// hh:mm[:ss[.fff]], in seconds.
std::optional<double> scan_time_of_day(Scanner& in) {
    const auto hour = in.digits(2);
    if (!hour || *hour > 23 || !in.take(':')) return {};
    const auto minute = in.digits(2);
    if (!minute || *minute > 59) return {};
    double seconds = 3600.0 * *hour + 60.0 * *minute;
    if (!in.take(':')) return seconds;
    const auto second = in.digits(2);
    if (!second || *second > 59) return {};
    seconds += *second;
    if (!in.take('.') && !in.take(',')) return seconds;
    const auto part = in.fraction();
    if (!part) return {};
    return seconds + *part;
}

/// "Z", "+hh[[:]mm]", "-hh[[:]mm]" or nothing, in seconds to the east.
std::optional<double> scan_offset(Scanner& in) {
    if (in.done() || in.take('Z') || in.take('z')) return 0;
    const bool west = in.take('-');
    if (!west && !in.take('+')) return {};
    const auto hour = in.digits(2);
    if (!hour || *hour > 23) return {};
    int minute = 0;
    if (in.take(':') || !in.done()) {
        const auto read = in.digits(2);
        if (!read || *read > 59) return {};
        minute = *read;
    }
    const double seconds = 3600.0 * *hour + 60.0 * minute;
    return west ? -seconds : seconds;
}

/// The Julian day of a whole text, nothing if it is not a time.
std::optional<double> scan_time(std::string_view text) {
    Scanner in(text);
    const auto days = scan_date(in);
    if (!days) return {};
    double seconds = 0;
    if (in.take('T') || in.take('t') || in.take(' ')) {
        const auto of_day = scan_time_of_day(in);
        if (!of_day) return {};
        const auto offset = scan_offset(in);
        if (!offset) return {};
        seconds = *of_day - *offset;
    }
    if (!in.done()) return {};
    return kUnixEpoch + *days + seconds / 86400;
}

}  // namespace

SunDirection sun_at(LatLon place, double julian_day_utc) {
    // Astronomical Almanac, page C5: ecliptic longitude from the mean longitude and anomaly, then to the
    // equator.
    const double n = julian_day_utc - kJ2000;
    const double mean_longitude = 280.460 + 0.9856474 * n;
    const double anomaly = Degrees{357.528 + 0.9856003 * n}.radians();
    const double longitude =
        Degrees{mean_longitude + 1.915 * std::sin(anomaly) + 0.020 * std::sin(2 * anomaly)}.radians();
    const double obliquity = Degrees{23.439 - 0.0000004 * n}.radians();
    const double ascension = std::atan2(std::cos(obliquity) * std::sin(longitude), std::cos(longitude));
    const double declination = std::asin(std::sin(obliquity) * std::sin(longitude));

    // Greenwich mean sidereal time (US Naval Observatory, approximate formula), in hours.
    const double sidereal = std::fmod(18.697374558 + 24.06570982441908 * n, 24.0);
    const double hour_angle = Degrees{15 * sidereal + place.lon.value}.radians() - ascension;

    const double lat = place.lat.radians();
    const double east = -std::cos(declination) * std::sin(hour_angle);
    const double north =
        std::sin(declination) * std::cos(lat) - std::cos(declination) * std::sin(lat) * std::cos(hour_angle);
    const double up =
        std::sin(declination) * std::sin(lat) + std::cos(declination) * std::cos(lat) * std::cos(hour_angle);
    return {wrapped_360(Degrees::from_radians(std::atan2(east, north))),
            Degrees::from_radians(std::atan2(up, std::hypot(east, north)))};
}

Result<double> parse_iso_time(std::string_view text) {
    if (const auto day = scan_time(text)) return *day;
    return Error{ErrorKind::usage,
                 fmt::format("\"{}\" is not an ISO 8601 time such as 2026-06-21T12:00:00Z or "
                             "2026-06-21T14:00+02:00.",
                             text)};
}

}  // namespace relevo::geo
