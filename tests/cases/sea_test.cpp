// Hard case 5: what is sea, and what is land below it. Each case is a drawing, one character for 4 x 4 posts,
// next to the drawing of its classes; real data follows, where it is at hand.
#include <cmath>
#include <limits>

#include <gdal_priv.h>
#include <gtest/gtest.h>

#include "ingest/source/open_dataset.hpp"
#include "tests/ingest/classifying.hpp"
#include "tests/shared_data.hpp"

namespace relevo::ingest {
namespace {

using lod::SeaInfo;
using test::Classified;
using test::classify;
using test::drawn;
using test::Heights;
using test::picture;
using Drawing = std::vector<std::string>;

constexpr int kScale = 4;
const float kNone = std::numeric_limits<float>::quiet_NaN();

// . sea level   - just below   = a polder   v deep   o low land   O hills   and nothing where there is none
const std::map<char, float> kLegend{{'.', 0}, {'-', -1}, {'=', -4},   {'v', -430},
                                    {'o', 4}, {'O', 60}, {'M', 2000}, {' ', kNone}};

Classified classified(const Drawing& drawing, const std::map<char, float>& legend = kLegend,
                      SeaInfo::Request request = SeaInfo::Request::unasked) {
    return classify(drawn(drawing, legend, kScale), test::asking(request));
}

Drawing classes(const Drawing& drawing, const std::map<char, float>& legend = kLegend) {
    return picture(classified(drawing, legend), kScale);
}

TEST(Sea, PoldersBehindDikesAreLandEvenAtTheBorder) {
    EXPECT_EQ(classes({"....o=======", "....o==o====", "....o=======", "....oooooooo"}),
              (Drawing{"~~~~########", "~~~~########", "~~~~########", "~~~~########"}));
}

TEST(Sea, TheDeadSeaIsLandInsideAndWhereACutTouchesIt) {
    EXPECT_EQ(classes({"..oOOOOOO", "..oOvvvOO", "..oOvvvOO", "..oOOOOOO"}),
              (Drawing{"~~#######", "~~#######", "~~#######", "~~#######"}));
    const auto cut = classified({"vvvO", "vvvO", "OvvO"});
    EXPECT_EQ(cut.sea(), 0U);
    EXPECT_EQ(cut.info.rule, SeaInfo::Rule::nothing);
    EXPECT_EQ(cut.info.lowest_land_m, -430);
    // Its slopes cross the heights from -15 to 0 at the border, and are no sea either.
    Heights slope(60, 40);
    for (int r = 0; r < 40; ++r) {
        for (int c = 0; c < 60; ++c) slope.at(c, r) = -430.0F + 10.0F * static_cast<float>(c);
    }
    EXPECT_EQ(classify(slope).sea(), 0U);
}

TEST(Sea, LagoonsAreSeaWhereTheyAreOpenToIt) {
    EXPECT_EQ(classes({"...ooooooo", "...o..o..o", "......o..o", "...o..o..o", "...ooooooo"}),
              (Drawing{"~~~#######", "~~~#~~####", "~~~~~~####", "~~~#~~####", "~~~#######"}));
}

TEST(Sea, WaterDoesNotPassBetweenCorners) {
    EXPECT_EQ(classes({"..o==o", "..o=oo", "..oooo", "...o==", "..oo=o", "..oooo"})[2], "~~####");
    // A dike of one post that runs aslant.
    Heights heights(30, 30, 0);
    for (int r = 0; r < 30; ++r) {
        for (int c = 0; c < 30; ++c) {
            if (c + r == 30) heights.at(c, r) = 3;
            if (c + r > 30) heights.at(c, r) = c < 29 && r < 29 ? -2.0F : 3.0F;
        }
    }
    const auto scene = classify(heights);
    EXPECT_EQ(scene.marks.at(20, 20).post_class(), lod::PostClass::land);
    EXPECT_EQ(scene.marks.at(5, 5).post_class(), lod::PostClass::sea);
}

TEST(Sea, AnIslandOfOnePostIsLand) {
    Heights heights(40, 40, 0);
    heights.at(17, 23) = 1;
    const auto scene = classify(heights);
    EXPECT_EQ(scene.land(), 1U);
    EXPECT_EQ(scene.marks.at(17, 23).post_class(), lod::PostClass::land);
    EXPECT_EQ(scene.heights.at(17, 23), 1);
    EXPECT_EQ(scene.sea(), 1599U);
}

TEST(Sea, AnEstuaryIsSeaAsFarAsItIsNotAboveIt) {
    EXPECT_EQ(classes({"..oooooooo", "....--ooOO", "..oo-----o", "..oooooooo"}),
              (Drawing{"~~########", "~~~~~~####", "~~##~~~~~#", "~~########"}));
}

TEST(Sea, ALakeInTheMountainsIsLand) {
    EXPECT_EQ(classes({"..oOMMMM", "..oOMMMM", "..oOMMMM"}), (Drawing{"~~######", "~~######", "~~######"}));
}

TEST(Sea, ACliffMeetsTheSea) {
    EXPECT_EQ(classes({"...OMM", "...MMM", "....OM"}), (Drawing{"~~~###", "~~~###", "~~~~##"}));
}

TEST(Sea, NodataBesideALowCoastIsSeaAndItsBedIsModelled) {
    const auto scene = classified({"    oooooO", "    =ooooO", "    o==oOO", "    oooooO"});
    EXPECT_EQ(picture(scene, kScale), (Drawing{"~~~~######", "~~~~######", "~~~~######", "~~~~######"}));
    EXPECT_EQ(scene.info.rule, SeaInfo::Rule::nodata);
    for (int r = 0; r < 16; ++r) {
        for (int c = 0; c < 40; ++c) {
            const bool bed = c < 16;
            EXPECT_EQ(scene.marks.at(c, r).modelled(), bed);
            EXPECT_FALSE(std::isnan(scene.heights.at(c, r)));
            EXPECT_TRUE(!bed || scene.heights.at(c, r) <= 0);
        }
    }
}

TEST(Sea, NodataBesideHighLandIsVoid) {
    EXPECT_EQ(classes({"   OOO", "   OOO", "OOOO O"}), (Drawing{"   ###", "   ###", "#### #"}));
}

TEST(Sea, NodataBeyondACoverageIsVoidWhereItCutsSeaAndLand) {
    EXPECT_EQ(classes({"      ", "      ", "...oOO", "...oOO"}),
              (Drawing{"      ", "      ", "~~~###", "~~~###"}));
}

TEST(Sea, AMissingTileOfSeaIsSea) {
    const auto scene = classified({"   ....", "   ....", "......o", ".....oo"});
    EXPECT_EQ(picture(scene, kScale), (Drawing{"~~~~~~~", "~~~~~~~", "~~~~~~#", "~~~~~##"}));
    EXPECT_TRUE(scene.marks.at(0, 0).modelled());
    EXPECT_FALSE(scene.marks.at(20, 0).modelled());  // at the surface, as the data has it
    EXPECT_EQ(scene.heights.at(20, 0), 0);
}

TEST(Sea, BathymetryHasToBeAskedFor) {
    const Drawing bed{"vvvv..oO", "vvvv-ooO", "vvvvv.oO"};
    EXPECT_EQ(classified(bed).sea(), 0U);
    EXPECT_NE(classified(bed).info.text.find("--sea depths"), std::string::npos);
    const auto asked = classified(bed, kLegend, SeaInfo::Request::depths);
    EXPECT_EQ(picture(asked, kScale), (Drawing{"~~~~~~##", "~~~~~###", "~~~~~~##"}));
    EXPECT_EQ(asked.info.rule, SeaInfo::Rule::depths);
    EXPECT_EQ(asked.heights.at(3, 3), -430);
    EXPECT_FALSE(asked.marks.at(3, 3).modelled());
    // No land is as deep as this: --sea auto knows it, and the Dead Sea from it.
    auto ocean = kLegend;
    ocean['v'] = -2300;
    EXPECT_EQ(classified(bed, ocean, SeaInfo::Request::automatic).sea(), asked.sea());
    EXPECT_EQ(classified(bed, kLegend, SeaInfo::Request::automatic).sea(), 0U);
}

TEST(Sea, NoneIsNone) {
    const auto scene = classified({"..oo", "  oo"}, kLegend, SeaInfo::Request::none);
    EXPECT_EQ(scene.sea(), 0U);
    EXPECT_EQ(scene.voids(), 2U * kScale * kScale);
}

TEST(Sea, SourceAndHeightOfSeaPostsStay) {
    const auto scene = classified({"..oo", ".-oo"});
    EXPECT_EQ(scene.marks.at(0, 0).source(), 3);
    EXPECT_EQ(scene.heights.at(5, 5), -1);
    EXPECT_EQ(scene.marks.at(5, 5).post_class(), lod::PostClass::sea);
}

// --- real data

struct Dem {
    Heights heights;
    geo::GridFrame frame;
};

Dem read(const std::filesystem::path& file, std::optional<float> none = {}) {
    const GdalMessages messages;
    OpenRequest request;
    request.input = file.string();
    const auto opened = open_dataset(request, messages);
    if (!opened) {
        ADD_FAILURE() << opened.error().message;
        return {};
    }
    GDALRasterBand* band = opened->dataset->GetRasterBand(1);
    Dem dem;
    dem.heights = Heights(band->GetXSize(), band->GetYSize());
    EXPECT_EQ(band->RasterIO(GF_Read, 0, 0, band->GetXSize(), band->GetYSize(), dem.heights.samples().data(),
                             band->GetXSize(), band->GetYSize(), GDT_Float32, 0, 0, nullptr),
              CE_None);
    int has = 0;
    const double declared = band->GetNoDataValue(&has);
    if (!none && has != 0) none = static_cast<float>(declared);
    for (float& height : dem.heights.samples()) {
        if (none && height == *none) height = kNone;
    }
    double transform[6];
    opened->dataset->GetGeoTransform(transform);
    dem.frame = test::frame_for(dem.heights, transform[1] < 1 ? transform[1] : 0.001);
    return dem;
}

Classified classified(const Dem& dem, SeaInfo::Request request = SeaInfo::Request::unasked) {
    return classify(dem.heights, test::asking(request), 512, false, dem.frame);
}

std::uint64_t below_zero(const Classified& scene, lod::PostClass post_class) {
    std::uint64_t posts = 0;
    for (std::size_t i = 0; i < scene.marks.samples().size(); ++i) {
        posts += scene.marks.samples()[i].post_class() == post_class &&
                 !scene.marks.samples()[i].modelled() && scene.heights.samples()[i] < 0;
    }
    return posts;
}

TEST(RealSea, TheNetherlandsKeepTheirPolders) {
    RELEVO_NEEDS_DATA("coast/netherlands_30s.nc");
    const auto scene = classified(read(test::shared_data("coast/netherlands_30s.nc")));
    EXPECT_EQ(scene.info.rule, SeaInfo::Rule::nodata) << scene.info.text;
    EXPECT_EQ(below_zero(scene, lod::PostClass::land), 12095U);
    EXPECT_EQ(scene.sea(), 91729U);  // the one void area that reaches the border
    EXPECT_LE(scene.voids(), 40U);   // lakes
    EXPECT_EQ(scene.info.void_areas_sea, 1U);
}

TEST(RealSea, CutsOfTheNetherlandsKeepTheirPolders) {
    RELEVO_NEEDS_DATA("coast/netherlands_30s.nc");
    const Dem whole = read(test::shared_data("coast/netherlands_30s.nc"));
    // Amsterdam with both coasts, Zeeland, the north; 30" from 3 E, 54 N.
    for (const Window cut : {Window{180, 144, 120, 72}, {48, 264, 120, 72}, {240, 96, 144, 48}}) {
        const auto scene = classify(test::part(whole.heights, cut));
        EXPECT_EQ(below_zero(scene, lod::PostClass::sea), 0U) << cut.column << " " << cut.row;
        EXPECT_GT(scene.sea(), 1000U);
        EXPECT_LE(scene.voids(), 40U);
    }
}

TEST(RealSea, TheCoastOfNiceIsSeaAndItsMountainsKeepTheirVoids) {
    RELEVO_NEEDS_DATA("coast/N43E007.hgt.zip");
    const auto scene = classified(read(test::shared_data("coast/N43E007.hgt.zip")));
    EXPECT_EQ(scene.info.rule, SeaInfo::Rule::level_zero);
    EXPECT_NEAR(static_cast<double>(scene.sea()), 0.735 * 1201 * 1201, 0.005 * 1201 * 1201);
    EXPECT_GE(scene.voids(), 1590U);  // of 1595: a few lie in the sea
    EXPECT_GT(below_zero(scene, lod::PostClass::land), 0U);
}

TEST(RealSea, WhatNobodySurveyedBeyondTheOlympicPeninsulaIsVoid) {
    RELEVO_NEEDS_DATA("coast/N48W125.hgt.zip");
    const auto scene = classified(read(test::shared_data("coast/N48W125.hgt.zip")));
    EXPECT_EQ(scene.info.rule, SeaInfo::Rule::level_zero);
    EXPECT_EQ(scene.sea(), 3700450U);
    EXPECT_GE(scene.voids(), 6482170U);
    EXPECT_EQ(scene.marks.at(100, 100).post_class(), lod::PostClass::void_post);
}

TEST(RealSea, TheDeltaOfCaliforniaIsLand) {
    RELEVO_NEEDS_DATA("mosaic/california/w122_n37.dt0");
    // The twelve cells joined by their shared edges; the four missing ones are all sea.
    Heights whole(4 * 120 + 1, 4 * 120 + 1, kNone);
    for (int west = 125; west >= 122; --west) {
        for (int south = 36; south <= 39; ++south) {
            const auto cell = test::shared_data("mosaic/california/w" + std::to_string(west) + "_n" +
                                                std::to_string(south) + ".dt0");
            if (!std::filesystem::exists(cell)) continue;
            test::put(read(cell).heights, {0, 0, 121, 121}, (125 - west) * 120, (39 - south) * 120, whole);
        }
    }
    const auto scene = classify(whole, {}, 512, false, test::frame_for(whole, 1.0 / 120));
    EXPECT_EQ(scene.info.rule, SeaInfo::Rule::level_zero);
    EXPECT_EQ(below_zero(scene, lod::PostClass::sea), 0U);
    EXPECT_GT(below_zero(scene, lod::PostClass::land), 900U);
    EXPECT_EQ(scene.voids(), 0U);
    EXPECT_EQ(scene.sea(), 68705U + 57600U);
    // The bay is sea through the Golden Gate: 37.75 N, 122.3 W.
    EXPECT_EQ(scene.marks.at(324, 270).post_class(), lod::PostClass::sea);
}

TEST(RealSea, NewZealandsNodataIsItsSea) {
    RELEVO_NEEDS_DATA("coast/nz_elev.tif");
    const auto scene = classified(read(test::shared_data("coast/nz_elev.tif")));
    EXPECT_EQ(scene.info.rule, SeaInfo::Rule::nodata);
    EXPECT_GE(scene.sea(), 1348391U);
    EXPECT_LT(scene.voids(), 300U);  // lakes
}

TEST(RealSea, BathymetryIsKept) {
    RELEVO_NEEDS_DATA("coast/france_italy_etopo2.nc");
    const Dem dem = read(test::shared_data("coast/france_italy_etopo2.nc"));
    EXPECT_EQ(classified(dem).sea(), 0U);
    for (const auto request : {SeaInfo::Request::automatic, SeaInfo::Request::depths}) {
        const auto scene = classified(dem, request);
        EXPECT_EQ(scene.info.rule, SeaInfo::Rule::depths);
        EXPECT_GE(scene.sea(), 120186U + 32567U);
        EXPECT_EQ(scene.heights.samples(), dem.heights.samples());
        EXPECT_EQ(below_zero(scene, lod::PostClass::land) > 0, true);  // the Po delta and others inland
    }
}

}  // namespace
}  // namespace relevo::ingest
