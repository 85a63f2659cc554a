#include <cmath>

#include "output/measurement_formats.hpp"
#include <fmt/format.h>

#include "geo/antimeridian.hpp"

namespace relevo::output {
namespace {

using Json = nlohmann::json;
using lod::Measurement;
using lod::MeasurementKind;
using Places = std::vector<geo::LatLon>;

Error wrong(std::string what) {
    return {ErrorKind::input, std::move(what)};
}

// --- Writing

Json position(geo::LatLon place) {
    return Json::array({std::remainder(place.lon.value, 360.0), place.lat.value});
}

Json positions(const Places& places) {
    Json json = Json::array();
    for (const geo::LatLon& place : places) json.push_back(position(place));
    return json;
}

Json ring(const Places& places) {
    Json json = positions(places);
    json.push_back(position(places.front()));
    return json;
}

/// Rounding to a half turn must not bring 180 to -180 and back.
Json split_positions(const Places& places, bool close) {
    Json json = Json::array();
    for (const geo::LatLon& place : places) json.push_back({place.lon.value, place.lat.value});
    if (close) json.push_back(json.front());
    return json;
}

Json geometry(const Measurement& measurement) {
    const bool polygon = measurement.kind == MeasurementKind::polygon;
    if (measurement.kind == MeasurementKind::point)
        return {{"type", "Point"}, {"coordinates", position(measurement.vertices.front())}};
    const auto parts =
        polygon ? geo::split_polygon(measurement.vertices) : geo::split_path(measurement.vertices);
    Json coordinates = Json::array();
    for (const Places& part : parts) {
        const Json line = split_positions(part, polygon);
        coordinates.push_back(polygon ? Json::array({line}) : line);
    }
    const std::string type = polygon ? "Polygon" : "LineString";
    if (parts.size() == 1) return {{"type", type}, {"coordinates", coordinates.front()}};
    return {{"type", "Multi" + type}, {"coordinates", coordinates}};
}

/// As geometry() has it where nothing had to be split or turned round.
Json plain_coordinates(const Measurement& measurement) {
    switch (measurement.kind) {
        case MeasurementKind::point:
            return position(measurement.vertices.front());
        case MeasurementKind::path:
            return positions(measurement.vertices);
        case MeasurementKind::polygon:
            break;
    }
    return Json::array({ring(measurement.vertices)});
}

// --- Reading

Result<Places> places_of(const Json& json) {
    Places places;
    if (!json.is_array()) return wrong("the coordinates of a line are a list of positions");
    for (const Json& entry : json) {
        if (!entry.is_array() || entry.size() < 2 || !entry[0].is_number() || !entry[1].is_number())
            return wrong("a position is a list of longitude and latitude");
        places.push_back({geo::Degrees{entry[1].get<double>()}, geo::Degrees{entry[0].get<double>()}});
    }
    return places;
}

bool same(geo::LatLon a, geo::LatLon b) {
    return a.lat == b.lat && a.lon == b.lon;
}

/// Geometry and vertices of files that other programs have saved again may be rounded.
bool nearly_equal(const Json& a, const Json& b) {
    constexpr double kRounding = 2e-6;
    if (a.is_number() && b.is_number()) return std::abs(a.get<double>() - b.get<double>()) <= kRounding;
    if (a.is_array() && b.is_array()) {
        if (a.size() != b.size()) return false;
        for (std::size_t i = 0; i < a.size(); ++i)
            if (!nearly_equal(a[i], b[i])) return false;
        return true;
    }
    return a == b;
}

/// The places themselves, where the geometry had to be split or turned round for other programs; nothing
/// where it was changed since.
std::optional<Places> own_vertices(const Json& properties, MeasurementKind kind, const Json& shape) {
    if (!properties.is_object() || !properties.contains("vertices")) return {};
    Json list = properties["vertices"];
    if (list.is_string()) list = Json::parse(list.get<std::string>(), nullptr, false);  // by way of GDAL
    auto places = places_of(list);
    const Measurement measurement{"", kind, places ? *places : Places{}};
    if (!lod::check(measurement)) return {};
    if (!nearly_equal(geometry(measurement), shape)) return {};
    return *std::move(places);
}

class Reader {
  public:
    Result<void> read(const Json& json, const std::string& name, const Json& properties) {
        if (!json.is_object() || !json.contains("type") || !json["type"].is_string())
            return wrong("this is not GeoJSON: an object has no type");
        if (auto reference = check_reference(json); !reference) return reference;
        const auto type = json["type"].get<std::string>();
        if (type == "FeatureCollection") return read_each(json, "features", name, properties);
        if (type == "GeometryCollection") return read_each(json, "geometries", name, properties);
        if (type == "Feature") return read_feature(json);
        return read_geometry(json, type, name, properties);
    }

    std::vector<Measurement> all;

  private:
    Result<void> read_each(const Json& json, const char* key, const std::string& name,
                           const Json& properties) {
        if (!json.contains(key) || !json[key].is_array())
            return wrong(fmt::format("an object has no list of {}", key));
        for (const Json& entry : json[key]) {
            if (auto done = read(entry, name, properties); !done) return done;
        }
        return {};
    }

    Result<void> read_feature(const Json& json) {
        const Json properties = json.value("properties", Json::object());
        std::string name;
        for (const char* key : {"name", "Name", "title"}) {
            if (!name.empty() || !properties.is_object() || !properties.contains(key)) continue;
            const Json& value = properties[key];
            name = value.is_string() ? value.get<std::string>() : value.is_null() ? "" : value.dump();
        }
        if (!json.contains("geometry") || json["geometry"].is_null()) return {};  // a feature without a place
        return read(json["geometry"], name, properties);
    }

    /// RFC 7946 knows WGS 84 alone; older files say what they are in.
    Result<void> check_reference(const Json& json) const {
        if (!json.contains("crs") || json["crs"].is_null()) return {};
        const std::string said = json["crs"].dump();
        for (const char* same_as : {"CRS84", "4326", "CRS83"}) {
            if (said.find(same_as) != std::string::npos) return {};
        }
        return wrong(
            fmt::format("it is in another CRS than WGS 84 longitude and latitude ({}): convert it "
                        "with `ogr2ogr -t_srs EPSG:4326 -lco RFC7946=YES`",
                        said));
    }

    Result<void> read_geometry(const Json& json, const std::string& type, const std::string& name,
                               const Json& properties) {
        struct Known {
            const char* type;
            MeasurementKind kind;
            bool multi;
        };
        constexpr Known kKnown[] = {
            {"Point", MeasurementKind::point, false},     {"MultiPoint", MeasurementKind::point, true},
            {"LineString", MeasurementKind::path, false}, {"MultiLineString", MeasurementKind::path, true},
            {"Polygon", MeasurementKind::polygon, false}, {"MultiPolygon", MeasurementKind::polygon, true}};
        for (const Known& known : kKnown) {
            if (type != known.type) continue;
            if (!json.contains("coordinates") || !json["coordinates"].is_array())
                return wrong(fmt::format("a {} has no coordinates", type));
            if (auto own = own_vertices(properties, known.kind, json)) {
                all.push_back({name, known.kind, *std::move(own)});
                return {};
            }
            if (!known.multi) return add(json["coordinates"], known.kind, name);
            for (const Json& part : json["coordinates"]) {
                if (auto done = add(part, known.kind, name); !done) return done;
            }
            return {};
        }
        return wrong(fmt::format("\"{}\" is no type of GeoJSON", type));
    }

    Result<void> add(const Json& coordinates, MeasurementKind kind, const std::string& name) {
        if (kind == MeasurementKind::polygon && (!coordinates.is_array() || coordinates.size() != 1)) {
            return wrong(fmt::format(
                "the polygon \"{}\" has holes, which are not measured: draw its outline alone", name));
        }
        auto places = places_of(kind == MeasurementKind::point     ? Json::array({coordinates})
                                : kind == MeasurementKind::polygon ? coordinates.front()
                                                                   : coordinates);
        if (!places) return places.error();
        if (kind == MeasurementKind::polygon && places->size() > 1 && same(places->front(), places->back()))
            places->pop_back();
        all.push_back({name, kind, *std::move(places)});
        return {};
    }
};

}  // namespace

std::string measurements_to_geojson(std::span<const MeasurementRecord> records) {
    Json features = Json::array();
    for (const auto& [measurement, heights, results] : records) {
        Json properties = results.is_object() ? results : Json::object();
        properties["name"] = measurement.name;
        Json shape = geometry(measurement);
        if (shape["coordinates"] != plain_coordinates(measurement))
            properties["vertices"] = positions(measurement.vertices);
        if (!heights.empty() && measurement.kind != MeasurementKind::point) {
            Json list = Json::array();
            for (const auto& H : heights) list.push_back(H ? Json(*H) : Json());
            properties["vertex_H_m"] = std::move(list);
        }
        features.push_back(
            {{"type", "Feature"}, {"properties", std::move(properties)}, {"geometry", std::move(shape)}});
    }
    const Json json = {{"type", "FeatureCollection"}, {"features", std::move(features)}};
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + '\n';
}

Result<std::vector<Measurement>> measurements_from_geojson(const std::string& text) {
    const Json json = Json::parse(text, nullptr, false);
    if (json.is_discarded()) return wrong("this is not JSON");
    Reader reader;
    if (auto done = reader.read(json, "", Json::object()); !done) return done.error();
    return std::move(reader.all);
}

}  // namespace relevo::output
