#include "ingest/reference/vertical.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "ingest/reference/vertical_datum.hpp"

namespace relevo::ingest {
namespace {

constexpr double kFoot = 0.3048;
constexpr double kSurveyFoot = 1200.0 / 3937.0;

struct NamedUnit {
    std::string_view name;
    double metres;
};

// In small letters, without spaces and signs.
constexpr std::array kUnits{
    NamedUnit{"m", 1},
    NamedUnit{"metre", 1},
    NamedUnit{"metres", 1},
    NamedUnit{"meter", 1},
    NamedUnit{"meters", 1},
    NamedUnit{"mm", 0.001},
    NamedUnit{"millimetre", 0.001},
    NamedUnit{"millimeter", 0.001},
    NamedUnit{"cm", 0.01},
    NamedUnit{"centimetre", 0.01},
    NamedUnit{"centimeter", 0.01},
    NamedUnit{"dm", 0.1},
    NamedUnit{"decimetre", 0.1},
    NamedUnit{"decimeter", 0.1},
    NamedUnit{"km", 1000},
    NamedUnit{"kilometre", 1000},
    NamedUnit{"kilometer", 1000},
    NamedUnit{"ft", kFoot},
    NamedUnit{"foot", kFoot},
    NamedUnit{"feet", kFoot},
    NamedUnit{"internationalfoot", kFoot},
    NamedUnit{"internationalfeet", kFoot},
    NamedUnit{"footinternational", kFoot},
    NamedUnit{"footintl", kFoot},
    NamedUnit{"fti", kFoot},
    NamedUnit{"ftint", kFoot},
    NamedUnit{"intft", kFoot},
    NamedUnit{"ftus", kSurveyFoot},
    NamedUnit{"usft", kSurveyFoot},
    NamedUnit{"sft", kSurveyFoot},
    NamedUnit{"ussurveyfoot", kSurveyFoot},
    NamedUnit{"ussurveyfeet", kSurveyFoot},
    NamedUnit{"ussurveyft", kSurveyFoot},
    NamedUnit{"usfoot", kSurveyFoot},
    NamedUnit{"usfeet", kSurveyFoot},
    NamedUnit{"footus", kSurveyFoot},
    NamedUnit{"feetus", kSurveyFoot},
    NamedUnit{"footussurvey", kSurveyFoot},
    NamedUnit{"feetussurvey", kSurveyFoot},
    NamedUnit{"ftussurvey", kSurveyFoot},
    NamedUnit{"surveyft", kSurveyFoot},
    NamedUnit{"surveyfoot", kSurveyFoot},
    NamedUnit{"surveyfeet", kSurveyFoot},
};

/// "9003", "EPSG:9003": the codes that units of length have in WKT and in GeoTIFF keys.
std::optional<double> unit_of_epsg(const std::string& name) {
    const std::string code = name.rfind("EPSG:", 0) == 0 ? name.substr(5) : name;
    if (code == "9001") return 1;
    if (code == "9002") return kFoot;
    if (code == "9003") return kSurveyFoot;
    return {};
}

bool is_unnamed(const std::string& name) {
    std::string plain;
    for (const char c : name) plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    constexpr std::array<std::string_view, 7> kNothing{"",          "unknown", "unnamed", "unspecified",
                                                       "undefined", "none",    "n/a"};
    return std::find(kNothing.begin(), kNothing.end(), plain) != kNothing.end();
}

lod::VerticalReference reference(const VerticalClues& clues, std::vector<std::string>& notes) {
    using lod::VerticalDatum;
    const bool told = clues.crs && !is_unnamed(clues.crs->name);
    if (clues.datum) {
        const bool ellipsoid = *clues.datum == VerticalDatum::ellipsoid;
        if (told)
            notes.push_back(fmt::format("the file's vertical datum ({}) is overridden", clues.crs->name));
        return {*clues.datum, ellipsoid ? "WGS 84 ellipsoid" : "EGM96", false};
    }
    if (!told) {
        notes.emplace_back(
            "the file does not say what its heights are above: mean sea level (EGM96) is assumed; "
            "--vertical tells otherwise");
        return {VerticalDatum::egm96, "EGM96", true};
    }
    auto reference = vertical_reference_of(*clues.crs);
    if (reference.datum == VerticalDatum::other)
        notes.push_back(fmt::format(
            "heights are kept above {}: h and N are known where its geoid is (--geoid)", reference.name));
    return reference;
}

Result<double> unit_in_metres(const VerticalClues& clues, std::vector<std::string>& notes) {
    if (clues.height_scale) {
        notes.push_back(fmt::format("heights are multiplied by {} (--height-scale)", *clues.height_scale));
        return *clues.height_scale;
    }
    std::optional<double> band;
    if (!is_unnamed(clues.unit)) {
        band = length_unit(clues.unit);
        if (!band)
            return Error{
                ErrorKind::input,
                fmt::format("the band's unit '{}' is not a length, so these may not be heights. If they are, "
                            "give metres per unit with --height-scale",
                            clues.unit)};
    }
    // A CRS without a usable name still tells its unit. Old definitions round it ("Foot_US", 0.3048006), but
    // not so far that the two feet, 6e-7 m apart, become one.
    constexpr double kRounding = 1e-7;
    if (band && clues.crs && std::abs(*band - clues.crs->unit_m) > kRounding)
        return Error{
            ErrorKind::input,
            fmt::format("the band's unit is '{}', but its vertical CRS '{}' has a unit of {} m. Give metres "
                        "per unit with --height-scale",
                        clues.unit, clues.crs->name, clues.crs->unit_m)};
    const double unit = band ? *band : clues.crs ? clues.crs->unit_m : 1;
    if (unit != 1) notes.push_back(fmt::format("heights are converted from units of {:.10g} m", unit));
    return unit;
}

}  // namespace

std::optional<double> length_unit(const std::string& name) {
    if (const auto code = unit_of_epsg(name)) return code;
    std::string plain;
    for (const char c : name)
        if (std::isalpha(static_cast<unsigned char>(c)) != 0)
            plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const auto* found =
        std::find_if(kUnits.begin(), kUnits.end(), [&](const NamedUnit& u) { return u.name == plain; });
    if (found == kUnits.end()) return {};
    return found->metres;
}

Result<HeightRule> height_rule(const VerticalClues& clues) {
    HeightRule rule;
    const auto unit = unit_in_metres(clues, rule.notes);
    if (!unit) return unit.error();
    const double sign = clues.crs && clues.crs->down ? -1 : 1;
    if (sign < 0) rule.notes.emplace_back("depths (positive downwards) are turned into heights");
    if (clues.scale != 1 || clues.offset != 0)
        rule.notes.push_back(
            fmt::format("the band's scale {} and offset {} are applied", clues.scale, clues.offset));
    if (clues.height_offset != 0)
        rule.notes.push_back(fmt::format("{} m are added to heights (--height-offset)", clues.height_offset));
    rule.scale = clues.scale * *unit * sign;
    rule.offset = clues.offset * *unit * sign + clues.height_offset;
    if (!std::isfinite(rule.scale) || rule.scale == 0 || !std::isfinite(rule.offset))
        return Error{ErrorKind::input,
                     fmt::format("a scale of {} and an offset of {} give no heights. Give others "
                                 "with --height-scale and --height-offset",
                                 rule.scale, rule.offset)};
    rule.reference = reference(clues, rule.notes);
    return rule;
}

}  // namespace relevo::ingest
