#include "viewer/view_state.hpp"

#include <functional>
#include <set>

#include <fmt/format.h>

#include "viewer/numbers.hpp"

namespace relevo::viewer {

namespace {

Error usage(std::string message) {
    return {ErrorKind::usage, std::move(message)};
}

/// Stores what a parser found, or says why not.
template <class T>
Result<void> keep(const Result<T>& parsed, T& place) {
    if (!parsed) return parsed.error();
    place = *parsed;
    return {};
}

Result<double> parse_number(std::string_view text) {
    const auto numbers = parse_numbers(text);
    if (!numbers || numbers->size() != 1) return usage(fmt::format("\"{}\" is not a number", text));
    return numbers->front();
}

Result<void> keep_number(std::string_view text, double& place) {
    return keep(parse_number(text), place);
}

Result<void> set(ViewState& view, std::string_view key, std::string_view value) {
    if (key == "heading") return keep_number(value, view.heading.value);
    if (key == "pitch") return keep_number(value, view.pitch.value);
    if (key == "roll") return keep_number(value, view.roll.value);
    if (key == "fov") return keep_number(value, view.fov.value);
    if (key == "tau") return keep_number(value, view.tau_px);
    if (key == "exaggeration") return keep_number(value, view.exaggeration);
    if (key == "lod") return keep(parse_method(value), view.method);
    if (key == "metric") return keep(parse_metric(value), view.metric);
    if (key == "morph") return keep(parse_switch(value), view.morph);
    if (key == "layer") return keep(parse_layer(value), view.layer);
    if (key == "overlays") return keep(parse_overlays(value), view.overlays);
    if (key == "wireframe") return keep(parse_switch(value), view.wireframe);
    if (key == "shading") return keep(parse_shading(value), view.shading);
    if (key == "sun") return keep(parse_sun(value), view.sun);
    if (key == "haze") return keep(parse_haze(value), view.haze);
    if (key == "ocean") return keep(parse_ocean(value), view.ocean.kind);
    if (key == "wind") return keep(parse_wind(value), view.ocean.wind);
    if (key == "time") return keep_number(value, view.ocean.time_s);
    return usage(fmt::format("\"{}\" is nothing that a view has", key));
}

}  // namespace

std::string_view to_string(Method method) {
    switch (method) {
        case Method::lstr:
            return "lstr";
        case Method::full:
            return "full";
        default:
            return "soar";
    }
}

Result<Method> parse_method(std::string_view text) {
    if (text == "soar") return Method::soar;
    if (text == "full") return Method::full;
    if (text == "lstr") return Method::lstr;
    return usage(fmt::format("no method \"{}\": soar, lstr or full", text));
}

std::string_view metric_name(lod::ErrorMetric metric) {
    return metric == lod::ErrorMetric::incremental ? "incremental" : "bounded";
}

Result<lod::ErrorMetric> parse_metric(std::string_view text) {
    if (text == "bounded") return lod::ErrorMetric::bounded;
    if (text == "incremental") return lod::ErrorMetric::incremental;
    return usage(fmt::format("no metric \"{}\": bounded or incremental", text));
}

Result<bool> parse_switch(std::string_view text) {
    if (text == "on") return true;
    if (text == "off") return false;
    return usage(fmt::format("\"{}\": expected on or off", text));
}

Result<void> check(const ViewState& view) {
    struct Range {
        const char* what;
        double value, least, most;
        bool open;  // the ends are not allowed
    };
    const Range ranges[] = {{"latitude", view.place.lat.value, -90, 90, false},
                            {"longitude", view.place.lon.value, -540, 540, false},
                            {"eye height", view.H.m, -20e3, 1e9, false},
                            {"heading", view.heading.value, -3600, 3600, false},
                            {"pitch", view.pitch.value, -90, 90, false},
                            {"roll", view.roll.value, -3600, 3600, false},
                            {"fov", view.fov.value, 0, 180, true},
                            {"tau", view.tau_px, 0, 1e6, true},
                            {"exaggeration", view.exaggeration, 0, 1000, false},
                            {"time", view.ocean.time_s, -1e9, 1e9, false}};
    for (const Range& range : ranges) {
        const bool inside = range.open ? range.value > range.least && range.value < range.most
                                       : range.value >= range.least && range.value <= range.most;
        if (!inside) {
            return usage(fmt::format("{} {}: must be {} {} and {} {}", range.what, range.value,
                                     range.open ? "above" : "at least", range.least,
                                     range.open ? "below" : "at most", range.most));
        }
    }
    return {};
}

std::string to_string(const ViewState& view) {
    // "{}" prints the shortest digits that read back as the same double.
    return fmt::format(
        "{},{},{}/heading={}/pitch={}/roll={}/fov={}/tau={}/lod={}/metric={}/morph={}/layer={}/wireframe={}/"
        "exaggeration={}/shading={}/sun={}/haze={}/ocean={}/wind={},{}/time={}/overlays={}",
        view.place.lat.value, view.place.lon.value, view.H.m, view.heading.value, view.pitch.value,
        view.roll.value, view.fov.value, view.tau_px, to_string(view.method), metric_name(view.metric),
        view.morph ? "on" : "off", to_string(view.layer), view.wireframe ? "on" : "off", view.exaggeration,
        to_string(view.shading), view.sun.text, to_string(view.haze), to_string(view.ocean.kind),
        view.ocean.wind.speed_m_s, view.ocean.wind.from.value, view.ocean.time_s, to_string(view.overlays));
}

Result<ViewState> parse_view_state(std::string_view text, const ViewState& base) {
    ViewState view = base;
    std::set<std::string_view> seen;
    bool first = true;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find('/', at), text.size());
        const std::string_view part = text.substr(at, end - at);
        at = end + 1;
        if (first) {
            const auto numbers = parse_numbers(part);
            if (!numbers || numbers->size() != 3) {
                return usage(
                    fmt::format("view \"{}\": expected LAT,LON,H and then /heading=90/pitch=-10...", text));
            }
            view.place = {geo::Degrees{(*numbers)[0]}, geo::Degrees{(*numbers)[1]}};
            view.H.m = (*numbers)[2];
            first = false;
            continue;
        }
        const std::size_t equals = part.find('=');
        if (equals == std::string_view::npos)
            return usage(fmt::format("view: \"{}\" is not KEY=VALUE", part));
        if (!seen.insert(part.substr(0, equals)).second) {
            return usage(fmt::format("view: {} is given twice", part.substr(0, equals)));
        }
        if (auto done = set(view, part.substr(0, equals), part.substr(equals + 1)); !done) {
            return usage(fmt::format("view: {}: {}", part.substr(0, equals), done.error().message));
        }
    }
    if (auto done = check(view); !done) return done.error();
    return view;
}

}  // namespace relevo::viewer
