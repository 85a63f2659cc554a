#include "lod/ocean/wave_map_error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relevo::lod {

namespace {

constexpr int kPlaces = 1 << 15;
constexpr double kMargin = 1.1;
/// Spacing of the first error, a post to 1: half of the one from which on waves fade.
constexpr double kFinestPosts = 0.5 / kPostsPerSpacing;

struct Place {
    glm::dvec2 at;     // the tile to 1
    glm::dvec2 along;  // a direction
    double height_m;   // of the map there
};

/// Spread evenly over tile and directions: the additive recurrence of the powers of 1/g, g^4 = g + 1, which
/// is the golden ratio's for three numbers.
std::vector<Place> places_of(const WaveMap& map) {
    constexpr double kG = 1.2207440846057596;
    std::vector<Place> places;
    for (int i = 0; i < kPlaces; ++i) {
        const auto part = [i](double step) { return std::fmod(0.5 + i * step, 1.0); };
        const glm::dvec2 at(part(1 / kG), part(1 / (kG * kG)));
        const double angle = 2 * std::numbers::pi * part(1 / (kG * kG * kG));
        places.push_back({at, {std::cos(angle), std::sin(angle)}, map.tile_height(at, 0)});
    }
    return places;
}

/// \param spacing  parts of a tile
double largest_error(const WaveMap& map, const std::vector<Place>& places, double spacing) {
    const double reach = spacing / std::numbers::sqrt2;  // half a diagonal
    double most = 0;
    for (const Place& place : places) {
        const auto off = [&](const glm::dvec2& half) {
            const double drawn =
                0.5 * (map.tile_height(place.at + half, spacing) + map.tile_height(place.at - half, spacing));
            return std::abs(drawn - place.height_m);
        };
        const glm::dvec2 along = place.along * reach;
        most = std::max({most, off({0, 0}), off(along), off({-along.y, along.x})});
    }
    return most;
}

}  // namespace

WaveMapError::WaveMapError(const WaveMap& map) {
    for (const auto& copy : map.copies()) tile_m_.push_back(copy.tile_m);
    const int side = map.levels().front().side;
    finest_ = kFinestPosts / side;
    const auto places = places_of(map);
    double worst = 0;
    for (double spacing = finest_;; spacing *= std::numbers::sqrt2) {
        worst = std::max(worst, kMargin * largest_error(map, places, spacing));
        errors_.push_back(worst);
        if (kPostsPerSpacing * spacing >= 1) break;  // the last level, which is flat
    }
}

double WaveMapError::longest_m() const {
    return *std::max_element(tile_m_.begin(), tile_m_.end()) * std::numbers::sqrt2 / kPostsPerSpacing;
}

double WaveMapError::of_tile(double spacing) const {
    // Below the first it falls as the square of the spacing does; between two it is a power of the spacing.
    if (spacing <= finest_) return errors_.front() * (spacing / finest_) * (spacing / finest_);
    const double step = 2 * std::log2(spacing / finest_);
    if (!(step < static_cast<double>(errors_.size() - 1))) return errors_.back();
    const auto before = static_cast<std::size_t>(step);
    const double fine = errors_[before];
    return fine > 0 ? fine * std::pow(errors_[before + 1] / fine, step - static_cast<double>(before))
                    : errors_[before + 1];
}

double WaveMapError::at(double spacing_m) const {
    double sum = 0;
    for (const double tile_m : tile_m_) sum += of_tile(spacing_m / tile_m);
    return sum / std::numbers::sqrt2;
}

}  // namespace relevo::lod
