#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <GeographicLib/Constants.hpp>
#include <GeographicLib/MGRS.hpp>
#include <GeographicLib/UTMUPS.hpp>
#include <fmt/format.h>

#include "geo/coordinate_text.hpp"

// Numbers are read by std::from_chars alone: strtod and streams obey the locale, where 37.58 may be two
// numbers.

namespace relevo::geo {
namespace {

Error not_a_place(std::string_view text, std::string_view why) {
    return {ErrorKind::usage,
            fmt::format(
                "\"{}\" is not a place: {}. Write latitude, longitude as 37.58,-105.49 or 37.58N 105.49W, as "
                "37d34'48\"N 105d29'24\"W, as UTM/UPS (13N 456000 4159000) or as MGRS (13SDB5600059000).",
                text, why)};
}

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
bool is_letter(char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}
bool is_space(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}
char upper(char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

/// A decimal number without exponent that is the whole text.
std::optional<double> number(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    const std::string_view unsigned_text = text.starts_with('-') ? text.substr(1) : text;
    // from_chars knows "inf" and "nan" too.
    if (unsigned_text.empty() || !(is_digit(unsigned_text[0]) || unsigned_text[0] == '.')) return {};
    double value = 0;
    const auto [end, failure] =
        std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
    if (failure != std::errc{} || end != text.data() + text.size()) return {};
    return value;
}

/// The signs that people paste, as ASCII: d for degrees, ' and " for minutes and seconds.
std::string to_ascii(std::string_view text) {
    static constexpr std::array<std::pair<std::string_view, char>, 11> kSigns{{{"°", 'd'},
                                                                               {"º", 'd'},
                                                                               {"˚", 'd'},
                                                                               {"′", '\''},
                                                                               {"’", '\''},
                                                                               {"´", '\''},
                                                                               {"″", '"'},
                                                                               {"”", '"'},
                                                                               {"''", '"'},
                                                                               {"−", '-'},
                                                                               {"\u00A0", ' '}}};
    std::string ascii;
    while (!text.empty()) {
        const auto* const sign = std::find_if(kSigns.begin(), kSigns.end(),
                                              [&](const auto& s) { return text.starts_with(s.first); });
        const bool found = sign != kSigns.end();
        ascii += found ? sign->second : text.front();
        text.remove_prefix(found ? sign->first.size() : 1);
    }
    return ascii;
}

std::vector<std::string_view> words(std::string_view text) {
    std::vector<std::string_view> found;
    while (true) {
        while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
        if (text.empty()) return found;
        const auto end = std::find_if(text.begin(), text.end(), is_space);
        found.push_back(text.substr(0, static_cast<std::size_t>(end - text.begin())));
        text.remove_prefix(found.back().size());
    }
}

// --- UTM/UPS and MGRS

/// "13N 456000 4159000" or "N 2000000 2000000", if the text looks like it.
std::optional<Result<LatLon>> parse_utm(std::string_view text) {
    const auto parts = words(text);
    if (parts.size() != 3) return {};
    const char hemisphere = upper(parts[0].back());
    const std::string_view zone_text = parts[0].substr(0, parts[0].size() - 1);
    const auto easting = number(parts[1]);
    const auto northing = number(parts[2]);
    if (!is_letter(hemisphere) || zone_text.size() > 2 || !easting || !northing) return {};
    if (!std::all_of(zone_text.begin(), zone_text.end(), is_digit)) return {};

    if (hemisphere != 'N' && hemisphere != 'S')
        return not_a_place(text,
                           "after a UTM zone comes N or S for the hemisphere, not the letter of a band");
    int zone = 0;
    std::from_chars(zone_text.data(), zone_text.data() + zone_text.size(), zone);
    if (!zone_text.empty() && (zone < 1 || zone > 60)) return not_a_place(text, "UTM zones run from 1 to 60");
    try {
        double lat = 0;
        double lon = 0;
        GeographicLib::UTMUPS::Reverse(zone, hemisphere == 'N', *easting, *northing, lat, lon);
        return LatLon{Degrees{lat}, Degrees{lon}};
    } catch (const GeographicLib::GeographicErr& error) {
        return not_a_place(text, error.what());
    }
}

/// The zone's number (none for UPS), three letters (the band and two of the square), and the digits within
/// it.
bool looks_like_mgrs(std::string_view compact) {
    const auto first_letter = std::find_if_not(compact.begin(), compact.end(), is_digit);
    const auto after_letters = std::find_if_not(first_letter, compact.end(), is_letter);
    return first_letter - compact.begin() <= 2 && after_letters - first_letter == 3 &&
           std::all_of(after_letters, compact.end(), is_digit);
}

std::optional<Result<LatLon>> parse_mgrs(std::string_view text) {
    std::string compact;
    for (const char c : text) {
        if (!is_space(c)) compact += upper(c);
    }
    if (!looks_like_mgrs(compact)) return {};
    try {
        int zone = 0;
        bool north = true;
        double easting = 0;
        double northing = 0;
        int digits = 0;
        GeographicLib::MGRS::Reverse(compact, zone, north, easting, northing, digits);
        double lat = 0;
        double lon = 0;
        GeographicLib::UTMUPS::Reverse(zone, north, easting, northing, lat, lon);
        if (!std::isfinite(lat)) return not_a_place(text, "there is no such square");  // "INV" is read as NaN
        return LatLon{Degrees{lat}, Degrees{lon}};
    } catch (const GeographicLib::GeographicErr& error) {
        return not_a_place(text, error.what());
    }
}

// --- Degrees

/// A piece of "37d34'48\"N": a number with its sign, or one of N S E W d ' " :
struct Token {
    char kind = 0;  // '0' for a number
    bool negative = false;
    bool has_sign = false;
    bool has_point = false;
    double value = 0;  // without the sign
};

std::optional<std::vector<Token>> tokens_of(std::string_view text) {
    std::vector<Token> tokens;
    for (std::size_t i = 0; i < text.size();) {
        const char c = upper(text[i]);
        if (is_space(c)) {
            ++i;
        } else if (std::string_view("NSEWD'\":").find(c) != std::string_view::npos) {
            tokens.push_back({.kind = c});
            ++i;
        } else {
            Token token{.kind = '0', .negative = c == '-', .has_sign = c == '-' || c == '+'};
            if (token.has_sign) ++i;
            const std::size_t start = i;
            while (i < text.size() && (is_digit(text[i]) || text[i] == '.')) ++i;
            const std::string_view digits = text.substr(start, i - start);
            const auto value = number(digits);
            if (!value) return {};
            token.has_point = digits.find('.') != std::string_view::npos;
            token.value = *value;
            tokens.push_back(token);
        }
    }
    return tokens;
}

bool is_hemisphere(const Token& token) {
    return std::string_view("NSEW").find(token.kind) != std::string_view::npos;
}

/// One angle: degrees, minutes, seconds as far as they are given, a hemisphere before or after.
struct Angle {
    double degrees = 0;
    char hemisphere = 0;  // 0: none
    int parts = 0;        // numbers it was written with
};

std::optional<Angle> parse_angle(std::span<const Token> tokens) {
    Angle angle;
    if (!tokens.empty() && is_hemisphere(tokens.front())) {
        angle.hemisphere = tokens.front().kind;
        tokens = tokens.subspan(1);
    } else if (!tokens.empty() && is_hemisphere(tokens.back())) {
        angle.hemisphere = tokens.back().kind;
        tokens = tokens.first(tokens.size() - 1);
    }

    bool negative = angle.hemisphere == 'S' || angle.hemisphere == 'W';
    bool last = false;  // a number with a decimal point ends the angle
    constexpr std::array<char, 3> kMarks{'D', '\'', '"'};
    constexpr std::array<double, 3> kUnits{1, 60, 3600};
    for (std::size_t part = 0; !tokens.empty(); ++part) {
        const Token& token = tokens.front();
        if (part == 3 || last || token.kind != '0') return {};
        if (token.has_sign && (part > 0 || angle.hemisphere != 0)) return {};
        if (part > 0 && token.value >= 60) return {};
        negative = negative || token.negative;
        last = token.has_point;
        angle.degrees += token.value / kUnits[part];
        ++angle.parts;
        tokens = tokens.subspan(1);
        if (tokens.empty()) break;
        const bool colon = tokens.front().kind == ':' && part < 2 && tokens.size() > 1;
        if (tokens.front().kind == kMarks[part] || colon) tokens = tokens.subspan(1);
    }
    if (angle.parts == 0) return {};
    if (negative) angle.degrees = -angle.degrees;
    return angle;
}

/// Latitude and longitude in this order, unless the hemispheres say otherwise.
std::optional<std::pair<Angle, Angle>> as_lat_lon(std::optional<Angle> first, std::optional<Angle> second) {
    if (!first || !second) return {};
    const auto is_lat = [](const Angle& a) { return a.hemisphere == 'N' || a.hemisphere == 'S'; };
    const auto is_lon = [](const Angle& a) { return a.hemisphere == 'E' || a.hemisphere == 'W'; };
    if (is_lon(*first) && is_lat(*second)) return std::pair{*second, *first};
    if (is_lon(*first) || is_lat(*second)) return {};
    return std::pair{*first, *second};
}

/// Two angles without a comma between them: where they can be divided in one way alone, or into equal halves.
std::optional<std::pair<Angle, Angle>> divide(std::span<const Token> tokens) {
    std::optional<std::pair<Angle, Angle>> only;
    int ways = 0;
    for (std::size_t i = 1; i < tokens.size(); ++i) {
        const auto pair = as_lat_lon(parse_angle(tokens.first(i)), parse_angle(tokens.subspan(i)));
        if (!pair) continue;
        if (pair->first.parts == pair->second.parts) return pair;
        only = pair;
        ++ways;
    }
    return ways == 1 ? only : std::nullopt;
}

Result<LatLon> parse_degrees(std::string_view text, const std::string& ascii) {
    const auto commas = std::count(ascii.begin(), ascii.end(), ',');
    if (commas > 1)
        return not_a_place(text, "it has more than one comma (decimals are written with a point)");

    std::optional<std::pair<Angle, Angle>> angles;
    if (commas == 1) {
        const std::size_t comma = ascii.find(',');
        const auto first = tokens_of(std::string_view(ascii).substr(0, comma));
        const auto second = tokens_of(std::string_view(ascii).substr(comma + 1));
        if (first && second) angles = as_lat_lon(parse_angle(*first), parse_angle(*second));
    } else if (const auto tokens = tokens_of(ascii)) {
        angles = divide(*tokens);
    }
    if (!angles) return not_a_place(text, "it cannot be read");

    const double lat = angles->first.degrees;
    const double lon = angles->second.degrees;
    if (std::abs(lat) > 90) return not_a_place(text, "latitudes run from -90 to 90");
    if (lon < -180 || lon > 360)
        return not_a_place(text, "longitudes run from -180 to 180, or from 0 to 360");
    return LatLon{Degrees{lat}, Degrees{lon > 180 ? lon - 360 : lon}};
}

}  // namespace

Result<LatLon> parse_lat_lon(std::string_view text) {
    const std::string ascii = to_ascii(text);
    if (words(ascii).empty()) return not_a_place(text, "it is empty");
    if (auto place = parse_utm(ascii)) return *std::move(place);
    if (auto place = parse_mgrs(ascii)) return *std::move(place);
    return parse_degrees(text, ascii);
}

}  // namespace relevo::geo
