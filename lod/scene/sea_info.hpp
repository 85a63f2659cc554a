#pragma once

#include <cstdint>
#include <string>

#include <nlohmann/json_fwd.hpp>

namespace relevo::lod {

class JsonFields;

/// How it was decided which posts are sea (docs/sea.md has the rule).
struct SeaInfo {
    /// What was asked for.
    enum class Request {
        unasked,    ///< the rule for land DEMs
        automatic,  ///< the same, and depths that no land has are sea
        depths,     ///< everything below 0 that reaches the border is sea
        none,       ///< there is no sea
        mask,       ///< a file says where
    };
    /// What decided.
    enum class Rule {
        none,        ///< asked for no sea
        mask,        ///< the file
        nothing,     ///< no place where open sea could begin
        level_zero,  ///< a plain of exactly 0 that reaches the data's border or nodata
        nodata,      ///< nodata at the data's border with a low coast: what has heights is land
        depths,      ///< depths that reach the data's border
        low_border,  ///< posts of -15 to 0 m at the data's border or at nodata, and nothing better
    };

    Request request = Request::unasked;
    Rule rule = Rule::nothing;
    std::string mask;              ///< the file's name without its folder, or empty
    double beginning_low_m = -15;  ///< open sea begins between this and beginning_high_m
    double beginning_high_m = 0;
    std::uint64_t beginnings = 0;      ///< contacts of sea with the data's border or nodata in that band
    std::uint64_t low_areas_sea = 0;   ///< connected areas at or below 0 m that became sea
    std::uint64_t low_areas_land = 0;  ///< that reach the border or nodata there and stayed land
    std::uint64_t void_areas_sea = 0;  ///< connected areas of nodata that became sea
    double lowest_land_m = 0;          ///< the lowest of those that stayed land; 0 where there are none
    std::string text;                  ///< the decision for people, one sentence
};

/// "unasked", "auto", "depths", "none", "mask".
const char* to_string(SeaInfo::Request request);
/// "none", "mask", "nothing", "level_zero", "nodata", "depths", "low_border".
const char* to_string(SeaInfo::Rule rule);

nlohmann::json to_json(const SeaInfo& sea);
/// What is wrong is recorded in the fields' problem.
SeaInfo sea_info_from(JsonFields fields);

}  // namespace relevo::lod
