#include "lod/measure/results.hpp"

#include "geo/coordinate_text.hpp"

namespace relevo::lod {
namespace {

using Json = nlohmann::json;

Json or_null(const std::optional<double>& value) {
    return value ? Json(*value) : Json();
}

template <class Height>
Json metres(const std::optional<Height>& height) {
    return height ? Json(height->m) : Json();
}

double longitude(geo::LatLon place) {
    return geo::wrapped_180(place.lon).value;
}

/// \param name  of the value, with its unit
template <class Extreme>
Json extreme(const char* name, const std::optional<Extreme>& e) {
    if (!e) return {};
    return {{name, e->value}, {"lat", e->place.lat.value}, {"lon", longitude(e->place)}};
}

Json along(const char* name, const std::optional<Profile::Extreme>& e) {
    Json json = extreme(name, e);
    if (e) json["distance_m"] = e->distance_m;
    return json;
}

Json place_of(const std::optional<SightMeasurement::Place>& p) {
    if (!p) return {};
    return {{"distance_m", p->distance_m},
            {"lat", p->place.lat.value},
            {"lon", longitude(p->place)},
            {"H_m", p->H_m},
            {"clearance_m", p->clearance_m}};
}

}  // namespace

PointSource source_of(const SceneInfo& info, const PointMeasurement& point) {
    if (info.sources.empty()) return {};
    const SourceInfo& source = info.sources[static_cast<std::size_t>(point.source.value_or(0))];
    return {&source, source_position(source, point.place)};
}

const char* to_string(PointClass kind) {
    switch (kind) {
        case PointClass::land:
            return "land";
        case PointClass::sea:
            return "sea";
        case PointClass::none:
            return "void";
        case PointClass::outside:
            break;
    }
    return "outside";
}

Json results_of(const PointMeasurement& m, const PointSource& source, const SceneInfo& info) {
    const bool inside = m.kind != PointClass::outside;
    Json source_crs;
    if (source.info != nullptr) {
        source_crs = {{"code", source.info->crs},
                      {"x", source.position ? Json(source.position->x) : Json()},
                      {"y", source.position ? Json(source.position->y) : Json()}};
    }
    Json native;
    if (m.nearest_post) {
        native = {{"column", m.nearest_post->column},       {"row", m.nearest_post->row},
                  {"lat", m.nearest_post->place.lat.value}, {"lon", longitude(m.nearest_post->place)},
                  {"H_m", or_null(m.nearest_post->H_m)},    {"distance_m", m.nearest_post->distance_m}};
    }
    const bool has_aspect = m.slope && m.slope->aspect;
    return {
        {"lat", m.place.lat.value},
        {"lon", m.place.lon.value},
        {"dms", geo::to_dms(m.place)},
        {"class", to_string(m.kind)},
        {"H_m", metres(m.H)},
        {"h_m", metres(m.h)},
        {"N_m", metres(m.N)},
        {"vertical_datum", info.vertical.name},
        {"slope_deg", m.slope ? Json(m.slope->degrees) : Json()},
        {"aspect_deg", has_aspect ? Json(m.slope->aspect->value) : Json()},
        {"native_sample", native},
        {"source_crs", source_crs},
        {"position_accuracy_m", source.info == nullptr ? Json() : or_null(source.info->operation_accuracy_m)},
        {"height_accuracy_m", nullptr},  // no source that is read states one
        {"utm", geo::to_utm(m.place)},
        {"mgrs", geo::to_mgrs(m.place)},
        {"resolution_m", inside ? Json(m.resolution_m) : Json()},
        {"resampling_rms_m", info.resampling.rms_m},
        {"filled", m.filled},
        {"modelled", m.modelled}};
}

Json results_of(const LineMeasurement& line) {
    return {{"geodesic_m", line.geodesic.length_m},
            {"azimuth1_deg", line.geodesic.azimuth1.value},
            {"azimuth2_deg", line.geodesic.azimuth2.value},
            {"surface_m", or_null(line.surface_m)},
            {"climb_m", or_null(line.climb_m)},
            {"descent_m", or_null(line.descent_m)}};
}

Json results_of(const PathMeasurement& path) {
    Json legs = Json::array();
    for (const LineMeasurement& leg : path.legs) legs.push_back(results_of(leg));
    Json turns = Json::array();
    for (const geo::Degrees turn : path.turns) turns.push_back(turn.value);
    return {{"length_m", path.length_m},        {"surface_m", or_null(path.surface_m)},
            {"climb_m", or_null(path.climb_m)}, {"descent_m", or_null(path.descent_m)},
            {"turns_deg", std::move(turns)},    {"legs", std::move(legs)}};
}

Json results_of(const Profile& profile) {
    Json samples = Json::array();
    for (const ProfileSample& s : profile.samples)
        samples.push_back({{"distance_m", s.distance_m},
                           {"lat", s.place.lat.value},
                           {"lon", longitude(s.place)},
                           {"H_m", or_null(s.H_m)},
                           {"h_m", or_null(s.h_m)}});
    Json gaps = Json::array();
    for (const ProfileGap& gap : profile.gaps)
        gaps.push_back(
            {{"from_m", gap.from_m}, {"to_m", gap.to_m}, {"why", gap.outside ? "outside" : "void"}});
    return {{"length_m", profile.vertices_m.back()},
            {"measured_m", profile.measured_m},
            {"vertices_m", profile.vertices_m},
            {"lowest", along("H_m", profile.lowest)},
            {"highest", along("H_m", profile.highest)},
            {"mean_H_m", or_null(profile.mean_H_m)},
            {"steepest_up", along("slope", profile.steepest_up)},
            {"steepest_down", along("slope", profile.steepest_down)},
            {"mean_slope", or_null(profile.mean_slope)},
            {"gaps", std::move(gaps)},
            {"samples", std::move(samples)}};
}

Json results_of(const AreaMeasurement& area, const SceneInfo& info) {
    return {{"geodesic_area_m2", area.geodesic.area_m2},
            {"perimeter_m", area.geodesic.perimeter_m},
            {"measured_area_m2", area.measured_m2},
            {"void_area_m2", area.void_m2},
            {"outside_area_m2", area.outside_m2},
            {"surface_area_m2", or_null(area.surface_m2)},
            {"lowest", extreme("H_m", area.lowest)},
            {"highest", extreme("H_m", area.highest)},
            {"mean_H_m", or_null(area.mean_H_m)},
            {"mean_slope_deg", or_null(area.mean_slope_deg)},
            {"steepest", extreme("slope_deg", area.steepest_deg)},
            {"plane_H_m", or_null(area.plane_H_m)},
            {"volume_above_m3", or_null(area.volume_above_m3)},
            {"volume_below_m3", or_null(area.volume_below_m3)},
            {"vertical_datum", info.vertical.name}};
}

Json results_of(const SightMeasurement& sight, const Looking& looking) {
    return {{"visible", sight.visible ? Json(*sight.visible) : Json()},
            {"geodesic_m", sight.geodesic.length_m},
            {"azimuth1_deg", sight.geodesic.azimuth1.value},
            {"eye_H_m", or_null(sight.eye_H_m)},
            {"target_H_m", or_null(sight.target_H_m)},
            {"first_blocked", place_of(sight.first_blocked)},
            {"worst", place_of(sight.worst)},
            {"least_clearance", place_of(sight.least_clearance)},
            {"unknown_m", sight.unknown_m},
            {"eye_height_m", looking.eye_height_m},
            {"target_height_m", looking.target_height_m},
            {"refraction", looking.refraction}};
}

Json results_of(const Viewshed& shed, const ViewshedRequest& request) {
    return {{"visible_area_m2", shed.visible_m2},
            {"hidden_area_m2", shed.hidden_m2},
            {"unknown_area_m2", shed.unknown_m2},
            {"visible_posts", shed.visible_posts},
            {"hidden_posts", shed.hidden_posts},
            {"unknown_posts", shed.unknown_posts},
            {"eye_H_m", shed.eye_H_m},
            {"radius_m", request.radius_m},
            {"eye_height_m", request.looking.eye_height_m},
            {"target_height_m", request.looking.target_height_m},
            {"refraction", request.looking.refraction}};
}

Result<MeasuredItem> measure_item(HeightSampler& sampler, const Measurement& measurement,
                                  const AreaRequest& request) {
    if (const auto good = check(measurement); !good) return good.error();
    const SceneInfo& info = sampler.scene().info();
    MeasuredItem item;
    for (const geo::LatLon& place : measurement.vertices) {
        const auto H = sampler.height(info.frame.grid_position(place));
        if (!H) return H.error();
        item.H_m.push_back(*H);
    }
    switch (measurement.kind) {
        case MeasurementKind::point: {
            const auto point = measure_point(sampler, measurement.vertices.front());
            if (!point) return point.error();
            item.results = results_of(*point, source_of(info, *point), info);
            break;
        }
        case MeasurementKind::path: {
            const auto path = measure_path(sampler, measurement.vertices);
            if (!path) return path.error();
            item.results = results_of(*path);
            break;
        }
        case MeasurementKind::polygon: {
            const auto area = measure_area(sampler.scene(), measurement.vertices, request);
            if (!area) return area.error();
            item.results = results_of(*area, info);
            break;
        }
    }
    item.results["kind"] = to_string(measurement.kind);
    return item;
}

}  // namespace relevo::lod
