#include "viewer/height_ramp.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>

#include <fmt/format.h>

#include "viewer/numbers.hpp"

namespace relevo::viewer {

namespace {

constexpr int kTexels = 4096;

constexpr std::string_view kViridis =
    "0% 68 1 84\n12.5% 71 44 122\n25% 59 81 139\n37.5% 44 113 142\n50% 33 144 141\n62.5% 39 173 129\n"
    "75% 92 200 99\n87.5% 170 220 50\n100% 253 231 37\n";
constexpr std::string_view kGrey = "0% 40 40 40\n100% 250 250 250\n";
constexpr std::string_view kClassic =
    "0% 60 140 80\n20% 150 180 90\n40% 230 210 130\n60% 190 140 90\n80% 140 110 100\n100% 255 255 255\n";

Error wrong(int line, std::string what) {
    return {ErrorKind::usage, fmt::format("line {}: {}", line, what)};
}

/// The words of a line.
std::vector<std::string_view> words(std::string_view line) {
    constexpr std::string_view kBlanks = " \t,:;\r";
    std::vector<std::string_view> found;
    while (true) {
        const std::size_t begin = line.find_first_not_of(kBlanks);
        if (begin == std::string_view::npos) return found;
        line.remove_prefix(begin);
        const std::size_t end = std::min(line.find_first_of(kBlanks), line.size());
        found.push_back(line.substr(0, end));
        line.remove_prefix(end);
    }
}

std::optional<double> number(std::string_view text) {
    const auto numbers = parse_numbers(text);
    if (!numbers || numbers->size() != 1) return std::nullopt;
    return numbers->front();
}

Result<HeightRamp::Stop> parse_stop(const std::vector<std::string_view>& line, int at) {
    HeightRamp::Stop stop;
    if (line.size() != 4 && line.size() != 5)
        return wrong(at, "expected a height and three colours: 1500 120 90 60");
    std::string_view height = line[0];
    stop.is_part = height.ends_with('%');
    if (stop.is_part) height.remove_suffix(1);
    const auto value = number(height);
    if (!value) return wrong(at, fmt::format("\"{}\" is not a height", line[0]));
    stop.at = stop.is_part ? *value / 100 : *value;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto colour = number(line[i + 1]);
        if (!colour || !(*colour >= 0 && *colour <= 255))
            return wrong(at, fmt::format("\"{}\" is not a colour, 0 to 255", line[i + 1]));
        stop.colour[i] = *colour;
    }
    return stop;
}

}  // namespace

Result<HeightRamp> parse_height_ramp(std::string_view text) {
    HeightRamp ramp;
    int at = 0;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const auto line = words(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        ++at;
        if (line.empty() || line[0].starts_with('#') || line[0] == "nv") continue;
        const auto stop = parse_stop(line, at);
        if (!stop) return stop.error();
        ramp.stops.push_back(*stop);
    }
    if (ramp.stops.empty()) return Error{ErrorKind::usage, "it has no line of a height and three colours"};
    return ramp;
}

Result<HeightRamp> read_height_ramp(const std::string& name_or_file) {
    if (name_or_file == "viridis") return parse_height_ramp(kViridis);
    if (name_or_file == "grey") return parse_height_ramp(kGrey);
    if (name_or_file == "classic") return parse_height_ramp(kClassic);
    std::ifstream file(name_or_file);
    if (!file)
        return Error{ErrorKind::input,
                     fmt::format("{}: no ramp and no file that can be read. Ramps are viridis, grey "
                                 "and classic",
                                 name_or_file)};
    constexpr std::size_t kMost = 1 << 20;
    std::string text;
    char c = 0;
    while (text.size() <= kMost && file.get(c)) text += c;
    if (text.size() > kMost)
        return Error{ErrorKind::input, fmt::format("{}: too large for a ramp", name_or_file)};
    auto ramp = parse_height_ramp(text);
    if (!ramp) return Error{ErrorKind::input, fmt::format("{}: {}", name_or_file, ramp.error().message)};
    return ramp;
}

std::vector<std::array<std::uint8_t, 4>> colours_of(const HeightRamp& ramp, const HeightSpan& span) {
    std::vector<HeightRamp::Stop> stops = ramp.stops;
    for (HeightRamp::Stop& stop : stops) {
        if (stop.is_part) stop.at = span.low + stop.at * (span.high - span.low);
    }
    std::stable_sort(stops.begin(), stops.end(), [](const auto& a, const auto& b) { return a.at < b.at; });
    std::vector<std::array<std::uint8_t, 4>> colours;
    colours.reserve(kTexels);
    for (int i = 0; i < kTexels; ++i) {
        const double H = span.low + (span.high - span.low) * i / (kTexels - 1);
        const auto above = std::find_if(stops.begin(), stops.end(),
                                        [&](const HeightRamp::Stop& stop) { return stop.at > H; });
        const auto& high = above == stops.end() ? stops.back() : *above;
        const auto& low = above == stops.begin() ? stops.front() : *std::prev(above);
        const double part = high.at > low.at ? std::clamp((H - low.at) / (high.at - low.at), 0.0, 1.0) : 0;
        std::array<std::uint8_t, 4> colour{0, 0, 0, 255};
        for (std::size_t k = 0; k < 3; ++k)
            colour[k] =
                static_cast<std::uint8_t>(std::lround(std::lerp(low.colour[k], high.colour[k], part)));
        colours.push_back(colour);
    }
    return colours;
}

}  // namespace relevo::viewer
