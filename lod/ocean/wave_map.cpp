#include "lod/ocean/wave_map.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <numbers>
#include <span>

#include <glm/geometric.hpp>

#include "geo/cubic_spline.hpp"
#include "lod/ocean/waves.hpp"

namespace relevo::lod {

namespace {

constexpr double kSecondScale = 3.7;
constexpr geo::Degrees kSecondTurn{37};

/// A square of numbers that repeats.
struct Square {
    std::size_t side;
    std::vector<double> values;

    double at(std::size_t column, std::size_t row) const {
        return values[(row & (side - 1)) * side + (column & (side - 1))];
    }
};

Square halved(const Square& fine) {
    Square coarse{fine.side / 2, {}};
    for (std::size_t row = 0; row < fine.side; row += 2) {
        for (std::size_t column = 0; column < fine.side; column += 2) {
            coarse.values.push_back(0.25 * (fine.at(column, row) + fine.at(column + 1, row) +
                                            fine.at(column, row + 1) + fine.at(column + 1, row + 1)));
        }
    }
    return coarse;
}

void transpose(Square& square) {
    for (std::size_t row = 0; row < square.side; ++row) {
        for (std::size_t column = 0; column < row; ++column) {
            std::swap(square.values[row * square.side + column], square.values[column * square.side + row]);
        }
    }
}

Square spline_coefficients(Square square) {
    for (int axis = 0; axis < 2; ++axis) {
        const std::span<double> all(square.values);
        for (std::size_t row = 0; row < square.side; ++row) {
            geo::to_periodic_spline_coefficients(all.subspan(row * square.side, square.side));
        }
        transpose(square);
    }
    return square;
}

double variance_of(const Square& square) {
    double sum = 0;
    for (const double h : square.values) sum += h * h;
    return sum / static_cast<double>(square.values.size());
}

/// Of the slopes at the posts, a post to 1. The spline's slope there is (c[1] - c[-1]) / 2 along its axis,
/// with the spline's value, (c[-1] + 4 c[0] + c[1]) / 6, taken across.
double slope_variance_of(const Square& c) {
    double sum = 0;
    const std::size_t before = c.side - 1;
    for (std::size_t row = 0; row < c.side; ++row) {
        for (std::size_t column = 0; column < c.side; ++column) {
            const auto east = [&](std::size_t r) { return c.at(column + 1, r) - c.at(column + before, r); };
            const auto north = [&](std::size_t k) { return c.at(k, row + 1) - c.at(k, row + before); };
            const double x = (east(row + before) + 4 * east(row) + east(row + 1)) / 12;
            const double y = (north(column + before) + 4 * north(column) + north(column + 1)) / 12;
            sum += x * x + y * y;
        }
    }
    return sum / static_cast<double>(c.values.size());
}

WaveMap::Level level_of(const Square& square) {
    WaveMap::Level level{static_cast<int>(square.side), {}};
    for (const double value : square.values) level.coefficients.push_back(static_cast<float>(value));
    return level;
}

/// \param at  a tile to 1
double spline_at(const WaveMap::Level& level, const glm::dvec2& at) {
    const double x = (at.x - std::floor(at.x)) * level.side - 0.5;
    const double y = (at.y - std::floor(at.y)) * level.side - 0.5;
    const double left = std::floor(x);
    const double below = std::floor(y);
    const auto across = geo::spline_weights(x - left);
    const auto up = geo::spline_weights(y - below);
    double sum = 0;
    const int mask = level.side - 1;
    for (int j = 0; j < 4; ++j) {
        const int first = ((static_cast<int>(below) + j - 1) & mask) * level.side;
        const float* const row = level.coefficients.data() + first;
        double line = 0;
        for (int i = 0; i < 4; ++i) {
            line += across[static_cast<std::size_t>(i)] *
                    static_cast<double>(row[(static_cast<int>(left) + i - 1) & mask]);
        }
        sum += up[static_cast<std::size_t>(j)] * line;
    }
    return sum;
}

}  // namespace

WaveMap::WaveMap(int side, const std::vector<float>& heights_m, double tile_m, geo::Degrees wind_from) {
    assert(side > 0 && std::has_single_bit(static_cast<unsigned>(side)) && tile_m > 0);
    Square square{static_cast<std::size_t>(side), {heights_m.begin(), heights_m.end()}};
    assert(square.values.size() == square.side * square.side);
    double mean = 0;
    for (const double h : square.values) mean += h;
    mean /= static_cast<double>(square.values.size());
    for (double& h : square.values) h -= mean;

    const Square coefficients = spline_coefficients(square);
    const double slopes = slope_variance_of(coefficients);
    mean_length_m_ =
        slopes > 0 ? 2 * std::numbers::pi * std::sqrt(variance_of(square) / slopes) * tile_m / side : tile_m;

    levels_.push_back(level_of(coefficients));
    while (square.side > 1) {
        square = halved(square);
        levels_.push_back(level_of(square));
    }
    levels_.back().coefficients.front() = 0;  // the mean: but for rounding it is

    const double towards = wind_from.radians() + std::numbers::pi;
    const glm::dvec2 along(std::sin(towards), std::cos(towards));
    const auto copy = [&](double scale, geo::Degrees turn) {
        const double length = mean_length_m_ * scale;
        const double speed = deep_water_rad_s(length) * length / (2 * std::numbers::pi);
        return Copy{
            tile_m * scale, {std::cos(turn.radians()), std::sin(turn.radians())}, along * speed, length};
    };
    copies_ = {copy(1, geo::Degrees{0}), copy(kSecondScale, kSecondTurn)};
}

glm::dvec2 WaveMap::Copy::in_tile(const glm::dvec2& at, double time_s) const {
    const glm::dvec2 moved = (at - velocity_m_s * time_s) / tile_m;
    return {turn.x * moved.x + turn.y * moved.y, turn.x * moved.y - turn.y * moved.x};
}

double WaveMap::tile_height(const glm::dvec2& at, double spacing) const {
    const double posts = kPostsPerSpacing * spacing * levels_.front().side;
    const double octave = std::min(std::log2(std::max(posts, 1.0)), static_cast<double>(levels_.size() - 1));
    const auto level = static_cast<std::size_t>(octave);
    const double part = octave - static_cast<double>(level);
    const double fine = spline_at(levels_[level], at);
    return part > 0 ? std::lerp(fine, spline_at(levels_[level + 1], at), part) : fine;
}

double WaveMap::height(const glm::dvec2& at, double time_s, double spacing_m, double depth_m) const {
    double sum = 0;
    for (const Copy& copy : copies_) {
        sum += tile_height(copy.in_tile(at, time_s), spacing_m / copy.tile_m) *
               depth_part(depth_m, copy.length_m);
    }
    return sum / std::numbers::sqrt2;
}

double WaveMap::crest_m() const {
    // Posts are weighted means of level 0's coefficients, and coarser levels are means of posts.
    double most = 0;
    for (const float c : levels_.front().coefficients)
        most = std::max(most, std::abs(static_cast<double>(c)));
    return std::numbers::sqrt2 * most;
}

}  // namespace relevo::lod
