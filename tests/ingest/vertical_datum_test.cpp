#include "ingest/reference/vertical_datum.hpp"

#include <array>
#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

#include "ingest/reference/read_geoid.hpp"
#include "tests/ingest/importing.hpp"

namespace relevo::ingest {
namespace {

using lod::VerticalDatum;
using test::SceneFolder;
using test::SyntheticRaster;

geo::LatLon at(double lat, double lon) {
    return {geo::Degrees{lat}, geo::Degrees{lon}};
}

lod::VerticalReference of_crs(const std::string& definition) {
    const auto crs = Crs::parse(definition);
    EXPECT_TRUE(crs) << definition;
    if (!crs || !crs->vertical()) return {};
    return vertical_reference_of(*crs->vertical());
}

/// A geoid grid of 10' steps over 5..15 E, 40..50 N: any smooth surface.
SyntheticRaster geoid_raster() {
    SyntheticRaster raster;
    raster.type = GDT_Float32;
    raster.columns = raster.rows = 61;
    const double step = 1.0 / 6;
    raster.geotransform = {5 - step / 2, step, 0, 50 + step / 2, 0, -step};
    raster.value = [](int column, int row) { return 45 + std::sin(column / 9.0) + std::cos(row / 7.0); };
    return raster;
}

double model(double lat, double lon) {
    return 45 + std::sin((lon - 5) * 6 / 9) + std::cos((50 - lat) * 6 / 7);
}

TEST(VerticalDatum, UnitsAndDepthsOfOneDatumAreOneReference) {
    const auto navd88 = of_crs("EPSG:32611+5703");
    EXPECT_EQ(navd88.datum, VerticalDatum::other);
    EXPECT_EQ(navd88.name, "NAVD88 height");
    for (const char* crs : {"EPSG:32611+6360", "EPSG:32611+8228", "EPSG:32611+6357", "EPSG:32611+6358"})
        EXPECT_TRUE(same_datum(of_crs(crs), navd88)) << crs << " " << of_crs(crs).name;
    EXPECT_FALSE(same_datum(of_crs("EPSG:4326+3855"), navd88));
    EXPECT_EQ(of_crs("EPSG:4326+5773").datum, VerticalDatum::egm96);
    EXPECT_EQ(of_crs("EPSG:4979").datum, VerticalDatum::ellipsoid);
}

TEST(VerticalDatum, Named) {
    const auto datum = [](const char* name) {
        const auto reference = vertical_reference_named(name);
        EXPECT_TRUE(reference) << name;
        return reference ? *reference : lod::VerticalReference{};
    };
    EXPECT_EQ(datum("egm96").datum, VerticalDatum::egm96);
    EXPECT_EQ(datum("EPSG:5773").datum, VerticalDatum::egm96);
    EXPECT_EQ(datum("ellipsoid").datum, VerticalDatum::ellipsoid);
    EXPECT_TRUE(same_datum(datum("egm2008"), of_crs("EPSG:4326+3855")));
    EXPECT_TRUE(same_datum(datum("EPSG:6360"), of_crs("EPSG:32611+5703")));
    EXPECT_FALSE(datum("egm2008").assumed);
    for (const char* name : {"", "EPSG:32611", "nonsense", "EPSG:4979"}) {
        const auto reference = vertical_reference_named(name);
        ASSERT_FALSE(reference) << name;
        EXPECT_EQ(reference.error().kind, ErrorKind::usage);
    }
}

TEST(GeoidOf, EllipsoidNeedsNone) {
    const auto geoid = geoid_of({VerticalDatum::ellipsoid, "", false}, {});
    ASSERT_TRUE(geoid);
    EXPECT_FALSE(geoid->has_value());
}

TEST(GeoidOf, Egm96IsTheCubicOne) {
    const auto own = geo::Geoid::egm96();
    if (!own) GTEST_SKIP() << own.error().message;
    const auto geoid = geoid_of({}, {});
    ASSERT_TRUE(geoid && *geoid);
    EXPECT_EQ((*geoid)->undulation(at(27.1, 92.9)), own->undulation(at(27.1, 92.9)));
}

TEST(GeoidOf, AMissingGridIsNamed) {
    const auto missing = [](const char* crs, std::optional<Bounds> area,
                            std::initializer_list<const char*> parts) {
        const auto reference = of_crs(crs);
        const auto geoid = geoid_of(reference, {}, area);
        ASSERT_FALSE(geoid) << crs;
        EXPECT_EQ(geoid.error().kind, ErrorKind::input);
        EXPECT_TRUE(test::says(geoid.error().message, parts));
        EXPECT_TRUE(test::says(geoid.error().message, {"--geoid", "PROJ_DATA", reference.name.c_str()}));
    };
    missing("EPSG:4326+3855", {}, {"us_nga_egm08_25.tif"});
    missing("EPSG:32611+5703", Bounds{-118, 34, -117, 35}, {"us_noaa_g2018u0.tif"});  // California
    missing("EPSG:32611+6360", Bounds{-150, 60, -149, 61}, {"us_noaa_g"});            // Alaska
    missing("EPSG:25832+7837", Bounds{9, 48, 10, 49}, {"DHHN2016 height"});
    const auto unknown = geoid_of({VerticalDatum::other, "the harbour's gauge", false}, {});
    ASSERT_FALSE(unknown);
    EXPECT_TRUE(test::says(unknown.error().message, {"the harbour's gauge", "--geoid"}));
}

TEST(GeoidOf, AFileOfTheUsersServesOtherDatumsAlone) {
    const SceneFolder folder;
    const auto file = geoid_raster().write(folder / "national.tif");
    const auto geoid = geoid_of({VerticalDatum::other, "the harbour's gauge", false}, file);
    ASSERT_TRUE(geoid) << geoid.error().message;
    EXPECT_NEAR((*geoid)->undulation(at(45, 10)).m, model(45, 10), 1e-5);              // a node, as float32
    EXPECT_NEAR((*geoid)->undulation(at(44.913, 9.77)).m, model(44.913, 9.77), 1e-4);  // between nodes
    EXPECT_TRUE((*geoid)->covers(at(40, 5)));
    EXPECT_FALSE((*geoid)->covers(at(39.9, 5)));
    const auto egm96 = geoid_of({}, file);
    if (egm96) {
        EXPECT_TRUE((*egm96)->covers(at(0, 100)));
    }
    EXPECT_FALSE(*geoid_of({VerticalDatum::ellipsoid, "", false}, file));
}

TEST(ReadGeoid, SouthUpNodataAndUnits) {
    const SceneFolder folder;
    SyntheticRaster raster = geoid_raster();
    const auto north_up = read_geoid(raster.write(folder / "n.tif"));
    raster.geotransform[3] = 40 - 1.0 / 12;
    raster.geotransform[5] = 1.0 / 6;
    raster.unit = "US survey foot";
    raster.type = GDT_Float64;
    raster.nodata = -32767;
    raster.value = [](int column, int row) {
        if (column == 0 && row == 0) return -32767.0;
        return (45 + std::sin(column / 9.0) + std::cos((60 - row) / 7.0)) * 3937 / 1200;
    };
    const auto south_up = read_geoid(raster.write(folder / "s.tif"));
    ASSERT_TRUE(north_up && south_up) << south_up.error().message;
    for (double lat = 41; lat < 50; lat += 0.37)
        EXPECT_NEAR(north_up->undulation(at(lat, 9.9)).m, south_up->undulation(at(lat, 9.9)).m, 1e-5);
    EXPECT_FALSE(south_up->covers(at(40.05, 5.05)));
    EXPECT_TRUE(south_up->covers(at(41, 6)));
}

TEST(ReadGeoid, OfALargeGridOnlyThePlace) {
    const SceneFolder folder;
    SyntheticRaster raster = geoid_raster();
    raster.columns = 3600;
    raster.rows = 1801;
    raster.geotransform = {-0.05, 0.1, 0, 90.05, 0, -0.1};  // 0 .. 360
    raster.value = [](int column, int row) {
        return row == 0 || row == 1800
                   ? 10
                   : 10 + std::sin(column * 6.28318530717958 / 360) * std::sin(row / 40.0);
    };
    const auto file = raster.write(folder / "world.tif");
    const auto world = read_geoid(file);
    ASSERT_TRUE(world) << world.error().message;
    for (const Bounds area : {Bounds{-118, 34, -117, 35}, Bounds{-1, 50, 1, 51}, Bounds{179, -20, 181, -19},
                              Bounds{10, 88, 20, 90}}) {
        const auto part = read_geoid(file, area);
        ASSERT_TRUE(part) << part.error().message;
        for (double u = 0; u <= 1; u += 0.13) {
            const auto place =
                at(area.south + u * (area.north - area.south), area.west + u * (area.east - area.west));
            EXPECT_TRUE(part->covers(place));
            EXPECT_NEAR(part->undulation(place).m, world->undulation(place).m, 1e-9);
        }
    }
    const auto part = read_geoid(file, Bounds{-118, 34, -117, 35});
    EXPECT_FALSE(part->covers(at(0, 0)));  // it was a part
}

TEST(ReadGeoid, RefusesWhatIsNone) {
    const SceneFolder folder;
    SyntheticRaster raster = geoid_raster();
    raster.crs = "EPSG:32632";
    raster.geotransform = {500000, 1000, 0, 5000000, 0, -1000};
    const auto projected = read_geoid(raster.write(folder / "utm.tif"));
    ASSERT_FALSE(projected);
    EXPECT_TRUE(test::says(projected.error().message, {"utm.tif", "degrees"}));
    raster = geoid_raster();
    raster.value = [](int, int) { return 1500; };
    const auto heights = read_geoid(raster.write(folder / "dem.tif"));
    ASSERT_FALSE(heights);
    EXPECT_TRUE(test::says(heights.error().message, {"dem.tif", "no undulation"}));
    EXPECT_FALSE(read_geoid(folder / "none.tif"));
}

// PROJ's grid is used once it is installed: in a process of its own, as PROJ reads its search path once.
TEST(GeoidOf, FindsTheGridInProjData) {
    const SceneFolder folder;
    geoid_raster().write(folder / "us_nga_egm08_25.tif");
    const auto reference = of_crs("EPSG:4326+3855");
    const auto with_grid = [&] {
        setenv("PROJ_DATA", (folder.path().string() + ":/usr/share/proj").c_str(), 1);
        const auto geoid = geoid_of(reference, {}, Bounds{8, 44, 9, 45});
        if (!geoid) fmt::print(stderr, "{}", geoid.error().message);
        std::_Exit(
            geoid && *geoid && std::abs((*geoid)->undulation(at(45, 10)).m - model(45, 10)) < 1e-5 ? 0 : 1);
    };
    EXPECT_EXIT(with_grid(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace relevo::ingest
