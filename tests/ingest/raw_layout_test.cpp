#include "ingest/source/raw_layout.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "ingest/source/source.hpp"
#include "tests/ingest/importing.hpp"

namespace relevo::ingest {
namespace {

using test::SceneFolder;

TEST(RawLayout, IsReadFromText) {
    const auto layout = raw_layout("3601x1201,int16,be");
    ASSERT_TRUE(layout);
    EXPECT_EQ(layout->columns, 3601);
    EXPECT_EQ(layout->rows, 1201);
    EXPECT_EQ(layout->type, "int16");
    EXPECT_FALSE(layout->little_endian);
    EXPECT_TRUE(raw_layout("2x2,uint8"));
    for (const char* type : {"uint8", "int16", "uint16", "int32", "float32", "float64"})
        EXPECT_TRUE(raw_layout(std::string{"1x1,"} + type + ",le")) << type;
    for (const char* bad : {"", "x", "3x,int16,le", "3x3", "3x3,int16", "3x3,int16,me", "0x3,int16,le",
                            "-3x3,int16,le", "3x3,int24,le", "99999999999x1,int16,le", "3x3,int16,le,",
                            "3 x3,int16,le", "2147483647x2147483647,float64,le"}) {
        const auto layout_of_bad = raw_layout(bad);
        ASSERT_FALSE(layout_of_bad) << bad;
        EXPECT_EQ(layout_of_bad.error().kind, ErrorKind::usage);
        EXPECT_TRUE(test::says(layout_of_bad.error().message, {"3601x3601,int16,be"}));
    }
}

SourceRequest raw_request(const std::filesystem::path& file, const std::string& layout) {
    SourceRequest request;
    request.input = file.string();
    request.raw = *raw_layout(layout);
    request.crs = "EPSG:4326";
    request.bounds = Bounds{10, 49, 13, 51};
    return request;
}

// The bytes are written out by hand.
TEST(RawLayout, EveryTypeAndOrder) {
    struct Case {
        const char* layout;
        std::string bytes;  // three columns, one row
        double values[3];
    };
    using namespace std::string_literals;
    const Case cases[] = {
        {"3x1,uint8", "\x00\x01\xff"s, {0, 1, 255}},
        {"3x1,int16,le", "\x01\x00\xff\xff\x00\x80"s, {1, -1, -32768}},
        {"3x1,int16,be", "\x00\x01\xff\xff\x80\x00"s, {1, -1, -32768}},
        {"3x1,uint16,le", "\x01\x00\xff\xff\x00\x80"s, {1, 65535, 32768}},
        {"3x1,int32,be", "\x00\x00\x00\x02\xff\xff\xff\xfe\x00\x01\x00\x00"s, {2, -2, 65536}},
        {"3x1,float32,le", "\x00\x00\xc0\x3f\x00\x00\x00\x00\x00\x00\x20\xc1"s, {1.5, 0, -10}},
        {"3x1,float64,be",
         "\x3f\xf8\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\xc0\x24\x00\x00\x00\x00\x00\x00"s,
         {1.5, 0, -10}},
    };
    const SceneFolder folder;
    for (const Case& c : cases) {
        test::replace(folder / "a & <b>.raw", c.bytes);
        const auto source = Source::open(raw_request(folder / "a & <b>.raw", c.layout));
        ASSERT_TRUE(source) << c.layout << " " << source.error().message;
        EXPECT_EQ(source->name(), "a & <b>.raw");
        const auto heights = source->read({0, 0, 3, 1});
        ASSERT_TRUE(heights) << heights.error().message;
        for (int i = 0; i < 3; ++i) EXPECT_EQ(heights->at(i, 0), c.values[i]) << c.layout << " " << i;
        EXPECT_NEAR(source->posts().x0, 10.5, 1e-12);
    }
}

TEST(RawLayout, RefusesAnotherSize) {
    const SceneFolder folder;
    test::replace(folder / "short.raw", std::string(11, 'x'));
    const auto message = [&](const SourceRequest& request) {
        const auto source = Source::open(request);
        return source ? std::string{"opened"} : source.error().message;
    };
    EXPECT_TRUE(test::says(message(raw_request(folder / "short.raw", "3x2,int16,le")),
                           {"short.raw", "11 bytes", "12", "--raw"}));
    EXPECT_TRUE(test::says(message(raw_request(folder / "short.raw", "1048576x1048576,float64,le")),
                           {"short.raw", "11 bytes", "8796093022208"}));
    EXPECT_TRUE(
        test::says(message(raw_request(folder / "none.raw", "3x2,int16,le")), {"none.raw", "no such file"}));
    test::replace(folder / "right.raw", std::string(12, 'x'));
    auto nowhere = raw_request(folder / "right.raw", "3x2,int16,le");
    nowhere.bounds.reset();
    EXPECT_TRUE(test::says(message(nowhere), {"right.raw", "--bounds"}));
}

}  // namespace
}  // namespace relevo::ingest
