#include "ingest/source/suspicions.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "ingest/reference/operation.hpp"

namespace relevo::ingest {
namespace {

/// Heights of windows spread over the source, sorted, without voids.
Result<std::vector<double>> sample(const Source& source) {
    constexpr int kWindows = 8;  // in each direction
    constexpr int kSide = 64;
    std::vector<double> heights;
    const auto starts = [](int length) {
        std::vector<int> first;
        if (length <= kWindows * kSide) {
            for (int i = 0; i < length; i += kSide) first.push_back(i);
        } else {
            for (int i = 0; i < kWindows; ++i)
                first.push_back(static_cast<int>(std::int64_t{length - kSide} * i / (kWindows - 1)));
        }
        return first;
    };
    for (const int row : starts(source.rows()))
        for (const int column : starts(source.columns())) {
            const auto window = source.read({column, row, std::min(kSide, source.columns() - column),
                                             std::min(kSide, source.rows() - row)});
            if (!window) return window.error();
            for (const double height : window->samples())
                if (std::isfinite(height)) heights.push_back(height);
        }
    std::sort(heights.begin(), heights.end());
    return heights;
}

/// Values that programs write where they know nothing. As the file has them, before units.
bool is_usual_code(double value) {
    constexpr std::array kCodes{-32768.0, -32767.0, -9999.0, -99999.0, -999.0, 32767.0, 65535.0, 9999.0};
    return std::abs(value) > 1e30 || std::find(kCodes.begin(), kCodes.end(), value) != kCodes.end();
}

/// A note if the value `extreme`, in `count` posts, with `next` the nearest other and `range` that of all
/// others, is hardly a height.
std::optional<std::string> undeclared_void(const HeightRule& rule, double extreme, std::size_t count,
                                           std::size_t all, double next, double range) {
    const double raw = (extreme - rule.offset) / rule.scale;
    const double gap = std::abs(extreme - next);
    const bool usual =
        is_usual_code(std::round(raw)) && std::abs(raw - std::round(raw)) < 1e-6 * std::abs(raw);
    const bool many = count >= 3 && count * 2000 >= all;
    constexpr double kFar = 500;  // metres: more than a cliff
    if (!many || !(gap > (usual ? kFar / 5 : std::max(kFar, range)))) return {};
    return fmt::format(
        "the value {:.10g} stands in {} of the {} posts looked at and is far from all others (the "
        "nearest is {:.6g} m): if it means void, say so with --nodata {:.10g}",
        raw, count, all, next, raw);
}

void note_undeclared_voids(const HeightRule& rule, const std::vector<double>& heights,
                           std::vector<std::string>& notes) {
    const auto all = heights.size();
    const auto after_lowest = std::upper_bound(heights.begin(), heights.end(), heights.front());
    const auto before_highest = std::lower_bound(heights.begin(), heights.end(), heights.back());
    if (after_lowest == heights.end()) {
        const double raw = (heights.front() - rule.offset) / rule.scale;
        if (is_usual_code(raw))
            notes.push_back(
                fmt::format("all posts looked at have the value {:.10g}: if it means void, say so with "
                            "--nodata {:.10g}",
                            raw, raw));
        return;
    }
    const double lowest_rest = *after_lowest;
    const double highest_rest = *(before_highest - 1);
    if (auto note =
            undeclared_void(rule, heights.front(), static_cast<std::size_t>(after_lowest - heights.begin()),
                            all, lowest_rest, heights.back() - lowest_rest))
        notes.push_back(std::move(*note));
    if (auto note =
            undeclared_void(rule, heights.back(), static_cast<std::size_t>(heights.end() - before_highest),
                            all, highest_rest, highest_rest - heights.front()))
        notes.push_back(std::move(*note));
}

std::optional<geo::LatLon> middle_of(const Source& source) {
    std::array<Place, 1> middle{source.posts().at({(source.columns() - 1) / 2.0, (source.rows() - 1) / 2.0})};
    const auto operation = Operation::to_wgs84(source.crs(), middle);
    if (!operation) return {};
    operation->forward(middle);
    if (!std::isfinite(middle[0].x) || !(std::abs(middle[0].y) <= 90)) return {};
    return geo::LatLon{geo::Degrees{middle[0].y}, geo::Degrees{middle[0].x}};
}

struct Part {
    double south, north, west, east;
    double highest_m;
};

// Parts of the world and their highest mountains; the first that holds a place counts.
constexpr std::array kParts{
    Part{-90, -60, -180, 180, 4892},  // Antarctica: Mount Vinson
    Part{59, 84, -56, -10, 3694},     // Greenland: Gunnbjorn Fjeld
    Part{30, 49, -125, -60, 4421},    // North America between Mexico and Canada: Mount Whitney
    Part{49, 72, -170, -52, 6190},    // Alaska and Canada: Denali
    Part{36, 72, -12, 30, 4810},      // Europe to the Black Sea: Mont Blanc
    Part{-36, 36, -20, 40, 5895},     // Africa: Kilimanjaro
    Part{-56, 13, -82, -34, 6961},    // South America: Aconcagua
    Part{-48, -11, 110, 180, 3724},   // Australia and New Zealand: Aoraki
    Part{30, 46, 129, 146, 3776},     // Japan: Fuji
};
constexpr double kHighest = 8850;  // Everest
constexpr double kDeepest = -11000;

}  // namespace

double highest_ground_m(const geo::LatLon& place) {
    const double lat = place.lat.value;
    const double lon = geo::wrapped_180(place.lon).value;
    for (const Part& part : kParts)
        if (lat >= part.south && lat <= part.north && lon >= part.west && lon <= part.east)
            return part.highest_m;
    return kHighest;
}

Result<std::vector<std::string>> suspicions(const Source& source, const std::optional<geo::LatLon>& where) {
    const auto heights = sample(source);
    if (!heights) return heights.error();
    std::vector<std::string> notes;
    if (heights->empty()) return notes;
    note_undeclared_voids(source.heights(), *heights, notes);
    if (!notes.empty()) return notes;  // they would spoil the judgement on units

    // One post in 2000 may be a spike.
    const std::size_t spikes = heights->size() / 2000;
    const double high = (*heights)[heights->size() - 1 - spikes];
    const double low = (*heights)[spikes];
    const double limit = where ? highest_ground_m(*where) : kHighest;
    // Heights above an ellipsoid are up to 85 m larger; a coarse table deserves some slack.
    if (high > limit * 1.02 + 100)
        notes.push_back(
            fmt::format("heights reach {:.0f} m, but no ground {} is higher than {:.0f} m: they may be "
                        "feet (--height-scale 0.3048) or decimetres (--height-scale 0.1)",
                        high, where ? "in that part of the world" : "on earth", limit));
    if (low < kDeepest)
        notes.push_back(
            fmt::format("heights go down to {:.0f} m, below the deepest sea: voids may be undeclared "
                        "(--nodata) or the unit another (--height-scale)",
                        low));
    return notes;
}

std::vector<std::string> suspicions_about(const std::vector<SourceRequest>& requests) {
    std::vector<std::string> notes;
    const std::size_t stride = 1 + requests.size() / kMostSuspected;
    for (std::size_t i = 0; i < requests.size(); i += stride) {
        const auto source = Source::open(requests[i]);
        if (!source) continue;
        const auto found = suspicions(*source, middle_of(*source));
        if (!found) continue;
        for (const auto& note : *found) notes.push_back(source->name() + ": " + note);
    }
    return notes;
}

}  // namespace relevo::ingest
