#include "tests/bench/peers/surface_error.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <numeric>

namespace relevo::peers {

Heights read_heights(const std::string& path) {
    Heights heights;
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file) return heights;
    const auto count = static_cast<std::size_t>(file.tellg()) / sizeof(float);
    const auto side = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(count))));
    if (side * side != count || side < 2) return heights;
    heights.samples.resize(count);
    file.seekg(0);
    file.read(reinterpret_cast<char*>(heights.samples.data()),
              static_cast<std::streamsize>(count * sizeof(float)));
    if (file) heights.posts = static_cast<int>(side);
    return heights;
}

PixelErrors figures_of(std::vector<double>& errors) {
    if (errors.empty()) return {};
    PixelErrors figures;
    figures.pixels = errors.size();
    figures.max_px = *std::max_element(errors.begin(), errors.end());
    const double sum2 =
        std::transform_reduce(errors.begin(), errors.end(), 0.0, std::plus{}, [](double e) { return e * e; });
    figures.rms_px = std::sqrt(sum2 / static_cast<double>(errors.size()));
    const auto p99 =
        errors.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(errors.size() - 1));
    std::nth_element(errors.begin(), p99, errors.end());
    figures.p99_px = *p99;
    return figures;
}

PixelErrors measure(const Heights& heights, const Place& eye, int width, int height,
                    const std::vector<double>& depth) {
    const double focal = 0.5 * height / std::tan(0.5 * radians(kFovDegrees));
    const double sine = std::sin(radians(kPitchDegrees));
    const double cosine = std::cos(radians(kPitchDegrees));
    std::vector<double> errors;
    for (int row = 0; row < height; ++row) {
        for (int column = 0; column < width; ++column) {
            const double away = depth[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                                      static_cast<std::size_t>(column)];
            if (!std::isfinite(away)) continue;
            const double right = (column + 0.5 - 0.5 * width) / focal;
            const double up = (0.5 * height - row - 0.5) / focal;
            const double x = eye.x + away * right;
            const double y = eye.y + away * (cosine - up * sine);
            const double along = (x + 0.5 * kSideM) / heights.spacing_m();
            const double down = (0.5 * kSideM - y) / heights.spacing_m();
            if (!(along >= 0 && down >= 0 && along <= heights.posts - 1 && down <= heights.posts - 1))
                continue;
            double best = std::numeric_limits<double>::infinity();
            const auto H_at = [&](int x_post, int y_post) {
                return static_cast<double>(heights.at(x_post, y_post));
            };
            for (const double H : surfaces_at(H_at, heights.posts, heights.posts, along, down)) {
                const double true_depth = (y - eye.y) * cosine + (H - eye.z) * sine;
                const double true_up = (H - eye.z) * cosine - (y - eye.y) * sine;
                best = std::min(
                    best, focal * std::hypot((x - eye.x) / true_depth - right, true_up / true_depth - up));
            }
            errors.push_back(best);
        }
    }
    return figures_of(errors);
}

}  // namespace relevo::peers
