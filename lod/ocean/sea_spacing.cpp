#include "lod/ocean/sea_spacing.hpp"

#include <algorithm>
#include <cmath>

#include "lod/ocean/wave_error.hpp"

namespace relevo::lod {

namespace {

constexpr double kFinest = 0.01;  // metres
constexpr double kStep = 1.05;
/// Of the pixels of error, for the sagging of triangles under the curved sea.
constexpr double kCurvaturePart = 0.1;
/// No mesh is coarser: triangles that reach far behind what they cover are clipped and culled badly.
constexpr double kCoarsestSlope = 0.25;

}  // namespace

SeaSpacing::SeaSpacing(const Waves& waves, double focal_px, double error_px, double radius_m)
    : SeaSpacing([&](double spacing_m) { return mesh_error_m(waves, spacing_m); },
                 waves.components().empty() ? 0 : waves.components().front().length_m(), focal_px, error_px,
                 radius_m) {}

SeaSpacing::SeaSpacing(const std::function<double(double)>& bound_m, double longest_m, double focal_px,
                       double error_px, double radius_m)
    : focal_px_(focal_px), error_px_(error_px), radius_m_(radius_m) {
    if (!(longest_m > 0)) return;
    double worst = 0;
    for (double spacing = kFinest; spacing < longest_m; spacing *= kStep) {
        worst = std::max(worst, bound_m(spacing));
        errors_.push_back(worst);
    }
    errors_.push_back(std::max(worst, bound_m(longest_m)));
}

bool SeaSpacing::flat_from(double distance_m) const {
    return errors_.empty() || errors_.back() <= error_px_ * distance_m / focal_px_;
}

double SeaSpacing::at(double distance_m) const {
    const double error_m = error_px_ * distance_m / focal_px_;
    // A chord of length s lies s^2 / 8R below the sphere.
    double spacing =
        std::min(std::sqrt(8 * radius_m_ * kCurvaturePart * error_m), kCoarsestSlope * distance_m);
    if (!errors_.empty() && errors_.back() > error_m) {
        const auto beyond = std::upper_bound(errors_.begin(), errors_.end(), error_m);
        const auto step = std::max<std::ptrdiff_t>(beyond - errors_.begin() - 1, 0);
        spacing = std::min(spacing, kFinest * std::pow(kStep, static_cast<double>(step)));
    }
    return spacing;
}

}  // namespace relevo::lod
