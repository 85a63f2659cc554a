#include "viewer/overlay/overlay.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "viewer/numbers.hpp"

namespace relevo::viewer {

namespace {

constexpr double kLeastInterval = 0.01;
constexpr double kMostInterval = 1e5;

Error usage(std::string message) {
    return {ErrorKind::usage, std::move(message)};
}

/// Cuts off what is before the first `at`; all where there is none.
std::string_view cut(std::string_view& text, char at) {
    const std::size_t end = std::min(text.find(at), text.size());
    const std::string_view part = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    return part;
}

Result<double> number(std::string_view text, double least, double most) {
    const auto numbers = parse_numbers(text);
    if (!numbers || numbers->size() != 1 || !(numbers->front() >= least && numbers->front() <= most))
        return usage(fmt::format("\"{}\" is not a number from {} to {}", text, least, most));
    return numbers->front();
}

Result<Overlay> with_opacity(Overlay overlay, std::string_view text) {
    if (text.empty()) return overlay;
    const auto opacity = number(text, 0, 1);
    if (!opacity) return usage("opacity: " + opacity.error().message);
    overlay.opacity = *opacity;
    return overlay;
}

std::string_view kind_name(Overlay::Kind kind) {
    switch (kind) {
        case Overlay::Kind::graticule:
            return "graticule";
        case Overlay::Kind::imagery:
            return "imagery";
        case Overlay::Kind::vectors:
            return "vectors";
        case Overlay::Kind::contours:
            break;
    }
    return "contours";
}

std::string what_text(const Overlay& overlay) {
    switch (overlay.kind) {
        case Overlay::Kind::contours:
            return overlay.interval_m == 0 ? "auto" : fmt::format("{}", overlay.interval_m);
        case Overlay::Kind::graticule:
            return overlay.utm ? "utm" : "latlon";
        default:
            return fmt::format("{}", overlay.file);
    }
}

Result<Overlay> contours(std::string_view what) {
    Overlay overlay{.kind = Overlay::Kind::contours};
    if (what == "auto") return overlay;
    const auto interval = number(what, kLeastInterval, kMostInterval);
    if (!interval) return usage("expected auto or metres: " + interval.error().message);
    overlay.interval_m = *interval;
    return overlay;
}

Result<Overlay> graticule(std::string_view what) {
    Overlay overlay{.kind = Overlay::Kind::graticule};
    if (what != "auto" && what != "latlon" && what != "utm")
        return usage(fmt::format("no graticule \"{}\": auto, latlon, utm or off", what));
    overlay.utm = what == "utm";
    return overlay;
}

Result<Overlay> of_file(Overlay::Kind kind, std::string_view what) {
    const auto file = number(what, 0, kMostOverlays - 1);
    if (!file || *file != std::floor(*file)) return usage(fmt::format("\"{}\" is no number of a file", what));
    return Overlay{.kind = kind, .file = static_cast<int>(*file)};
}

Result<Overlay> parse_overlay(std::string_view text) {
    const std::string_view kind = cut(text, ':');
    const std::string_view what = cut(text, ':');
    auto overlay = kind == "contours"    ? contours(what)
                   : kind == "graticule" ? graticule(what)
                   : kind == "imagery"   ? of_file(Overlay::Kind::imagery, what)
                   : kind == "vectors"
                       ? of_file(Overlay::Kind::vectors, what)
                       : Result<Overlay>(usage(fmt::format(
                             "no overlay \"{}\": contours, graticule, imagery or vectors", kind)));
    if (!overlay) return overlay;
    return with_opacity(*overlay, text);
}

}  // namespace

std::string to_string(const Overlays& overlays) {
    if (overlays.empty()) return "none";
    std::string text;
    for (const Overlay& overlay : overlays)
        text += fmt::format("{}{}:{}:{}", text.empty() ? "" : ",", kind_name(overlay.kind),
                            what_text(overlay), overlay.opacity);
    return text;
}

Result<Overlays> parse_overlays(std::string_view text) {
    Overlays overlays;
    if (text == "none") return overlays;
    do {
        const auto overlay = parse_overlay(cut(text, ','));
        if (!overlay) return overlay.error();
        overlays.push_back(*overlay);
    } while (!text.empty());
    if (overlays.size() > kMostOverlays) return usage(fmt::format("more than {} overlays", kMostOverlays));
    for (const Overlay::Kind kind : {Overlay::Kind::contours, Overlay::Kind::graticule}) {
        const auto count = std::count_if(overlays.begin(), overlays.end(),
                                         [&](const Overlay& overlay) { return overlay.kind == kind; });
        if (count > 1) return usage(fmt::format("{} are given twice", kind_name(kind)));
    }
    return overlays;
}

Result<Overlay> parse_contours(std::string_view text) {
    const auto overlay = contours(cut(text, ','));
    if (!overlay) return overlay;
    return with_opacity(*overlay, text);
}

Result<std::optional<Overlay>> parse_graticule(std::string_view text) {
    if (text == "off") return std::optional<Overlay>{};
    auto overlay = graticule(cut(text, ','));
    if (overlay) overlay = with_opacity(*overlay, text);
    if (!overlay) return overlay.error();
    return std::optional(*overlay);
}

const Overlay* find(const Overlays& overlays, Overlay::Kind kind) {
    const auto found =
        std::find_if(overlays.begin(), overlays.end(), [&](const Overlay& o) { return o.kind == kind; });
    return found == overlays.end() ? nullptr : &*found;
}

}  // namespace relevo::viewer
