#include "viewer/ground/page_bounds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include <glm/geometric.hpp>

#include "geo/ellipsoid.hpp"

namespace relevo::viewer {

namespace {

constexpr int kSamples = 5;  // of the surface, a side

using Samples = std::array<std::array<glm::dvec3, kSamples>, kSamples>;

/// How far a smooth surface leaves the bilinear patches between its samples: an eighth of the second
/// differences along both directions where these do not change; twice that here, as they do.
double bulge(const Samples& at) {
    double along = 0;
    double across = 0;
    for (std::size_t i = 0; i < kSamples; ++i) {
        for (std::size_t k = 1; k + 1 < kSamples; ++k) {
            along = std::max(along, glm::length(at[i][k - 1] - 2.0 * at[i][k] + at[i][k + 1]));
            across = std::max(across, glm::length(at[k - 1][i] - 2.0 * at[k][i] + at[k + 1][i]));
        }
    }
    return 0.25 * (along + across);
}

}  // namespace

PageBounds::PageBounds(const geo::GridFrame& frame, const geo::PostPositions& positions,
                       const lod::UndulationGrid& undulations, const GroundFacts& facts)
    : frame_(frame),
      positions_(positions),
      undulations_(undulations),
      middle_m_(0.5 * (facts.lowest_m + facts.highest_m)),
      half_range_m_(0.5 * (facts.highest_m - facts.lowest_m)) {}

PageBounds::PageBounds(const geo::GridFrame& frame, const geo::PostPositions& positions,
                       const lod::UndulationGrid& undulations, const GroundFacts& facts, int finer,
                       lod::Raster<float> some, int apart)
    : PageBounds(frame, positions, undulations, facts) {
    finer_ = finer;
    some_ = std::move(some);
    apart_ = apart;
}

void PageBounds::set_heights(Bare& made, int west, int north, int east, int south) const {
    made.middle_m = middle_m_;
    made.half_range_m = half_range_m_;
    if (some_.samples().empty()) return;
    const double lowest = middle_m_ - half_range_m_;
    const double highest = middle_m_ + half_range_m_;
    double low = highest;
    double high = lowest;
    for (int row = north >> apart_; row <= std::min((south >> apart_) + 1, some_.rows() - 1); ++row) {
        for (int column = west >> apart_; column <= std::min((east >> apart_) + 1, some_.columns() - 1);
             ++column) {
            const auto H = static_cast<double>(some_.at(column, row));
            if (std::isnan(H)) continue;
            low = std::min(low, H);
            high = std::max(high, H);
        }
    }
    if (low > high) low = high = lowest;  // nothing but voids
    const double range = high - low;
    low = std::max(low - range, lowest);
    high = std::min(high + range, highest);
    made.middle_m = 0.5 * (low + high);
    made.half_range_m = 0.5 * (high - low);
}

PageBounds::Bare PageBounds::bare(const Page& page) const {
    // The whole cells of the frame that the page is in.
    const auto side = std::int64_t{kPageCells} << page.level;
    const auto down = [&](std::int64_t at) { return static_cast<int>(at >> finer_); };
    const auto up = [&](std::int64_t at) { return static_cast<int>(-((-at) >> finer_)); };
    const int west = down(page.column * side);
    const int north = down(page.row * side);
    const int width = std::min(up((page.column + 1) * side), frame_.columns - 1) - west;
    const int height = std::min(up((page.row + 1) * side), frame_.rows - 1) - north;
    Samples at;
    Bare made;
    for (int i = 0; i < kSamples; ++i) {
        const int row = north + static_cast<int>(static_cast<long>(height) * i / (kSamples - 1));
        for (int k = 0; k < kSamples; ++k) {
            const int column = west + static_cast<int>(static_cast<long>(width) * k / (kSamples - 1));
            at[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)] =
                positions_.at(column, row, undulations_.at(column, row));
            const auto spacing = frame_.spacing({static_cast<double>(column), static_cast<double>(row)});
            made.spacing_m =
                std::max(made.spacing_m, std::ldexp(std::min(spacing.column_m, spacing.row_m), -finer_));
        }
    }
    made.centre = at[kSamples / 2][kSamples / 2];
    made.up = positions_.normal(west + width / 2, north + height / 2);
    for (const auto& row : at) {
        for (const glm::dvec3& p : row)
            made.radius_m = std::max(made.radius_m, glm::distance(p, made.centre));
    }
    made.radius_m += bulge(at);
    set_heights(made, west, north, west + width, north + height);
    return made;
}

PageBounds::Bounds PageBounds::of(const Page& page, double exaggeration) const {
    auto found = known_.find(page);
    if (found == known_.end()) found = known_.emplace(page, bare(page)).first;
    const Bare& surface = found->second;
    // Normals spread upwards: by the angle between them, at most the distance over the axis' smaller radius
    // of curvature.
    const double middle = exaggeration * surface.middle_m;
    const double half_range = exaggeration * surface.half_range_m;
    const double spread = 1 + (std::abs(middle) + half_range) / 6.3e6;
    return {surface.centre + middle * surface.up, spread * surface.radius_m + half_range, surface.spacing_m};
}

}  // namespace relevo::viewer
