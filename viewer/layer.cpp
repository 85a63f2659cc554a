#include "viewer/layer.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include <fmt/format.h>

namespace relevo::viewer {

namespace {

struct Stop {
    double at;
    double red, green, blue;
};

// From lowland green over dry grass and bare rock to snow; CIE lightness 47 to 97, rising all the way. No
// dark brown in the middle: darkness is left to the hillshade.
constexpr std::array<Stop, 7> kHypsometric{{{0.00, 72, 120, 84},
                                            {0.18, 118, 148, 92},
                                            {0.38, 170, 172, 108},
                                            {0.56, 205, 186, 136},
                                            {0.74, 219, 204, 176},
                                            {0.88, 233, 226, 216},
                                            {1.00, 250, 250, 252}}};

// From the shore down. Its lightest is darker than the green of the shore's other side: the coast is a line.
constexpr std::array<Stop, 4> kSea{
    {{0.00, 118, 170, 190}, {0.15, 90, 146, 178}, {0.50, 58, 108, 154}, {1.00, 30, 62, 112}}};

// Flat is nearly white, steep is dark: yellow at 15 degrees, orange at 30, red at 40, purple beyond.
constexpr std::array<Stop, 6> kSlope{{{0.00, 247, 247, 242},
                                      {0.25, 250, 224, 140},
                                      {0.50, 240, 144, 60},
                                      {0.67, 206, 62, 56},
                                      {0.83, 128, 28, 84},
                                      {1.00, 52, 14, 72}}};

// By compass: north blue, east green, south yellow, west red, and halfway between. Lightness 58 to 78:
// north-west, from where maps are lit, is about as light as south-east, for nothing here is light or shadow.
constexpr std::array<Stop, 9> kAspect{{{0.000, 98, 146, 214},
                                       {0.125, 84, 178, 190},
                                       {0.250, 110, 190, 112},
                                       {0.375, 180, 200, 84},
                                       {0.500, 238, 200, 84},
                                       {0.625, 238, 152, 84},
                                       {0.750, 218, 108, 108},
                                       {0.875, 168, 116, 184},
                                       {1.000, 98, 146, 214}}};

std::array<std::uint8_t, 4> colour_at(std::span<const Stop> stops, double at) {
    std::size_t upper = 1;
    while (upper + 1 < stops.size() && stops[upper].at < at) ++upper;
    const Stop& low = stops[upper - 1];
    const Stop& high = stops[upper];
    const double part = (at - low.at) / (high.at - low.at);
    const auto mixed = [part](double a, double b) {
        return static_cast<std::uint8_t>(std::lround(a + part * (b - a)));
    };
    return {mixed(low.red, high.red), mixed(low.green, high.green), mixed(low.blue, high.blue), 255};
}

constexpr int kTexels = 4096;  // of 2 m on the whole earth

}  // namespace

std::string_view to_string(Layer layer) {
    switch (layer) {
        case Layer::hypsometric:
            return "hypsometric";
        case Layer::hillshade:
            return "hillshade";
        case Layer::slope:
            return "slope";
        case Layer::terrain:
            return "terrain";
        case Layer::plain:
            return "plain";
        case Layer::aspect:
            return "aspect";
        case Layer::lod:
            break;
    }
    return "lod";
}

Result<Layer> parse_layer(std::string_view text) {
    for (const Layer layer : {Layer::hypsometric, Layer::hillshade, Layer::slope, Layer::aspect, Layer::lod,
                              Layer::terrain, Layer::plain}) {
        if (text == to_string(layer)) return layer;
    }
    if (text == "imagery") {
        return Error{
            ErrorKind::usage,
            "imagery is drawn over a layer: --imagery FILE; layers are hypsometric, hillshade, slope, "
            "aspect, lod, terrain and plain"};
    }
    return Error{
        ErrorKind::usage,
        fmt::format("no layer \"{}\": hypsometric, hillshade, slope, aspect, lod, terrain or plain", text)};
}

std::vector<std::array<std::uint8_t, 4>> colour_ramp(Layer layer, const HeightSpan& span) {
    std::vector<std::array<std::uint8_t, 4>> colours;
    colours.reserve(kTexels);
    for (int i = 0; i < kTexels; ++i) {
        const double at = i / (kTexels - 1.0);
        if (layer == Layer::slope) {
            colours.push_back(colour_at(kSlope, at));
            continue;
        }
        if (layer == Layer::aspect) {
            colours.push_back(colour_at(kAspect, at));
            continue;
        }
        const double H = span.low + at * (span.high - span.low);
        const double of_land =
            span.high > span.land_low ? (H - span.land_low) / (span.high - span.land_low) : 0.5;
        colours.push_back(colour_at(kHypsometric, std::clamp(of_land, 0.0, 1.0)));
    }
    return colours;
}

std::vector<std::array<std::uint8_t, 4>> sea_ramp(const HeightSpan& span) {
    // Both sides of 0 on one scale, so that the shallows of a scene that has nothing deeper look shallow.
    const double reach = std::max(std::abs(span.low), std::abs(span.high));
    std::vector<std::array<std::uint8_t, 4>> colours;
    colours.reserve(kTexels);
    for (int i = 0; i < kTexels; ++i) {
        const double H = span.low + i * (span.high - span.low) / (kTexels - 1);
        colours.push_back(colour_at(kSea, reach > 0 ? std::max(-H, 0.0) / reach : 0));
    }
    return colours;
}

}  // namespace relevo::viewer
