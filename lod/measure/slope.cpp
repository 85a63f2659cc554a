#include "lod/measure/slope.hpp"

#include <cmath>

namespace relevo::lod {
namespace {

/// The first cells along an axis that a coordinate is in or on the edge of, and how many.
struct Range {
    int first = 0;
    int count = 1;
};

Range cells_at(double coordinate) {
    const double nearest = std::round(coordinate);
    if (std::abs(coordinate - nearest) <= HeightSampler::kPostTolerance)
        return {static_cast<int>(nearest) - 1, 2};
    return {static_cast<int>(std::floor(coordinate)), 1};
}

}  // namespace

Result<std::optional<SurfaceSlope>> surface_slope(HeightSampler& sampler, geo::LatLon place) {
    const geo::GridFrame& frame = sampler.scene().info().frame;
    const geo::GridPosition at = frame.grid_position(place);
    const auto here = sampler.height(at);
    if (!here) return here.error();
    if (!*here) return std::optional<SurfaceSlope>{};
    const Range columns = cells_at(at.column);
    const Range rows = cells_at(at.row);
    double per_column = 0;
    double per_row = 0;
    int cells = 0;
    for (int row = rows.first; row < rows.first + rows.count; ++row) {
        for (int column = columns.first; column < columns.first + columns.count; ++column) {
            if (column < 0 || row < 0 || column + 1 >= frame.columns || row + 1 >= frame.rows) continue;
            const auto cell = sampler.cell({column + 0.5, row + 0.5});
            if (!cell) return cell.error();
            if (!*cell) continue;
            const auto slope = (*cell)->slope(at);
            per_column += slope.per_column;
            per_row += slope.per_row;
            ++cells;
        }
    }
    if (cells == 0) return std::optional<SurfaceSlope>{};
    const auto spacing = frame.spacing(at);
    // At a pole columns have no width, and heights along the row do not change.
    const double right = per_column == 0 ? 0 : per_column / cells / spacing.column_m;
    const double down = per_row / cells / spacing.row_m;
    SurfaceSlope slope;
    slope.degrees = geo::Degrees::from_radians(std::atan(std::hypot(right, down))).value;
    if (right != 0 || down != 0) {
        const auto from_up = geo::Degrees::from_radians(std::atan2(-right, down));
        slope.aspect = geo::wrapped_360(frame.up_azimuth(place.lon) + from_up);
    }
    return std::optional{slope};
}

}  // namespace relevo::lod
