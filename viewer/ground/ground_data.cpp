#include "viewer/ground/ground_data.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "viewer/ground/height_code.hpp"
#include "viewer/ground/page.hpp"

namespace relevo::viewer {

GroundFacts ground_facts(const lod::SceneInfo& info) {
    const bool has_sea = info.sea_posts > 0;
    return {.lowest_m = info.height_min_m,
            .highest_m = info.height_max_m,
            .lowest_land_m = has_sea
                                 ? std::clamp(info.sea.lowest_land_m, info.height_min_m, info.height_max_m)
                                 : info.height_min_m,
            .has_voids = info.void_posts > 0,
            .has_sea = has_sea,
            .sea_is_level = has_sea && (info.sea.rule == lod::SeaInfo::Rule::level_zero ||
                                        info.sea.rule == lod::SeaInfo::Rule::mask)};
}

std::string height_defines(const GroundFacts& facts) {
    const HeightCode code = height_code(facts);
    return fmt::format(
        "#define SCENE_MIDDLE ({:.9e})\n#define SCENE_HALF {:.9e}\n#define SCENE_STEP {:.9e}\n"
        "#define SCENE_LOWEST ({:.9e})\n#define SCENE_RANGE {:.9e}\n",
        code.middle_m, code.half_m(), code.step_m, facts.lowest_m,
        std::max(facts.highest_m - facts.lowest_m, 1e-6));
}

Result<GroundFacts> ground_facts(const lod::Pyramid& pyramid) {
    const geo::GridFrame& frame = pyramid.frame();
    GroundFacts facts;
    float lowest = std::numeric_limits<float>::infinity();
    float highest = -lowest;
    float lowest_land = lowest;
    const auto add = [&](float H, bool is_sea) {
        if (std::isnan(H)) {
            facts.has_voids = true;
            return;
        }
        lowest = std::min(lowest, H);
        highest = std::max(highest, H);
        facts.has_sea = facts.has_sea || is_sea;
        if (!is_sea) lowest_land = std::min(lowest_land, H);
    };
    for (Page page; has_data(page, frame); ++page.row) {
        for (page.column = 0; has_data(page, frame); ++page.column) {
            const auto posts = pyramid.read_ground(page);
            if (!posts) return posts.error();
            const int columns = std::min(posts->heights.columns(), frame.columns - page.column * kPageCells);
            const int rows = std::min(posts->heights.rows(), frame.rows - page.row * kPageCells);
            for (int row = 0; row < rows; ++row) {
                for (int column = 0; column < columns; ++column)
                    add(posts->heights.at(column, row), posts->is_sea.at(column, row) != 0);
            }
        }
        page.column = 0;
    }
    if (lowest > highest) return facts;  // all void
    facts.lowest_m = static_cast<double>(lowest);
    facts.highest_m = static_cast<double>(highest);
    facts.lowest_land_m = static_cast<double>(std::min(lowest_land, highest));
    return facts;
}

}  // namespace relevo::viewer
