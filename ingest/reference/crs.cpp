#include "ingest/reference/crs.hpp"

#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <proj_experimental.h>  // proj_crs_demote_to_2D, for 3D CRSs

namespace relevo::ingest {
namespace {

std::string text_of(const char* text) {
    return text == nullptr ? "" : text;
}

std::string code_of(const PJ* object) {
    const std::string authority = text_of(proj_get_id_auth_name(object, 0));
    return authority.empty() ? authority
                             : fmt::format("{}:{}", authority, text_of(proj_get_id_code(object, 0)));
}

/// The EPSG code of a CRS that carries none but is one in all that matters (an old USGS DEM names nothing,
/// for instance). PROJ's list also holds CRSs that merely could be meant.
std::string identified_code(PJ_CONTEXT* context, const PJ* crs) {
    PJ_OBJ_LIST* list = proj_identify(context, crs, "EPSG", nullptr, nullptr);
    std::string code;
    for (int i = 0; list != nullptr && code.empty() && i < proj_list_get_count(list); ++i) {
        const PjPtr match{proj_list_get(context, list, i)};
        if (proj_is_equivalent_to_with_ctx(context, match.get(), crs, PJ_COMP_EQUIVALENT) != 0)
            code = code_of(match.get());
    }
    proj_list_destroy(list);
    return code;
}

struct Axis {
    std::string direction;
    double unit_factor = 1;
    std::string unit;
};

std::optional<Axis> axis_of(PJ_CONTEXT* context, const PJ* crs, int index) {
    const PjPtr system{proj_crs_get_coordinate_system(context, crs)};
    if (!system || index >= proj_cs_get_axis_count(context, system.get())) return {};
    const char* direction = nullptr;
    const char* unit = nullptr;
    Axis axis;
    if (proj_cs_get_axis_info(context, system.get(), index, nullptr, nullptr, &direction, &axis.unit_factor,
                              &unit, nullptr, nullptr) == 0)
        return {};
    axis.direction = text_of(direction);
    axis.unit = text_of(unit);
    return axis;
}

/// A CRS without the transformation to WGS 84 that may be bound to it.
PjPtr unbound(PJ_CONTEXT* context, const PJ* crs) {
    return PjPtr{proj_get_type(crs) == PJ_TYPE_BOUND_CRS ? proj_get_source_crs(context, crs)
                                                         : proj_clone(context, crs)};
}

VerticalCrs vertical_of(PJ_CONTEXT* context, const PJ* bound) {
    const PjPtr crs = unbound(context, bound);
    VerticalCrs vertical;
    vertical.name = text_of(proj_get_name(crs.get()));
    vertical.code = code_of(crs.get());
    if (const auto axis = axis_of(context, crs.get(), 0)) {
        vertical.down = axis->direction == "down";
        vertical.unit_m = axis->unit_factor;
    }
    return vertical;
}

}  // namespace

std::shared_ptr<PJ_CONTEXT> make_proj_context() {
    std::shared_ptr<PJ_CONTEXT> context{proj_context_create(), proj_context_destroy};
    proj_log_level(context.get(), PJ_LOG_NONE);
    return context;
}

double Crs::full_turn() const {
    return 2 * std::numbers::pi / unit_factor_;
}

Result<Crs> Crs::parse(const std::string& text) {
    Crs crs;
    crs.context_ = make_proj_context();
    PJ_CONTEXT* context = crs.context_.get();
    PjPtr whole{proj_create(context, text.c_str())};
    if (!whole || proj_is_crs(whole.get()) == 0)
        return Error{
            ErrorKind::input,
            fmt::format("'{}' is not a coordinate reference system that PROJ knows", text.substr(0, 200))};
    crs.wkt_ = text_of(proj_as_wkt(context, whole.get(), PJ_WKT2_2019, nullptr));
    crs.name_ = code_of(whole.get());

    if (proj_get_type(whole.get()) == PJ_TYPE_COMPOUND_CRS) {
        const PjPtr vertical{proj_crs_get_sub_crs(context, whole.get(), 1)};
        if (vertical) crs.vertical_ = vertical_of(context, vertical.get());
        crs.horizontal_.reset(proj_crs_get_sub_crs(context, whole.get(), 0));
    } else {
        crs.horizontal_ = std::move(whole);
    }

    const PjPtr bare = unbound(context, crs.horizontal_.get());
    if (const auto up = axis_of(context, bare.get(), 2);
        up && proj_get_type(bare.get()) != PJ_TYPE_GEOCENTRIC_CRS) {
        crs.vertical_ = VerticalCrs{.name = text_of(proj_get_name(bare.get())) + " ellipsoidal height",
                                    .code = code_of(bare.get()),
                                    .ellipsoidal = true,
                                    .down = up->direction == "down",
                                    .unit_m = up->unit_factor};
        if (PjPtr flat{proj_crs_demote_to_2D(context, nullptr, crs.horizontal_.get())})
            crs.horizontal_ = std::move(flat);
    }

    const PJ_TYPE type = proj_get_type(bare.get());
    crs.geographic_ = type == PJ_TYPE_GEOGRAPHIC_2D_CRS || type == PJ_TYPE_GEOGRAPHIC_3D_CRS;
    if (!crs.geographic_ && type != PJ_TYPE_PROJECTED_CRS)
        return Error{ErrorKind::input,
                     fmt::format("the coordinate reference system '{}' does not say where on earth "
                                 "it is (neither geographic nor projected)",
                                 text_of(proj_get_name(bare.get())))};
    if (const auto axis = axis_of(context, bare.get(), 0)) {
        crs.unit_ = axis->unit;
        crs.unit_factor_ = axis->unit_factor;
    }
    if (crs.name_.empty()) {
        std::string horizontal = code_of(crs.horizontal_.get());
        if (horizontal.empty()) horizontal = identified_code(context, bare.get());
        if (horizontal.empty()) horizontal = text_of(proj_get_name(bare.get()));
        crs.name_ = horizontal;
        if (crs.vertical_ && !crs.vertical_->ellipsoidal)
            crs.name_ = fmt::format("{} + {}", horizontal,
                                    crs.vertical_->code.empty() ? crs.vertical_->name : crs.vertical_->code);
    }
    return crs;
}

}  // namespace relevo::ingest
