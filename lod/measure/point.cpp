#include "lod/measure/point.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "geo/geodesic.hpp"
#include "lod/measure/known_undulation.hpp"

namespace relevo::lod {
Result<PointMeasurement> measure_point(HeightSampler& sampler, geo::LatLon place) {
    const SceneInfo& info = sampler.scene().info();
    const geo::GridPosition position = info.frame.grid_position(place);
    PointMeasurement point;
    point.place = place;
    const bool inside = sampler.inside(position);
    const auto spacing =
        info.frame.spacing({std::clamp(position.column, 0.0, static_cast<double>(info.frame.columns - 1)),
                            std::clamp(position.row, 0.0, static_cast<double>(info.frame.rows - 1))});
    point.resolution_m = std::max(spacing.column_m, spacing.row_m);
    if (!inside) return point;
    point.N = known_undulation(sampler.scene(), place);
    PointMeasurement::Post post;
    post.column = static_cast<int>(std::clamp(std::round(position.column), 0.0, info.frame.columns - 1.0));
    post.row = static_cast<int>(std::clamp(std::round(position.row), 0.0, info.frame.rows - 1.0));
    post.place = info.frame.lat_lon({post.column + 0.0, post.row + 0.0});
    post.distance_m = geo::geodesic(place, post.place).length_m;
    const auto native = sampler.post(post.column, post.row);
    if (!native) return native.error();
    post.H_m = *native;
    point.nearest_post = post;

    const auto H = sampler.height(position);
    if (!H) return H.error();
    point.kind = PointClass::none;
    if (!*H) return point;
    point.H = geo::OrthometricHeight{**H};
    if (point.N) point.h = *point.H + *point.N;

    const auto slope = surface_slope(sampler, place);
    if (!slope) return slope.error();
    point.slope = *slope;

    const auto marks = sampler.marks(position);
    if (!marks) return marks.error();
    assert(*marks);
    const PlaceMarks& here = **marks;
    point.kind = here.nearest.post_class() == PostClass::sea ? PointClass::sea : PointClass::land;
    point.filled = here.filled;
    point.modelled = here.modelled;
    if (here.nearest.source() < static_cast<int>(info.sources.size())) point.source = here.nearest.source();
    return point;
}

}  // namespace relevo::lod
