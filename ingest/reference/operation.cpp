#include "ingest/reference/operation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace relevo::ingest {
namespace {

struct DestroyList {
    void operator()(PJ_OBJ_LIST* list) const { proj_list_destroy(list); }
};
using ListPtr = std::unique_ptr<PJ_OBJ_LIST, DestroyList>;

void run(PJ* operation, PJ_DIRECTION direction, std::span<Place> places) {
    if (places.empty()) return;
    proj_errno_reset(operation);
    proj_trans_generic(operation, direction, &places[0].x, sizeof(Place), places.size(), &places[0].y,
                       sizeof(Place), places.size(), nullptr, 0, 0, nullptr, 0, 0);
    for (Place& place : places)
        if (!std::isfinite(place.x) || !std::isfinite(place.y))
            place.x = place.y = std::numeric_limits<double>::quiet_NaN();
}

/// Where the data is, roughly (ballpark transformations allowed), to choose the operation by. Degrees.
std::optional<Bounds> rough_area(PJ_CONTEXT* context, const PJ* crs, const PJ* wgs84,
                                 std::span<const Place> places) {
    const PjPtr any{proj_create_crs_to_crs_from_pj(context, crs, wgs84, nullptr, nullptr)};
    if (!any) return {};
    const PjPtr xy{proj_normalize_for_visualization(context, any.get())};
    if (!xy) return {};
    std::vector<Place> there{places.begin(), places.end()};
    run(xy.get(), PJ_FWD, there);
    std::erase_if(there, [](Place p) { return std::isnan(p.x); });
    if (there.empty()) return {};
    Bounds area{there[0].x, there[0].y, there[0].x, there[0].y};
    for (const Place& p : there) {
        const double lon = p.x - 360 * std::round((p.x - there[0].x) / 360);  // on across the antimeridian
        area.west = std::min(area.west, lon);
        area.east = std::max(area.east, lon);
        area.south = std::min(area.south, p.y);
        area.north = std::max(area.north, p.y);
    }
    if (area.east - area.west >= 360) return Bounds{-180, area.south, 180, area.north};
    const auto wrapped = [](double lon) { return lon - 360 * std::floor((lon + 180) / 360); };
    area.west = wrapped(area.west);
    area.east = wrapped(area.east);
    return area;
}

ListPtr operations(PJ_CONTEXT* context, const PJ* crs, const PJ* wgs84, const std::optional<Bounds>& area,
                   PROJ_GRID_AVAILABILITY_USE grids) {
    PJ_OPERATION_FACTORY_CONTEXT* factory = proj_create_operation_factory_context(context, nullptr);
    proj_operation_factory_context_set_allow_ballpark_transformations(context, factory, 0);
    proj_operation_factory_context_set_grid_availability_use(context, factory, grids);
    proj_operation_factory_context_set_spatial_criterion(context, factory,
                                                         PROJ_SPATIAL_CRITERION_PARTIAL_INTERSECTION);
    if (area)
        proj_operation_factory_context_set_area_of_interest(context, factory, area->west, area->south,
                                                            area->east, area->north);
    ListPtr list{proj_create_operations(context, crs, wgs84, factory)};
    proj_operation_factory_context_destroy(factory);
    return list;
}

std::string name_of(const PJ* operation) {
    const char* name = proj_get_name(operation);
    return name == nullptr ? "" : name;
}

std::optional<double> accuracy_of(PJ_CONTEXT* context, const PJ* operation) {
    if (proj_get_type(operation) == PJ_TYPE_CONVERSION) return 0.0;  // of WGS 84 itself: nothing is measured
    const double accuracy = proj_coordoperation_get_accuracy(context, operation);
    if (accuracy < 0) return {};
    return accuracy;
}

std::string missing_grids(PJ_CONTEXT* context, const PJ* operation) {
    std::vector<std::string> missing;
    for (int i = 0; i < proj_coordoperation_get_grid_used_count(context, operation); ++i) {
        const char* name = nullptr;
        int available = 0;
        if (proj_coordoperation_get_grid_used(context, operation, i, &name, nullptr, nullptr, nullptr,
                                              nullptr, nullptr, &available) != 0 &&
            available == 0)
            missing.emplace_back(name);
    }
    return fmt::format("{}", fmt::join(missing, ", "));
}

/// Size of an operation's area of use in square degrees: the smaller, the more it is made for the place.
double area_of_use(PJ_CONTEXT* context, const PJ* operation) {
    double west = 0;
    double south = 0;
    double east = 0;
    double north = 0;
    if (proj_get_area_of_use(context, operation, &west, &south, &east, &north, nullptr) == 0 || west < -1000)
        return 360 * 180;
    if (east < west) east += 360;
    return (east - west) * (north - south);
}

/// Names the operation that would be more accurate than the one in use, were its grids here.
std::string better_but_missing(PJ_CONTEXT* context, PJ_OBJ_LIST* all, std::optional<double> accuracy) {
    std::string note;
    double smallest = std::numeric_limits<double>::infinity();
    for (int i = 0; all != nullptr && i < proj_list_get_count(all); ++i) {
        const PjPtr candidate{proj_list_get(context, all, i)};
        const auto its = accuracy_of(context, candidate.get());
        if (proj_coordoperation_is_instantiable(context, candidate.get()) != 0 || !its) continue;
        if (accuracy && *its >= *accuracy) continue;
        const double area = area_of_use(context, candidate.get());
        if (area >= smallest) continue;
        smallest = area;
        note = fmt::format("'{}' ({} m) would be more accurate, but its grid is not installed ({})",
                           name_of(candidate.get()), *its, missing_grids(context, candidate.get()));
    }
    return note;
}

std::size_t defined_at(PJ* operation, std::span<const Place> places) {
    std::vector<Place> there{places.begin(), places.end()};
    run(operation, PJ_FWD, there);
    return static_cast<std::size_t>(
        std::count_if(there.begin(), there.end(), [](Place p) { return std::isfinite(p.x); }));
}

}  // namespace

Result<Operation> Operation::to_wgs84(const Crs& crs, std::span<const Place> places) {
    Operation chosen;
    chosen.context_ = crs.context();
    PJ_CONTEXT* context = chosen.context_.get();
    const PjPtr wgs84{proj_create(context, "EPSG:4326")};
    if (!wgs84)
        return Error{ErrorKind::internal, "PROJ does not find its database (proj.db; Debian: proj-data)"};

    const auto area = rough_area(context, crs.horizontal(), wgs84.get(), places);
    const ListPtr usable = operations(context, crs.horizontal(), wgs84.get(), area,
                                      PROJ_GRID_AVAILABILITY_DISCARD_OPERATION_IF_MISSING_GRID);
    const ListPtr all =
        operations(context, crs.horizontal(), wgs84.get(), area, PROJ_GRID_AVAILABILITY_IGNORED);

    // A grid's operation is not defined outside the grid, and nothing stands in for it there: the first of
    // PROJ's order that is defined at the most places.
    std::size_t most = 0;
    for (int i = 0; usable && most < places.size() && i < proj_list_get_count(usable.get()); ++i) {
        const PjPtr candidate{proj_list_get(context, usable.get(), i)};
        if (proj_coordoperation_has_ballpark_transformation(context, candidate.get()) != 0 ||
            proj_coordoperation_is_instantiable(context, candidate.get()) == 0)
            continue;
        PjPtr xy{proj_normalize_for_visualization(context, candidate.get())};
        if (!xy) continue;
        const std::size_t defined = defined_at(xy.get(), places);
        if (defined <= most) continue;
        most = defined;
        chosen.name_ = name_of(candidate.get());
        chosen.accuracy_m_ = accuracy_of(context, candidate.get());
        chosen.operation_ = std::move(xy);
    }
    if (chosen.operation_) {
        chosen.note_ = better_but_missing(context, all.get(), chosen.accuracy_m_);
        return chosen;
    }
    if (usable && proj_list_get_count(usable.get()) > 0)
        return Error{ErrorKind::input,
                     fmt::format("none of its posts has a place in {}. Check the CRS (--crs)", crs.name())};
    const std::string missing = better_but_missing(context, all.get(), {});
    return Error{ErrorKind::input,
                 fmt::format("there is no way from {} to WGS 84{}", crs.name(),
                             missing.empty() ? ". Give another CRS with --crs" : ": " + missing)};
}

void Operation::transform(std::span<Place> places, PJ_DIRECTION direction) const {
    const std::scoped_lock one_at_a_time{*one_at_a_time_};
    run(operation_.get(), direction, places);
}

}  // namespace relevo::ingest
