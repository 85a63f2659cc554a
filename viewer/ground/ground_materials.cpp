#include "viewer/ground/ground_materials.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "viewer/ground/periodic_noise.hpp"

namespace relevo::viewer {

namespace {

constexpr auto kTexels = static_cast<std::size_t>(kMaterialSide) * kMaterialSide;

/// A place of a tile before it is brought to its mean: any units.
struct Sample {
    double height;
    double brightness;
    double colour;
};

/// Tufts, and leaves between them; light on top and dark in the gaps. Nothing as large as the tile, here and
/// below: it would be seen to repeat.
Sample grass(const PeriodicNoise& noise, double x, double y) {
    const double bent = 0.02 * noise.octaves(x + 0.3, y, 6, 3);
    const double tufts = noise.octaves(x, y, 9, 3, 0.8);
    const double leaves = std::abs(noise.octaves(x + bent, y - bent, 36, 3, 0.8));
    return {0.6 * tufts + 0.5 * leaves, 0.4 * tufts + 1.6 * leaves, noise.octaves(y + 0.11, x, 7, 4, 0.8)};
}

/// Ridges on ridges, with cracks that stay dark.
Sample rock(const PeriodicNoise& noise, double x, double y) {
    const double bent_x = x + 0.06 * noise.octaves(x, y, 3, 3);
    const double bent_y = y + 0.06 * noise.octaves(x, y + 0.37, 3, 3);
    double ridges = 0;
    double amplitude = 1;
    for (int octave = 0, cells = 4; octave < 5; ++octave, cells *= 2, amplitude *= 0.55)
        ridges -= amplitude * std::abs(noise.gradient(bent_x, bent_y, cells));
    const auto block = noise.cellular(bent_x, bent_y, 7);
    const double crack = std::min((block.second - block.nearest) / 0.12, 1.0);
    const double grains = noise.octaves(x, y, 48, 2);
    return {ridges + 0.12 * crack + 0.03 * grains + 0.1 * block.number,
            ridges + 0.12 * crack + 0.3 * grains + 0.12 * block.number,
            noise.octaves(y, x, 3, 4, 0.6) + 0.3 * block.number};
}

/// Stones of three sizes, the smaller ones in the gaps between the larger.
Sample gravel(const PeriodicNoise& noise, double x, double y) {
    Sample sample{};
    double free = 1;
    for (const int cells : {11, 24, 52}) {
        const auto stone = noise.cellular(x, y, cells);
        const double size = 0.35 + 0.3 * stone.number;
        const double dome = std::sqrt(std::max(1 - std::pow(stone.nearest / size, 2), 0.0));
        const double share = free * std::min(3 * dome, 1.0);
        sample.height += share * dome * 11.0 / cells;
        sample.brightness += share * (0.6 * stone.number + 0.5 * dome);
        sample.colour += share * stone.number;
        free -= share;
    }
    const double dust = noise.octaves(x, y, 30, 3, 0.7);
    return {sample.height + 0.05 * dust, sample.brightness + 0.15 * dust,
            sample.colour + 0.8 * noise.octaves(y, x, 3, 3)};
}

/// Drifts that the wind has drawn out, and a fine crust.
Sample snow(const PeriodicNoise& noise, double x, double y) {
    const double bent = 0.05 * noise.octaves(x, y, 3, 2);
    const double drifts = noise.octaves(x + bent, y, 6, 3, 0.6);
    const double crust = noise.gradient(x, y + bent, 32) + 0.5 * noise.gradient(x, y, 64);
    return {drifts + 0.05 * crust, 0.7 * drifts + 0.25 * crust, noise.octaves(y, x, 4, 3)};
}

/// Equally much of every size, for it belongs to no material.
Sample grain(const PeriodicNoise& noise, double x, double y) {
    const auto clod = noise.cellular(x, y, 14);
    const double rough = noise.octaves(x, y, 10, 4, 0.8);
    return {rough - 0.4 * clod.nearest, rough + 0.3 * (clod.number - clod.nearest),
            noise.octaves(y + 0.21, x, 5, 4, 0.7)};
}

Sample sample(Material material, const PeriodicNoise& noise, double x, double y) {
    switch (material) {
        case Material::grass:
            return grass(noise, x, y);
        case Material::rock:
            return rock(noise, x, y);
        case Material::gravel:
            return gravel(noise, x, y);
        case Material::snow:
            return snow(noise, x, y);
        case Material::grain:
            break;
    }
    return grain(noise, x, y);
}

/// Brings values to a mean of 0.5 and a scatter that leaves nearly all of them between 0 and 1, and into a
/// channel of the texels.
void store(std::span<const double> values, std::size_t channel, std::vector<MaterialTexel>& texels) {
    constexpr double kScatter = 0.17;  // three times it is 0.5
    double sum = 0;
    double squares = 0;
    for (const double value : values) sum += value, squares += value * value;
    const double mean = sum / static_cast<double>(values.size());
    const double scatter = std::sqrt(squares / static_cast<double>(values.size()) - mean * mean);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double part = 0.5 + kScatter * (values[i] - mean) / scatter;
        texels[i][channel] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(part, 0.0, 1.0)));
    }
}

}  // namespace

std::string_view to_string(Material material) {
    constexpr std::array<std::string_view, kMaterials> kNames{"grass", "rock", "gravel", "snow", "grain"};
    return kNames[static_cast<std::size_t>(material)];
}

std::vector<MaterialTexel> material_tile(Material material, std::uint64_t seed) {
    const PeriodicNoise noise(seed * kMaterials + static_cast<std::uint64_t>(material));
    std::vector<double> heights(kTexels), brightness(kTexels), colour(kTexels);
    for (std::size_t i = 0; i < kTexels; ++i) {
        const Sample at = sample(material, noise, static_cast<double>(i % kMaterialSide) / kMaterialSide,
                                 static_cast<double>(i / kMaterialSide) / kMaterialSide);
        heights[i] = at.height;
        brightness[i] = at.brightness;
        colour[i] = at.colour;
    }
    std::vector<double> right(kTexels), up(kTexels);
    for (std::size_t i = 0; i < kTexels; ++i) {
        const std::size_t column = i % kMaterialSide;
        const std::size_t row = i - column;
        right[i] = heights[row + (column + 1) % kMaterialSide] -
                   heights[row + (column + kMaterialSide - 1) % kMaterialSide];
        up[i] = heights[(i + kMaterialSide) % kTexels] - heights[(i + kTexels - kMaterialSide) % kTexels];
    }
    std::vector<MaterialTexel> texels(kTexels);
    store(brightness, 0, texels);
    store(colour, 1, texels);
    store(right, 2, texels);
    store(up, 3, texels);
    return texels;
}

}  // namespace relevo::viewer
