#include "ingest/resampling_error.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <tbb/parallel_for.h>

#include "ingest/interpolated_transform.hpp"

namespace relevo::ingest {
namespace {

constexpr int kStep = 8 * kTransformTile;  // source posts a side read at once
constexpr double kPostTolerance = 1e-6;    // within it a measurement is the post (DESIGN: measuring)

/// Height of the scene's surface; NaN where a post that it needs is void, or outside.
double surface(const lod::Raster<float>& heights, Place p) {
    const auto last_column = static_cast<double>(heights.columns() - 1);
    const auto last_row = static_cast<double>(heights.rows() - 1);
    // Places on the border come out on either side of it, within the tolerance of interpolated positions.
    if (!(p.x >= -kPositionTolerance && p.y >= -kPositionTolerance &&
          p.x <= last_column + kPositionTolerance && p.y <= last_row + kPositionTolerance))
        return std::numeric_limits<double>::quiet_NaN();
    const double x = std::clamp(p.x, 0.0, last_column);
    const double y = std::clamp(p.y, 0.0, last_row);
    if (std::abs(x - std::round(x)) <= kPostTolerance && std::abs(y - std::round(y)) <= kPostTolerance)
        return static_cast<double>(
            heights.at(static_cast<int>(std::round(x)), static_cast<int>(std::round(y))));
    const int c0 = static_cast<int>(x);
    const int r0 = static_cast<int>(y);
    const int c1 = std::min(c0 + 1, heights.columns() - 1);
    const int r1 = std::min(r0 + 1, heights.rows() - 1);
    const double u = x - c0;
    const double v = y - r0;
    return (1 - v) * ((1 - u) * static_cast<double>(heights.at(c0, r0)) +
                      u * static_cast<double>(heights.at(c1, r0))) +
           v * ((1 - u) * static_cast<double>(heights.at(c0, r1)) +
                u * static_cast<double>(heights.at(c1, r1)));
}

/// The source posts that may have a part in the scene.
Window source_part(const Source& source, const GridMap& map, const geo::GridFrame& frame) {
    const Window all{0, 0, source.columns(), source.rows()};
    constexpr int kPlaces = 64;
    std::vector<Place> places;
    for (int j = 0; j <= kPlaces; ++j)
        for (int i = 0; i <= kPlaces; ++i)
            places.push_back({(frame.columns - 1.0) * i / kPlaces, (frame.rows - 1.0) * j / kPlaces});
    map.to_source(places);
    double left = all.columns;
    double top = all.rows;
    double right = 0;
    double bottom = 0;
    for (const Place& p : places) {
        if (std::isnan(p.x)) return all;
        left = std::min(left, p.x);
        top = std::min(top, p.y);
        right = std::max(right, p.x);
        bottom = std::max(bottom, p.y);
    }
    // What may bulge out between the places looked at.
    const double spare_x = 0.05 * (right - left) + kTransformTile;
    const double spare_y = 0.05 * (bottom - top) + kTransformTile;
    const auto aligned = [](double at, int most) {
        return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(most))) / kTransformTile *
               kTransformTile;
    };
    const int first_column = aligned(left - spare_x, all.columns);
    const int first_row = aligned(top - spare_y, all.rows);
    const int end_column = static_cast<int>(std::min<double>(right + spare_x, all.columns));
    const int end_row = static_cast<int>(std::min<double>(bottom + spare_y, all.rows));
    return {first_column, first_row, std::max(end_column - first_column, 0),
            std::max(end_row - first_row, 0)};
}

struct RowSum {
    double squares = 0;
    double largest = 0;
    std::uint64_t posts = 0;
    std::uint64_t lost = 0;
};

}  // namespace

Result<lod::ResamplingError> resampling_error(const Source& source, const GridMap& map,
                                              const geo::GridFrame& frame, const lod::Raster<float>& heights,
                                              bool part_wanted, const Stage& stage) {
    const Window part =
        part_wanted ? source_part(source, map, frame) : Window{0, 0, source.columns(), source.rows()};
    const auto outside = [&](Place p) {
        return !(p.x >= 0 && p.y >= 0 && p.x <= frame.columns - 1 && p.y <= frame.rows - 1);
    };
    lod::ResamplingError error;
    double squares = 0;
    for (int row = 0; row < part.rows; row += kStep)
        for (int column = 0; column < part.columns; column += kStep) {
            const Window window{part.column + column, part.row + row, std::min(kStep, part.columns - column),
                                std::min(kStep, part.rows - row)};
            const auto truth = source.read(window);
            if (!truth) return truth.error();
            const auto places = transform_posts([&](std::span<Place> p) { map.to_scene(p); }, window);
            std::vector<RowSum> rows(static_cast<std::size_t>(window.rows));
            tbb::parallel_for(0, window.rows, [&](int r) {
                RowSum& sum = rows[static_cast<std::size_t>(r)];
                for (int c = 0; c < window.columns; ++c) {
                    const double height = truth->at(c, r);
                    if (std::isnan(height)) continue;
                    const Place p = places.at(c, r);
                    const double difference = surface(heights, p) - height;
                    if (std::isnan(difference)) {
                        if (!part_wanted || !outside(p)) ++sum.lost;
                        continue;
                    }
                    if (part_wanted && outside(p)) continue;
                    ++sum.posts;
                    sum.squares += difference * difference;
                    sum.largest = std::max(sum.largest, std::abs(difference));
                }
            });
            // In their order, so that the sum does not depend on threads.
            for (const RowSum& sum : rows) {
                squares += sum.squares;
                error.max_m = std::max(error.max_m, sum.largest);
                error.posts += sum.posts;
                error.lost_posts += sum.lost;
            }
            if (!stage((row + static_cast<double>(window.rows) * (column + window.columns) / part.columns) /
                       part.rows))
                return interrupted();
        }
    if (error.posts > 0) error.rms_m = std::sqrt(squares / static_cast<double>(error.posts));
    return error;
}

}  // namespace relevo::ingest
