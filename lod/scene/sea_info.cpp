#include "lod/scene/sea_info.hpp"

#include <array>

#include <nlohmann/json.hpp>

#include "lod/scene/json_fields.hpp"

namespace relevo::lod {
namespace {

using Request = SeaInfo::Request;
using Rule = SeaInfo::Rule;

template <class Enum, std::size_t N>
Enum named(JsonFields& fields, const char* key, const std::array<Enum, N>& values) {
    const std::string name = fields.text(key);
    for (const Enum value : values) {
        if (name == to_string(value)) return value;
    }
    fields.wrong(key, "is unknown");
    return values.front();
}

}  // namespace

const char* to_string(Request request) {
    switch (request) {
        case Request::unasked:
            return "unasked";
        case Request::automatic:
            return "auto";
        case Request::depths:
            return "depths";
        case Request::none:
            return "none";
        case Request::mask:
            break;
    }
    return "mask";
}

const char* to_string(Rule rule) {
    switch (rule) {
        case Rule::none:
            return "none";
        case Rule::mask:
            return "mask";
        case Rule::nothing:
            return "nothing";
        case Rule::level_zero:
            return "level_zero";
        case Rule::nodata:
            return "nodata";
        case Rule::depths:
            return "depths";
        case Rule::low_border:
            break;
    }
    return "low_border";
}

nlohmann::json to_json(const SeaInfo& sea) {
    return {{"request", to_string(sea.request)},
            {"rule", to_string(sea.rule)},
            {"mask", sea.mask},
            {"beginning_low_m", sea.beginning_low_m},
            {"beginning_high_m", sea.beginning_high_m},
            {"beginnings", sea.beginnings},
            {"low_areas_sea", sea.low_areas_sea},
            {"low_areas_land", sea.low_areas_land},
            {"void_areas_sea", sea.void_areas_sea},
            {"lowest_land_m", sea.lowest_land_m},
            {"text", sea.text}};
}

SeaInfo sea_info_from(JsonFields fields) {
    SeaInfo sea;
    sea.request = named(
        fields, "request",
        std::array{Request::unasked, Request::automatic, Request::depths, Request::none, Request::mask});
    sea.rule = named(fields, "rule",
                     std::array{Rule::none, Rule::mask, Rule::nothing, Rule::level_zero, Rule::nodata,
                                Rule::depths, Rule::low_border});
    sea.mask = fields.text("mask");
    sea.beginning_low_m = fields.number("beginning_low_m", -1e6, 1e6);
    sea.beginning_high_m = fields.number("beginning_high_m", sea.beginning_low_m, 1e6);
    sea.beginnings = fields.count("beginnings");
    sea.low_areas_sea = fields.count("low_areas_sea");
    sea.low_areas_land = fields.count("low_areas_land");
    sea.void_areas_sea = fields.count("void_areas_sea");
    sea.lowest_land_m = fields.number("lowest_land_m", -1e6, 0);
    sea.text = fields.text("text");
    return sea;
}

}  // namespace relevo::lod
