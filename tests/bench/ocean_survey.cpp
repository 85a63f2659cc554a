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
#include "viewer/bench/ocean_stage.hpp"
#include "viewer/gl/gl_check.hpp"
#include "viewer/numbers.hpp"

namespace {

using namespace relevo;
using viewer::OceanGaze;
using viewer::OceanKind;
using viewer::OceanStage;

constexpr auto kKinds = viewer::kOceanKinds;
constexpr std::array kHeights{2.0, 50.0, 2000.0, 50000.0};
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

viewer::OceanSettings ocean_of(const Options& options, OceanKind kind) {
    auto ocean = ocean_of(options);
    ocean.kind = kind;
    return ocean;
}

viewer::OceanSight sight_of(const Options& options, double height_m, OceanGaze gaze) {
    return {
        .place = options.place, .heading = geo::Degrees{options.heading}, .eye_m = height_m, .gaze = gaze};
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

Result<void> print_row(OceanStage& stage, const Options& options, std::string_view first, OceanKind kind,
                       double height_m, OceanGaze gaze) {
    const auto row =
        stage.measure(sight_of(options, height_m, gaze), ocean_of(options, kind), options.frames);
    if (!row) return row.error();
    const viewer::SeaError& error = row->error;
    const viewer::Swimming& swimming = row->swimming;
    fmt::print(
        "| {} | {:g} | {} | {} | {} | {} | {:.2f} | {:.1f} | {:.3f} | {:.4f} | {:.3f} | {} | {} | {:.3f} | "
        "{:.4f} | {} | {:.3f} | {:.4f} | {:.0f} % |\n",
        first, height_m, to_string(gaze), row->figures.vertices, row->figures.triangles,
        row->figures.draw_calls, row->cpu_ms, row->gpu_ms, error.max_px, error.rms_px, error.p99_px,
        error.over, error.pixels, error.position_max_px, error.position_rms_px, row->holes, swimming.max_px,
        swimming.rms_px,
        100.0 * static_cast<double>(swimming.pixels) /
            std::max(1.0, static_cast<double>(swimming.sea_pixels)));
    std::fflush(stdout);
    return {};
}

Result<void> survey_meshes(OceanStage& stage, const Options& options) {
    print_head("mesh");
    for (const double height_m : kHeights) {
        for (const OceanGaze gaze : viewer::kOceanGazes) {
            for (const OceanKind kind : kKinds) {
                if (auto done = print_row(stage, options, to_string(kind), kind, height_m, gaze); !done)
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

void use_own_meshes(OceanStage& stage) {
    stage.ocean().use_mesh(OceanKind::geoclipmap, std::make_unique<lod::Geoclipmap>());
    stage.ocean().use_mesh(OceanKind::radial, std::make_unique<lod::RadialGrid>());
    stage.ocean().use_mesh(OceanKind::projected, std::make_unique<lod::ProjectedMesh>());
}

Result<void> survey_equal(OceanStage& stage, const Options& options) {
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
            for (const OceanGaze gaze : viewer::kOceanGazes) {
                for (std::size_t i = 0; i < kKinds.size(); ++i) {
                    const auto name = fmt::format("{}, {:.0f}", to_string(kKinds[i]), totals[i]);
                    if (auto done = print_row(stage, options, name, kKinds[i], height_m, gaze); !done)
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
Result<void> survey_plane(OceanStage& stage, const Options& options) {
    constexpr int kMostRings = 11;  // 2.2 million vertices
    fmt::print(
        "\n| eye m | direction | mesh | error max px | triangles | ms | plane's spacing m | its error px | "
        "triangles to the horizon | ratio | triangles drawn | ms | ms to the horizon | ratio |\n"
        "|---:|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
    for (const double height_m : {2.0, 50.0}) {
        for (const OceanGaze gaze : viewer::kOceanGazes) {
            const lod::Camera camera = stage.camera(sight_of(options, height_m, gaze));
            struct Own {
                double px, ms, triangles;
            };
            std::array<Own, kKinds.size()> own{};
            for (std::size_t i = 0; i < kKinds.size(); ++i) {
                const auto picture = stage.probe(camera, ocean_of(options, kKinds[i]));
                if (!picture) return picture.error();
                const auto times = stage.time(camera, ocean_of(options, kKinds[i]), options.frames);
                if (!times) return times.error();
                own[i] = {viewer::measure_sea_error(*picture, stage.sea()).max_px,
                          times->cpu_ms + times->gpu_ms, static_cast<double>(times->figures.triangles)};
            }
            const auto rings_for = [&](double spacing_m) {
                const double blocks = reach_m(height_m) / (Plane::kCells * spacing_m);
                return static_cast<int>(std::clamp(std::ceil(blocks - 0.5), 0.0, 1.0 * kMostRings));
            };
            for (std::size_t i = 0; i < kKinds.size(); ++i) {
                const auto error_of = [&](double spacing_m) -> Result<double> {
                    stage.ocean().use_mesh(OceanKind::geoclipmap,
                                           std::make_unique<Plane>(spacing_m, rings_for(spacing_m)));
                    const auto picture = stage.probe(camera, ocean_of(options, OceanKind::geoclipmap));
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
                const auto times =
                    stage.time(camera, ocean_of(options, OceanKind::geoclipmap), options.frames);
                if (!times) return times.error();
                use_own_meshes(stage);
                const double drawn = static_cast<double>(times->figures.triangles);
                const double ms = times->cpu_ms + times->gpu_ms;
                const double side = 2 * reach_m(height_m) / fine;
                const double needed = std::max(2 * side * side, drawn);
                const double needed_ms = ms * needed / std::max(drawn, 1.0);
                fmt::print(
                    "| {:g} | {} | {} | {:.3f} | {:.0f} | {:.1f} | {:.4g} | {:.3f} | {:.3g} | {:.3g} | "
                    "{:.0f} | "
                    "{:.1f} | {:.3g} | {:.3g} |\n",
                    height_m, to_string(gaze), to_string(kKinds[i]), own[i].px, own[i].triangles, own[i].ms,
                    fine, reached, needed, needed / own[i].triangles, drawn, ms, needed_ms,
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

Result<bool> fly(OceanStage& stage, const Options& options) {
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
            const auto picture = stage.probe(stage.camera(state), state.ocean);
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
    const viewer::EyeHeight heights(scene->geoid());
    const auto stage = OceanStage::create(*scene, *terrain, heights, flight ? 640 : 1280, flight ? 360 : 720);
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
