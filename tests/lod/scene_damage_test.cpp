// Nothing that happens to a scene's files is taken for data, and none of it crashes: each is an error that
// names the file.

#include <chrono>
#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "lod/scene/block_file.hpp"
#include "lod/scene/post_block.hpp"
#include "lod/scene/scene_files.hpp"
#include "lod/scene/sha256.hpp"
#include "tests/damage_trials.hpp"
#include "tests/lod/scratch_scene.hpp"

namespace relevo::test {
namespace {

namespace fs = std::filesystem;
using lod::Scene;

/// Reads everything; the first error.
Result<void> read_all(const fs::path& path) {
    const auto scene = Scene::open(path);
    if (!scene) return scene.error();
    const auto heights = scene->read_all_heights();
    if (!heights) return heights.error();
    for (const lod::BlockInfo& block : scene->info().marks) {
        const auto box =
            lod::BlockGrid::of_heights(heights->columns(), heights->rows()).box(block.column, block.row);
        const auto marks = scene->read_marks(block.column, block.row, lod::part_of(*heights, box));
        if (!marks) return marks.error();
    }
    for (int level = 1; level <= static_cast<int>(scene->info().levels.size()); ++level) {
        for (const lod::BlockInfo& block : scene->info().level(level).vertices) {
            if (const auto read = scene->read_level_heights(level, block.column, block.row); !read)
                return read.error();
            for (const auto metric : {lod::ErrorMetric::bounded, lod::ErrorMetric::incremental}) {
                const auto read = scene->read_codes(level, block.column, block.row, metric);
                if (!read) return read.error();
            }
            if (const auto read = scene->read_level_ground(level, block.column, block.row); !read)
                return read.error();
        }
    }
    return {};
}

void expect_error(const Result<void>& result, ErrorKind kind, const std::string& part) {
    ASSERT_FALSE(result) << part;
    EXPECT_EQ(result.error().kind, kind) << result.error().message;
    EXPECT_NE(result.error().message.find(part), std::string::npos) << result.error().message;
}

class SceneDamage : public testing::Test {
  protected:
    void SetUp() override {
        SceneParts parts = made_up_scene(600, 40);
        parts.marks = lod::plain_marks(parts.heights);
        parts.marks.at(0, 0).set_class(lod::PostClass::sea);
        parts.marks.at(599, 0).set_class(lod::PostClass::sea);
        ASSERT_TRUE(write_scene(parts, path_));
    }

    SceneFolder folder_;
    fs::path path_ = folder_ / "a.relevo";
    fs::path json_ = path_ / "scene.json";
};

TEST_F(SceneDamage, NoSuchPath) {
    expect_error(read_all(folder_ / "b.relevo"), ErrorKind::input, "b.relevo");
}

TEST_F(SceneDamage, AFile) {
    replace(folder_ / "file", "x");
    expect_error(read_all(folder_ / "file"), ErrorKind::input, "file");
}

TEST_F(SceneDamage, AFolderThatIsNoScene) {
    expect_error(read_all(folder_.path()), ErrorKind::input, "is not a scene");
}

TEST_F(SceneDamage, EveryBlockMissingIsNamed) {
    std::vector<std::string> files;
    for (const auto& [name, text] : all_files(path_)) files.push_back(name);
    ASSERT_EQ(files.size(),
              2U + 2 + 2 * (2 + 1) + 3);  // 2 blocks each of heights and marks, of heights and of vertices 2
                                          // at level 1 and one at level 2; the geoid, the JSON, the VRT
    for (const std::string& file : files) {
        if (file == "heights.vrt" || file == "scene.json") continue;
        const std::string text = contents(path_ / file);
        fs::remove(path_ / file);
        expect_error(read_all(path_), ErrorKind::damaged, file);
        replace(path_ / file, text);
    }
    EXPECT_TRUE(read_all(path_));
}

TEST_F(SceneDamage, AnyBitFlippedAnywhereIsFound) {
    std::mt19937 random(20240501);
    for (const auto& [file, text] : all_files(path_)) {
        if (file == "heights.vrt") continue;  // for other programs, which may change it
        for (int i = 0; i < 40; ++i) {
            std::string flipped = text;
            const auto byte = std::uniform_int_distribution<std::size_t>(0, text.size() - 1)(random);
            flipped[byte] = static_cast<char>(flipped[byte] ^ (1 << (i % 8)));
            replace(path_ / file, flipped);
            const auto scene = Scene::open(path_);
            const bool found = !scene || !scene->verify().empty();
            // White space in the JSON carries nothing; everything else does.
            const bool same = file == "scene.json" &&
                              nlohmann::json::parse(flipped, nullptr, false) == nlohmann::json::parse(text);
            EXPECT_TRUE(found || same) << file << " byte " << byte << " bit " << i % 8;
        }
        replace(path_ / file, text);
    }
}

TEST_F(SceneDamage, EveryFileCutShortIsFound) {
    for (const auto& [file, text] : all_files(path_)) {
        for (const double part : {0.0, 0.3, 0.9, 0.99}) {
            replace(path_ / file,
                    text.substr(0, static_cast<std::size_t>(part * static_cast<double>(text.size()))));
            const auto scene = Scene::open(path_);
            if (scene) {
                const auto messages = scene->verify();
                ASSERT_EQ(messages.size(), 1U) << file;
                EXPECT_NE(messages[0].find(file), std::string::npos) << messages[0];
            } else {
                EXPECT_EQ(scene.error().kind, ErrorKind::damaged);
                EXPECT_NE(scene.error().message.find(file), std::string::npos) << scene.error().message;
            }
        }
        replace(path_ / file, text);
    }
}

TEST_F(SceneDamage, VerifyNamesEveryDamagedBlock) {
    replace(path_ / "heights/r0000-c0001.tif", "x");
    fs::remove(path_ / "vertices-1/r0000-c0000.tif");
    const auto scene = Scene::open(path_);
    ASSERT_TRUE(scene);
    const auto messages = scene->verify();
    ASSERT_EQ(messages.size(), 2U);
    EXPECT_NE(messages[0].find("heights/r0000-c0001.tif"), std::string::npos);
    EXPECT_NE(messages[1].find("vertices-1/r0000-c0000.tif"), std::string::npos);
}

TEST_F(SceneDamage, ANewerFormatIsNotCalledDamage) {
    auto json = nlohmann::json::parse(contents(json_));
    json["format_version"] = 99;
    json.erase("frame");
    replace(json_, json.dump());
    expect_error(read_all(path_), ErrorKind::input, "newer Relevo");
}

TEST_F(SceneDamage, AnOlderFormatAsksForAnotherImport) {
    auto json = nlohmann::json::parse(contents(json_));
    for (const int version : {1, 2}) {
        json["format_version"] = version;
        replace(json_, json.dump());
        expect_error(read_all(path_), ErrorKind::input, "import its sources again");
    }
}

TEST_F(SceneDamage, ChangedByHandIsFound) {
    auto json = nlohmann::json::parse(contents(json_));
    json["frame"]["west"] = -104.0;
    replace(json_, json.dump());
    expect_error(read_all(path_), ErrorKind::damaged, "checksum");
}

TEST_F(SceneDamage, AFolderInPlaceOfABlock) {
    fs::remove(path_ / "geoid.tif");
    fs::create_directory(path_ / "geoid.tif");
    expect_error(read_all(path_), ErrorKind::damaged, "geoid.tif");
}

// Sparse files: they take no disk, but reading them would take all memory.
TEST_F(SceneDamage, HugeFilesAreNotReadIntoMemory) {
    for (const auto* file : {"heights/r0000-c0000.tif", "geoid.tif", "scene.json"}) {
        const auto size = fs::file_size(path_ / file);
        fs::resize_file(path_ / file, std::uintmax_t{1} << 42);
        expect_error(read_all(path_), ErrorKind::damaged, file);
        fs::resize_file(path_ / file, size);
    }
    EXPECT_TRUE(read_all(path_));
}

/// What became of many damaged scenes. Each is opened, verified and read as a whole.
struct Fates {
    int refused = 0;
    int accepted = 0;  ///< what was damaged carries nothing
    double slowest_s = 0;

    /// \return was it refused?
    bool judge(const fs::path& path) {
        const auto start = std::chrono::steady_clock::now();
        const auto scene = Scene::open(path);
        const bool verified = scene && scene->verify().empty();
        const auto read = scene ? read_all(path) : Result<void>(scene.error());
        // heights.vrt is verified, and never read.
        EXPECT_TRUE(read || !verified) << read.error().message;
        if (!read) {
            EXPECT_EQ(read.error().message.find(path.string()), 0U) << read.error().message;
        }
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
        slowest_s = std::max(slowest_s, taken.count());
        ++(verified ? accepted : refused);
        return !verified;
    }

    void print(const char* what) const {
        fmt::print("{}: {} refused, {} accepted, the slowest took {:.3f} s\n", what, refused, accepted,
                   slowest_s);
        EXPECT_LT(slowest_s, 5);
    }
};

/// Does a file say the same with other bytes? White space carries nothing.
bool says_the_same(const std::string& file, const std::string& text, const std::string& damaged) {
    if (damaged == text) return true;  // a bit was flipped back
    if (file == "scene.json")
        return nlohmann::json::parse(damaged, nullptr, false) == nlohmann::json::parse(text);
    return file == "heights.vrt" && damaged + "\n" == text;
}

std::string sha256_of(const std::string& text) {
    return lod::sha256_hex(std::as_bytes(std::span(text)));
}

class SmallSceneDamage : public testing::Test {
  protected:
    void SetUp() override {
        SceneParts parts = made_up_scene(260, 3);
        parts.marks = lod::plain_marks(parts.heights);
        parts.marks.at(0, 0).set_class(lod::PostClass::sea);
        ASSERT_TRUE(write_scene(parts, path_));
        files_ = all_files(path_);
        ASSERT_EQ(files_.size(), 7U);  // a block of each layer, the geoid, the JSON, the VRT
        ASSERT_TRUE(read_all(path_));
    }

    SceneFolder folder_;
    fs::path path_ = folder_ / "a.relevo";
    std::map<std::string, std::string> files_;
};

TEST_F(SmallSceneDamage, EveryPrefixOfEveryFile) {
    Fates fates;
    for (const auto& [file, text] : files_) {
        for (std::size_t size = 0; size < text.size(); ++size) {
            const std::string cut = text.substr(0, size);
            replace(path_ / file, cut);
            EXPECT_EQ(fates.judge(path_), !says_the_same(file, text, cut))
                << file << " of " << size << " bytes";
        }
        replace(path_ / file, text);
    }
    fates.print("prefixes");
}

TEST_F(SmallSceneDamage, FlippedBits) {
    constexpr unsigned kSeed = 7;
    std::mt19937_64 random(kSeed);
    Fates fates;
    files_.erase("heights.vrt");  // for other programs, which may change it
    const int count = damage_trials(2000);
    for (int i = 0; i < count; ++i) {
        const auto& [file, text] = *std::next(files_.begin(), i % static_cast<int>(files_.size()));
        std::string flipped = text;
        for (auto flips = 1 + random() % 4; flips > 0; --flips)
            flipped[random() % text.size()] ^= static_cast<char>(1U << random() % 8);
        replace(path_ / file, flipped);
        EXPECT_EQ(fates.judge(path_), !says_the_same(file, text, flipped))
            << file << ", trial " << i << " of seed " << kSeed;
        replace(path_ / file, text);
    }
    EXPECT_EQ(fates.refused + fates.accepted, count);
    fates.print("flipped bits");
}

// Somebody who means harm gives the checksum, too: then the decoders alone stand in the way. What they let
// through are other heights, no more.
TEST_F(SmallSceneDamage, FlippedBitsUnderTheirOwnChecksum) {
    constexpr unsigned kSeed = 8;
    std::mt19937_64 random(kSeed);
    Fates fates;
    const auto info = lod::scene_info_from_text(files_["scene.json"]);
    ASSERT_TRUE(info);
    files_.erase("heights.vrt");
    files_.erase("scene.json");
    const int count = damage_trials(600);
    for (int i = 0; i < count; ++i) {
        const auto& [file, text] = *std::next(files_.begin(), i % static_cast<int>(files_.size()));
        std::string flipped = text;
        for (auto flips = 1 + random() % 4; flips > 0; --flips)
            flipped[random() % text.size()] ^= static_cast<char>(1U << random() % 8);
        if (i % 3 == 0) flipped.resize(random() % text.size());
        replace(path_ / file, flipped);
        lod::SceneInfo forged = *info;
        lod::LevelInfo& level = forged.levels.at(0);
        for (auto* layer : {&forged.heights, &forged.marks, &level.heights, &level.vertices}) {
            if (layer->at(0).file == file) layer->at(0).sha256 = sha256_of(flipped);
        }
        if (forged.geoid.file.file == file) forged.geoid.file.sha256 = sha256_of(flipped);
        replace(path_ / "scene.json", lod::scene_text(forged));
        const auto start = std::chrono::steady_clock::now();
        ++(read_all(path_) ? fates.accepted : fates.refused);
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
        fates.slowest_s = std::max(fates.slowest_s, taken.count());
        replace(path_ / file, text);
    }
    fates.print("flipped bits under their own checksum");
}

// No source gives such a height, and the mesh knows none.
TEST(SceneDamageOfHeights, InfinityIsRefused) {
    const float infinity = std::numeric_limits<float>::infinity();
    for (const float height : {infinity, -infinity}) {
        const std::vector<float> heights{1, 2, 3, height};
        const auto bytes = lod::encode_block<float>(heights, {2, 2}, std::nullopt);
        ASSERT_TRUE(bytes);
        const auto read = lod::decode_heights(*bytes, lod::HeightType::float32, {0, 0, 2, 2}, "block.tif");
        ASSERT_FALSE(read);
        EXPECT_EQ(read.error().kind, ErrorKind::damaged);
        EXPECT_NE(read.error().message.find("block.tif"), std::string::npos);
    }
}

// A pipe was once waited for, for ever.
TEST_F(SmallSceneDamage, APipeInPlaceOfAFile) {
    for (const auto& [file, text] : files_) {
        fs::remove(path_ / file);
        ASSERT_EQ(::mkfifo((path_ / file).c_str(), 0666), 0);
        const auto scene = Scene::open(path_);
        EXPECT_FALSE(scene && scene->verify().empty()) << file;
        fs::remove(path_ / file);
        replace(path_ / file, text);
    }
}

// Lists within lists once ended the program: comparing the checksum goes down into them.
TEST(SceneInfoJson, DeepNestingIsRefused) {
    for (const int depth : {100, 1'000'000}) {
        const std::string lists(static_cast<std::size_t>(depth), '[');
        const std::string ends(static_cast<std::size_t>(depth), ']');
        const auto info = lod::scene_info_from_text("{\"sha256\": \"0\", \"notes\": " + lists + ends + "}");
        ASSERT_FALSE(info);
        EXPECT_EQ(info.error().kind, ErrorKind::damaged);
    }
}

/// Values that pass for JSON but make no sense. The checksum is not asked here: it would hide them.
TEST(SceneInfoJson, NonsenseIsRefused) {
    const SceneFolder folder;
    ASSERT_TRUE(write_scene(made_up_scene(600, 40), folder / "a.relevo"));
    const auto good = nlohmann::json::parse(contents(folder / "a.relevo/scene.json"));
    ASSERT_TRUE(lod::scene_info_from_json(good));

    const auto huge = nlohmann::json::parse("1e400", nullptr, false);  // discarded by the parser
    EXPECT_TRUE(huge.is_discarded());
    const std::pair<const char*, const char*> edits[] = {
        {"/format_version", "0"},
        {"/format_version", "\"1\""},
        {"/format_version", "-1"},
        {"/frame", "[]"},
        {"/frame/kind", "\"toroidal\""},
        {"/frame/west", "1e300"},
        {"/frame/west", "null"},
        {"/frame/north", "91"},
        {"/frame/step_x", "0"},
        {"/frame/step_x", "-1"},
        {"/frame/step_y", "100"},
        {"/frame/columns", "0"},
        {"/frame/columns", "-5"},
        {"/frame/columns", "4294967297"},
        {"/frame/columns", "18446744073709551615"},
        {"/frame/columns", "600.5"},
        {"/frame/rows", "99999999"},
        {"/frame/rows", "39"},
        {"/vertical_datum", "\"navd88\""},
        {"/vertical_assumed", "1"},
        {"/height_type", "\"int8\""},
        {"/height_min_m", "1e9"},
        {"/height_max_m", "-5"},
        {"/valid_posts", "5"},
        {"/void_posts", "1e3"},
        {"/resampling", "null"},
        {"/resampling/rms_m", "-1"},
        {"/sources", "{}"},
        {"/sources/0", "7"},
        {"/sources/0/columns", "\"many\""},
        {"/block_side", "256"},
        {"/heights", "[]"},
        {"/heights/0/column", "1"},
        {"/heights/1/column", "2"},
        {"/heights/0/file", "\"../../etc/passwd\""},
        {"/heights/0/file", "\"/etc/passwd\""},
        {"/heights/0/bytes", "-1"},
        {"/levels", "[]"},
        {"/levels/0/vertices/0/row", "1"},
        {"/levels/0/heights", "[]"},
        {"/levels/0/heights/0/file", "\"heights/r0000-c0000.tif\""},
        {"/levels/2", "{\"heights\": [], \"vertices\": []}"},
        {"/geoid", "[]"},
        {"/geoid/rows", "1000000"},
        {"/geoid/south", "-91"},
        {"/geoid/file", "\"heights.vrt\""}};
    for (const auto& [where, value] : edits) {
        auto json = good;
        json[nlohmann::json::json_pointer(where)] = nlohmann::json::parse(value);
        const auto info = lod::scene_info_from_json(json);
        ASSERT_FALSE(info) << where << " = " << value;
        EXPECT_EQ(info.error().kind, ErrorKind::damaged);
    }
    const nlohmann::json values = good.flatten();
    for (const auto& item : values.items()) {
        if (item.key() == "/sha256") continue;  // of the file, which scene_info_from_text asks for
        auto json = good;
        const nlohmann::json::json_pointer pointer(item.key());
        auto& parent = json[pointer.parent_pointer()];
        if (!parent.is_object()) continue;
        parent.erase(pointer.back());
        EXPECT_FALSE(lod::scene_info_from_json(json)) << item.key() << " missing";
    }
}

TEST(SceneInfoJson, GoesThroughTextUnchanged) {
    SceneParts parts = made_up_scene(3, 3);
    parts.info.frame.west = 0.1 + 0.2;
    parts.info.frame.step_x = 1.0 / 3600;
    parts.info.resampling.rms_m = 1e-300;
    parts.info.sources[0].name = "caf\xe9.tif";  // Latin 1: not UTF-8
    parts.info.sources[0].operation_accuracy_m = 0.1;
    for (int row = 0; row < 1; ++row) {
        lod::BlockInfo block;
        block.file = lod::block_file_name("heights", 0, row);
        parts.info.heights.push_back(block);
    }
    const std::string text = lod::scene_text(parts.info);
    const auto info = lod::scene_info_from_text(text);
    ASSERT_TRUE(info) << info.error().message;
    EXPECT_EQ(info->frame.west, 0.1 + 0.2);
    EXPECT_EQ(info->resampling.rms_m, 1e-300);
    EXPECT_EQ(info->sources[0].operation_accuracy_m, 0.1);
    EXPECT_EQ(lod::scene_text(*info), text);
}

}  // namespace
}  // namespace relevo::test
