// Hard case 6 for one file: every prefix of it, and thousands with flipped bits, are read or refused, soon.
#include <chrono>
#include <random>

#include <gtest/gtest.h>

#include "ingest/source/gdal_messages.hpp"
#include "ingest/source/source.hpp"
#include "ingest/source/zip_archive.hpp"
#include "tests/damage_trials.hpp"
#include "tests/ingest/importing.hpp"

namespace relevo::ingest {
namespace {

using test::SceneFolder;
using test::SyntheticRaster;

struct Counts {
    int accepted = 0;
    int refused = 0;
    double slowest_s = 0;

    void record() const {
        testing::Test::RecordProperty("refused", refused);
        testing::Test::RecordProperty("accepted", accepted);
        testing::Test::RecordProperty("slowest_ms", static_cast<int>(1000 * slowest_s));
        EXPECT_LT(slowest_s, 5);
    }
};

/// Opens and reads; says what is wrong with how it went in a test failure.
void attempt(const std::filesystem::path& file, Counts& counts) {
    const auto start = std::chrono::steady_clock::now();
    SourceRequest request;
    request.input = file.string();
    const auto source = Source::open(request);
    std::string message = source ? "" : source.error().message;
    if (source) {
        // A flipped bit in the header may have made it large.
        const auto heights =
            source->read({0, 0, std::min(source->columns(), 2000), std::min(source->rows(), 2000)});
        if (!heights) message = heights.error().message;
    }
    ++(message.empty() ? counts.accepted : counts.refused);
    if (!message.empty()) {
        EXPECT_TRUE(test::says(message, {file.filename().c_str()}));
    }
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    counts.slowest_s = std::max(counts.slowest_s, taken.count());
}

/// A GeoTIFF of some hundred bytes with rows to decode.
std::string small_geotiff(const SceneFolder& folder) {
    SyntheticRaster raster;
    raster.creation_options = {"COMPRESS=LZW", "PREDICTOR=2", "BLOCKYSIZE=3"};
    raster.nodata = -32768;
    return test::contents(raster.write(folder / "whole.tif"));
}

TEST(Damage, EveryPrefixOfAGeoTiff) {
    const SceneFolder folder;
    const std::string whole = small_geotiff(folder);
    Counts counts;
    for (std::size_t size = 0; size < whole.size(); ++size) {
        test::replace(folder / "cut.tif", whole.substr(0, size));
        attempt(folder / "cut.tif", counts);
    }
    counts.record();
    EXPECT_EQ(counts.refused + counts.accepted, static_cast<int>(whole.size()));
    EXPECT_EQ(counts.accepted, 0);  // the file's last byte is one that it needs
}

TEST(Damage, TenThousandGeoTiffsWithFlippedBits) {
    const SceneFolder folder;
    const std::string whole = small_geotiff(folder);
    std::mt19937_64 random(6);
    Counts counts;
    for (int i = 0; i < 10000; ++i) {
        std::string bytes = whole;
        for (std::uint64_t flips = 1 + random() % 4; flips > 0; --flips)
            bytes[random() % bytes.size()] ^= static_cast<char>(1 << random() % 8);
        test::replace(folder / "flipped.tif", bytes);
        attempt(folder / "flipped.tif", counts);
    }
    counts.record();
    EXPECT_EQ(counts.refused + counts.accepted, 10000);
    EXPECT_GT(counts.refused, 1000);
}

/// Zipped ground of an HGT tile.
std::filesystem::path zip_tile(const SceneFolder& folder, const std::string& tile) {
    const auto archive = folder / "N45E007.hgt.zip";
    VSILFILE* out = VSIFOpenL(("/vsizip/" + archive.string() + "/N45E007.hgt").c_str(), "wb");
    EXPECT_NE(out, nullptr);
    VSIFWriteL(tile.data(), 1, tile.size(), out);
    VSIFCloseL(out);
    return archive;
}

// An HGT file has no header: its size alone says what it is.
TEST(Damage, PrefixesOfAnHgt) {
    const SceneFolder folder;
    const auto file = folder / "N45E007.hgt";
    test::replace(file, std::string(2 * 1201 * 1201, '\1'));
    Counts counts;
    attempt(file, counts);
    EXPECT_EQ(counts.accepted, 1);
    // All of them with RELEVO_DAMAGE_TRIALS=2884802.
    const auto whole = std::filesystem::file_size(file);
    const auto step =
        std::max(whole / static_cast<std::uintmax_t>(test::damage_trials(3000)), std::uintmax_t{1});
    for (auto size = whole; size > 0; size -= std::min(step, size)) {
        std::filesystem::resize_file(file, size - 1);
        attempt(file, counts);
    }
    EXPECT_EQ(counts.accepted, 1);
    counts.record();
}

TEST(Damage, PrefixesOfAZippedHgt) {
    const SceneFolder folder;
    const auto archive = zip_tile(folder, std::string(2 * 1201 * 1201, '\1'));
    const std::string zipped = test::contents(archive);
    Counts counts;
    attempt(archive, counts);
    EXPECT_EQ(counts.accepted, 1);
    // Its last two bytes are the length of a comment that it has not.
    for (std::size_t size = 0; size < zipped.size() - 2; size += 13) {
        test::replace(archive, zipped.substr(0, size));
        attempt(archive, counts);
    }
    EXPECT_EQ(counts.accepted, 1);
    counts.record();
}

/// What an archive gives out for an entry; "" where it cannot be opened.
std::string contents_of(const std::string& entry) {
    const GdalMessages quiet;
    VSILFILE* file = VSIFOpenL(("/vsizip/" + entry).c_str(), "rb");
    if (file == nullptr) return {};
    std::string bytes(3'000'000, 0);
    bytes.resize(VSIFReadL(bytes.data(), 1, bytes.size(), file));
    VSIFCloseL(file);
    return bytes;
}

TEST(Damage, ZippedHgtsWithFlippedBits) {
    const SceneFolder folder;
    std::string tile(2 * 1201 * 1201, '\1');
    for (std::size_t i = 0; i < tile.size(); i += 601) tile[i] = static_cast<char>(i % 7);
    const auto archive = zip_tile(folder, tile);
    const std::string zipped = test::contents(archive);
    std::mt19937_64 random(6);
    Counts counts;
    const int trials = test::damage_trials(300);
    ASSERT_TRUE(check_archive(archive));
    int same = 0;
    for (int i = 0; i < trials; ++i) {
        std::string bytes = zipped;
        for (std::uint64_t flips = 1 + random() % 4; flips > 0; --flips)
            bytes[random() % bytes.size()] ^= static_cast<char>(1 << random() % 8);
        test::replace(archive, bytes);
        attempt(archive, counts);
        // GDAL may read it, but its checksum tells, unless what was hit says nothing of the tile.
        const std::string read = contents_of(archive.string() + "/N45E007.hgt");
        const bool same_tile = read == tile;
        EXPECT_TRUE(same_tile || read.empty() || !check_archive(archive)) << i << ": " << read.size();
        same += same_tile ? 1 : 0;
    }
    counts.record();
    RecordProperty("same_tile", same);
    EXPECT_LT(same, trials / 3);
}

}  // namespace
}  // namespace relevo::ingest
