#include "ingest/sea/sea_bed.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace relevo::ingest {
namespace {

constexpr double kSlope = 0.01;
constexpr double kDeepest = 200;  // metres

constexpr int kFar = kSeaBedHalo + 1;

bool has_data(lod::PostMark mark) {
    return !mark.is_void() && !mark.modelled();
}

/// Of each post, how many columns away the nearest post of its row with data is; kFar where none is near.
lod::Raster<std::uint8_t> columns_to_data(const lod::Raster<lod::PostMark>& marks) {
    lod::Raster<std::uint8_t> columns(marks.columns(), marks.rows(), kFar);
    for (int r = 0; r < marks.rows(); ++r) {
        int distance = kFar;
        const auto step = [&](int c) {
            distance = has_data(marks.at(c, r)) ? 0 : std::min(distance + 1, kFar);
            std::uint8_t& nearest = columns.at(c, r);
            nearest = static_cast<std::uint8_t>(std::min<int>(nearest, distance));
        };
        for (int c = 0; c < marks.columns(); ++c) step(c);
        distance = kFar;
        for (int c = marks.columns() - 1; c >= 0; --c) step(c);
    }
    return columns;
}

/// Distance from a post to the nearest one with data, in metres by its own spacing; infinite beyond
/// the halo.
double distance(const lod::Raster<std::uint8_t>& columns, int column, int row,
                geo::GridFrame::Spacing spacing) {
    double least = std::numeric_limits<double>::infinity();
    const int from = std::max(row - kSeaBedHalo, 0);
    const int to = std::min(row + kSeaBedHalo, columns.rows() - 1);
    for (int r = from; r <= to; ++r) {
        const int aside = columns.at(column, r);
        if (aside == kFar) continue;
        const double across = aside * spacing.column_m;
        const double along = (r - row) * spacing.row_m;
        least = std::min(least, across * across + along * along);
    }
    return std::sqrt(least);
}

}  // namespace

void model_sea_bed(const geo::GridFrame& frame, int first_column, int first_row, Window inside,
                   lod::Raster<float>& heights, const lod::Raster<lod::PostMark>& marks) {
    const lod::Raster<std::uint8_t> columns = columns_to_data(marks);
    for (int r = inside.row; r < inside.row + inside.rows; ++r) {
        for (int c = inside.column; c < inside.column + inside.columns; ++c) {
            const lod::PostMark mark = marks.at(c, r);
            if (mark.post_class() != lod::PostClass::sea || !mark.modelled()) continue;
            const auto spacing =
                frame.spacing({static_cast<double>(first_column + c), static_cast<double>(first_row + r)});
            // A post outside of the halo is farther than this, so the bed has no step where the halo ends.
            const double reach = kSeaBedHalo * std::min(spacing.column_m, spacing.row_m);
            const double depth =
                kSlope * std::min({distance(columns, c, r, spacing), reach, kDeepest / kSlope});
            heights.at(c, r) = static_cast<float>(-std::round(depth));
        }
    }
}

}  // namespace relevo::ingest
