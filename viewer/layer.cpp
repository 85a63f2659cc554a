#include "viewer/layer.hpp"

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

// Flat is nearly white, steep is dark: yellow at 15 degrees, orange at 30, red at 40, purple beyond.
constexpr std::array<Stop, 6> kSlope{{{0.00, 247, 247, 242},
                                      {0.25, 250, 224, 140},
                                      {0.50, 240, 144, 60},
                                      {0.67, 206, 62, 56},
                                      {0.83, 128, 28, 84},
                                      {1.00, 52, 14, 72}}};

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

}  // namespace

std::string_view to_string(Layer layer) {
    switch (layer) {
        case Layer::hypsometric:
            return "hypsometric";
        case Layer::hillshade:
            return "hillshade";
        case Layer::slope:
            return "slope";
        case Layer::lod:
            break;
    }
    return "lod";
}

Result<Layer> parse_layer(std::string_view text) {
    for (const Layer layer : {Layer::hypsometric, Layer::hillshade, Layer::slope, Layer::lod}) {
        if (text == to_string(layer)) return layer;
    }
    if (text == "terrain" || text == "imagery") {
        return Error{
            ErrorKind::usage,
            fmt::format("the layer \"{}\" comes with a later version; hypsometric, hillshade, slope and lod "
                        "are here",
                        text)};
    }
    return Error{ErrorKind::usage,
                 fmt::format("no layer \"{}\": hypsometric, hillshade, slope or lod", text)};
}

std::vector<std::array<std::uint8_t, 4>> colour_ramp(Layer layer) {
    std::vector<std::array<std::uint8_t, 4>> colours;
    colours.reserve(256);
    for (int i = 0; i < 256; ++i) {
        const double at = i / 255.0;
        colours.push_back(layer == Layer::slope ? colour_at(kSlope, at) : colour_at(kHypsometric, at));
    }
    return colours;
}

}  // namespace relevo::viewer
