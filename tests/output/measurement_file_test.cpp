#include "output/measurement_file.hpp"

#include <cmath>
#include <fstream>
#include <random>

#include <gtest/gtest.h>

#include "tests/geo/outside_program.hpp"

namespace relevo::output {
namespace {

using lod::Measurement;
using lod::MeasurementKind;

geo::LatLon at(double lat, double lon) {
    return {geo::Degrees{lat}, geo::Degrees{lon}};
}

std::vector<MeasurementRecord> hard_ones() {
    std::vector<MeasurementRecord> all;
    const auto add = [&](std::string name, MeasurementKind kind, std::vector<geo::LatLon> vertices) {
        all.push_back({{std::move(name), kind, std::move(vertices)}, {}, {{"length_m", 1234.5678901234567}}});
    };
    add("summit, \"high\" <&> Čapek\nsecond line", MeasurementKind::point,
        {at(37.577841234567891, -105.485599)});
    add("", MeasurementKind::point, {at(-90, 180)});
    add("a line", MeasurementKind::path, {at(0.1, 0.2), at(1.0 / 3, 2.0 / 3)});
    add("across", MeasurementKind::path,
        {at(-16.123456789012345, 179.98765432109876), at(-17, -179.5), at(-18, 179)});
    add("on it", MeasurementKind::path, {at(1, 179), at(2, 180), at(3, -180), at(4, -179)});
    add("clockwise", MeasurementKind::polygon, {at(10, 20), at(11, 20), at(11, 21), at(10, 21)});
    add("other way", MeasurementKind::polygon, {at(10, 21), at(11, 21), at(11, 20), at(10, 20)});
    add("fiji", MeasurementKind::polygon, {at(-19, 177.1), at(-19.7, -178.3), at(-15, -178), at(-15, 177)});
    add("pole", MeasurementKind::polygon, {at(80.1, 10), at(81, 130), at(79, -110)});
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> lat(-90, 90);
    std::uniform_real_distribution<double> lon(-180, 180);
    for (int i = 0; i < 50; ++i)
        add("random", MeasurementKind::path, {at(lat(random), lon(random)), at(lat(random), lon(random))});
    return all;
}

void expect_same(const std::vector<Measurement>& loaded, const std::vector<MeasurementRecord>& saved) {
    ASSERT_EQ(loaded.size(), saved.size());
    for (std::size_t i = 0; i < loaded.size(); ++i) {
        const Measurement& expected = saved[i].measurement;
        EXPECT_EQ(loaded[i].name, expected.name);
        EXPECT_EQ(loaded[i].kind, expected.kind) << expected.name;
        ASSERT_EQ(loaded[i].vertices.size(), expected.vertices.size()) << expected.name;
        for (std::size_t k = 0; k < expected.vertices.size(); ++k) {
            EXPECT_EQ(loaded[i].vertices[k].lat, expected.vertices[k].lat) << expected.name;
            EXPECT_EQ(loaded[i].vertices[k].lon, expected.vertices[k].lon) << expected.name;
        }
    }
}

class MeasurementFile : public testing::Test {
  protected:
    std::filesystem::path put(const std::string& name, const std::string& text) {
        std::ofstream(folder / name, std::ios::binary) << text;
        return folder / name;
    }
    Result<std::vector<Measurement>> load(const std::string& name, const std::string& text) {
        return load_measurements(put(name, text));
    }
    test::ScratchFolder folder{"measurements"};
};

TEST_F(MeasurementFile, EveryFormatKeepsEveryBit) {
    const auto records = hard_ones();
    for (const char* name : {"a.geojson", "a.csv", "a.kml"}) {
        const auto saved = save_measurements(folder / name, records, false);
        ASSERT_TRUE(saved) << saved.error().message;
        const auto loaded = load_measurements(folder / name);
        ASSERT_TRUE(loaded) << loaded.error().message;
        SCOPED_TRACE(name);
        expect_same(*loaded, records);
    }
}

TEST_F(MeasurementFile, LongitudesOfOtherTurnsAreTheSamePlace) {
    const std::vector<MeasurementRecord> records{
        {{"", MeasurementKind::path, {at(1, 359.5), at(2, -200)}}, {}, {}}};
    for (const char* name : {"a.geojson", "a.csv", "a.kml"}) {
        ASSERT_TRUE(save_measurements(folder / name, records, true));
        const auto loaded = load_measurements(folder / name);
        ASSERT_TRUE(loaded) << loaded.error().message;
        EXPECT_EQ(loaded->front().vertices[0].lon.value, -0.5);
        EXPECT_EQ(loaded->front().vertices[1].lon.value, 160);
    }
}

TEST_F(MeasurementFile, GdalReadsTheResults) {
    ASSERT_TRUE(save_measurements(folder / "a.geojson", hard_ones(), false));
    ASSERT_TRUE(save_measurements(folder / "a.kml", hard_ones(), false));
    for (const char* name : {"a.geojson", "a.kml"}) {
        std::string text;
        for (const std::string& line :
             test::ask(fmt::format("ogrinfo -al '{}'", (folder / name).string()), {}))
            text += line + '\n';
        if (text.empty()) GTEST_SKIP() << "ogrinfo is not installed (package gdal-bin)";
        EXPECT_NE(text.find("length_m"), std::string::npos) << name;
        EXPECT_NE(text.find("1234.567890123"), std::string::npos) << name;
        EXPECT_NE(text.find("LINESTRING (0.2 0.1,0.666666666666667 0.333333333333333)"), std::string::npos)
            << text;
    }
}

TEST_F(MeasurementFile, GeometryThatWasEditedElsewhereCounts) {
    std::vector<MeasurementRecord> records{{{"", MeasurementKind::path, {at(1, 179), at(2, -179)}}, {}, {}}};
    ASSERT_TRUE(save_measurements(folder / "a.geojson", records, false));
    auto json = nlohmann::json::parse(std::ifstream(folder / "a.geojson"));
    json["features"][0]["geometry"]["coordinates"][1][1] = {-170, 5};
    const auto loaded = load("b.geojson", json.dump());
    ASSERT_TRUE(loaded) << loaded.error().message;
    ASSERT_EQ(loaded->size(), 2u);  // the two parts, as they are drawn
    EXPECT_EQ((*loaded)[1].vertices[1].lat.value, 5);
}

TEST_F(MeasurementFile, ReadsWhatOthersWrite) {
    const auto bare = load("a.json", R"({"type":"Polygon","coordinates":[[[1,2],[3,2],[3,4],[1,2]]]})");
    ASSERT_TRUE(bare) << bare.error().message;
    EXPECT_EQ(bare->front().vertices.size(), 3u);
    const auto multi = load(
        "a.json",
        R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:OGC:1.3:CRS84"}},
        "features":[{"type":"Feature","properties":{"Name":"ab"},"geometry":{"type":"MultiPoint","coordinates":[[1,2,3],[4,5]]}},
        {"type":"Feature","properties":null,"geometry":null}]})");
    ASSERT_TRUE(multi) << multi.error().message;
    ASSERT_EQ(multi->size(), 2u);
    EXPECT_EQ(multi->back().name, "ab");
    EXPECT_EQ(multi->back().vertices[0].lon.value, 4);
    const auto table =
        load("a.csv", "\xef\xbb\xbfLongitude,comment,Latitude\r\n-105.5,\"a, b\",37.25\r\n\r\n+1,,2\r\n");
    ASSERT_TRUE(table) << table.error().message;
    ASSERT_EQ(table->size(), 2u);
    EXPECT_EQ(table->front().vertices[0].lat.value, 37.25);
    const auto kml = load(
        "a.kml",
        "<?xml version='1.0'?><kml xmlns='http://www.opengis.net/kml/2.2'><Document><Folder><name>f</name>"
        "<Placemark><name>track</name><LineString><coordinates>\n 7,46,1200 7.5,46.25,1300\n"
        "</coordinates></LineString></Placemark></Folder></Document></kml>");
    ASSERT_TRUE(kml) << kml.error().message;
    ASSERT_EQ(kml->size(), 1u);
    EXPECT_EQ(kml->front().name, "track");
    EXPECT_EQ(kml->front().vertices[1].lat.value, 46.25);
}

TEST_F(MeasurementFile, SaysWhatIsWrong) {
    const auto message = [&](const char* name, const std::string& text) {
        const auto loaded = load(name, text);
        EXPECT_FALSE(loaded) << text;
        if (loaded) return std::string();
        EXPECT_EQ(loaded.error().kind, ErrorKind::input);
        EXPECT_NE(loaded.error().message.find(name), std::string::npos);
        return loaded.error().message;
    };
    const auto has = [](const std::string& text, const char* part) {
        return text.find(part) != std::string::npos;
    };
    EXPECT_TRUE(has(message("a.json", "{"), "not JSON"));
    EXPECT_TRUE(has(message("a.json", "[1]"), "not GeoJSON"));
    EXPECT_TRUE(has(message("a.json", R"({"type":"Point","coordinates":["a",2]})"), "position"));
    EXPECT_TRUE(has(message("a.json", R"({"type":"Point","coordinates":[2,95]})"), "no place on earth"));
    EXPECT_TRUE(has(message("a.json", R"({"type":"LineString","coordinates":[[2,9]]})"), "needs 2"));
    EXPECT_TRUE(has(message("a.json", R"({"type":"Circle"})"), "Circle"));
    EXPECT_TRUE(has(message("a.json", R"({"type":"Point"})"), "coordinates"));
    EXPECT_TRUE(has(
        message("a.json", R"({"type":"Polygon","coordinates":[[[0,0],[9,0],[9,9]],[[1,1],[2,1],[2,2]]]})"),
        "holes"));
    EXPECT_TRUE(has(
        message(
            "a.json",
            R"({"type":"Point","crs":{"type":"name","properties":{"name":"EPSG:3857"}},"coordinates":[1,2]})"),
        "ogr2ogr"));
    EXPECT_TRUE(has(message("a.csv", ""), "empty"));
    EXPECT_TRUE(has(message("a.csv", "x,y\n1,2\n"), "lat"));
    EXPECT_TRUE(has(message("a.csv", "lat,lon\n1,2\n1;5,2\n"), "line 3"));
    EXPECT_TRUE(has(message("a.csv", "lat,lon\n1,nan\n"), "no place on earth"));
    EXPECT_TRUE(has(message("a.csv", "lat,lon,name\n1,2,\"a\n"), "quote"));
    EXPECT_TRUE(has(message("a.csv", "name,kind,vertex,lat,lon\n,path,1,1,2\n,path,3,1,2\n"), "line 3"));
    EXPECT_TRUE(has(message("a.csv", "name,kind,vertex,lat,lon\n,walk,1,1,2\n"), "walk"));
    EXPECT_TRUE(has(message("a.kml", "<kml><Placemark>"), "KML"));
    const auto missing = load_measurements(folder / "none.csv");
    ASSERT_FALSE(missing);
    EXPECT_TRUE(has(missing.error().message, "no such file"));
    EXPECT_EQ(load_measurements(folder / "a.shp").error().kind, ErrorKind::usage);
    EXPECT_EQ(save_measurements(put("there.csv", ""), {}, false).error().kind, ErrorKind::usage);
}

// Every truncation and many a flipped bit: an error or a list of places, never a crash.
TEST_F(MeasurementFile, DamageIsNoCrash) {
    auto records = hard_ones();
    records.resize(9);
    std::mt19937 random(3);
    for (const char* name : {"a.geojson", "a.csv", "a.kml"}) {
        ASSERT_TRUE(save_measurements(folder / name, records, true));
        std::ifstream stream(folder / name, std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(stream), {}};
        const std::string damaged = std::string("damaged-") + name;
        for (int i = 0; i < 150; ++i) {
            std::string part = text.substr(0, random() % text.size());
            if (i % 2 == 1) {
                part = text;
                part[random() % part.size()] ^= static_cast<char>(1u << random() % 8);
            }
            const auto loaded = load(damaged, part);
            if (!loaded) {
                EXPECT_NE(loaded.error().message.find(damaged), std::string::npos);
            }
        }
    }
}

}  // namespace
}  // namespace relevo::output
