#include "viewer/bench/ocean_stage.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relevo::viewer {

namespace {

DrawSettings with_ocean(const OceanSettings& settings) {
    DrawSettings how;
    how.ocean = settings;
    return how;
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

/// The eye a hundredth of its height to the side, or forward.
lod::Camera moved(const lod::Camera& camera, double eye_m, bool forward) {
    const double heading = camera.heading.radians() + (forward ? 0 : 0.5 * std::numbers::pi);
    const double step = 0.01 * eye_m;
    const geo::EnuFrame here(camera.eye);
    lod::Camera next = camera;
    next.eye = geo::to_geodetic(here.to_ecef({{step * std::sin(heading), step * std::cos(heading), 0}}));
    next.eye.h = camera.eye.h;
    return next;
}

/// Water in which waves feel no bed, metres.
double deep_m(const lod::WaveMap* map, const lod::Waves& waves) {
    if (map) return 0.5 * map->mean_length_m();
    return waves.components().empty() ? 0 : 0.5 * waves.components().front().length_m();
}

}  // namespace

std::string_view to_string(OceanGaze gaze) {
    switch (gaze) {
        case OceanGaze::down:
            return "down";
        case OceanGaze::slanted:
            return "45 degrees";
        case OceanGaze::horizon:
            break;
    }
    return "horizon";
}

double deep_water_m(const OceanSettings& settings) {
    return deep_m(settings.map.get(), lod::Waves::of_wind(settings.wind));
}

OceanStage::OceanStage(const lod::Scene& scene, const lod::Terrain& terrain, const EyeHeight& heights,
                       OffscreenContext context)
    : terrain_(terrain),
      heights_(heights),
      facts_(ground_facts(scene.info())),
      context_(std::move(context)),
      mesher_(terrain),
      off_shore_(*terrain.pyramid()),
      holes_(terrain, sea_) {
    sea_.heights = &heights_;
    sea_.depth_m = [this](geo::LatLon place) { return depth_m(place); };
}

Result<std::unique_ptr<OceanStage>> OceanStage::create(const lod::Scene& scene, const lod::Terrain& terrain,
                                                       const EyeHeight& heights, int width, int height) {
    auto context = OffscreenContext::create();
    if (!context) return context.error();
    std::unique_ptr<OceanStage> made(new OceanStage(scene, terrain, heights, *std::move(context)));
    made->width_ = width;
    made->height_ = height;
    auto renderer = Renderer::create(
        terrain, {.pyramid = terrain.pyramid().get(), .facts = made->facts_, .heights = &heights});
    if (!renderer) return renderer.error();
    made->renderer_.emplace(*std::move(renderer));
    auto probe = OceanProbe::create(width, height);
    if (!probe) return probe.error();
    made->probe_.emplace(*std::move(probe));
    auto target = RenderTarget::create(width, height, 1);
    if (!target) return target.error();
    made->target_.emplace(*std::move(target));
    made->sea_.waves = &made->ocean().waves();
    return made;
}

lod::Camera OceanStage::camera(const OceanSight& sight) const {
    constexpr double kRadius = 6371e3;
    ViewState state;
    state.place = sight.place;
    state.H.m = sight.eye_m;
    state.heading = sight.heading;
    const auto dip = geo::Degrees::from_radians(std::acos(kRadius / (kRadius + sight.eye_m)));
    state.pitch.value = sight.gaze == OceanGaze::down      ? -90
                        : sight.gaze == OceanGaze::slanted ? -45
                                                           : -dip.value;
    return camera(state);
}

Result<void> OceanStage::prepare(const lod::View& view, const DrawSettings& settings) {
    map_ = settings.ocean.map;
    sea_.map = map_.get();
    const auto ground = mesher_.whole_ground(view, {});
    if (!ground) return ground.error();
    renderer_->upload(*ground);
    return renderer_->complete(view, settings, {0, 0, width_, height_});
}

Result<ProbePicture> OceanStage::probe(const lod::Camera& camera, const OceanSettings& settings) {
    const lod::View view(camera);
    const DrawSettings how = with_ocean(settings);
    if (auto done = prepare(view, how); !done) return done.error();
    return probe_->draw(*renderer_, view, how);
}

Result<OceanStage::Times> OceanStage::time(const lod::Camera& camera, const OceanSettings& settings,
                                           int frames) {
    const lod::View view(camera);
    const DrawSettings how = with_ocean(settings);
    if (auto done = prepare(view, how); !done) return done.error();
    Times times;
    std::vector<double> cpu, gpu;
    for (int frame = -1; frame < frames; ++frame) {  // the first compiles
        const auto drawn = renderer_->draw(view, how, *target_, {}, true);
        if (!drawn) return drawn.error();
        times.figures = drawn->ocean;
        if (frame < 0) continue;
        cpu.push_back(drawn->ocean.arrange_ms);
        gpu.push_back(drawn->ocean.draw_ms);
    }
    times.cpu_ms = median(std::move(cpu));
    times.gpu_ms = median(std::move(gpu));
    return times;
}

Result<OceanRow> OceanStage::measure(const OceanSight& sight, const OceanSettings& settings, int frames) {
    const lod::Camera here = camera(sight);
    const auto times = time(here, settings, frames);
    if (!times) return times.error();
    const auto picture = probe(here, settings);
    if (!picture) return picture.error();
    OceanRow row{.kind = settings.kind,
                 .asked_px = settings.error_px,
                 .eye_m = sight.eye_m,
                 .gaze = sight.gaze,
                 .figures = times->figures,
                 .cpu_ms = times->cpu_ms,
                 .gpu_ms = times->gpu_ms,
                 .error = measure_sea_error(*picture, sea_),
                 .holes = holes(*picture).size(),
                 .swimming = {}};
    for (const bool forward : {false, true}) {
        const auto next = probe(moved(here, sight.eye_m, forward), settings);
        if (!next) return next.error();
        const auto swimming = measure_swimming(*picture, *next, sea_);
        row.swimming.max_px = std::max(row.swimming.max_px, swimming.max_px);
        row.swimming.rms_px = std::max(row.swimming.rms_px, swimming.rms_px);
        row.swimming.pixels += swimming.pixels;
        row.swimming.sea_pixels += swimming.sea_pixels;
    }
    return row;
}

double OceanStage::depth_m(geo::LatLon place) {
    if (facts_.sea_is_level) return off_shore_.at(place) ? INFINITY : NAN;
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
    const double bed = (1 - y) * ((1 - x) * H(0, 0) + x * H(1, 0)) + y * ((1 - x) * H(0, 1) + x * H(1, 1));
    return -bed > deep_m(sea_.map, *sea_.waves) ? -bed : NAN;
}

}  // namespace relevo::viewer
