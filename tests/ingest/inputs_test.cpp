#include "ingest/source/inputs.hpp"

#include <fstream>

#include <gtest/gtest.h>

#include "tests/ingest/importing.hpp"

namespace relevo::ingest {
namespace {

using test::says;
using test::SceneFolder;
using test::SyntheticRaster;

std::string write(const std::filesystem::path& file, const std::string& text) {
    std::ofstream{file} << text;
    return file.string();
}

TEST(Inputs, AFolderStandsForItsRastersByName) {
    const SceneFolder folder;
    std::filesystem::create_directory(folder / "tiles");
    SyntheticRaster{}.write(folder / "tiles" / "b.tif");
    SyntheticRaster{}.write(folder / "tiles" / "a.tif");
    write(folder / "tiles" / "readme.lic", "no raster");
    write(folder / "tiles" / "a.prj", "no raster");
    write(folder / "tiles" / "c.zip", "looked at when it is opened");
    const auto inputs = expand_inputs({(folder / "tiles").string()});
    ASSERT_TRUE(inputs) << inputs.error().message;
    EXPECT_EQ(*inputs, (std::vector<std::string>{(folder / "tiles" / "a.tif").string(),
                                                 (folder / "tiles" / "b.tif").string(),
                                                 (folder / "tiles" / "c.zip").string()}));
}

TEST(Inputs, AFolderWithoutRastersIsAnError) {
    const SceneFolder folder;
    std::filesystem::create_directory(folder / "empty");
    const auto inputs = expand_inputs({(folder / "empty").string()});
    ASSERT_FALSE(inputs);
    EXPECT_EQ(inputs.error().kind, ErrorKind::input);
    EXPECT_TRUE(says(inputs.error().message, {"empty", "no elevation file"}));
}

TEST(Inputs, AListNamesInputsRelativeToItself) {
    const SceneFolder folder;
    const auto a = SyntheticRaster{}.write(folder / "a.tif");
    const auto b = SyntheticRaster{}.write(folder / "b.tif");
    const auto list = write(folder / "list.txt", "# tiles\n\n  b.tif\r\n" + a.string() + "\n");
    const auto inputs = expand_inputs({"@" + list, "other.tif"});
    ASSERT_TRUE(inputs) << inputs.error().message;
    EXPECT_EQ(*inputs, (std::vector<std::string>{b.string(), a.string(), "other.tif"}));
}

TEST(Inputs, ATileMissingFromAListIsNamed) {
    const SceneFolder folder;
    SyntheticRaster{}.write(folder / "a.tif");
    const auto list = write(folder / "list.txt", "a.tif\nlost.tif\n");
    const auto inputs = expand_inputs({"@" + list});
    ASSERT_FALSE(inputs);
    EXPECT_TRUE(says(inputs.error().message, {"list.txt", "line 2", "lost.tif"}));
    const auto none = expand_inputs({"@" + (folder / "nothing.txt").string()});
    ASSERT_FALSE(none);
    EXPECT_TRUE(says(none.error().message, {"nothing.txt"}));
    EXPECT_FALSE(expand_inputs({"@" + write(folder / "blank.txt", "\n# nothing\n")}));
}

}  // namespace
}  // namespace relevo::ingest
