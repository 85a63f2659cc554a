#include <queue>
#include <random>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "lod/scene/json_fields.hpp"
#include "tests/ingest/classifying.hpp"

namespace relevo::ingest {
namespace {

using lod::PostClass;
using lod::SeaInfo;
using test::Classified;
using test::classify;
using test::Heights;

/// Ground of a few waves with some noise, cut by the sea; seeded.
Heights random_ground(std::uint32_t seed, int columns, int rows, bool level_sea, double voids) {
    std::mt19937 random{seed};
    std::uniform_real_distribution<double> unit{-1, 1};
    Heights heights(columns, rows);
    double wave[6][4];
    for (auto& w : wave) {
        w[0] = 12 * unit(random);
        w[1] = 0.25 * unit(random);
        w[2] = 0.25 * unit(random);
        w[3] = 3 * unit(random);
    }
    for (int r = 0; r < rows; ++r) {
        for (int c = 0; c < columns; ++c) {
            double height = 2 * unit(random);
            for (const auto& w : wave) height += w[0] * std::sin(w[1] * c + w[2] * r + w[3]);
            height = std::max(std::round(height), -14.0);
            if (level_sea && height < -3) height = 0;
            heights.at(c, r) = static_cast<float>(height);
        }
    }
    // Round holes, some of them over the border.
    const int holes = static_cast<int>(voids * 40);
    for (int i = 0; i < holes; ++i) {
        const double x = columns * (0.5 + 0.6 * unit(random));
        const double y = rows * (0.5 + 0.6 * unit(random));
        const double radius = 1 + 5 * (1 + unit(random));
        for (int r = 0; r < rows; ++r) {
            for (int c = 0; c < columns; ++c) {
                if (std::hypot(c - x, r - y) < radius) heights.at(c, r) = std::nanf("");
            }
        }
    }
    return heights;
}

/// The oracle: all of the raster at once, spreading from every place where open sea begins.
std::vector<bool> flooded(const Heights& heights, bool from_open_voids) {
    const int columns = heights.columns();
    const int rows = heights.rows();
    const auto index = [&](int c, int r) {
        return static_cast<std::size_t>(r) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(c);
    };
    // Spreads over posts of one kind, from some of them.
    const auto spread = [&](auto&& is_kind, std::vector<bool> wet) {
        std::queue<std::pair<int, int>> front;
        for (int r = 0; r < rows; ++r) {
            for (int c = 0; c < columns; ++c) {
                if (wet[index(c, r)]) front.emplace(c, r);
            }
        }
        while (!front.empty()) {
            const auto [c, r] = front.front();
            front.pop();
            for (const auto& [x, y] : {std::pair{c - 1, r}, {c + 1, r}, {c, r - 1}, {c, r + 1}}) {
                if (x < 0 || y < 0 || x >= columns || y >= rows || wet[index(x, y)]) continue;
                if (!is_kind(heights.at(x, y))) continue;
                wet[index(x, y)] = true;
                front.emplace(x, y);
            }
        }
        return wet;
    };
    const auto at_border = [&](auto&& is_kind) {
        std::vector<bool> wet(heights.samples().size());
        for (int r = 0; r < rows; ++r) {
            for (int c = 0; c < columns; ++c) {
                if (c == 0 || r == 0 || c + 1 == columns || r + 1 == rows)
                    wet[index(c, r)] = is_kind(heights.at(c, r));
            }
        }
        return wet;
    };
    const auto is_void = [](float h) { return std::isnan(h); };
    const auto is_low = [](float h) { return h <= 0; };
    std::vector<bool> begins = at_border(is_low);
    if (from_open_voids) {
        const std::vector<bool> open = spread(is_void, at_border(is_void));
        for (int r = 0; r < rows; ++r) {
            for (int c = 0; c < columns; ++c) {
                if (!is_low(heights.at(c, r))) continue;
                if ((c > 0 && open[index(c - 1, r)]) || (c + 1 < columns && open[index(c + 1, r)]) ||
                    (r > 0 && open[index(c, r - 1)]) || (r + 1 < rows && open[index(c, r + 1)]))
                    begins[index(c, r)] = true;
            }
        }
    }
    return spread(is_low, std::move(begins));
}

TEST(SeaClassifier, FindsWhatAFloodOfTheWholeFinds) {
    std::uint64_t sea = 0;
    std::uint64_t low_land = 0;
    for (std::uint32_t seed = 1; seed <= 60; ++seed) {
        const Heights heights = random_ground(seed, 90, 70, false, 0);
        const auto expected = flooded(heights, false);
        for (const int side : {7, 32, 512}) {
            const Classified scene = classify(heights, {}, side);
            for (std::size_t i = 0; i < expected.size(); ++i) {
                const bool is_sea = scene.marks.samples()[i].post_class() == PostClass::sea;
                ASSERT_EQ(is_sea, expected[i])
                    << "seed " << seed << " side " << side << " post " << i << " " << scene.info.text;
                sea += is_sea;
                low_land += !is_sea && heights.samples()[i] <= 0;
            }
        }
    }
    EXPECT_GT(sea, 10000U);
    EXPECT_GT(low_land, 1000U);
}

TEST(SeaClassifier, FindsTheSameAroundVoids) {
    for (std::uint32_t seed = 1; seed <= 60; ++seed) {
        const Heights heights = random_ground(seed, 90, 70, false, 0.5);
        const auto expected = flooded(heights, true);
        for (const int side : {7, 32, 512}) {
            const Classified scene = classify(heights, test::asking(SeaInfo::Request::depths), side);
            for (std::size_t i = 0; i < expected.size(); ++i) {
                if (std::isnan(heights.samples()[i])) continue;
                ASSERT_EQ(scene.marks.samples()[i].post_class() == PostClass::sea, expected[i])
                    << "seed " << seed << " side " << side << " post " << i;
            }
        }
    }
}

TEST(SeaClassifier, DoesNotDependOnTheBlocks) {
    int with_sea = 0;
    int with_bed = 0;
    for (std::uint32_t seed = 1; seed <= 120; ++seed) {
        const Heights heights =
            random_ground(seed, 150, 130, seed % 2 == 0, seed % 3 == 0 ? 0 : 0.4 * (seed % 5));
        const Classified whole = classify(heights);
        with_sea += whole.sea() > 0;
        for (const auto mark : whole.marks.samples()) {
            if (!mark.modelled()) continue;
            ++with_bed;
            break;
        }
        for (const int side : {5, 16, 64, 149}) {
            for (const bool backwards : {false, true}) {
                const Classified blocks = classify(heights, {}, side, backwards);
                ASSERT_EQ(blocks.marks.samples(), whole.marks.samples())
                    << "seed " << seed << " side " << side;
                ASSERT_EQ(blocks.info.text, whole.info.text);
                ASSERT_EQ(lod::to_json(blocks.info), lod::to_json(whole.info)) << "seed " << seed;
                for (std::size_t i = 0; i < heights.samples().size(); ++i) {
                    if (std::isnan(whole.heights.samples()[i])) continue;
                    ASSERT_EQ(blocks.heights.samples()[i], whole.heights.samples()[i]);
                }
            }
        }
    }
    EXPECT_GT(with_sea, 60);
    EXPECT_GT(with_bed, 10);
}

TEST(SeaClassifier, JoinsTheEndsOfAGridRoundTheEarth) {
    // A sea at the antimeridian, away from the poles: the first and the last column are one meridian, and
    // not the data's border.
    Heights heights(361, 100, 50);
    for (int r = 40; r < 60; ++r) {
        for (int c = 0; c < 361; ++c) {
            if (c < 10 || c > 350) heights.at(c, r) = 0;
        }
    }
    geo::GridFrame frame;
    frame.west = -180;
    frame.north = 50;
    frame.step_x = 1;
    frame.step_y = 1;
    frame.columns = 361;
    frame.rows = 100;
    EXPECT_EQ(classify(heights, {}, 64, false, frame).sea(), 0U) << "a lake";
    for (int r = 60; r < 100; ++r) heights.at(355, r) = 0;  // a strait to the south, at the eastern end
    for (const int side : {64, 512}) {
        const Classified scene = classify(heights, {}, side, false, frame);
        EXPECT_EQ(scene.marks.at(3, 50).post_class(), PostClass::sea) << "the western end";
        EXPECT_EQ(scene.marks.at(358, 50).post_class(), PostClass::sea);
    }
}

TEST(SeaBed, FallsFromTheShoreByOneInAHundred) {
    Heights heights(300, 9, std::nanf(""));
    for (int r = 0; r < 9; ++r) {
        for (int c = 0; c < 20; ++c) heights.at(c, r) = c == 19 ? 0.0F : 5.0F;
    }
    const auto frame = test::frame_for(heights, 1.0 / 120);  // posts of some 570 m
    const Classified scene = classify(heights, {}, 64, false, frame);
    ASSERT_EQ(scene.voids(), 0U) << scene.info.text;
    for (int c = 20; c < 300; ++c) {
        const double spacing = frame.spacing({static_cast<double>(c), 4}).column_m;
        const double depth = std::min(0.01 * std::min(c - 19, kSeaBedHalo) * spacing, 200.0);
        EXPECT_NEAR(-scene.heights.at(c, 4), depth, 0.5 + 1e-6) << c;
        EXPECT_EQ(scene.heights.at(c, 4), std::round(scene.heights.at(c, 4)));
    }
    EXPECT_EQ(scene.heights.at(299, 4), -200);
}

/// Where the halo ends before 200 m are reached the bed goes on level: no step is seen.
TEST(SeaBed, HasNoStepWhereNothingNearHasData) {
    Heights heights(200, 70, std::nanf(""));
    for (int r = 0; r < 70; ++r) heights.at(0, r) = r % 3 == 0 ? 0.0F : 2.0F;
    const auto frame = test::frame_for(heights, 1.0 / 3600);  // posts of 19 m by 31 m
    const Classified scene = classify(heights, {}, 50, false, frame);
    ASSERT_EQ(scene.voids(), 0U) << scene.info.text;
    for (int c = 1; c < 200; ++c) {
        EXPECT_LE(scene.heights.at(c, 40), 0);
        EXPECT_LE(std::abs(scene.heights.at(c, 40) - scene.heights.at(c - 1, 40)), c == 1 ? 3.0F : 1.0F) << c;
    }
    const double reach = kSeaBedHalo * frame.spacing({199, 40}).column_m;
    EXPECT_EQ(scene.heights.at(199, 40), -std::round(0.01 * reach));
}

TEST(SeaClassifier, DoesNotLookForSeaLevelAboveTheEllipsoid) {
    const Heights heights(30, 30, 0);
    auto request = test::asking(SeaInfo::Request::unasked);
    request.zero_is_sea_level = false;
    const Classified scene = classify(heights, request);
    EXPECT_EQ(scene.sea(), 0U);
    EXPECT_EQ(scene.info.rule, SeaInfo::Rule::nothing);
    EXPECT_NE(scene.info.text.find("--sea FILE"), std::string::npos);
}

TEST(SeaInfo, ComesBackFromJson) {
    SeaInfo info;
    info.request = SeaInfo::Request::mask;
    info.rule = SeaInfo::Rule::low_border;
    info.mask = "coast.gpkg";
    info.beginnings = 7;
    info.low_areas_sea = 2;
    info.low_areas_land = 3;
    info.void_areas_sea = 1;
    info.lowest_land_m = -6;
    info.text = "because";
    std::string problem;
    const auto json = lod::to_json(info);
    const SeaInfo back = lod::sea_info_from(lod::JsonFields(json, "sea", problem));
    EXPECT_EQ(problem, "");
    EXPECT_EQ(lod::to_json(back), json);
    for (const auto& item : json.items()) {
        auto damaged = json;
        damaged[item.key()] = nlohmann::json::array();
        problem.clear();
        (void)lod::sea_info_from(lod::JsonFields(damaged, "sea", problem));
        EXPECT_NE(problem, "") << item.key();
    }
}

}  // namespace
}  // namespace relevo::ingest
