#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "lod/lstr/chunk_making.hpp"
#include "lod/scene/scene.hpp"
#include "lod/soar/pick.hpp"
#include "tests/cases/real_dem.hpp"
#include "tests/lod/scratch_scene.hpp"
#include "tests/shared_data.hpp"
#include "tests/viewer/studio.hpp"

namespace relevo::test {
namespace {

class HolesInRealDems : public testing::TestWithParam<RealDem> {};

/// Background in pixels around which all rays hit the ground as far as the mesh may be off: no skyline and no
/// void's edge can have moved there.
int holes(const lod::Terrain& terrain, const lod::View& view, const viewer::Picture& picture, double tau_px) {
    const auto hits = [&](double x, double y) {
        return lod::pick_exactly(terrain, view.eye(), view.ray({x, y})).has_value();
    };
    const auto hits_around = [&](double x, double y) {
        for (const double way : {0.7, 0.5 * tau_px + 1, tau_px + 1}) {
            for (int k = 0; k < 8; ++k) {
                if (!hits(x + way * std::cos(k * 0.785398), y + way * std::sin(k * 0.785398))) return false;
            }
        }
        return true;
    };
    int found = 0;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            found += is_magenta(picture.at(x, y)) && hits(x + 0.5, y + 0.5) && hits_around(x + 0.5, y + 0.5);
        }
    }
    return found;
}

TEST_P(HolesInRealDems, NoBackgroundShinesThrough) {
    RELEVO_NEEDS_DATA(GetParam().file);
    const SceneFolder folder;
    ingest::ImportOptions options;
    options.fill_width =
        255;  // voids may have moved as far as the mesh is off: they are not what is looked for
    const auto scene = must(import_real(GetParam(), folder, options));
    auto terrain = must(lod::Terrain::open(scene, lod::ErrorMetric::bounded, {.fade_s = 0}));
    must(lod::provide_chunks(scene, terrain));
    Studio studio(std::move(terrain));

    const geo::GridFrame& frame = studio.terrain().frame();
    constexpr unsigned kSeed = 11;
    std::mt19937 random(kSeed);
    const auto any = [&](double low, double high) {
        return std::uniform_real_distribution<>(low, high)(random);
    };
    std::uint64_t ground = 0;
    for (int i = 0; i < 16; ++i) {
        lod::Camera camera =
            above_looking_down(studio.terrain(), std::round(any(0.2, 0.8) * (frame.columns - 1)),
                               std::round(any(0.2, 0.8) * (frame.rows - 1)), 0, 320, 240);
        camera.eye.h.m = scene.info().height_max_m + std::exp(any(std::log(100), std::log(30e3)));
        camera.heading.value = any(0, 360);
        camera.pitch.value = any(-90, -15);
        viewer::ViewState how;
        how.method = i % 2 == 0 ? viewer::Method::lstr : viewer::Method::soar;
        how.tau_px = std::exp(any(std::log(0.5), std::log(30)));
        how.morph = i % 4 < 2;
        const auto picture = studio.draw(camera, {.background = kMagenta}, how);
        EXPECT_EQ(holes(studio.terrain(), lod::View(camera), picture, how.tau_px), 0)
            << to_string(how.method) << ", view " << i << ", seed " << kSeed << ", tau " << how.tau_px;
        for (int y = 0; y < picture.height; ++y) {
            for (int x = 0; x < picture.width; ++x) ground += is_magenta(picture.at(x, y)) ? 0 : 1;
        }
    }
    EXPECT_GT(ground, 16u * 320 * 240 / 3);
}

INSTANTIATE_TEST_SUITE_P(All, HolesInRealDems,
                         testing::Values(RealDem{"Rainier", "mountains/mt_rainier_90m.tif", ""},
                                         RealDem{"Everest", "mountains/mt_everest_90m.tif", ""},
                                         RealDem{"Baltoro", "mountains/baltoro.tif", ""},
                                         RealDem{"BigTujunga", "mountains/bigtujunga.tif", ""},
                                         RealDem{"Columbia", "coast/columbia.tif", ""}),
                         [](const auto& all) { return std::string(all.param.name); });

}  // namespace
}  // namespace relevo::test
