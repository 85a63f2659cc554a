#include "ingest/reference/vertical.hpp"

#include <gtest/gtest.h>

namespace relevo::ingest {
namespace {

VerticalCrs vertical_crs(const std::string& definition) {
    const auto crs = Crs::parse(definition);
    EXPECT_TRUE(crs) << definition;
    if (!crs || !crs->vertical()) return {};
    return *crs->vertical();
}

TEST(LengthUnit, FeetOfBothKinds) {
    for (const char* name : {"ft", "foot", "Feet", "International foot", "[ft_i]", "9002", "EPSG:9002"})
        EXPECT_EQ(length_unit(name), 0.3048) << name;
    for (const char* name : {"US survey foot", "us_survey_foot", "ft-us", "US-ft", "survey feet", "ftUS",
                             "us-ft", "Foot_US", "US foot", "feet (US survey)", "9003", "EPSG:9003"})
        EXPECT_EQ(length_unit(name), 1200.0 / 3937) << name;
    for (const char* name : {"m", "metre", "Meters", "M"}) EXPECT_EQ(length_unit(name), 1) << name;
    for (const char* name : {"", "K", "degree", "m/s", "mm/day", "1"})
        EXPECT_FALSE(length_unit(name)) << name;
}

TEST(HeightRule, SaysThatTheDatumIsAssumed) {
    const auto rule = height_rule({});
    ASSERT_TRUE(rule);
    EXPECT_TRUE(rule->identity());
    EXPECT_EQ(rule->reference.datum, lod::VerticalDatum::egm96);
    EXPECT_TRUE(rule->reference.assumed);
    EXPECT_EQ(rule->notes.size(), 1U);
}

TEST(HeightRule, DatumOfTheCrs) {
    struct Case {
        const char* crs;
        lod::VerticalDatum datum;
        double scale;
    };
    for (const Case& c :
         {Case{"EPSG:4326+5773", lod::VerticalDatum::egm96, 1},
          Case{"EPSG:4979", lod::VerticalDatum::ellipsoid, 1},
          Case{"EPSG:4326+3855", lod::VerticalDatum::other, 1},               // EGM2008
          Case{"EPSG:32611+5703", lod::VerticalDatum::other, 1},              // NAVD88
          Case{"EPSG:32611+6360", lod::VerticalDatum::other, 1200.0 / 3937},  // NAVD88 in US feet
          Case{"EPSG:32611+8228", lod::VerticalDatum::other, 0.3048},
          Case{"EPSG:32611+6357", lod::VerticalDatum::other, -1}}) {  // NAVD88 depth
        VerticalClues clues;
        clues.crs = vertical_crs(c.crs);
        const auto rule = height_rule(clues);
        ASSERT_TRUE(rule) << c.crs;
        EXPECT_EQ(rule->reference.datum, c.datum) << c.crs;
        EXPECT_FALSE(rule->reference.assumed) << c.crs;
        EXPECT_FALSE(rule->reference.name.empty()) << c.crs;
        EXPECT_NEAR(rule->scale, c.scale, 1e-15) << c.crs;
    }
}

TEST(HeightRule, UserOverridesTheDatum) {
    VerticalClues clues;
    clues.crs = vertical_crs("EPSG:4326+3855");
    clues.datum = lod::VerticalDatum::ellipsoid;
    const auto rule = height_rule(clues);
    ASSERT_TRUE(rule);
    EXPECT_EQ(rule->reference.datum, lod::VerticalDatum::ellipsoid);
    EXPECT_FALSE(rule->reference.assumed);
}

TEST(HeightRule, ScaleOffsetAndUnitInTheirOrder) {
    VerticalClues clues;
    clues.unit = "ft";
    clues.scale = 0.1;
    clues.offset = 1000;
    clues.height_offset = -5;
    const auto rule = height_rule(clues);
    ASSERT_TRUE(rule);
    EXPECT_NEAR((*rule)(200), (200 * 0.1 + 1000) * 0.3048 - 5, 1e-12);
}

TEST(HeightRule, HeightScaleStandsForTheUnit) {
    VerticalClues clues;
    clues.unit = "K";
    EXPECT_FALSE(height_rule(clues));  // a temperature is no height ...
    clues.height_scale = 0.25;
    const auto rule = height_rule(clues);  // ... unless told otherwise
    ASSERT_TRUE(rule);
    EXPECT_EQ((*rule)(8), 2);
}

TEST(HeightRule, ARoundedUnitIsNoContradiction) {
    VerticalClues clues;
    clues.unit = "US survey foot";
    clues.crs = VerticalCrs{.name = "old", .code = "", .unit_m = 0.3048006};
    const auto rule = height_rule(clues);
    ASSERT_TRUE(rule);
    EXPECT_EQ(rule->scale, 1200.0 / 3937);
    clues.unit = "ft";
    EXPECT_FALSE(height_rule(clues));
}

TEST(HeightRule, RefusesContradictions) {
    VerticalClues clues;
    clues.unit = "m";
    clues.crs = vertical_crs("EPSG:32611+6360");
    const auto rule = height_rule(clues);
    ASSERT_FALSE(rule);
    EXPECT_NE(rule.error().message.find("--height-scale"), std::string::npos);
    clues.unit = "ft";
    EXPECT_FALSE(height_rule(clues));  // the other foot
    clues.crs = vertical_crs("EPSG:32611+8228");
    EXPECT_TRUE(height_rule(clues));
    clues.unit = "us-ft";
    EXPECT_FALSE(height_rule(clues));
    clues.crs = vertical_crs("EPSG:32611+5703");
    EXPECT_FALSE(height_rule(clues));
    VerticalClues flat;
    flat.height_scale = 0;
    EXPECT_FALSE(height_rule(flat));
}

}  // namespace
}  // namespace relevo::ingest
