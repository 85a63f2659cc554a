#include "ingest/reference/vertical_datum.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <proj_experimental.h>  // proj_create_compound_crs

#include "ingest/reference/read_geoid.hpp"
#include "ingest/refusal.hpp"

namespace relevo::ingest {
namespace {

using lod::VerticalDatum;

std::string lower(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

/// "NAVD88 height (ftUS)" and "NAVD88 depth" are NAVD88 height.
std::string without_unit(std::string name) {
    const auto bracket = name.rfind(" (");
    if (bracket != std::string::npos && name.back() == ')') name.erase(bracket);
    constexpr std::string_view kDepth = " depth";
    if (name.size() > kDepth.size() && name.ends_with(kDepth))
        name.replace(name.size() - kDepth.size(), kDepth.size(), " height");
    return name;
}

/// The vertical CRS of a name as PROJ's database has it; nothing where it has none.
PjPtr vertical_crs_named(PJ_CONTEXT* context, const std::string& name) {
    // As ArcGIS and GDAL's GeoTIFFs write: "NAVD88 height - Geoid18 (ftUS)".
    for (const std::string& candidate : {name, name.substr(0, name.find(" - "))}) {
        PjPtr crs{proj_create(context, candidate.c_str())};
        if (crs && proj_get_type(crs.get()) == PJ_TYPE_VERTICAL_CRS) return crs;
    }
    return {};
}

/// A geoid grid of PROJ, installed or not.
struct Grid {
    std::string name;
    std::filesystem::path file;  ///< empty: not installed
};

/// The geoid grid of an operation that does nothing but add it; nothing where it takes another way (a step
/// from one vertical datum to another, a shift of the ellipsoid).
std::optional<Grid> geoid_grid(PJ_CONTEXT* context, const PJ* operation) {
    const char* text = proj_as_proj_string(context, operation, PJ_PROJ_5, nullptr);
    const std::string pipeline = text == nullptr ? "" : text;
    constexpr std::string_view kShift = "+proj=vgridshift";
    const auto shift = pipeline.find(kShift);
    if (shift == std::string::npos || pipeline.find(kShift, shift + 1) != std::string::npos) return {};
    for (const char* other :
         {"hgridshift", "helmert", "geogoffset", "vertoffset", "gridshift +xy", "deformation"})
        if (pipeline.find(other) != std::string::npos) return {};
    const char* name = nullptr;
    const char* file = nullptr;
    int available = 0;
    if (proj_coordoperation_get_grid_used_count(context, operation) != 1 ||
        proj_coordoperation_get_grid_used(context, operation, 0, &name, &file, nullptr, nullptr, nullptr,
                                          nullptr, &available) == 0)
        return {};
    return Grid{name == nullptr ? "" : name, available != 0 && file != nullptr ? file : ""};
}

/// The best geoid grid of a datum that is installed, else the best one, else nothing.
std::optional<Grid> grid_of(PJ_CONTEXT* context, const std::string& datum,
                            const std::optional<Bounds>& area) {
    const PjPtr vertical = vertical_crs_named(context, datum);
    const PjPtr flat{proj_create(context, "EPSG:4326")};
    const PjPtr ellipsoidal{proj_create(context, "EPSG:4979")};
    if (!vertical || !flat || !ellipsoidal) return {};
    const PjPtr heights{proj_create_compound_crs(context, "heights", flat.get(), vertical.get())};
    if (!heights) return {};
    PJ_OPERATION_FACTORY_CONTEXT* factory = proj_create_operation_factory_context(context, nullptr);
    proj_operation_factory_context_set_allow_ballpark_transformations(context, factory, 0);
    proj_operation_factory_context_set_grid_availability_use(context, factory,
                                                             PROJ_GRID_AVAILABILITY_IGNORED);
    proj_operation_factory_context_set_spatial_criterion(context, factory,
                                                         PROJ_SPATIAL_CRITERION_PARTIAL_INTERSECTION);
    if (area) {
        const auto wrapped = [](double lon) { return geo::wrapped_180(geo::Degrees{lon}).value; };
        const bool all_round = area->east - area->west >= 360;
        proj_operation_factory_context_set_area_of_interest(
            context, factory, all_round ? -180 : wrapped(area->west), area->south,
            all_round ? 180 : wrapped(area->east), area->north);
    }
    PJ_OBJ_LIST* list = proj_create_operations(context, heights.get(), ellipsoidal.get(), factory);
    proj_operation_factory_context_destroy(factory);
    std::optional<Grid> best;
    for (int i = 0; list != nullptr && i < proj_list_get_count(list); ++i) {
        const PjPtr operation{proj_list_get(context, list, i)};
        auto grid = geoid_grid(context, operation.get());
        if (!grid) continue;
        if (!grid->file.empty()) {
            best = std::move(grid);
            break;
        }
        if (!best) best = std::move(grid);
    }
    proj_list_destroy(list);
    return best;
}

}  // namespace

lod::VerticalReference vertical_reference_of(const VerticalCrs& crs) {
    if (crs.ellipsoidal) return {VerticalDatum::ellipsoid, crs.name, false};
    const std::string name = without_unit(crs.name);
    if (crs.code == "EPSG:5773" || name.rfind("EGM96", 0) == 0) return {VerticalDatum::egm96, "EGM96", false};
    return {VerticalDatum::other, name, false};
}

Result<lod::VerticalReference> vertical_reference_named(const std::string& name) {
    const std::string plain = lower(name);
    if (plain == "ellipsoid")
        return lod::VerticalReference{VerticalDatum::ellipsoid, "WGS 84 ellipsoid", false};
    if (plain == "egm96") return lod::VerticalReference{VerticalDatum::egm96, "EGM96", false};
    const auto context = make_proj_context();
    const PjPtr crs = vertical_crs_named(context.get(), plain == "egm2008" ? "EPSG:3855" : name);
    const char* known = crs ? proj_get_name(crs.get()) : nullptr;
    if (known == nullptr)
        return Error{
            ErrorKind::usage,
            fmt::format("'{}' is not a vertical datum that PROJ knows: ellipsoid, egm96, egm2008, or a "
                        "vertical CRS such as EPSG:5703",
                        name)};
    VerticalCrs vertical;
    vertical.name = known;
    return vertical_reference_of(vertical);
}

bool same_datum(const lod::VerticalReference& a, const lod::VerticalReference& b) {
    return a.datum == b.datum && (a.datum != VerticalDatum::other || a.name == b.name);
}

Result<std::optional<geo::Geoid>> geoid_of(const lod::VerticalReference& reference,
                                           const std::optional<std::filesystem::path>& geoid_file,
                                           const std::optional<Bounds>& area) {
    const auto some = [](Result<geo::Geoid> geoid) -> Result<std::optional<geo::Geoid>> {
        if (!geoid) return geoid.error();
        return std::optional<geo::Geoid>{std::move(*geoid)};
    };
    if (reference.datum == VerticalDatum::ellipsoid) return std::optional<geo::Geoid>{};
    if (reference.datum == VerticalDatum::egm96) return some(geo::Geoid::egm96());
    if (geoid_file) return some(read_geoid(*geoid_file, area));
    const auto context = make_proj_context();
    const auto grid = grid_of(context.get(), reference.name, area);
    if (!grid)
        return Error{ErrorKind::input,
                     fmt::format("the geoid of {} is not known to PROJ. Give its grid with --geoid FILE",
                                 reference.name)};
    if (grid->file.empty())
        return Error{
            ErrorKind::input,
            fmt::format("the geoid grid {} of {} is not installed. Put it into a folder that PROJ_DATA "
                        "names (PROJ's packages and https://cdn.proj.org have it), or give a grid with "
                        "--geoid FILE",
                        grid->name, reference.name)};
    return some(read_geoid(grid->file, area));
}

}  // namespace relevo::ingest
