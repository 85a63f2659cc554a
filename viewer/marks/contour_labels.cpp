#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "lod/soar/pick.hpp"
#include "viewer/marks/map_labels.hpp"

namespace relevo::viewer {

namespace {

constexpr double kMostRays = 120;
constexpr double kLeastStep = 40;   // pixels between them
constexpr double kMargin = 24;      // pixels to the picture's edge
constexpr double kLetterRoom = 14;  // pixels that lines beside a label must leave
constexpr int kTries = 5;

struct Ground {
    double H;
    double distance_m;
};

/// What is seen at a pixel.
class Looking {
  public:
    Looking(const lod::Terrain& terrain, const lod::View& view, double exaggeration)
        : terrain_(terrain), view_(view), exaggeration_(exaggeration) {}

    std::optional<Ground> at(const glm::dvec2& pixel) const {
        const glm::dvec3 ray = view_.ray(pixel);
        const auto hit = lod::pick(terrain_, view_.eye(), ray, exaggeration_);
        if (!hit) return std::nullopt;
        // The height is the hit's own: no block has to be read for it.
        const auto place = geo::to_geodetic({view_.eye().m + hit->distance_m * ray});
        const double N = terrain_.undulations().at(hit->place);
        return Ground{(place.h.m - N) / exaggeration_, hit->distance_m};
    }

  private:
    const lod::Terrain& terrain_;
    const lod::View& view_;
    double exaggeration_;
};

/// Is it one slope from one to the other? Past a ridge the ground behind it is much farther away.
bool is_near(const Ground& a, const Ground& b) {
    return std::max(a.distance_m, b.distance_m) < 1.4 * std::min(a.distance_m, b.distance_m);
}

/// Where the ground between two pixels is at a height, by false position.
std::optional<glm::dvec2> find_height(const Looking& look, double H, glm::dvec2 low_at, double low,
                                      glm::dvec2 high_at, double high) {
    for (int i = 0; i < kTries; ++i) {
        const double part = std::clamp((H - low) / (high - low), 0.05, 0.95);
        const glm::dvec2 at = low_at + part * (high_at - low_at);
        const auto ground = look.at(at);
        if (!ground) return std::nullopt;
        const double a_pixel = std::abs(high - low) / std::max(glm::distance(low_at, high_at), 1e-6);
        if (std::abs(ground->H - H) <= 0.5 * a_pixel) return at;
        (ground->H < H ? low_at : high_at) = at;
        (ground->H < H ? low : high) = ground->H;
        if (high - low <= 0) return std::nullopt;
    }
    return std::nullopt;
}

/// How heights grow along x and along y of the picture, metres a pixel.
std::optional<glm::dvec2> growth(const Looking& look, const glm::dvec2& at) {
    constexpr double kReach = 5;
    // Three places around it, a third of a turn apart.
    const std::array<glm::dvec2, 3> around{{{0, -1}, {0.8660254, 0.5}, {-0.8660254, 0.5}}};
    std::array<Ground, 3> seen;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto ground = look.at(at + kReach * around[i]);
        if (!ground || !is_near(*ground, i == 0 ? *ground : seen[0])) return std::nullopt;
        seen[i] = *ground;
    }
    glm::dvec2 found{0};
    for (std::size_t i = 0; i < 3; ++i) found += (2.0 / 3 / kReach) * seen[i].H * around[i];
    return found;
}

/// Of a line along which heights do not grow; upright.
double angle_of(const glm::dvec2& growth) {
    double angle = std::atan2(growth.x, -growth.y) * 180 / 3.14159265358979323846;
    if (angle > 90) angle -= 180;
    if (angle <= -90) angle += 180;
    return angle;
}

}  // namespace

std::vector<MapLabel> contour_labels(const lod::Terrain& terrain, const lod::View& view, double interval_m,
                                     const LabelOptions& options) {
    std::vector<MapLabel> labels;
    if (!(options.exaggeration > 0)) return labels;
    const Looking look(terrain, view, options.exaggeration);
    const double width = view.camera().width - 2 * kMargin;
    const double height = view.camera().height - 2 * kMargin;
    if (width < kLeastStep || height < kLeastStep) return labels;
    const double step = std::max(std::sqrt(width * height / kMostRays), kLeastStep);
    const int columns = static_cast<int>(width / step) + 1;
    const int rows = static_cast<int>(height / step) + 1;
    const auto pixel = [&](int column, int row) {
        return glm::dvec2(kMargin + column * step, kMargin + row * step);
    };
    std::vector<std::optional<Ground>> seen;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) seen.push_back(look.at(pixel(column, row)));
    }

    const double index_m = 5 * interval_m;
    const auto is_free = [&](const glm::dvec2& at) {
        return std::all_of(labels.begin(), labels.end(), [&](const MapLabel& other) {
            return glm::distance(other.pixel, at) >= options.apart_px;
        });
    };
    const auto try_between = [&](int column, int row, int next_column, int next_row) {
        if (next_column >= columns || next_row >= rows) return;
        const auto& a = seen[static_cast<std::size_t>(row * columns + column)];
        const auto& b = seen[static_cast<std::size_t>(next_row * columns + next_column)];
        if (!a || !b || !is_near(*a, *b)) return;
        glm::dvec2 low_at = pixel(column, row);
        glm::dvec2 high_at = pixel(next_column, next_row);
        double low = a->H;
        double high = b->H;
        if (low > high) {
            std::swap(low, high);
            std::swap(low_at, high_at);
        }
        const double H = index_m * std::ceil(low / index_m);
        if (!(H > low && H < high)) return;
        if (!is_free(low_at + (H - low) / (high - low) * (high_at - low_at))) return;
        const auto at = find_height(look, H, low_at, low, high_at, high);
        if (!at || !is_free(*at)) return;
        const auto slope = growth(look, *at);
        if (!slope) return;
        const double metres_a_pixel = glm::length(*slope);
        if (metres_a_pixel <= 0 || index_m / metres_a_pixel < kLetterRoom) return;
        labels.push_back({*at, angle_of(*slope), fmt::format("{:.6g} m", H + 0.0)});
    };
    const auto most = static_cast<std::size_t>(std::max(options.most, 0));
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns && labels.size() < most; ++column) {
            try_between(column, row, column + 1, row);
            if (labels.size() < most) try_between(column, row, column, row + 1);
        }
    }
    return labels;
}

}  // namespace relevo::viewer
