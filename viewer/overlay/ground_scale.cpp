#include "viewer/overlay/ground_scale.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace relevo::viewer {

double round_step(double least) {
    const double power = std::pow(10.0, std::floor(std::log10(least)));
    for (const double step : {1.0, 2.0, 5.0}) {
        if (step * power >= least * (1 - 1e-12)) return step * power;
    }
    return 10 * power;
}

double contour_interval(double pixel_m) {
    return round_step(6 * pixel_m);
}

GroundScale::GroundScale(const lod::Terrain& terrain)
    : terrain_(&terrain), posts_apart_(std::exp2(terrain.pyramid()->top())) {
    auto posts = terrain.pyramid()->read_ground({terrain.pyramid()->top(), 0, 0});
    if (posts) heights_ = std::move(posts->heights);
}

double GroundScale::mean_height(geo::GridPosition at, double eye_m) const {
    const auto spacing = terrain_->frame().spacing(at);
    const double apart_m = posts_apart_ * std::max(std::min(spacing.column_m, spacing.row_m), 1e-6);
    const int reach = static_cast<int>(std::clamp(0.5 * std::abs(eye_m) / apart_m, 1.0, 24.0));
    const int column = static_cast<int>(at.column / posts_apart_);
    const int row = static_cast<int>(at.row / posts_apart_);
    double sum = 0;
    int count = 0;
    for (int r = std::max(row - reach, 0); r <= std::min(row + reach, heights_.rows() - 1); ++r) {
        for (int c = std::max(column - reach, 0); c <= std::min(column + reach, heights_.columns() - 1);
             ++c) {
            const auto H = static_cast<double>(heights_.at(c, r));
            if (std::isnan(H)) continue;
            sum += H;
            ++count;
        }
    }
    return count > 0 ? sum / count : 0;
}

double GroundScale::pixel_m(const lod::View& view, double exaggeration) const {
    constexpr double kNearest = 2;  // metres: what the eye keeps from the ground
    const geo::GridFrame& frame = terrain_->frame();
    const geo::Geodetic& eye = view.camera().eye;
    geo::GridPosition at = frame.grid_position({eye.lat, eye.lon});
    at = {std::clamp(at.column, 0.0, frame.columns - 1.0), std::clamp(at.row, 0.0, frame.rows - 1.0)};
    const double N = terrain_->undulations().at(at);
    const double H = exaggeration * mean_height(at, eye.h.m - N);
    const glm::dvec3 ground = frame.ecef(at, geo::EllipsoidalHeight{N + H}).m;
    return std::max(glm::distance(ground, view.eye().m), kNearest) / view.focal_px();
}

}  // namespace relevo::viewer
