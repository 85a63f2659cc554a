#include "lod/measure/source_position.hpp"

#include <cmath>
#include <memory>
#include <utility>

#include <proj.h>
#include <proj_experimental.h>

namespace relevo::lod {
namespace {

struct Destroy {
    void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
    void operator()(PJ* object) const { proj_destroy(object); }
    void operator()(PJ_OBJ_LIST* list) const { proj_list_destroy(list); }
    void operator()(PJ_OPERATION_FACTORY_CONTEXT* factory) const {
        proj_operation_factory_context_destroy(factory);
    }
};
using PjPtr = std::unique_ptr<PJ, Destroy>;

/// The horizontal part of a CRS: of a compound one its first, of a 3D one its first two axes.
PjPtr horizontal_crs(PJ_CONTEXT* context, const std::string& wkt) {
    PjPtr crs{proj_create(context, wkt.c_str())};
    if (!crs) return crs;
    if (proj_get_type(crs.get()) == PJ_TYPE_COMPOUND_CRS)
        crs.reset(proj_crs_get_sub_crs(context, crs.get(), 0));
    if (!crs) return crs;
    return PjPtr{proj_crs_demote_to_2D(context, nullptr, crs.get())};
}

/// From WGS 84 (lon, lat) to the CRS (x, y): the operation of that name, else the one that PROJ holds best.
PjPtr operation_to(PJ_CONTEXT* context, const PJ* crs, const std::string& name) {
    const PjPtr wgs84{proj_create(context, "EPSG:4326")};
    if (!wgs84) return nullptr;
    const std::unique_ptr<PJ_OPERATION_FACTORY_CONTEXT, Destroy> factory{
        proj_create_operation_factory_context(context, nullptr)};
    proj_operation_factory_context_set_allow_ballpark_transformations(context, factory.get(), 0);
    proj_operation_factory_context_set_grid_availability_use(
        context, factory.get(), PROJ_GRID_AVAILABILITY_DISCARD_OPERATION_IF_MISSING_GRID);
    proj_operation_factory_context_set_spatial_criterion(context, factory.get(),
                                                         PROJ_SPATIAL_CRITERION_PARTIAL_INTERSECTION);
    // From the CRS to WGS 84, as ingest asks: the names are those of this direction.
    const std::unique_ptr<PJ_OBJ_LIST, Destroy> all{
        proj_create_operations(context, crs, wgs84.get(), factory.get())};
    PjPtr chosen;
    for (int i = 0; all && i < proj_list_get_count(all.get()); ++i) {
        PjPtr candidate{proj_list_get(context, all.get(), i)};
        const char* const its_name = proj_get_name(candidate.get());
        const bool same = its_name != nullptr && name == its_name;
        if (same || !chosen) chosen = std::move(candidate);
        if (same) break;
    }
    if (!chosen) return nullptr;
    return PjPtr{proj_normalize_for_visualization(context, chosen.get())};
}

}  // namespace

struct SourceProjection::Proj {
    std::unique_ptr<PJ_CONTEXT, Destroy> context;
    PjPtr operation;
};

SourceProjection::SourceProjection(std::unique_ptr<Proj> proj) : proj_(std::move(proj)) {}
SourceProjection::SourceProjection(SourceProjection&&) noexcept = default;
SourceProjection& SourceProjection::operator=(SourceProjection&&) noexcept = default;
SourceProjection::~SourceProjection() = default;

std::optional<SourceProjection> SourceProjection::create(const SourceInfo& source) {
    auto proj = std::make_unique<Proj>();
    proj->context.reset(proj_context_create());
    PJ_CONTEXT* const context = proj->context.get();
    proj_log_level(context, PJ_LOG_NONE);
    const PjPtr crs = horizontal_crs(context, source.crs_wkt);
    if (!crs) return {};
    proj->operation = operation_to(context, crs.get(), source.operation);
    if (!proj->operation) return {};
    return SourceProjection(std::move(proj));
}

std::optional<SourcePosition> SourceProjection::position(geo::LatLon place) const {
    const PJ_COORD there =
        proj_trans(proj_->operation.get(), PJ_INV, proj_coord(place.lon.value, place.lat.value, 0, HUGE_VAL));
    if (!std::isfinite(there.xy.x) || !std::isfinite(there.xy.y)) return {};
    return SourcePosition{there.xy.x, there.xy.y};
}

std::optional<SourcePosition> source_position(const SourceInfo& source, geo::LatLon place) {
    const auto projection = SourceProjection::create(source);
    if (!projection) return {};
    return projection->position(place);
}

}  // namespace relevo::lod
