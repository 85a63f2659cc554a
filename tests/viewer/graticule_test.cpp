// Graticules: lines where the coordinates are whole numbers of intervals, by GeographicLib.

#include "viewer/overlay/graticule.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lod/soar/pick.hpp"
#include "tests/shared_data.hpp"
#include "tests/viewer/read_dem.hpp"
#include "tests/viewer/studio.hpp"
#include "viewer/marks/map_labels.hpp"

namespace relevo::test {
namespace {

using viewer::Graticule;
using viewer::Overlay;

double to_whole(double value) {
    return std::abs(value - std::round(value));
}

TEST(Graticule, ChoosesRoundIntervals) {
    const geo::LatLon place{geo::Degrees{45}, geo::Degrees{7}};
    double last = 0;
    for (double pixel = 0.01; pixel < 1e5; pixel *= 1.3) {
        const auto utm = viewer::suitable_graticule(true, place, pixel);
        EXPECT_GE(utm.interval.x, 160 * pixel * (1 - 1e-9));
        EXPECT_LE(utm.interval.x, 401 * pixel);
        EXPECT_EQ(utm.zone.number, 32);
        const auto degrees = viewer::suitable_graticule(false, place, pixel);
        EXPECT_GE(degrees.interval.y, last);
        last = degrees.interval.y;
        EXPECT_LT(to_whole(90 / degrees.interval.y), 1e-4);
        EXPECT_TRUE(degrees.interval.y == 30 || degrees.interval.y * 111320 >= 160 * pixel * (1 - 1e-9));
    }
}

TEST(Graticule, WritesWhatItsLinesAre) {
    Graticule g;
    g.interval = {0.2 / 3600, 0.5 / 60};
    EXPECT_EQ(g.text(0, 5 * 3600 * 105.5 + 1), "105\u00b030'00.2\" E");
    EXPECT_EQ(g.text(1, -2 * (60 * 45 + 59) - 1), "45\u00b059'30\" S");
    g.interval = {1, 10 / 60.0};
    EXPECT_EQ(g.text(0, 190), "170\u00b0 W");
    EXPECT_EQ(g.text(0, 180), "180\u00b0 E");
    EXPECT_EQ(g.text(1, 6 * 45 + 3), "45\u00b030' N");
    EXPECT_EQ(g.text(1, 0), "0\u00b000'");
    g.is_utm = true;
    g.interval = {1000, 0.5};
    EXPECT_EQ(g.text(0, 456, {13, true}), "13N 456000 E");
    EXPECT_EQ(g.text(1, 8318001, {13, false}), "13S 4159000.5 N");
    EXPECT_EQ(g.text(0, 2100, {0, true}), "UPS N 2100000 E");
}

// The shader's polynomials, in double and in float, against GeographicLib.
TEST(Graticule, ItsPolynomialsAreOffByLittle) {
    constexpr unsigned kSeed = 11;
    std::mt19937_64 random(kSeed);
    const auto any = [&](double low, double high) {
        return std::uniform_real_distribution<>(low, high)(random);
    };
    const std::array<double, 3> far_m{50e3, 100e3, 250e3};
    std::array<double, 3> worst{};
    for (int trial = 0; trial < 60; ++trial) {
        const double lat = any(-64, 64);
        const geo::GridFrame grid{
            geo::FrameKind::geographic, any(-180, 170), lat + 3, 1.0 / 3600, 1.0 / 3600, 32769, 21601};
        const geo::LatLon eye = grid.lat_lon({16384, 10800});
        Graticule utm{.is_utm = true, .zone = geo::utm_zone(eye), .interval = glm::dvec2(1)};
        const auto terms = viewer::graticule_terms(utm, grid, eye);
        const auto exact0 = utm.lines(grid.lat_lon({terms.anchor.x, terms.anchor.y}));
        const auto made0 = *viewer::lines(terms, {terms.anchor.x, terms.anchor.y});
        for (std::size_t ring = 0; ring < 3; ++ring) {
            const auto spacing = grid.spacing({terms.anchor.x, terms.anchor.y});
            for (int i = 0; i < 40; ++i) {
                const double a = any(0, 6.2831853);
                const double far = far_m[ring] * std::sqrt(any(0, 1));
                const geo::GridPosition place{terms.anchor.x + far * std::cos(a) / spacing.column_m,
                                              terms.anchor.y + far * std::sin(a) / spacing.row_m};
                const auto exact = utm.lines(grid.lat_lon(place)) - exact0;
                const auto made = *viewer::lines(terms, place) - made0;
                worst[ring] = std::max(worst[ring], glm::distance(exact, made));
            }
        }
        EXPECT_LT(to_whole(made0.x - exact0.x), 1e-5);
        Graticule degrees{.interval = glm::dvec2(1.0 / 60)};
        const auto linear = viewer::graticule_terms(degrees, grid, eye);
        for (int i = 0; i < 20; ++i) {
            const geo::GridPosition place{any(0, 32768), any(0, 21600)};
            const auto off = *viewer::lines(linear, place) - degrees.lines(grid.lat_lon(place));
            EXPECT_LT(to_whole(off.x), 1e-6);
            EXPECT_LT(to_whole(off.y), 1e-6);
        }
    }
    fmt::print(
        "[ graticule ] UTM polynomials off by {:.2g} m to 50 km, {:.2g} m to 100 km, {:.2g} m to 250 km\n",
        worst[0], worst[1], worst[2]);
    EXPECT_LT(worst[0], 2e-5);
    EXPECT_LT(worst[1], 2e-3);
    EXPECT_LT(worst[2], 0.25);
}

const viewer::DrawSettings kBright{
    .layer = viewer::Layer::hillshade, .sun = *viewer::parse_sun("0,90"), .background = kMagenta};

/// Each pixel that a graticule changes is on a line: its worst distance to one, in pixels; how many there
/// are; and how many of them are where zones meet.
struct Found {
    double worst_px = 0;
    int pixels = 0;
    int on_border = 0;
};
Found check_lines(Studio& studio, const lod::Camera& camera, bool utm,
                  const viewer::DrawSettings& settings = kBright) {
    viewer::DrawSettings with = settings;
    with.overlays = {{.kind = Overlay::Kind::graticule, .utm = utm}};
    const auto plain = studio.draw(camera, settings);
    const auto drawn = studio.draw(camera, with);
    const Graticule graticule = *studio.renderer().graticule();
    const lod::View view(camera);
    const auto place = [&](double x, double y) -> std::optional<geo::LatLon> {
        const auto hit = lod::pick_exactly(studio.terrain(), view.eye(), view.ray({x, y}));
        if (!hit) return std::nullopt;
        return studio.terrain().frame().lat_lon(hit->place);
    };
    const auto zone = [&](double x, double y) {
        const auto at = place(x, y);
        return at ? graticule.zone_at(*at).number : -1;
    };
    Found found;
    for (int y = 1; y + 1 < camera.height; ++y) {
        for (int x = 1; x + 1 < camera.width; ++x) {
            if (std::abs(plain.at(x, y)[0] - drawn.at(x, y)[0]) < 80) continue;
            const double mx = x + 0.5;
            const double my = y + 0.5;
            if (!place(mx, my)) continue;  // the sea beyond the data
            ++found.pixels;
            const int here = zone(mx, my);
            if (utm && graticule.every_zone &&
                (zone(mx - 2, my) != here || zone(mx + 2, my) != here || zone(mx, my - 2) != here ||
                 zone(mx, my + 2) != here)) {
                ++found.on_border;
                continue;
            }
            const auto lines = [&](double dx, double dy) {
                const auto at = place(mx + dx, my + dy);
                return at ? graticule.lines(*at) : glm::dvec2(0.5);
            };
            const auto at = lines(0, 0);
            const auto dx = lines(1, 0) - at;
            const auto dy = lines(0, 1) - at;
            double px = 1e9;
            for (int axis = 0; axis < 2; ++axis)
                px = std::min(px, to_whole(at[axis]) / std::max(std::hypot(dx[axis], dy[axis]), 1e-12));
            found.worst_px = std::max(found.worst_px, px);
        }
    }
    return found;
}

TEST(Graticule, IsDrawnWhereItBelongs) {
    const auto flat = [](int, int) { return 100.0; };
    const auto frame = geographic_frame(1025, 1025, 46.2, 7.1);
    Studio studio(make_terrain(frame, make_heights(frame, flat)));
    for (const bool utm : {false, true}) {
        for (const double metres : {2.5, 40.0, 3000.0, 60000.0}) {
            // Near the grid's far corner, where a float of a column is coarsest.
            const auto found = check_lines(
                studio, above_looking_down(studio.terrain(), 1000.3, 990.7, metres, 500, 375), utm);
            EXPECT_GT(found.pixels, 100) << utm << " " << metres;
            EXPECT_LT(found.worst_px, 1.0) << utm << " " << metres;
        }
    }
}

TEST(Graticule, IsDrawnAroundThePoles) {
    for (const auto kind : {geo::FrameKind::ups_north, geo::FrameKind::ups_south}) {
        const auto frame = polar_frame(kind, 257, 257, 1000, 3000, -5000);
        Studio studio(make_terrain(frame, make_heights(frame, [](int, int) { return 2000.0; })));
        for (const bool utm : {false, true}) {
            auto camera = above_looking_down(studio.terrain(), 60, 90, 150e3, 500, 375);
            const auto found = check_lines(studio, camera, utm);
            EXPECT_GT(found.pixels, 100) << utm;
            EXPECT_LT(found.worst_px, 1.2) << utm;
            camera = above_looking_down(studio.terrain(), 125, 133, 50e3, 500, 375);  // the pole in view
            EXPECT_LT(check_lines(studio, camera, utm).worst_px, 1.5) << utm;
        }
    }
}

// A border goes through the picture's middle: of ordinary zones, of Norway's, which is at 3 degrees, of
// Svalbard's at 9, and the upper end of zone 31's western half at 56 degrees, where Norway's 32 begins.
TEST(Graticule, HasEachZonesLinesWithinItAlone) {
    struct Trial {
        double lat, lon;
    };
    for (const Trial& trial : {Trial{46, 12}, {60, 3}, {75, 9}, {56, 4.5}, {-30, -66}, {84, 20}}) {
        const auto frame = geographic_frame(513, 513, trial.lat + 0.1, trial.lon - 0.1);
        Studio studio(make_terrain(frame, make_heights(frame, [](int, int) { return 100.0; })));
        const auto at = frame.grid_position({geo::Degrees{trial.lat}, geo::Degrees{trial.lon}});
        int lines = 0;
        for (const double metres : {500.0, 5000.0}) {
            const auto camera =
                above_looking_down(studio.terrain(), at.column + 0.3, at.row + 0.3, metres, 240, 180);
            const auto found = check_lines(studio, camera, true);
            EXPECT_LT(found.worst_px, 1.0) << trial.lat << " " << metres;
            EXPECT_GT(found.on_border, 70) << trial.lat << " " << metres;
            lines += found.pixels - found.on_border;
        }
        EXPECT_GT(lines, 150) << trial.lat;
    }
}

// The Netherlands to the Rhine, across 6 degrees east, obliquely and from high up.
TEST(Graticule, HasEachZonesLinesOnARealModelOfTwo) {
    RELEVO_NEEDS_DATA("coast/netherlands_30s.nc");
    const Dem dem = read_dem(shared_data("coast/netherlands_30s.nc"), 100, 40, 385);
    ASSERT_LT(dem.frame.west, 6);
    ASSERT_GT(dem.frame.west + 384 * dem.frame.step_x, 6);
    Studio studio(make_terrain(dem.frame, dem.heights));
    const auto at = dem.frame.grid_position({geo::Degrees{dem.frame.north - 1.8}, geo::Degrees{6}});
    for (const double pitch : {-90.0, -40.0}) {
        auto camera = above_looking_down(studio.terrain(), at.column, at.row, 40e3, 400, 300);
        camera.pitch.value = pitch;
        const auto found = check_lines(studio, camera, true);
        EXPECT_LT(found.worst_px, pitch == -90 ? 1.0 : 1.5) << pitch;
        EXPECT_GT(found.on_border, 200) << pitch;
        const lod::View view(camera);
        viewer::DrawSettings with = kBright;
        with.overlays = {{.kind = Overlay::Kind::graticule, .utm = true}};
        studio.draw(camera, with);
        const auto labels = viewer::graticule_labels(studio.terrain(), view, *studio.renderer().graticule());
        const auto has = [&](const char* text) {
            return std::any_of(labels.begin(), labels.end(),
                               [&](const viewer::MapLabel& label) { return label.text.find(text) == 0; });
        };
        std::string all;
        for (const auto& label : labels) all += label.text + "; ";
        EXPECT_TRUE(has("31 | 32")) << pitch << " " << all;
        if (pitch == -90) {
            EXPECT_TRUE(has("31N ") && has("32N ")) << all;
        }
    }
}

// Flat water: a ray meets it where it meets the posts of the sea.
TEST(Graticule, LiesOnTheSeaAsOnTheGround) {
    const auto frame = geographic_frame(257, 257, 46.2, 7.1);
    lod::Raster<std::uint8_t> sea(257, 257);
    for (int row = 0; row < 257; ++row) {
        for (int column = 0; column < 200; ++column) sea.at(column, row) = 255;
    }
    const auto heights = make_heights(frame, [](int column, int) { return column < 200 ? 0.0 : 20.0; });
    Studio studio(make_terrain(frame, heights, lod::ErrorMetric::bounded, {}, sea));
    for (const auto kind : {viewer::OceanKind::radial, viewer::OceanKind::projected}) {
        viewer::DrawSettings settings{.layer = viewer::Layer::hypsometric, .background = kMagenta};
        settings.ocean.kind = kind;
        settings.ocean.wind.speed_m_s = 0;
        for (const bool utm : {false, true}) {
            auto camera = above_looking_down(studio.terrain(), 100, 128, 1200, 400, 300);
            const auto down = check_lines(studio, camera, utm, settings);
            EXPECT_LT(down.worst_px, 1.0) << utm;
            EXPECT_GT(down.pixels, 500) << utm << to_string(kind);
            camera.pitch.value = -35;
            const auto oblique = check_lines(studio, camera, utm, settings);
            EXPECT_LT(oblique.worst_px, 1.5) << utm;
            EXPECT_GT(oblique.pixels, 500) << utm;
        }
    }
}

TEST(GraticuleLabels, AreOnTheirLinesAtTheEdges) {
    const auto frame = geographic_frame(513, 513, 46.2, 7.1);
    Studio studio(make_terrain(frame, make_heights(frame, [](int column, int row) {
                                   return 1500 + 700 * std::sin(column / 60.0) * std::cos(row / 45.0);
                               })));
    for (const bool utm : {false, true}) {
        auto camera = above_looking_down(studio.terrain(), 256, 300, 4000, 1280, 720);
        camera.pitch.value = utm ? -50 : -90;
        viewer::DrawSettings with = kBright;
        with.overlays = {{.kind = Overlay::Kind::graticule, .utm = utm}};
        studio.draw(camera, with);
        const lod::View view(camera);
        const Graticule graticule = *studio.renderer().graticule();
        const auto labels = viewer::graticule_labels(studio.terrain(), view, graticule);
        EXPECT_GE(labels.size(), 5U);
        for (const auto& label : labels) {
            const auto at = [&](double dx) {
                const auto hit = lod::pick_exactly(studio.terrain(), view.eye(),
                                                   view.ray(label.pixel + glm::dvec2(dx, dx)));
                return graticule.lines(frame.lat_lon(hit->place));
            };
            const auto here = at(0);
            const auto step = at(1) - here;
            const double off =
                std::min(to_whole(here.x) / std::abs(step.x), to_whole(here.y) / std::abs(step.y));
            EXPECT_LT(off, 3) << label.text;
            const int axis = label.text.find(utm ? 'E' : 'E') != std::string::npos ? 0 : 1;
            const auto hit = lod::pick_exactly(studio.terrain(), view.eye(), view.ray(label.pixel));
            EXPECT_EQ(graticule.text(axis, here[axis], graticule.zone_at(frame.lat_lon(hit->place))),
                      label.text);
        }
    }
}

}  // namespace
}  // namespace relevo::test
