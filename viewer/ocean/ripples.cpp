#include "viewer/ocean/ripples.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "lod/ocean/waves.hpp"

namespace relevo::viewer {

namespace {

constexpr int kWaves = 10;  // a layer
constexpr int kFewest = 8;  // waves a tile; four times as many are the shortest
/// Of the sea's variance of slope what is seen of two octaves. (There is about twice as much, from the
/// longest waves down to a centimetre; but slopes of patterns that repeat catch the eye.)
constexpr double kShare = 0.05;
constexpr double kTurn = 2 * std::numbers::pi;

double uniform(std::mt19937_64& random) {
    return static_cast<double>(random() >> 11) * 0x1p-53;
}

}  // namespace

Ripples::Ripples(const lod::Wind& wind) {
    const lod::WindSea sea(wind);
    if (wind.speed_m_s <= 0) return;
    const double towards = (90 - wind.from.value + 180) / 360 * kTurn;  // counter-clockwise from east
    std::mt19937_64 random(3);
    for (std::size_t layer = 0; layer < kLayers; ++layer) {
        // No waves are longer than the wind raises.
        const double raised = std::min(1.0, sea.peak_length_m() / length_m(static_cast<int>(layer)));
        const double variance = kShare * lod::cox_munk_slope_variance(wind.speed_m_s) * raised * raised;
        const double slope = std::sqrt(2 * variance / kWaves);
        for (int i = 0; i < kWaves; ++i) {
            const double count = kFewest * std::exp2(2 * (i + uniform(random)) / kWaves);
            const double angle =
                towards + 1.1 * (uniform(random) + uniform(random) - 1) - turned(static_cast<int>(layer));
            Wave wave{static_cast<int>(std::lround(count * std::cos(angle))),
                      static_cast<int>(std::lround(count * std::sin(angle))), slope, 0,
                      kTurn * uniform(random)};
            if (wave.east == 0 && wave.north == 0) wave.east = kFewest;
            wave.omega =
                lod::deep_water_rad_s(tile_m(static_cast<int>(layer)) / std::hypot(wave.east, wave.north));
            waves_[layer].push_back(wave);
        }
        steepest_[layer] = 3 * std::sqrt(variance);
    }
}

void Ripples::bake(int layer, double time_s, std::vector<std::uint8_t>& rg) const {
    const auto at = static_cast<std::size_t>(layer);
    std::array<float, kSide> sines{};
    for (int i = 0; i < kSide; ++i)
        sines[static_cast<std::size_t>(i)] = static_cast<float>(std::sin(kTurn * i / kSide));
    std::vector<float> slopes(std::size_t{2} * kSide * kSide, 0.0F);
    for (const Wave& wave : waves_[at]) {
        // sin(a + b) with a from the table: no sine a texel.
        const double b = wave.phase - std::fmod(wave.omega * time_s, kTurn);
        const double along = wave.slope / std::hypot(wave.east, wave.north) / steepest_[at];
        const auto cosine = static_cast<float>(std::cos(b));
        const auto sine = static_cast<float>(std::sin(b));
        const auto east = static_cast<float>(along * wave.east);
        const auto north = static_cast<float>(along * wave.north);
        for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide; ++x) {
                const auto a = static_cast<unsigned>(wave.east * x + wave.north * y);
                const float s = sines[a % kSide] * cosine + sines[(a + kSide / 4) % kSide] * sine;
                float* to = slopes.data() + 2 * (y * kSide + x);
                to[0] += east * s;
                to[1] += north * s;
            }
        }
    }
    rg.resize(slopes.size());
    std::transform(slopes.begin(), slopes.end(), rg.begin(), [](float slope) {
        return static_cast<std::uint8_t>(std::lround(127.5F + 127.5F * std::clamp(slope, -1.0F, 1.0F)));
    });
}

}  // namespace relevo::viewer
