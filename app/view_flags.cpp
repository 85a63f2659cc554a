#include "app/view_flags.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>

#include <fmt/format.h>

#include "app/wave_flag.hpp"
#include "viewer/camera.hpp"
#include "viewer/numbers.hpp"
#include "viewer/offscreen.hpp"

namespace relevo::app {

namespace {

Error usage(std::string message) {
    return {ErrorKind::usage, std::move(message)};
}

template <class T>
Result<void> keep(const char* flag, const Result<T>& parsed, T& place) {
    if (!parsed) return usage(fmt::format("{}: {}", flag, parsed.error().message));
    place = *parsed;
    return {};
}

Result<void> read_eye(const std::string& text, viewer::ViewState& view) {
    const auto numbers = viewer::parse_numbers(text);
    if (!numbers || numbers->size() != 3) {
        return usage(fmt::format("--eye {}: expected LAT,LON,H in degrees and metres", text));
    }
    view.place = {geo::Degrees{(*numbers)[0]}, geo::Degrees{(*numbers)[1]}};
    view.H.m = (*numbers)[2];
    return {};
}

/// Puts an overlay of a flag on top, in place of the one of its kind that --at has.
Result<void> add_overlay(const char* flag, const Result<viewer::Overlay>& parsed, viewer::ViewState& view) {
    if (!parsed) return usage(fmt::format("{}: {}", flag, parsed.error().message));
    std::erase_if(view.overlays, [&](const viewer::Overlay& other) { return other.kind == parsed->kind; });
    view.overlays.push_back(*parsed);
    return {};
}

Result<void> read_graticule(const std::string& text, viewer::ViewState& view) {
    const auto parsed = viewer::parse_graticule(text);
    if (!parsed) return usage("--graticule: " + parsed.error().message);
    if (*parsed) return add_overlay("--graticule", **parsed, view);
    std::erase_if(view.overlays, [](const viewer::Overlay& other) {
        return other.kind == viewer::Overlay::Kind::graticule;
    });
    return {};
}

void turn(viewer::ViewState& view, const ViewFlags& flags) {
    if (flags.heading) view.heading.value = *flags.heading;
    if (flags.pitch) view.pitch.value = *flags.pitch;
    if (flags.roll) view.roll.value = *flags.roll;
}

std::optional<int> whole_number(std::string_view text) {
    int number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return number;
}

/// Nothing for "auto".
std::optional<std::uint64_t> memory_of(std::string text) {
    if (text == "auto") return std::nullopt;
    if (text.find('-') != std::string::npos) throw CLI::ValidationError("--memory", "a size, e.g. 512MiB");
    try {
        CLI::AsSizeValue(false)(text);  // changes it to a number
        return std::stoull(text);
    } catch (const std::exception& wrong) {
        throw CLI::ValidationError("--memory", wrong.what());
    }
}

}  // namespace

void add_picture_flags(CLI::App& command, ViewFlags& flags) {
    const auto add = [&command](const char* name, auto& place, const char* value, const char* what) {
        command.add_option(name, place, what)->type_name(value);
    };
    add("--size", flags.size, "WxH", "Of the picture, pixels [1280x720]");
    add("--tau", flags.tau, "PX", "Largest error on the screen, pixels [1]");
    add("--morph", flags.morph, "on|off", "Vertices move in continuously");
    add("--exaggeration", flags.exaggeration, "X", "Of heights, in the picture only [1]");
    add("--layer", flags.layer, "hypsometric|hillshade|slope|aspect|lod|terrain|plain",
        "What colours the ground [hypsometric]");
    add("--ramp", flags.ramp, "viridis|grey|classic|FILE",
        "Colours of heights in the layer hypsometric; a FILE as gdaldem color-relief reads it");
    add("--contours", flags.contours, "auto|METRES[,OPACITY]",
        "Lines of equal height over it, so many metres apart");
    add("--graticule", flags.graticule, "auto|latlon|utm|off[,OPACITY]",
        "Lines of latitude and longitude, or of the UTM zone below the eye");
    add("--shading", flags.shading, "sun|multidirectional|oblique|combined",
        "How light shows the shape of tints, hillshade and levels [sun]");
    add("--sun", flags.sun, "auto|AZ,EL|TIME", "Where the light comes from; TIME is ISO 8601 [auto: 315,45]");
    add("--haze", flags.haze, "on|off|KM",
        "Air in front of what is far; KM: how far a dark thing is seen at the sea's level [on: 586.8]");
    add("--ocean", flags.ocean, "auto|geoclipmap|radial|projected|off", "The sea's mesh [auto]");
    add("--wind", flags.wind, "SPEED,FROM", "What raises the waves, m/s and degrees; 0: a flat sea [6,300]");
    add("--waves", flags.waves, "MAP[,TILE_M[,HEIGHT_M]]",
        "Waves of a height map that repeats every TILE_M metres [200] and drifts with the wind; HEIGHT_M "
        "from its lowest to its highest, needed for shades of grey");
    add("--time", flags.time, "SECONDS", "Of the waves [0]");
    add("--samples", flags.samples, "1|4|8", "Samples a pixel, for smooth edges");
    command
        .add_option_function<std::string>(
            "--memory", [&flags](const std::string& text) { flags.memory = memory_of(text); },
            "Most memory for terrain and textures, e.g. 512MiB; auto is what fits the machine")
        ->type_name("auto|BYTES");
    command.add_flag("--wireframe", flags.wireframe, "Draw the mesh's edges, coloured by level");
}

void add_view_flags(CLI::App& command, ViewFlags& flags) {
    const auto add = [&command](const char* name, auto& place, const char* value, const char* what) {
        command.add_option(name, place, what)->type_name(value);
    };
    add("--at", flags.at, "VIEW", "A whole view in one string, as the window copies it (V)");
    add("--eye", flags.eye, "LAT,LON,H", "Where the eye is; H in metres above the scene's vertical datum");
    add("--heading", flags.heading, "DEG", "Clockwise from north");
    add("--pitch", flags.pitch, "DEG", "0 at the horizon, -90 straight down");
    add("--roll", flags.roll, "DEG", "Of the head, to the right");
    add("--fov", flags.fov, "DEG", "Vertical view angle, above 0 and below 180 [60]");
    add("--lod", flags.method, "soar|lstr|full", "How the mesh is made [soar]");
    add("--metric", flags.metric, "bounded|incremental", "The error that drives it [bounded]");
    add("--ground-map", flags.ground_map, "FILE",
        "What --layer terrain is made of: a georeferenced raster of four bands of bytes, the weights of "
        "grass, "
        "rock, gravel and snow");
    add("--marks", flags.marks, "all|none|legend,scale,north,labels",
        "Drawn over the picture; with view over those of Ctrl P [none]");
    add_picture_flags(command, flags);
}

void add_max_triangles_flag(CLI::App& command, BudgetFlags& flags) {
    command
        .add_option("--max-triangles", flags.max_triangles,
                    "Tau grows up to 64 where a frame would have more triangles")
        ->type_name("N");
}

void add_budget_flags(CLI::App& command, BudgetFlags& flags) {
    command
        .add_option("--budget", flags.budget_ms,
                    "Milliseconds a frame may take: tau grows up to 64 to keep to it")
        ->type_name("MS");
    add_max_triangles_flag(command, flags);
}

Result<viewer::BudgetLimits> read_budget(const BudgetFlags& flags) {
    if (flags.budget_ms && !(*flags.budget_ms >= 1 && *flags.budget_ms <= 1e5))
        return usage("--budget: 1 to 100000 milliseconds");
    if (flags.max_triangles && *flags.max_triangles < 100) return usage("--max-triangles: at least 100");
    return viewer::BudgetLimits{flags.budget_ms, flags.max_triangles};
}

Result<lod::TileStoreOptions> tile_options(const lod::CacheSizes& sizes, double fade_s) {
    lod::TileStoreOptions options;
    options.memory_bytes = sizes.mesh_bytes;
    options.threads = sizes.threads;
    options.fade_s = fade_s;
    if (const char* delay = std::getenv("RELEVO_READ_DELAY_MS")) {
        const auto ms = viewer::parse_numbers(delay);
        if (!ms || ms->size() != 1 || !(ms->front() >= 0 && ms->front() <= 60000))
            return usage(fmt::format("RELEVO_READ_DELAY_MS={}: 0 to 60000 milliseconds", delay));
        options.read_delay_s = ms->front() / 1000;
        options.threads = 8;  // that sleep most of the time
    }
    return options;
}

Result<viewer::ViewState> read_view(const ViewFlags& flags, const viewer::ViewState& base) {
    viewer::ViewState view = base;
    Result<void> done;
    if (flags.at) done = keep("--at", viewer::parse_view_state(*flags.at, base), view);
    if (done && flags.eye) done = read_eye(*flags.eye, view);
    if (done && flags.method) done = keep("--lod", viewer::parse_method(*flags.method), view.method);
    if (done && flags.metric) done = keep("--metric", viewer::parse_metric(*flags.metric), view.metric);
    if (done && flags.morph) done = keep("--morph", viewer::parse_switch(*flags.morph), view.morph);
    if (done && flags.layer) done = keep("--layer", viewer::parse_layer(*flags.layer), view.layer);
    if (done && flags.shading) done = keep("--shading", viewer::parse_shading(*flags.shading), view.shading);
    if (done && flags.sun) done = keep("--sun", viewer::parse_sun(*flags.sun), view.sun);
    if (done && flags.haze) done = keep("--haze", viewer::parse_haze(*flags.haze), view.haze);
    if (done && flags.ocean) done = keep("--ocean", viewer::parse_ocean(*flags.ocean), view.ocean.kind);
    if (done && flags.wind) done = keep("--wind", viewer::parse_wind(*flags.wind), view.ocean.wind);
    if (done && flags.contours)
        done = add_overlay("--contours", viewer::parse_contours(*flags.contours), view);
    if (done && flags.graticule) done = read_graticule(*flags.graticule, view);
    if (!done) return done.error();
    turn(view, flags);
    if (flags.time) view.ocean.time_s = *flags.time;
    if (flags.fov) view.fov.value = *flags.fov;
    if (flags.tau) view.tau_px = *flags.tau;
    if (flags.exaggeration) view.exaggeration = *flags.exaggeration;
    if (flags.wireframe) view.wireframe = true;
    if (auto fine = check(view); !fine) return fine.error();
    if (flags.ramp) {
        auto ramp = viewer::read_height_ramp(*flags.ramp);
        if (!ramp) return Error{ramp.error().kind, "--ramp: " + ramp.error().message};
        view.ramp = std::make_shared<viewer::HeightRamp>(*std::move(ramp));
    }
    if (flags.waves) {
        auto map = read_waves(*flags.waves, view.ocean.wind.from);
        if (!map) return map.error();
        view.ocean.map = std::move(*map);
    }
    return view;
}

void place_view(viewer::ViewState& view, const ViewFlags& flags, const lod::Scene& scene,
                const lod::Terrain& terrain, const viewer::EyeHeight& heights, PictureSize size) {
    if (flags.at || flags.eye) return;
    viewer::look_over(view, terrain, scene.info(), heights, size.width, size.height);
    turn(view, flags);
}

Result<PictureSize> read_size(const ViewFlags& flags, PictureSize base) {
    if (!flags.size) return base;
    const std::string_view text = *flags.size;
    const std::size_t x = std::min(text.find('x'), text.size());
    const auto width = whole_number(text.substr(0, x));
    const auto height = whole_number(text.substr(std::min(x + 1, text.size())));
    const auto fits = [](std::optional<int> side) {
        return side && *side >= 1 && *side <= viewer::kLargestPicture;
    };
    if (!fits(width) || !fits(height)) {
        return usage(
            fmt::format("--size {}: expected WIDTHxHEIGHT, each 1 to {}", text, viewer::kLargestPicture));
    }
    return PictureSize{*width, *height};
}

Result<viewer::Marks> read_marks(const ViewFlags& flags, PictureSize size) {
    if (!flags.marks) return viewer::Marks{};
    const auto marks = viewer::parse_marks(*flags.marks);
    if (!marks) return usage("--marks: " + marks.error().message);
    if (marks->any() && (size.width < viewer::kLeastMarkedWidth || size.height < viewer::kLeastMarkedHeight))
        return usage(fmt::format("--marks: a picture with marks has at least {} x {} pixels",
                                 viewer::kLeastMarkedWidth, viewer::kLeastMarkedHeight));
    return *marks;
}

Result<int> read_samples(const ViewFlags& flags, int base) {
    const int samples = flags.samples.value_or(base);
    if (samples != 1 && samples != 4 && samples != 8)
        return usage(fmt::format("--samples {}: 1, 4 or 8", samples));
    return samples;
}

}  // namespace relevo::app
