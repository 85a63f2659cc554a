#include "geo/position.hpp"

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "geo/ellipsoid.hpp"

namespace relevo::geo {
namespace {

constexpr double k10nm = 10e-9;

/// Families of trouble first, then everywhere.
std::vector<Geodetic> places() {
    std::vector<Geodetic> all;
    for (const double lat : {-90.0, -89.9999999999, -45.0, -1e-12, 0.0, 1e-300, 30.0, 89.99999, 90.0})
        for (const double lon :
             {-180.0, -179.999999999, -90.0, -1e-15, 0.0, 45.0, 90.0, 179.9999999999, 180.0, 359.0})
            for (const double h : {-11000.0, -1.0, 0.0, 1e-3, 8848.86, 400e3, 10000e3})
                all.push_back({Degrees{lat}, Degrees{lon}, EllipsoidalHeight{h}});
    std::mt19937_64 random(20240601);
    std::uniform_real_distribution<double> lat(-90, 90);
    std::uniform_real_distribution<double> lon(-180, 180);
    std::uniform_real_distribution<double> log_h(0, 7);
    for (int i = 0; i < 20000; ++i)
        all.push_back({Degrees{lat(random)}, Degrees{lon(random)},
                       EllipsoidalHeight{std::pow(10, log_h(random)) - 11000}});
    return all;
}

/// The closed form in 64-bit mantissas (x87): 2000 times finer than the bound.
glm::dvec3 difference_to_oracle(const Geodetic& p) {
    using Long = long double;
    constexpr Long kRadian = std::numbers::pi_v<Long> / 180;
    const Long f = 1 / 298.257223563L;
    const Long e2 = f * (2 - f);
    const Long sin_lat = std::sin(p.lat.value * kRadian);
    // Near the poles the cosine of the complement keeps its digits.
    const Long cos_lat = std::sin((90 - std::abs(static_cast<Long>(p.lat.value))) * kRadian);
    const Long lon = std::remainder(static_cast<Long>(p.lon.value), 360.0L) * kRadian;
    const Long across = 6378137.0L / std::sqrt(1 - e2 * sin_lat * sin_lat);
    const Ecef found = to_ecef(p);
    return {static_cast<double>(found.m.x - (across + p.h.m) * cos_lat * std::cos(lon)),
            static_cast<double>(found.m.y - (across + p.h.m) * cos_lat * std::sin(lon)),
            static_cast<double>(found.m.z - (across * (1 - e2) + p.h.m) * sin_lat)};
}

TEST(Position, EcefAgreesWithLongDoubleTo10Nanometres) {
    double worst = 0;
    for (const Geodetic& p : places()) worst = std::max(worst, glm::length(difference_to_oracle(p)));
    RecordProperty("worst_nm", std::to_string(worst * 1e9));
    EXPECT_LT(worst, k10nm);
}

TEST(Position, EcefOfGeodeticOfEcefIsThePositionTo10Nanometres) {
    double worst = 0;
    double worst_h = 0;
    for (const Geodetic& p : places()) {
        const Ecef there = to_ecef(p);
        const Geodetic back = to_geodetic(there);
        worst = std::max(worst, glm::length(to_ecef(back) - there));
        worst_h = std::max(worst_h, std::abs(back.h.m - p.h.m));
        EXPECT_LE(std::abs(back.lat.value), 90);
        EXPECT_LE(std::abs(back.lon.value), 180);
    }
    RecordProperty("worst_nm", std::to_string(worst * 1e9));
    EXPECT_LT(worst, k10nm);
    EXPECT_LT(worst_h, k10nm);
}

TEST(Position, AxesAreExact) {
    const auto at = [](double lat, double lon) { return to_ecef({Degrees{lat}, Degrees{lon}, {}}).m; };
    EXPECT_EQ(at(0, 0), glm::dvec3(wgs84::kSemiMajor, 0, 0));
    EXPECT_EQ(at(0, 90), glm::dvec3(0, wgs84::kSemiMajor, 0));
    EXPECT_EQ(at(0, 180), glm::dvec3(-wgs84::kSemiMajor, 0, 0));
    EXPECT_EQ(at(90, 37), glm::dvec3(0, 0, at(90, 0).z));
    EXPECT_NEAR(at(90, 0).z, wgs84::kSemiMinor, 2e-9);
    EXPECT_EQ(at(10, 180), at(10, -180));
    EXPECT_EQ(at(10, 200), at(10, -160));
}

TEST(EnuFrame, AxesAreOrthonormalAndRightHandedEverywhere) {
    for (const Geodetic& p : places()) {
        const EnuFrame frame(p);
        EXPECT_NEAR(glm::dot(frame.east(), frame.north()), 0, 1e-15);
        EXPECT_NEAR(glm::dot(frame.north(), frame.up()), 0, 1e-15);
        EXPECT_NEAR(glm::length(frame.up()), 1, 1e-15);
        EXPECT_NEAR(glm::dot(glm::cross(frame.east(), frame.north()), frame.up()), 1, 1e-14);
    }
}

TEST(EnuFrame, GoesThereAndBack) {
    for (const Geodetic& p : places()) {
        const EnuFrame frame(p);
        for (const glm::dvec3 offset :
             {glm::dvec3(0), glm::dvec3(0.001, -0.002, 0.003), glm::dvec3(-3e4, 2e4, 1e3)}) {
            const Enu back = frame.from_ecef(frame.to_ecef(Enu{offset}));
            EXPECT_LT(glm::length(back.m - offset), k10nm);
        }
    }
}

TEST(EnuFrame, UpIsTheDirectionOfHeight) {
    for (const Geodetic& p : places()) {
        const EnuFrame frame(p);
        const Enu above = frame.from_ecef(to_ecef({p.lat, p.lon, EllipsoidalHeight{p.h.m + 1000}}));
        EXPECT_LT(glm::length(above.m - glm::dvec3(0, 0, 1000)), 2 * k10nm);
    }
}

}  // namespace
}  // namespace relevo::geo
