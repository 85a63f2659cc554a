#include "viewer/ground/periodic_noise.hpp"

#include <cmath>

namespace relevo::viewer {

namespace {

int wrapped(int at, int cells) {
    return (at % cells + cells) % cells;
}

double smooth(double t) {
    return t * t * t * (t * (6 * t - 15) + 10);
}

/// The finaliser of splitmix64 (S. Vigna).
std::uint64_t mixed(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

}  // namespace

std::array<double, 2> PeriodicNoise::at(int column, int row, int cells) const {
    const auto place = static_cast<std::uint64_t>(wrapped(column, cells)) << 40 |
                       static_cast<std::uint64_t>(wrapped(row, cells)) << 20 |
                       static_cast<std::uint64_t>(cells);
    const std::uint64_t bits = mixed(mixed(place) + seed_ * 0x9e3779b97f4a7c15u);
    return {static_cast<double>(bits >> 32) * 0x1p-32, static_cast<double>(bits & 0xffffffffu) * 0x1p-32};
}

double PeriodicNoise::gradient(double x, double y, int cells) const {
    const double column = std::floor(x * cells);
    const double row = std::floor(y * cells);
    const double u = x * cells - column;
    const double v = y * cells - row;
    const auto corner = [&](int right, int down) {
        const auto slope = at(static_cast<int>(column) + right, static_cast<int>(row) + down, cells);
        return (2 * slope[0] - 1) * (u - right) + (2 * slope[1] - 1) * (v - down);
    };
    const double upper = std::lerp(corner(0, 0), corner(1, 0), smooth(u));
    const double lower = std::lerp(corner(0, 1), corner(1, 1), smooth(u));
    return std::lerp(upper, lower, smooth(v));
}

double PeriodicNoise::octaves(double x, double y, int cells, int count, double falling) const {
    double sum = 0;
    double amplitude = 1;
    for (int i = 0; i < count; ++i, cells *= 2, amplitude *= falling)
        sum += amplitude * gradient(x, y, cells);
    return sum;
}

PeriodicNoise::Cell PeriodicNoise::cellular(double x, double y, int cells) const {
    const int column = static_cast<int>(std::floor(x * cells));
    const int row = static_cast<int>(std::floor(y * cells));
    Cell found{9, 9, 0};
    for (int r = row - 1; r <= row + 1; ++r) {
        for (int c = column - 1; c <= column + 1; ++c) {
            const auto point = at(c, r, cells);
            const double distance = std::hypot(c + point[0] - x * cells, r + point[1] - y * cells);
            if (distance < found.nearest) {
                found = {distance, found.nearest, std::fmod(point[0] * 7 + point[1] * 13, 1.0)};
            } else if (distance < found.second) {
                found.second = distance;
            }
        }
    }
    return found;
}

}  // namespace relevo::viewer
