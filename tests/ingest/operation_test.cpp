#include "ingest/reference/operation.hpp"

#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "geo/coordinate_text.hpp"

namespace relevo::ingest {
namespace {

Result<Operation> operation(const std::string& definition, const std::vector<Place>& places) {
    const auto crs = Crs::parse(definition);
    if (!crs) return crs.error();
    return Operation::to_wgs84(*crs, places);
}

TEST(Operation, UtmAgreesWithGeographicLib) {
    const auto utm = operation("EPSG:32613", {{456000, 4159000}});
    ASSERT_TRUE(utm);
    for (const Place p : {Place{456000, 4159000}, {200000, 1000000}, {800000, 8000000}, {500000, 5000000}}) {
        Place there = p;
        utm->forward({&there, 1});
        const auto truth = geo::parse_lat_lon(fmt::format("13N {} {}", p.x, p.y));
        ASSERT_TRUE(truth);
        EXPECT_NEAR(there.x, truth->lon.value, 1e-11);
        EXPECT_NEAR(there.y, truth->lat.value, 1e-11);
        utm->inverse({&there, 1});
        EXPECT_NEAR(there.x, p.x, 1e-6);
        EXPECT_NEAR(there.y, p.y, 1e-6);
    }
    EXPECT_EQ(utm->note(), "");
    EXPECT_EQ(utm->accuracy_m(), 0);
}

// Debian has none of the grids from NAD27: PROJ's own choice for a transformation falls back to ballpark
// without a word, which is 100 m off here.
TEST(Operation, Nad27IsNeverABallpark) {
    const auto nad27 = operation("EPSG:26710", {{557805, 5122005}, {567615, 5107965}});
    ASSERT_TRUE(nad27) << nad27.error().message;
    EXPECT_EQ(nad27->name().find("Ballpark"), std::string::npos) << nad27->name();
    ASSERT_TRUE(nad27->accuracy_m());
    EXPECT_LE(*nad27->accuracy_m(), 10);
    if (*nad27->accuracy_m() > 3) {
        EXPECT_NE(nad27->note().find("not installed"), std::string::npos) << nad27->note();
    }

    Place place{562710, 5114985};
    nad27->forward({&place, 1});
    const auto unshifted =
        operation("+proj=utm +zone=10 +ellps=clrk66 +towgs84=0,0,0 +type=crs", {{562710, 5114985}});
    ASSERT_TRUE(unshifted) << unshifted.error().message;
    Place ballpark{562710, 5114985};
    unshifted->forward({&ballpark, 1});
    EXPECT_GT(std::abs(place.x - ballpark.x) * 77000, 50);  // metres
}

TEST(Operation, RefusesWhatHasNoWayToWgs84) {
    const auto unknown = operation(R"(GEOGCRS["somewhere",DATUM["mine",ELLIPSOID["mine",6300000,300]],)"
                                   R"(CS[ellipsoidal,2],AXIS["lat",north],AXIS["lon",east],)"
                                   R"(ANGLEUNIT["degree",0.0174532925199433]])",
                                   {{10, 50}});
    ASSERT_FALSE(unknown);
    EXPECT_EQ(unknown.error().kind, ErrorKind::input);
}

TEST(Operation, UndefinedPlacesAreNan) {
    const auto utm = operation("EPSG:32632", {{500000, 5000000}});
    ASSERT_TRUE(utm);
    std::vector<Place> places{{500000, 5000000}, {1e12, 1e12}, {500000, 5000001}};
    utm->forward(places);
    EXPECT_TRUE(std::isfinite(places[0].x));
    EXPECT_TRUE(std::isnan(places[1].x));
    EXPECT_TRUE(std::isfinite(places[2].x));
}

}  // namespace
}  // namespace relevo::ingest
