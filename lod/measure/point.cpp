#include "lod/measure/point.hpp"

#include <algorithm>
#include <cassert>

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

    const auto H = sampler.height(position);
    if (!H) return H.error();
    point.kind = PointClass::none;
    if (!*H) return point;
    point.H = geo::OrthometricHeight{**H};
    if (point.N) point.h = *point.H + *point.N;

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
