#include "geo/units.hpp"

#include <gtest/gtest.h>

namespace relevo::geo {
namespace {

TEST(Units, AreThoseOfTheirDefinitions) {
    EXPECT_DOUBLE_EQ(kMetresPerMile, 1609.344);
    EXPECT_DOUBLE_EQ(kSquareMetresPerAcre, 4046.8564224);
    EXPECT_DOUBLE_EQ(kSquareMetresPerSquareMile, 640 * kSquareMetresPerAcre);
}

TEST(Units, TextHasTheUnitThatFits) {
    using enum UnitSystem;
    EXPECT_EQ(length_text(812.3454, metric), "812.345 m");
    EXPECT_EQ(length_text(23456.789, metric), "23.456789 km");
    EXPECT_EQ(length_text(-23456.789, metric), "-23.456789 km");
    EXPECT_EQ(length_text(304.8, imperial), "1000.000 ft");
    EXPECT_EQ(length_text(16093.44, imperial), "10.000000 mi");
    EXPECT_EQ(length_text(1851, nautical), "1851.000 m");
    EXPECT_EQ(length_text(18520, nautical), "10.000000 nautical miles");
    EXPECT_EQ(height_text(4372.1234, metric), "4372.123 m");
    EXPECT_EQ(height_text(3048, imperial, 1), "10000.0 ft");
    EXPECT_EQ(height_text(3048, nautical), "3048.000 m");
    EXPECT_EQ(area_text(9999, metric), "9999.000 m2");
    EXPECT_EQ(area_text(12345.678, metric), "1.234568 ha");
    EXPECT_EQ(area_text(12345678, nautical), "12.345678 km2");
    EXPECT_EQ(area_text(0.09290304, imperial), "1.000 ft2");
    EXPECT_EQ(area_text(40468.564224, imperial), "10.000000 acres");
    EXPECT_EQ(area_text(2589988.110336, imperial), "1.000000 mi2");
    EXPECT_EQ(volume_text(1e6, metric), "1000000.000 m3");
    EXPECT_EQ(volume_text(0.764554857984, imperial), "1.000 yd3");
    EXPECT_EQ(unit_system("nautical"), nautical);
    EXPECT_FALSE(unit_system("stone"));
}

}  // namespace
}  // namespace relevo::geo
