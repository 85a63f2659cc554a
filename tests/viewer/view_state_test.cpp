#include "viewer/view_state.hpp"

#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace relevo::viewer {
namespace {

void expect_same(const ViewState& a, const ViewState& b) {
    EXPECT_EQ(a.place.lat, b.place.lat);
    EXPECT_EQ(a.place.lon, b.place.lon);
    EXPECT_EQ(a.H, b.H);
    EXPECT_EQ(a.heading, b.heading);
    EXPECT_EQ(a.pitch, b.pitch);
    EXPECT_EQ(a.roll, b.roll);
    EXPECT_EQ(a.fov, b.fov);
    EXPECT_EQ(a.tau_px, b.tau_px);
    EXPECT_EQ(a.method, b.method);
    EXPECT_EQ(a.metric, b.metric);
    EXPECT_EQ(a.morph, b.morph);
    EXPECT_EQ(a.exaggeration, b.exaggeration);
    EXPECT_EQ(a.layer, b.layer);
    EXPECT_EQ(a.wireframe, b.wireframe);
    EXPECT_EQ(a.sun.text, b.sun.text);
    EXPECT_EQ(a.shading, b.shading);
    EXPECT_EQ(a.haze, b.haze);
    EXPECT_EQ(a.overlays, b.overlays);
}

TEST(ViewString, RoundTripsToTheLastBit) {
    constexpr unsigned kSeed = 2;
    std::mt19937_64 random(kSeed);
    const auto any = [&](double low, double high) {
        return std::uniform_real_distribution<>(low, high)(random);
    };
    for (int i = 0; i < 1000; ++i) {
        ViewState view;
        view.place = {geo::Degrees{any(-90, 90)}, geo::Degrees{any(-180, 180)}};
        view.H.m = any(-400, 1e7);
        view.heading.value = any(0, 360);
        view.pitch.value = any(-90, 90);
        view.roll.value = any(-180, 180);
        view.fov.value = any(1e-3, 179);
        view.tau_px = any(1e-3, 100);
        view.method = i % 2 == 0 ? Method::soar : Method::full;
        view.metric = i % 3 == 0 ? lod::ErrorMetric::bounded : lod::ErrorMetric::incremental;
        view.morph = i % 5 == 0;
        view.exaggeration = any(0, 20);
        view.layer = static_cast<Layer>(i % 7);
        view.shading = static_cast<Shading>(i % 4);
        view.haze = {.on = i % 2 != 0, .visibility_km = i % 4 == 1 ? Haze::kClearKm : any(0.05, 1e5)};
        if (!view.haze.on) view.haze = {.on = false};
        for (int k = 0; k < i % 4; ++k) {
            view.overlays.push_back({.kind = static_cast<Overlay::Kind>((i + k) % 4), .opacity = any(0, 1)});
            Overlay& overlay = view.overlays.back();
            if (overlay.kind == Overlay::Kind::contours && i % 3 != 0) overlay.interval_m = any(0.01, 1e4);
            if (overlay.kind == Overlay::Kind::graticule) overlay.utm = i % 2 == 0;
            if (overlay.kind == Overlay::Kind::imagery || overlay.kind == Overlay::Kind::vectors)
                overlay.file = i % 3;
        }
        view.wireframe = i % 7 == 0;
        view.sun = *parse_sun(i % 3 == 0   ? "auto"
                              : i % 3 == 1 ? fmt::format("{},{}", any(0, 360), any(-90, 90))
                                           : "2026-06-21T12:00:00Z");
        const std::string text = to_string(view);
        const auto back = parse_view_state(text);
        ASSERT_TRUE(back) << back.error().message << ", seed " << kSeed;
        expect_same(view, *back);
        EXPECT_EQ(to_string(*back), text);
        EXPECT_EQ(text.find_first_of(" ;&|<>()$`\"'\\*?#~!"), std::string::npos) << text;
    }
}

TEST(ViewString, NeedsOnlyThePlace) {
    ViewState base;
    base.tau_px = 3;
    base.heading.value = 77;
    const auto view = parse_view_state("37.5,-105.25,4500", base);
    ASSERT_TRUE(view);
    EXPECT_EQ(view->place.lat.value, 37.5);
    EXPECT_EQ(view->place.lon.value, -105.25);
    EXPECT_EQ(view->H.m, 4500);
    EXPECT_EQ(view->tau_px, 3);
    EXPECT_EQ(view->heading.value, 77);
}

TEST(ViewString, RefusesWhatMakesNoSense) {
    for (const char* text : {"",
                             "37.5",
                             "37.5,-105",
                             "37.5,-105,4500,1",
                             "37.5,-105,4500m",
                             "nan,0,0",
                             "37.5,-105,inf",
                             "91,0,0",
                             "0,0,0/",
                             "0,0,0/heading",
                             "0,0,0/heading=",
                             "0,0,0/heading=x",
                             "0,0,0/heading=1/heading=2",
                             "0,0,0/colour=red",
                             "0,0,0/fov=0",
                             "0,0,0/fov=180",
                             "0,0,0/tau=0",
                             "0,0,0/tau=-1",
                             "0,0,0/pitch=91",
                             "0,0,0/exaggeration=-1",
                             "0,0,0/layer=imagery",
                             "0,0,0/layer=mud",
                             "0,0,0/lod=cdlod",
                             "0,0,0/sun=noon",
                             "0,0,0/shading=disco",
                             "0,0,0/haze=thick",
                             "0,0,0/haze=0",
                             "0,0,0/haze=-3",
                             "0,0,0/sun=10",
                             "0,0,0/morph=yes",
                             " 0,0,0",
                             "0,0,0 "}) {
        const auto view = parse_view_state(text);
        ASSERT_FALSE(view) << text;
        EXPECT_EQ(view.error().kind, ErrorKind::usage) << text;
    }
}

TEST(SunSetting, ReadsItsThreeForms) {
    const geo::LatLon greenwich{geo::Degrees{51.48}, geo::Degrees{0}};
    EXPECT_EQ(sun_at(*parse_sun("auto"), greenwich).azimuth.value, 315);
    EXPECT_EQ(sun_at(*parse_sun("-90,10.5"), greenwich).elevation.value, 10.5);
    // Midsummer noon at Greenwich: 90 - 51.48 + 23.44 degrees high, in the south.
    const auto noon = sun_at(*parse_sun("2026-06-21T12:02:00Z"), greenwich);
    EXPECT_NEAR(noon.elevation.value, 61.96, 0.05);
    EXPECT_NEAR(noon.azimuth.value, 180, 0.5);
}

}  // namespace
}  // namespace relevo::viewer
