// What is drawn of the sea: error in pixels against the waves' own function and the exact ellipsoid and
// geoid, holes, swimming, and what it costs; for three meshes, heights of the eye and directions. Then the
// same at equal numbers of vertices, and against a plane of equal spacing.
//
//   ocean_survey SCENE LAT,LON [--frames N] [--heading DEGREES] [--wind SPEED] [--time S] [--only TABLE]...
//   ocean_survey SCENE LAT,LON --watertight N [LAT,LON,H]...
//
// The place should have deep water around it: where the data has no bed, no error is measured. TABLE is
// meshes, equal or plane. A flight goes through the places that are given, or around the one place; its exit
// status says whether there was a hole.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "lod/ocean/geoclipmap.hpp"
#include "lod/ocean/projected_mesh.hpp"
#include "lod/ocean/radial_grid.hpp"
#include "lod/scene/scene.hpp"
#include "viewer/camera.hpp"
#include "viewer/gl_check.hpp"
#include "viewer/gl_context_egl.hpp"
#include "viewer/mesher.hpp"
#include "viewer/numbers.hpp"
#include "viewer/ocean/ocean_probe.hpp"
#include "viewer/renderer.hpp"

namespace {

using namespace relevo;
using viewer::OceanKind;

constexpr std::array kKinds{OceanKind::geoclipmap, OceanKind::radial, OceanKind::projected};
constexpr std::array kHeights{2.0, 50.0, 2000.0, 50000.0};
constexpr std::array kDirections{"down", "45 degrees", "horizon"};
constexpr double kRadius = 6371e3;

struct Options {
    geo::LatLon place;
    int frames = 5;
    double heading = 60;
    double wind_m_s = 10;
    double time_s = 100;
    int watertight = 0;
    std::set<std::string> only;
    std::vector<std::array<double, 3>> keys;  // latitude, longitude, height
};

viewer::OceanSettings ocean_of(const Options& options) {
    viewer::OceanSettings ocean;
    ocean.wind.speed_m_s = options.wind_m_s;
    ocean.time_s = options.time_s;
    return ocean;
}

/// Everything that draws a scene, for one size of picture.
class Stage {
  public:
    static Result<std::unique_ptr<Stage>> create(const lod::Scene& scene, const lod::Terrain& terrain,
                                                 int width, int height, const Options& options) {
        auto context = viewer::OffscreenContext::create();
        if (!context) return context.error();
        std::unique_ptr<Stage> made(new Stage(scene, terrain, *std::move(context), options));
        made->width_ = width;
        made->height_ = height;
        auto renderer = viewer::Renderer::create(
            terrain, {.pyramid = terrain.pyramid().get(), .facts = made->facts_, .heights = &made->heights_});
        if (!renderer) return renderer.error();
        made->renderer_.emplace(*std::move(renderer));
        auto probe = viewer::OceanProbe::create(width, height);
        if (!probe) return probe.error();
        made->probe_.emplace(*std::move(probe));
        auto target = viewer::RenderTarget::create(width, height, 1);
        if (!target) return target.error();
        made->target_.emplace(*std::move(target));
        return made;
    }

    viewer::Ocean& ocean() { return renderer_->ocean(); }
    const viewer::EyeHeight& heights() const { return heights_; }

    /// What the sea ought to be; of the waves that were drawn last.
    const viewer::TrueSea& sea() {
        sea_.waves = &ocean().waves();
        return sea_;
    }

    lod::Camera camera(const viewer::ViewState& state) const {
        return viewer::camera_of(state, heights_, width_, height_);
    }

    Result<viewer::ProbePicture> probe(const lod::Camera& camera, OceanKind kind) {
        const lod::View view(camera);
        if (auto done = prepare(view, kind); !done) return done.error();
        return probe_->draw(*renderer_, view, settings(kind));
    }

    struct Times {
        viewer::OceanFigures figures;
        double arrange_ms = 0;  // medians
        double draw_ms = 0;
    };
    Result<Times> time(const lod::Camera& camera, OceanKind kind, int frames) {
        const lod::View view(camera);
        if (auto done = prepare(view, kind); !done) return done.error();
        Times times;
        std::vector<double> arrange, draw;
        for (int frame = -1; frame < frames; ++frame) {  // the first compiles
            const auto drawn = renderer_->draw(view, settings(kind), *target_, {}, true);
            if (!drawn) return drawn.error();
            times.figures = drawn->ocean;
            if (frame < 0) continue;
            arrange.push_back(drawn->ocean.arrange_ms);
            draw.push_back(drawn->ocean.draw_ms);
        }
        const auto median = [](std::vector<double>& values) {
            std::sort(values.begin(), values.end());
            return values[values.size() / 2];
        };
        times.arrange_ms = median(arrange);
        times.draw_ms = median(draw);
        return times;
    }

    std::vector<glm::ivec2> holes(const viewer::ProbePicture& picture) {
        sea();
        return holes_.holes(picture);
    }

  private:
    Stage(const lod::Scene& scene, const lod::Terrain& terrain, viewer::OffscreenContext context,
          const Options& options)
        : terrain_(terrain),
          options_(options),
          heights_(scene.geoid()),
          facts_(viewer::ground_facts(scene.info())),
          context_(std::move(context)),
          mesher_(terrain),
          holes_(terrain, sea_) {
        sea_.heights = &heights_;
        sea_.depth_m = [this](geo::LatLon place) { return depth_m(place); };
    }

    viewer::DrawSettings settings(OceanKind kind) const {
        viewer::DrawSettings how;
        how.ocean = ocean_of(options_);
        how.ocean.kind = kind;
        return how;
    }

    Result<void> prepare(const lod::View& view, OceanKind kind) {
        const auto mesh = mesher_.whole_mesh(view, {});
        if (!mesh) return mesh.error();
        renderer_->upload(**mesh);
        return renderer_->complete(view, settings(kind), {0, 0, width_, height_});
    }

    double depth_m(geo::LatLon place) const {
        if (facts_.sea_is_level) return NAN;
        const geo::GridFrame& grid = terrain_.frame();
        geo::GridPosition at = grid.grid_position(place);
        at.column = std::clamp(at.column, 0.0, grid.columns - 1.0);
        at.row = std::clamp(at.row, 0.0, grid.rows - 1.0);
        const int west = std::min(static_cast<int>(at.column), grid.columns - 2);
        const int north = std::min(static_cast<int>(at.row), grid.rows - 2);
        const double x = at.column - west;
        const double y = at.row - north;
        const auto H = [&](int column, int row) {
            return static_cast<double>(posts_.H(west + column, north + row));
        };
        const double bed =
            (1 - y) * ((1 - x) * H(0, 0) + x * H(1, 0)) + y * ((1 - x) * H(0, 1) + x * H(1, 1));
        // In shallow water what is drawn depends on how finely the bed is read: deep water alone shows the
        // mesh.
        const double longest_m =
            sea_.waves->components().empty() ? 0 : sea_.waves->components().front().length_m();
        return -bed > 0.5 * longest_m ? -bed : NAN;
    }

    const lod::Terrain& terrain_;
    const Options& options_;
    viewer::EyeHeight heights_;
    viewer::GroundFacts facts_;
    viewer::OffscreenContext context_;  // before all that OpenGL has
    std::optional<viewer::Renderer> renderer_;
    std::optional<viewer::OceanProbe> probe_;
    std::optional<viewer::RenderTarget> target_;
    viewer::Mesher mesher_;
    mutable lod::TruePosts::Reader posts_{terrain_.posts()};
    viewer::TrueSea sea_;
    viewer::HoleFinder holes_;
    int width_ = 0;
    int height_ = 0;
};

viewer::ViewState view_of(const Options& options, double height_m, std::size_t direction) {
    viewer::ViewState state;
    state.place = options.place;
    state.H.m = height_m;
    state.heading.value = options.heading;
    const double dip = geo::Degrees::from_radians(std::acos(kRadius / (kRadius + height_m))).value;
    state.pitch.value = std::array{-90.0, -45.0, -dip}[direction];
    return state;
}

/// The eye a hundredth of its height to the side, or forward.
lod::Camera moved(const lod::Camera& camera, double height_m, bool forward) {
    const double heading = camera.heading.radians() + (forward ? 0 : 0.5 * std::numbers::pi);
    const double step = 0.01 * height_m;
    const geo::EnuFrame here(camera.eye);
    lod::Camera next = camera;
    next.eye = geo::to_geodetic(here.to_ecef({{step * std::sin(heading), step * std::cos(heading), 0}}));
    next.eye.h = camera.eye.h;
    return next;
}

struct Judged {
    viewer::SeaError error;
    std::size_t holes = 0;
    viewer::Swimming swimming;  // the worse of both ways
};

Result<Judged> judge(Stage& stage, const lod::Camera& camera, double height_m, OceanKind kind) {
    const auto picture = stage.probe(camera, kind);
    if (!picture) return picture.error();
    Judged judged;
    judged.error = viewer::measure_sea_error(*picture, stage.sea());
    judged.holes = stage.holes(*picture).size();
    for (const bool forward : {false, true}) {
        const auto next = stage.probe(moved(camera, height_m, forward), kind);
        if (!next) return next.error();
        const auto swimming = viewer::measure_swimming(*picture, *next, stage.sea());
        judged.swimming.max_px = std::max(judged.swimming.max_px, swimming.max_px);
        judged.swimming.rms_px = std::max(judged.swimming.rms_px, swimming.rms_px);
        judged.swimming.pixels += swimming.pixels;
        judged.swimming.sea_pixels += swimming.sea_pixels;
    }
    return judged;
}

void print_head(std::string_view first) {
    fmt::print(
        "\n| {} | eye m | direction | vertices | triangles | draw calls | arrange ms | draw ms | error max "
        "px "
        "| RMS | p99 | over 1 px | pixels | position max px | RMS | holes | swimming max px | RMS | "
        "compared "
        "|\n|---|---:|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n",
        first);
}

Result<void> print_row(Stage& stage, const Options& options, std::string_view first, OceanKind kind,
                       double height_m, std::size_t direction) {
    const lod::Camera camera = stage.camera(view_of(options, height_m, direction));
    const auto times = stage.time(camera, kind, options.frames);
    if (!times) return times.error();
    const auto judged = judge(stage, camera, height_m, kind);
    if (!judged) return judged.error();
    const auto& [error, holes, swimming] = *judged;
    fmt::print(
        "| {} | {:g} | {} | {} | {} | {} | {:.2f} | {:.1f} | {:.3f} | {:.4f} | {:.3f} | {} | {} | {:.3f} | "
        "{:.4f} | {} | {:.3f} | {:.4f} | {:.0f} % |\n",
        first, height_m, kDirections[direction], times->figures.vertices, times->figures.triangles,
        times->figures.draw_calls, times->arrange_ms, times->draw_ms, error.max_px, error.rms_px,
        error.p99_px, error.over, error.pixels, error.position_max_px, error.position_rms_px, holes,
        swimming.max_px, swimming.rms_px,
        100.0 * static_cast<double>(swimming.pixels) /
            std::max(1.0, static_cast<double>(swimming.sea_pixels)));
    std::fflush(stdout);
    return {};
}

Result<void> survey_meshes(Stage& stage, const Options& options) {
    print_head("mesh");
    for (const double height_m : kHeights) {
        for (std::size_t direction = 0; direction < kDirections.size(); ++direction) {
            for (const OceanKind kind : kKinds) {
                if (auto done = print_row(stage, options, to_string(kind), kind, height_m, direction); !done)
                    return done;
            }
        }
    }
    return {};
}

double reach_m(double height_m) {
    return lod::horizon_m(kRadius, height_m, 4);
}

/// As the mesh chooses its own, nested squares, but of about so many vertices.
lod::GeoclipmapShape geoclipmap_of(double vertices, double height_m) {
    lod::GeoclipmapShape best;
    double nearest = INFINITY;
    for (int cells = 4; cells <= 64; cells *= 2) {
        for (int squares = 1; squares <= 8; ++squares) {
            double block_m = reach_m(height_m) / 4.4 / std::pow(3, squares - 1);
            lod::GeoclipmapShape shape;
            double count = 0;
            for (int square = 0; square < squares; ++square, block_m *= 3) {
                for (int ring = square == 0 ? 0 : 2; ring <= 4; ++ring) {
                    shape.rings.push_back({square, ring, block_m, cells});
                    count += lod::blocks_of_ring(ring) * (cells + 1.0) * (cells + 1.0);
                }
            }
            // Too few squares see one cell under the eye, too many see nothing else.
            const double finest = shape.rings.front().block_m * 4.5 / height_m;
            const double off = std::abs(std::log(count / vertices)) + 0.3 * std::abs(std::log(finest));
            if (off < nearest) nearest = off, best = shape;
        }
    }
    return best;
}

lod::RadialShape radial_of(double vertices, double height_m) {
    constexpr int kBlock = lod::RadialGrid::kBlockCells;
    const double first_m = 0.05 * height_m;
    const double exponent = std::clamp(std::log(reach_m(height_m) / first_m), 2.0, 8.0);
    const int sectors = std::max(static_cast<int>(std::lround(std::sqrt(2 * vertices) / kBlock)), 1) * kBlock;
    const int rings = std::max(static_cast<int>(std::lround(vertices / sectors / kBlock)), 1) * kBlock + 1;
    return lod::radial_shape(first_m, reach_m(height_m), exponent, rings, sectors);
}

void use_own_meshes(Stage& stage) {
    stage.ocean().use_mesh(OceanKind::geoclipmap, std::make_unique<lod::Geoclipmap>());
    stage.ocean().use_mesh(OceanKind::radial, std::make_unique<lod::RadialGrid>());
    stage.ocean().use_mesh(OceanKind::projected, std::make_unique<lod::ProjectedMesh>());
}

Result<void> survey_equal(Stage& stage, const Options& options) {
    print_head("mesh, vertices in total");
    for (const double vertices : {10e3, 40e3, 160e3}) {
        for (const double height_m : kHeights) {
            const lod::GeoclipmapShape squares = geoclipmap_of(vertices, height_m);
            const lod::RadialShape rings = radial_of(vertices, height_m);
            // Its indices have 16 bits.
            const int side = std::min(static_cast<int>(std::sqrt(vertices)), 256);
            double in_squares = 0;
            for (const auto& ring : squares.rings)
                in_squares += lod::blocks_of_ring(ring.ring) * (ring.cells + 1.0) * (ring.cells + 1.0);
            stage.ocean().use_mesh(OceanKind::geoclipmap, std::make_unique<lod::Geoclipmap>(squares));
            stage.ocean().use_mesh(OceanKind::radial, std::make_unique<lod::RadialGrid>(rings));
            stage.ocean().use_mesh(OceanKind::projected, std::make_unique<lod::ProjectedMesh>(side));
            const std::array totals{in_squares, static_cast<double>(rings.rings) * rings.sectors,
                                    static_cast<double>(side) * side};
            for (std::size_t direction = 0; direction < kDirections.size(); ++direction) {
                for (std::size_t i = 0; i < kKinds.size(); ++i) {
                    const auto name = fmt::format("{}, {:.0f}", to_string(kKinds[i]), totals[i]);
                    if (auto done = print_row(stage, options, name, kKinds[i], height_m, direction); !done)
                        return done;
                }
            }
        }
    }
    use_own_meshes(stage);
    return {};
}

/// The brute force: one lattice of equal spacing, of which nothing is culled. The geoclipmap's shader draws
/// it.
class Plane final : public lod::OceanMesh {
  public:
    Plane(double spacing_m, int rings) : squares_(shape(spacing_m, rings)) {}

    static constexpr int kCells = 64;
    static double cells_a_side(int rings) { return kCells * lod::blocks_a_side(rings); }

    const std::vector<lod::OceanPatch>& patches() const override { return squares_.patches(); }
    void arrange(const lod::SeaView& sea, const lod::SeaSpacing& spacing, const lod::WaterIn& water_in,
                 lod::OceanPicture& picture) const override {
        // A picture that sees everything culls nothing.
        lod::Camera camera = sea.view.camera();
        camera.pitch = geo::Degrees{-90};
        camera.fov = geo::Degrees{179.999};
        camera.width = camera.height;
        const lod::View all(camera);
        const lod::SeaView whole(all, sea.chart, camera.eye.h.m - sea.eye_m, sea.crest_m);
        const auto any = [&](const glm::dvec2& centre, double radius_m) {
            return std::max(water_in(centre, radius_m), lod::Water::shore);
        };
        squares_.arrange(whole, spacing, any, picture);
    }

  private:
    static lod::GeoclipmapShape shape(double spacing_m, int rings) {
        lod::GeoclipmapShape made;
        for (int ring = 0; ring <= rings; ++ring) made.rings.push_back({0, ring, kCells * spacing_m, kCells});
        return made;
    }
    lod::Geoclipmap squares_;
};

/// Against a plane that has the same measured error, and reaches the horizon. What of it has no room in
/// memory is left out of its measure, and counted into its costs by the triangle.
Result<void> survey_plane(Stage& stage, const Options& options) {
    constexpr int kMostRings = 11;  // 2.2 million vertices
    fmt::print(
        "\n| eye m | direction | mesh | error max px | triangles | ms | plane's spacing m | its error px | "
        "triangles to the horizon | ratio | triangles drawn | ms | ms to the horizon | ratio |\n"
        "|---:|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
    for (const double height_m : {2.0, 50.0}) {
        for (std::size_t direction = 0; direction < kDirections.size(); ++direction) {
            const lod::Camera camera = stage.camera(view_of(options, height_m, direction));
            struct Own {
                double px, ms, triangles;
            };
            std::array<Own, kKinds.size()> own{};
            for (std::size_t i = 0; i < kKinds.size(); ++i) {
                const auto picture = stage.probe(camera, kKinds[i]);
                if (!picture) return picture.error();
                const auto times = stage.time(camera, kKinds[i], options.frames);
                if (!times) return times.error();
                own[i] = {viewer::measure_sea_error(*picture, stage.sea()).max_px,
                          times->arrange_ms + times->draw_ms, static_cast<double>(times->figures.triangles)};
            }
            const auto rings_for = [&](double spacing_m) {
                const double blocks = reach_m(height_m) / (Plane::kCells * spacing_m);
                return static_cast<int>(std::clamp(std::ceil(blocks - 0.5), 0.0, 1.0 * kMostRings));
            };
            for (std::size_t i = 0; i < kKinds.size(); ++i) {
                const auto error_of = [&](double spacing_m) -> Result<double> {
                    stage.ocean().use_mesh(OceanKind::geoclipmap,
                                           std::make_unique<Plane>(spacing_m, rings_for(spacing_m)));
                    const auto picture = stage.probe(camera, OceanKind::geoclipmap);
                    if (!picture) return picture.error();
                    const auto error = viewer::measure_sea_error(*picture, stage.sea());
                    return error.pixels > 0 ? error.max_px : 0;
                };
                double fine = 0.002;
                double coarse = 500;
                double reached = 0;
                for (int halving = 0; halving < 10; ++halving) {
                    const double middle = std::sqrt(fine * coarse);
                    const auto tried = error_of(middle);
                    if (!tried) return tried.error();
                    (*tried <= own[i].px ? fine : coarse) = middle;
                    if (*tried <= own[i].px) reached = *tried;
                }
                if (auto last = error_of(fine); !last) return last.error();
                const auto times = stage.time(camera, OceanKind::geoclipmap, options.frames);
                if (!times) return times.error();
                use_own_meshes(stage);
                const double drawn = static_cast<double>(times->figures.triangles);
                const double ms = times->arrange_ms + times->draw_ms;
                const double side = 2 * reach_m(height_m) / fine;
                const double needed = std::max(2 * side * side, drawn);
                const double needed_ms = ms * needed / std::max(drawn, 1.0);
                fmt::print(
                    "| {:g} | {} | {} | {:.3f} | {:.0f} | {:.1f} | {:.4g} | {:.3f} | {:.3g} | {:.3g} | "
                    "{:.0f} | "
                    "{:.1f} | {:.3g} | {:.3g} |\n",
                    height_m, kDirections[direction], to_string(kKinds[i]), own[i].px, own[i].triangles,
                    own[i].ms, fine, reached, needed, needed / own[i].triangles, drawn, ms, needed_ms,
                    needed_ms / own[i].ms);
                std::fflush(stdout);
            }
        }
    }
    return {};
}

/// Of a flight: through the keys, or twice around the place from 2 m to 3 km and back.
viewer::ViewState flight_view(const Options& options, double part) {
    const auto at = [&](double p) {
        std::array<double, 3> here{};
        if (options.keys.size() > 1) {
            const double way = std::clamp(p, 0.0, 1.0) * static_cast<double>(options.keys.size() - 1);
            const auto key = std::min(static_cast<std::size_t>(way), options.keys.size() - 2);
            const double rest = way - static_cast<double>(key);
            const auto& a = options.keys[key];
            const auto& b = options.keys[key + 1];
            for (std::size_t i = 0; i < 2; ++i) here[i] = a[i] + rest * (b[i] - a[i]);
            here[2] = a[2] * std::pow(b[2] / a[2], rest);
            return here;
        }
        const double turn = 4 * std::numbers::pi * p;
        constexpr double kAway = 0.1;  // degrees
        here[0] = options.place.lat.value + kAway * std::cos(turn);
        here[1] = options.place.lon.value + kAway * std::sin(turn) / std::cos(options.place.lat.radians());
        here[2] = 2 * std::pow(1500, 0.5 - 0.5 * std::cos(3 * turn));
        return here;
    };
    const auto here = at(part);
    const auto next = at(part + 1e-4);
    const auto last = at(part - 1e-4);
    viewer::ViewState state;
    state.place = {geo::Degrees{here[0]}, geo::Degrees{here[1]}};
    state.H.m = here[2];
    state.heading = geo::wrapped_360(geo::Degrees::from_radians(
        std::atan2((next[1] - last[1]) * std::cos(state.place.lat.radians()), next[0] - last[0])));
    // Along the horizon, down, and leaning, each in its own time.
    state.pitch.value = -32 + 30 * std::sin(37 * part);
    state.roll.value = 20 * std::sin(53 * part);
    state.ocean = ocean_of(options);
    return state;
}

Result<bool> fly(Stage& stage, const Options& options) {
    fmt::print(
        "| mesh | frames | with sea | sea pixels | holes | frames with holes | inside a wave |\n"
        "|---|---:|---:|---:|---:|---:|---:|\n");
    bool watertight = true;
    std::string offenders;
    for (const OceanKind kind : kKinds) {
        std::size_t holes = 0;
        std::size_t sea_pixels = 0;
        int leaking = 0;
        int with_sea = 0;
        int inside = 0;
        for (int frame = 0; frame < options.watertight; ++frame) {
            auto state = flight_view(options, static_cast<double>(frame) / options.watertight);
            state.ocean.kind = kind;
            const auto picture = stage.probe(stage.camera(state), kind);
            if (!picture) return picture.error();
            const auto sea = std::count_if(
                picture->pixels.begin(), picture->pixels.end(),
                [](const auto& pixel) { return pixel.what == viewer::ProbePicture::What::sea; });
            sea_pixels += static_cast<std::size_t>(sea);
            with_sea += sea > 0;
            if (picture->chart)
                inside +=
                    stage.sea().waves->height(picture->chart->at(state.place), picture->time_s) > state.H.m;
            const auto found = stage.holes(*picture);
            holes += found.size();
            leaking += !found.empty();
            if (!found.empty() && leaking <= 5) {
                offenders +=
                    fmt::format("{} frame {}: {} holes, at {},{}: --at '{}'\n", to_string(kind), frame,
                                found.size(), found.front().x, found.front().y, to_string(state));
            }
        }
        fmt::print("| {} | {} | {} | {} | {} | {} | {} |\n", to_string(kind), options.watertight, with_sea,
                   sea_pixels, holes, leaking, inside);
        std::fflush(stdout);
        watertight = watertight && holes == 0;
    }
    fmt::print("{}", offenders);
    return watertight;
}

Result<bool> run(const char* path, const Options& options) {
    const auto scene = lod::Scene::open(path);
    if (!scene) return scene.error();
    const auto terrain = lod::Terrain::open(*scene, lod::ErrorMetric::bounded, {.fade_s = 0});
    if (!terrain) return terrain.error();
    const bool flight = options.watertight > 0;
    const auto stage = Stage::create(*scene, *terrain, flight ? 640 : 1280, flight ? 360 : 720, options);
    if (!stage) return stage.error();
    fmt::print("{}, wind {:g} m/s, {}\n", path, options.wind_m_s, viewer::gl_description());
    if (flight) return fly(**stage, options);
    const auto wanted = [&](const char* table) {
        return options.only.empty() || options.only.contains(table);
    };
    if (wanted("meshes")) {
        if (auto done = survey_meshes(**stage, options); !done) return done.error();
    }
    if (wanted("equal")) {
        if (auto done = survey_equal(**stage, options); !done) return done.error();
    }
    if (wanted("plane")) {
        if (auto done = survey_plane(**stage, options); !done) return done.error();
    }
    return true;
}

std::optional<Options> read(int argc, char** argv) {
    Options options;
    const auto numbers = [](const char* text, std::size_t count) {
        auto read = viewer::parse_numbers(text);
        return read && read->size() == count ? read : std::nullopt;
    };
    if (argc < 3) return std::nullopt;
    const auto place = numbers(argv[2], 2);
    if (!place) return std::nullopt;
    options.place = {geo::Degrees{(*place)[0]}, geo::Degrees{(*place)[1]}};
    for (int i = 3; i < argc; ++i) {
        const std::string flag = argv[i];
        if (!flag.starts_with("--")) {
            const auto key = numbers(argv[i], 3);
            if (!key) return std::nullopt;
            options.keys.push_back({(*key)[0], (*key)[1], (*key)[2]});
            continue;
        }
        if (++i == argc) return std::nullopt;
        if (flag == "--frames")
            options.frames = std::max(std::atoi(argv[i]), 1);
        else if (flag == "--heading")
            options.heading = std::atof(argv[i]);
        else if (flag == "--wind")
            options.wind_m_s = std::atof(argv[i]);
        else if (flag == "--time")
            options.time_s = std::atof(argv[i]);
        else if (flag == "--watertight")
            options.watertight = std::atoi(argv[i]);
        else if (flag == "--only")
            options.only.insert(argv[i]);
        else
            return std::nullopt;
    }
    return options;
}

}  // namespace

int main(int argc, char** argv) {
    const auto options = read(argc, argv);
    if (!options) {
        fmt::print(stderr,
                   "usage: ocean_survey SCENE LAT,LON [--frames N] [--heading DEGREES] [--wind SPEED] "
                   "[--time S] [--only meshes|equal|plane]...\n"
                   "       ocean_survey SCENE LAT,LON --watertight N [LAT,LON,H]...\n");
        return 2;
    }
    const auto kept = run(argv[1], *options);
    if (!kept) {
        fmt::print(stderr, "{}\n", kept.error().message);
        return 1;
    }
    return *kept ? 0 : 1;
}
