#include "lod/measure/point.hpp"

#include <algorithm>
#include <cassert>

namespace relevo::lod {
namespace {

/// N of the scene's datum; nothing where that is unknown.
std::optional<geo::Undulation> undulation(const Scene& scene, geo::LatLon place) {
    const VerticalReference& vertical = scene.info().vertical;
    if (vertical.datum == VerticalDatum::ellipsoid) return geo::Undulation{0};
    const bool known = vertical.datum == VerticalDatum::egm96 || vertical.geoid_known;
    if (!known || scene.geoid() == nullptr || !scene.geoid()->covers(place)) return {};
    return scene.geoid()->undulation(place);
}

}  // namespace

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
    point.N = undulation(sampler.scene(), place);

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
