// Hard case 6 for one file: every prefix of it, and thousands with flipped bits, are read or refused, soon.
#include <chrono>
#include <cstdlib>
#include <random>

#include <gtest/gtest.h>

#include "ingest/source.hpp"
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

// An HGT file has no header: its size alone says what it is. Zipped, every byte counts.
TEST(Damage, PrefixesOfAnHgtAndOfItsArchive) {
    const SceneFolder folder;
    std::string whole(2 * 1201 * 1201, '\1');
    test::replace(folder / "N45E007.hgt", whole);
    Counts counts;
    attempt(folder / "N45E007.hgt", counts);
    EXPECT_EQ(counts.accepted, 1);
    std::mt19937_64 random(6);
    for (int i = 0; i < 100; ++i) {
        test::replace(folder / "N45E007.hgt", whole.substr(0, random() % whole.size()));
        attempt(folder / "N45E007.hgt", counts);
    }
    EXPECT_EQ(counts.accepted, 1);

    const auto archive = folder / "N45E007.hgt.zip";
    VSILFILE* out = VSIFOpenL(("/vsizip/" + archive.string() + "/N45E007.hgt").c_str(), "wb");
    ASSERT_NE(out, nullptr);
    VSIFWriteL(whole.data(), 1, whole.size(), out);
    VSIFCloseL(out);
    const std::string zipped = test::contents(archive);
    attempt(archive, counts);
    EXPECT_EQ(counts.accepted, 2);
    // Its last two bytes are the length of a comment that it has not.
    for (std::size_t size = 0; size < zipped.size() - 2; size += 13) {
        test::replace(archive, zipped.substr(0, size));
        attempt(archive, counts);
    }
    EXPECT_EQ(counts.accepted, 2);
    counts.record();
}

}  // namespace
}  // namespace relevo::ingest
