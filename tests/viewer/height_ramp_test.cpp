#include "viewer/height_ramp.hpp"

#include <gtest/gtest.h>

#include "tests/viewer/studio.hpp"

namespace relevo::test {
namespace {

using viewer::Layer;

// Truth: gdaldem color-relief's rule, linear between stops, and the outermost colours beyond.
TEST(HeightRamp, ReadsWhatGdaldemReads) {
    const auto ramp = viewer::parse_height_ramp(
        "# land\n\n0 10 20 30\n1000,110,120,130,255\nnv 0 0 0\n100%:200:210:220\r\n");
    ASSERT_TRUE(ramp) << ramp.error().message;
    const auto colours = viewer::colours_of(*ramp, {-500, 3595, -500});  // a metre a texel
    ASSERT_EQ(colours.size(), 4096U);
    EXPECT_EQ(colours[0], (std::array<std::uint8_t, 4>{10, 20, 30, 255}));
    EXPECT_EQ(colours[500], (std::array<std::uint8_t, 4>{10, 20, 30, 255}));
    EXPECT_EQ(colours[1000], (std::array<std::uint8_t, 4>{60, 70, 80, 255}));
    EXPECT_EQ(colours[1500], (std::array<std::uint8_t, 4>{110, 120, 130, 255}));
    EXPECT_EQ(colours[4095], (std::array<std::uint8_t, 4>{200, 210, 220, 255}));
}

TEST(HeightRamp, SaysWhichLineIsWrong) {
    for (const auto& [text, what] : {std::pair("", "no line"),
                                     {"0 1 2\n", "line 1"},
                                     {"0 1 2 3\nx 1 2 3", "line 2"},
                                     {"0 1 2 300", "line 1"},
                                     {"\n\n5 1 2 3 4 5", "line 3"}}) {
        const auto ramp = viewer::parse_height_ramp(text);
        ASSERT_FALSE(ramp) << text;
        EXPECT_NE(ramp.error().message.find(what), std::string::npos) << ramp.error().message;
    }
    EXPECT_FALSE(viewer::read_height_ramp("no such ramp"));
    for (const char* name : {"viridis", "grey", "classic"}) EXPECT_TRUE(viewer::read_height_ramp(name));
}

TEST(HeightRamp, ColoursTheGround) {
    const auto frame = geographic_frame(129, 129);
    Studio studio(make_terrain(frame, make_heights(frame, [](int column, int) { return 10.0 * column; })));
    viewer::DrawSettings settings{.sun = *viewer::parse_sun("0,90"), .background = kMagenta};
    const auto camera = above_looking_down(studio.terrain(), 64, 64, 3000);
    const auto plain = studio.draw(camera, settings);
    settings.ramp = std::make_shared<viewer::HeightRamp>(
        *viewer::parse_height_ramp("0 200 0 0\n640 200 0 0\n641 0 200 0"));
    const auto own = studio.draw(camera, settings);
    EXPECT_GT(own.at(40, 75)[0], 2 * own.at(40, 75)[1]);
    EXPECT_GT(own.at(160, 75)[1], 2 * own.at(160, 75)[0]);
    settings.ramp = nullptr;
    EXPECT_EQ(studio.draw(camera, settings).rgb, plain.rgb);
}

}  // namespace
}  // namespace relevo::test
