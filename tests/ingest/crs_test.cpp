#include "ingest/reference/crs.hpp"

#include <gtest/gtest.h>

namespace relevo::ingest {
namespace {

TEST(Crs, NamesItselfByItsCode) {
    for (const char* code : {"EPSG:4326", "EPSG:32611", "EPSG:3031"}) {
        const auto crs = Crs::parse(code);
        ASSERT_TRUE(crs) << code;
        EXPECT_EQ(crs->name(), code);
        EXPECT_FALSE(crs->vertical()) << code;
        const auto again = Crs::parse(crs->wkt());
        ASSERT_TRUE(again) << code;
        EXPECT_EQ(again->name(), code);
    }
}

TEST(Crs, FindsTheCodeOfADefinitionWithoutOne) {
    const auto crs = Crs::parse("+proj=utm +zone=11 +datum=WGS84 +units=m +type=crs");
    ASSERT_TRUE(crs);
    EXPECT_EQ(crs->name(), "EPSG:32611");
}

TEST(Crs, KnowsItsUnits) {
    const auto degrees = Crs::parse("EPSG:4326");
    ASSERT_TRUE(degrees);
    EXPECT_TRUE(degrees->geographic());
    EXPECT_EQ(degrees->unit(), "degree");
    EXPECT_NEAR(degrees->full_turn(), 360, 1e-10);
    const auto grads = Crs::parse("EPSG:4807");  // NTF (Paris)
    ASSERT_TRUE(grads);
    EXPECT_NEAR(grads->full_turn(), 400, 1e-10);
    const auto feet = Crs::parse("EPSG:2225");  // California zone 1
    ASSERT_TRUE(feet);
    EXPECT_FALSE(feet->geographic());
    EXPECT_EQ(feet->unit(), "US survey foot");
}

TEST(Crs, TakesTheVerticalPartOff) {
    const auto compound = Crs::parse("EPSG:26912+5703");
    ASSERT_TRUE(compound);
    ASSERT_TRUE(compound->vertical());
    EXPECT_EQ(compound->vertical()->code, "EPSG:5703");
    EXPECT_FALSE(compound->vertical()->ellipsoidal);
    const auto solid = Crs::parse("EPSG:4979");
    ASSERT_TRUE(solid);
    ASSERT_TRUE(solid->vertical());
    EXPECT_TRUE(solid->vertical()->ellipsoidal);
    EXPECT_TRUE(solid->geographic());
}

TEST(Crs, RefusesWhatIsNoPlaceOnEarth) {
    EXPECT_FALSE(Crs::parse(""));
    EXPECT_FALSE(Crs::parse("EPSG:999999"));
    EXPECT_FALSE(Crs::parse("EPSG:4978"));  // geocentric
    EXPECT_FALSE(Crs::parse("EPSG:5773"));  // heights alone
    EXPECT_FALSE(Crs::parse(R"(LOCAL_CS["here",UNIT["metre",1]])"));
}

}  // namespace
}  // namespace relevo::ingest
