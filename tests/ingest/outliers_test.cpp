#include "ingest/posts/outliers.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "ingest/source/open_dataset.hpp"
#include "tests/ingest/classifying.hpp"
#include "tests/shared_data.hpp"

namespace relevo::ingest {
namespace {

using test::Heights;
using test::Marks;

Outliers found(const Heights& heights, int side = 4096) {
    const Marks marks = test::marks_of(heights);
    Outliers all;
    for (const Window block : test::blocks_of(heights.columns(), heights.rows(), side)) {
        const auto halo = test::halo_block(heights.columns(), heights.rows(), block, kOutlierHalo);
        all.add(find_outliers(test::part(heights, halo.all), test::part(marks, halo.all), halo.inside,
                              block.column, block.row));
    }
    return all;
}

Heights slope(int side, float rise) {
    Heights heights(side, side);
    for (int r = 0; r < side; ++r) {
        for (int c = 0; c < side; ++c)
            heights.at(c, r) = 500.0F + rise * static_cast<float>(c) + 3.0F * static_cast<float>(r % 3);
    }
    return heights;
}

TEST(Outliers, FindsALoneSpikeAndALonePit) {
    for (const float rise : {0.0F, 1.0F, 30.0F}) {
        Heights heights = slope(40, rise);
        heights.at(20, 11) = 8000;
        heights.at(7, 30) = heights.at(7, 30) - 1000;
        const Outliers outliers = found(heights);
        ASSERT_EQ(outliers.count, 2U) << rise;
        EXPECT_EQ(outliers.largest[0].column, 20);
        EXPECT_EQ(outliers.largest[0].row, 11);
        EXPECT_EQ(outliers.largest[0].height, 8000);
        EXPECT_NEAR(outliers.largest[0].median, slope(40, rise).at(20, 11), 10);
        EXPECT_EQ(outliers.largest[1].column, 7);
        EXPECT_EQ(outliers.largest[1].row, 30);
    }
}

TEST(Outliers, SparesSlopesRidgesAndCliffs) {
    EXPECT_EQ(found(slope(40, 200)).count, 0U);
    Heights ridge = slope(40, 0);
    for (int r = 0; r < 40; ++r) {
        ridge.at(20, r) += 90;
        for (int c = 30; c < 40; ++c) ridge.at(c, r) += 900;
    }
    EXPECT_EQ(found(ridge).count, 0U);
}

TEST(Outliers, VoidsHaveNoPart) {
    Heights heights = slope(20, 1);
    heights.at(10, 10) = 9000;
    heights.at(11, 10) = std::nanf("");
    EXPECT_EQ(found(heights).count, 1U);
    Heights lone(20, 20, std::nanf(""));
    lone.at(10, 10) = 9000;
    lone.at(11, 10) = 10;
    EXPECT_EQ(found(lone).count, 0U);  // too little around it to tell
}

TEST(Outliers, ListsTheLargestAndCountsAllOfThem) {
    Heights heights = slope(300, 0);
    std::mt19937 random{3};
    for (int r = 5; r < 300; r += 10) {
        for (int c = 5; c < 300; c += 10) heights.at(c, r) = 1000.0F + static_cast<float>(random() % 5000);
    }
    const Outliers whole = found(heights);
    EXPECT_EQ(whole.count, 900U);
    ASSERT_EQ(whole.largest.size(), Outliers::kMostListed);
    std::vector<float> tops;
    for (int r = 5; r < 300; r += 10) {
        for (int c = 5; c < 300; c += 10) tops.push_back(heights.at(c, r));
    }
    std::sort(tops.rbegin(), tops.rend());
    for (const Outlier& outlier : whole.largest) EXPECT_GE(outlier.height, tops[110]);
    const Outliers blocks = found(heights, 37);
    EXPECT_EQ(blocks.count, whole.count);
    for (std::size_t i = 0; i < whole.largest.size(); ++i) {
        EXPECT_EQ(blocks.largest[i].column, whole.largest[i].column);
        EXPECT_EQ(blocks.largest[i].row, whole.largest[i].row);
        EXPECT_EQ(blocks.largest[i].median, whole.largest[i].median);
    }
}

TEST(Despike, PutsTheMedianThere) {
    Heights heights = slope(40, 2);
    const Heights clean = heights;
    heights.at(20, 11) = 8000;
    heights.at(22, 12) = -5000;  // both are judged by the heights as they were
    Marks marks = test::marks_of(heights);
    const Outliers outliers = despike(heights, marks, {2, 2, 36, 36}, 102, 202);
    EXPECT_EQ(outliers.count, 2U);
    EXPECT_EQ(outliers.largest[0].column, 120);
    EXPECT_EQ(outliers.largest[0].row, 211);
    for (int r = 0; r < 40; ++r) {
        for (int c = 0; c < 40; ++c) {
            const bool spike = (c == 20 && r == 11) || (c == 22 && r == 12);
            EXPECT_EQ(marks.at(c, r).filled(), spike);
            EXPECT_NEAR(heights.at(c, r), clean.at(c, r), spike ? 6.0F : 0.0F);
        }
    }
}

/// Real ground has none where posts are some 100 m apart; at 1 km and more the steps of steep coasts and of
/// the continental slope look like some. New Zealand's first is a real one: 4140 m in a plain of 18 m.
TEST(Outliers, AreRareInRealGround) {
    struct Dem {
        const char* file;
        std::uint64_t most;
    };
    for (const Dem& dem : {Dem{"mountains/mt_everest_90m.tif", 0}, Dem{"mountains/mt_rainier_90m.tif", 0},
                           Dem{"mountains/baltoro.tif", 0}, Dem{"mountains/bigtujunga.tif", 0},
                           Dem{"coast/N43E007.hgt.zip", 0}, Dem{"coast/N48W125.hgt.zip", 0},
                           Dem{"coast/netherlands_30s.nc", 0}, Dem{"coast/france_italy_etopo2.nc", 78},
                           Dem{"coast/columbia.tif", 0}, Dem{"coast/nz_elev.tif", 54},
                           Dem{"mosaic/pyrenees/N42E001.hgt.zip", 0}, Dem{"odd/SainteHelens.dem", 0}}) {
        if (!std::filesystem::exists(test::shared_data(dem.file))) continue;
        const GdalMessages messages;
        OpenRequest request;
        request.input = test::shared_data(dem.file).string();
        const auto opened = open_dataset(request, messages);
        ASSERT_TRUE(opened) << opened.error().message;
        GDALRasterBand* band = opened->dataset->GetRasterBand(1);
        Heights heights(band->GetXSize(), band->GetYSize());
        ASSERT_EQ(band->RasterIO(GF_Read, 0, 0, band->GetXSize(), band->GetYSize(), heights.samples().data(),
                                 band->GetXSize(), band->GetYSize(), GDT_Float32, 0, 0, nullptr),
                  CE_None);
        int has = 0;
        const double none = band->GetNoDataValue(&has);
        for (float& height : heights.samples()) {
            if ((has != 0 && height == static_cast<float>(none)) || height == -32768 || height == 32767)
                height = std::nanf("");
        }
        const Outliers outliers = found(heights, 512);
        EXPECT_LE(outliers.count, dem.most) << dem.file;
    }
}

}  // namespace
}  // namespace relevo::ingest
