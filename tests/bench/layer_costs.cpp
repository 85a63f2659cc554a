// What each layer and overlay costs: layer_costs SCENE [VIEW]. Draws one view of a scene, the mesh made once,
// at 1280x720 with one sample, each layer in turn and that again, and prints a table and, with --json, one
// object: medians of the milliseconds to the last pixel, and what is added to the layer below it.

#include <algorithm>
#include <chrono>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "lod/scene/scene.hpp"
#include "viewer/camera.hpp"
#include "viewer/gl/gl_check.hpp"
#include "viewer/gl/gl_context_egl.hpp"
#include "viewer/marks/label_keeper.hpp"
#include "viewer/mesher.hpp"
#include "viewer/renderer.hpp"

namespace {

using namespace relevo;
using viewer::Layer;
using viewer::Overlay;

constexpr int kWidth = 1280;
constexpr int kHeight = 720;
constexpr int kRounds = 11;

/// A picture as fine as the posts, half transparent.
class Checks final : public viewer::Drape {
  public:
    int finer() const override { return 0; }
    Result<viewer::DrapeTexels> read(const viewer::Page&) const override {
        viewer::DrapeTexels texels(static_cast<std::size_t>(viewer::kPagePosts) * viewer::kPagePosts);
        for (std::size_t i = 0; i < texels.size(); ++i) {
            const auto light = static_cast<std::uint8_t>((i / 16 + i / viewer::kPagePosts / 16) % 2 * 100);
            texels[i] = {light, light, 60, 128};
        }
        return texels;
    }
};

/// Lines as they lie in texels (ingest/vector_file.hpp): a line every 32 of them.
class Rows final : public viewer::Drape {
  public:
    int finer() const override { return 0; }
    std::optional<std::array<std::uint8_t, 3>> line_colour() const override {
        return std::array<std::uint8_t, 3>{214, 20, 110};
    }
    Result<viewer::DrapeTexels> read(const viewer::Page&) const override {
        viewer::DrapeTexels texels(static_cast<std::size_t>(viewer::kPagePosts) * viewer::kPagePosts);
        for (std::size_t i = 0; i < texels.size(); ++i) {
            const int row = static_cast<int>(i / viewer::kPagePosts) % 32 - 16;
            if (std::abs(row) < 8) texels[i] = {128, static_cast<std::uint8_t>(128 - 16 * row), 0, 0};
        }
        return texels;
    }
};

struct Case {
    std::string name;
    std::string base;  ///< the case that it adds to
    viewer::ViewState view;
    std::vector<double> ms = {};
    double median() const {
        std::vector<double> sorted = ms;
        std::sort(sorted.begin(), sorted.end());
        return sorted[sorted.size() / 2];
    }
};

std::vector<Case> cases_of(const viewer::ViewState& view) {
    std::vector<Case> cases;
    const auto add = [&](std::string name, std::string base, auto&& change) {
        cases.push_back({std::move(name), std::move(base), view});
        change(cases.back().view);
    };
    const auto layer = [](Layer what) { return [what](viewer::ViewState& v) { v.layer = what; }; };
    const auto overlay = [](Overlay what) {
        return [what](viewer::ViewState& v) { v.overlays.push_back(what); };
    };
    add("tints", "", layer(Layer::hypsometric));
    add("plain", "tints", layer(Layer::plain));
    add("hillshade", "tints", layer(Layer::hillshade));
    for (const auto shading :
         {viewer::Shading::multidirectional, viewer::Shading::oblique, viewer::Shading::combined}) {
        add(fmt::format("hillshade, {}", to_string(shading)), "hillshade", [&](viewer::ViewState& v) {
            v.layer = Layer::hillshade;
            v.shading = shading;
        });
    }
    add("slope", "tints", layer(Layer::slope));
    add("aspect", "tints", layer(Layer::aspect));
    add("natural ground", "tints", layer(Layer::terrain));
    add("no haze", "tints", [](viewer::ViewState& v) { v.haze.on = false; });
    add("contours", "tints", overlay({.kind = Overlay::Kind::contours}));
    add("graticule of degrees", "tints", overlay({.kind = Overlay::Kind::graticule}));
    add("graticule of UTM", "tints", overlay({.kind = Overlay::Kind::graticule, .utm = true}));
    add("imagery", "tints", overlay({.kind = Overlay::Kind::imagery, .file = 0}));
    add("vectors", "tints", overlay({.kind = Overlay::Kind::vectors, .file = 1}));
    add("contours and graticule of degrees", "tints", [](viewer::ViewState& v) {
        v.overlays = {{.kind = Overlay::Kind::contours}, {.kind = Overlay::Kind::graticule}};
    });
    return cases;
}

double ms_of(const auto& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

template <class T>
T must(Result<T> result) {
    if (result) return *std::move(result);
    fmt::print(stderr, "{}\n", result.error().message);
    std::exit(1);
}
void must(const Result<void>& result) {
    if (result) return;
    fmt::print(stderr, "{}\n", result.error().message);
    std::exit(1);
}

}  // namespace

int main(int count, char** words) {
    const bool json = count > 1 && std::strcmp(words[count - 1], "--json") == 0;
    if (json) --count;
    if (count != 2 && count != 3) {
        fmt::print(stderr, "layer_costs SCENE [VIEW] [--json]\n");
        return 2;
    }
    const auto scene = must(lod::Scene::open(words[1]));
    const auto terrain = must(lod::Terrain::open(scene, lod::ErrorMetric::bounded, {}));
    const viewer::EyeHeight heights(scene.geoid());
    viewer::ViewState start;
    look_over(start, terrain, scene.info(), heights, kWidth, kHeight);
    if (count == 3) start = must(viewer::parse_view_state(words[2], start));

    const auto context = must(viewer::OffscreenContext::create());
    const viewer::GroundData ground{.pyramid = terrain.pyramid().get(),
                                    .facts = viewer::ground_facts(scene.info()),
                                    .heights = &heights,
                                    .drapes = {std::make_shared<Checks>(), std::make_shared<Rows>()}};
    auto renderer = must(viewer::Renderer::create(terrain, ground));
    const auto target = must(viewer::RenderTarget::create(kWidth, kHeight, 1));
    viewer::Mesher mesher(terrain);
    const lod::View view(camera_of(start, heights, kWidth, kHeight));
    const viewer::DrawnGround drawn = must(mesher.whole_ground(view, start));
    renderer.upload(drawn);

    auto cases = cases_of(start);
    std::vector<double> label_ms;
    for (int round = 0; round <= kRounds; ++round) {  // the first compiles and loads
        for (Case& of : cases) {
            const auto settings = draw_settings(of.view);
            must(renderer.complete(view, settings, {0, 0, kWidth, kHeight}));
            viewer::gl_finish();
            const double ms = ms_of([&] {
                must(renderer.draw(view, settings, target));
                viewer::gl_finish();
            });
            if (round > 0) of.ms.push_back(ms);
            if (of.name == "contours and graticule of degrees")
                label_ms.push_back(ms_of([&] { labels_of(renderer, terrain, of.view, view); }));
        }
    }
    std::sort(label_ms.begin(), label_ms.end());
    const double labels = label_ms[label_ms.size() / 2];

    const auto ms_named = [&](const std::string& name) {
        return std::find_if(cases.begin(), cases.end(), [&](const Case& of) { return of.name == name; })
            ->median();
    };
    nlohmann::json table = nlohmann::json::array();
    if (!json) fmt::print("{} triangles, {}\n", viewer::triangles(drawn), viewer::gl_description());
    for (const Case& of : cases) {
        const double added = of.base.empty() ? 0 : of.median() - ms_named(of.base);
        table.push_back(
            {{"layer", of.name}, {"frame_ms", of.median()}, {"added_ms", added}, {"to", of.base}});
        if (!json) fmt::print("| {} | {:.1f} | {:+.1f} |\n", of.name, of.median(), added);
    }
    if (json) {
        fmt::print("{}\n", nlohmann::json{{"triangles", viewer::triangles(drawn)},
                                          {"width", kWidth},
                                          {"height", kHeight},
                                          {"rounds", kRounds},
                                          {"gl_renderer", viewer::gl_description()},
                                          {"at", to_string(start)},
                                          {"labels_ms", labels},
                                          {"layers", table}}
                               .dump(2));
    } else {
        fmt::print("labels of the last, not in its time: {:.1f} ms\n", labels);
    }
}
