#include "tests/bench/peers/surface_error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numeric>

namespace relevo::peers {

namespace {

/// Heights of the surface at a place of the grid, cut by either diagonal.
std::array<double, 2> heights_at(const Heights& heights, double x, double y) {
    const int column = std::min(static_cast<int>(x), heights.posts - 2);
    const int row = std::min(static_cast<int>(y), heights.posts - 2);
    const double u = x - column;
    const double v = y - row;
    const auto H = [&](int right, int down) {
        return static_cast<double>(heights.at(column + right, row + down));
    };
    const double nw = H(0, 0), ne = H(1, 0), sw = H(0, 1), se = H(1, 1);
    return {u > v ? nw + u * (ne - nw) + v * (se - ne) : nw + v * (sw - nw) + u * (se - sw),
            u + v < 1 ? nw + u * (ne - nw) + v * (sw - nw) : se + (1 - u) * (sw - se) + (1 - v) * (ne - se)};
}

}  // namespace

Heights read_heights(const std::string& path) {
    Heights heights;
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file) return heights;
    const auto count = static_cast<std::size_t>(file.tellg()) / sizeof(float);
    const auto side = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(count))));
    if (side * side != count || side < 2) return heights;
    heights.samples.resize(count);
    file.seekg(0);
    file.read(reinterpret_cast<char*>(heights.samples.data()), static_cast<std::streamsize>(count * sizeof(float)));
    if (file) heights.posts = static_cast<int>(side);
    return heights;
}

PixelErrors figures_of(std::vector<double>& errors) {
    if (errors.empty()) return {};
    PixelErrors figures;
    figures.pixels = errors.size();
    figures.max_px = *std::max_element(errors.begin(), errors.end());
    const double sum2 = std::transform_reduce(errors.begin(), errors.end(), 0.0, std::plus{},
                                              [](double e) { return e * e; });
    figures.rms_px = std::sqrt(sum2 / static_cast<double>(errors.size()));
    const auto p99 =
        errors.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(errors.size() - 1));
    std::nth_element(errors.begin(), p99, errors.end());
    figures.p99_px = *p99;
    return figures;
}

PixelErrors measure(const Heights& heights, const Place& eye, int width, int height, const std::vector<double>& depth) {
    const double focal = 0.5 * height / std::tan(0.5 * radians(kFovDegrees));
    const double sine = std::sin(radians(kPitchDegrees));
    const double cosine = std::cos(radians(kPitchDegrees));
    std::vector<double> errors;
    for (int row = 0; row < height; ++row) {
        for (int column = 0; column < width; ++column) {
            const double away =
                depth[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column)];
            if (!std::isfinite(away)) continue;
            const double right = (column + 0.5 - 0.5 * width) / focal;
            const double up = (0.5 * height - row - 0.5) / focal;
            const double x = eye.x + away * right;
            const double y = eye.y + away * (cosine - up * sine);
            const double along = (x + 0.5 * kSideM) / heights.spacing_m();
            const double down = (0.5 * kSideM - y) / heights.spacing_m();
            if (!(along >= 0 && down >= 0 && along <= heights.posts - 1 && down <= heights.posts - 1)) continue;
            double best = std::numeric_limits<double>::infinity();
            for (const double H : heights_at(heights, along, down)) {
                const double true_depth = (y - eye.y) * cosine + (H - eye.z) * sine;
                const double true_up = (H - eye.z) * cosine - (y - eye.y) * sine;
                best = std::min(best, focal * std::hypot((x - eye.x) / true_depth - right, true_up / true_depth - up));
            }
            errors.push_back(best);
        }
    }
    return figures_of(errors);
}

}  // namespace relevo::peers
