#include <cmath>
#include <memory>

#include "output/measurement_formats.hpp"
#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

namespace relevo::output {
namespace {

using lod::Measurement;
using lod::MeasurementKind;

Error wrong(std::string what) {
    return {ErrorKind::input, std::move(what)};
}

std::string escaped(const std::string& text) {
    std::string safe;
    for (const char c : text) {
        switch (c) {
            case '&':
                safe += "&amp;";
                break;
            case '<':
                safe += "&lt;";
                break;
            case '>':
                safe += "&gt;";
                break;
            case '"':
                safe += "&quot;";
                break;
            default:  // XML has no other control characters
                if (static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t') safe += c;
        }
    }
    return safe;
}

std::string coordinates(const Measurement& measurement) {
    std::string text;
    const auto add = [&](geo::LatLon place) {
        text += fmt::format("{}{},{}", text.empty() ? "" : " ", std::remainder(place.lon.value, 360.0),
                            place.lat.value);
    };
    for (const geo::LatLon& place : measurement.vertices) add(place);
    if (measurement.kind == MeasurementKind::polygon) add(measurement.vertices.front());
    return "<coordinates>" + text + "</coordinates>";
}

std::string geometry(const Measurement& measurement) {
    const std::string inside = coordinates(measurement);
    switch (measurement.kind) {
        case MeasurementKind::point:
            return "<Point>" + inside + "</Point>";
        case MeasurementKind::path:
            return "<LineString><tessellate>1</tessellate>" + inside + "</LineString>";
        case MeasurementKind::polygon:
            break;
    }
    return "<Polygon><tessellate>1</tessellate><outerBoundaryIs><LinearRing>" + inside +
           "</LinearRing></outerBoundaryIs></Polygon>";
}

/// The places of a point, a path or a ring; nothing of an empty one.
std::vector<geo::LatLon> places_of(const OGRSimpleCurve& curve, bool closed) {
    std::vector<geo::LatLon> places;
    const int count = curve.getNumPoints();
    for (int i = 0; i < count; ++i)
        places.push_back({geo::Degrees{curve.getY(i)}, geo::Degrees{curve.getX(i)}});
    if (closed && count > 1 && curve.getX(0) == curve.getX(count - 1) &&
        curve.getY(0) == curve.getY(count - 1))
        places.pop_back();
    return places;
}

Result<void> add(const OGRGeometry& geometry, const std::string& name, std::vector<Measurement>& all) {
    if (geometry.IsEmpty()) return {};
    switch (wkbFlatten(geometry.getGeometryType())) {
        case wkbPoint: {
            const OGRPoint& point = *geometry.toPoint();
            all.push_back(
                {name, MeasurementKind::point, {{geo::Degrees{point.getY()}, geo::Degrees{point.getX()}}}});
            return {};
        }
        case wkbLineString:
            all.push_back({name, MeasurementKind::path, places_of(*geometry.toLineString(), false)});
            return {};
        case wkbPolygon: {
            const OGRPolygon& polygon = *geometry.toPolygon();
            if (polygon.getNumInteriorRings() > 0)
                return wrong(fmt::format(
                    "the polygon \"{}\" has holes, which are not measured: draw its outline alone", name));
            all.push_back({name, MeasurementKind::polygon, places_of(*polygon.getExteriorRing(), true)});
            return {};
        }
        case wkbMultiPoint:
        case wkbMultiLineString:
        case wkbMultiPolygon:
        case wkbGeometryCollection:
            for (const OGRGeometry* part : *geometry.toGeometryCollection()) {
                if (auto done = add(*part, name, all); !done) return done;
            }
            return {};
        default:
            return wrong(
                fmt::format("\"{}\" is a {}, which cannot be measured", name, geometry.getGeometryName()));
    }
}

/// GDAL's messages are told as ours.
class Quiet {
  public:
    Quiet() {
        CPLPushErrorHandler(CPLQuietErrorHandler);
        CPLErrorReset();
    }
    ~Quiet() { CPLPopErrorHandler(); }
    Quiet(const Quiet&) = delete;
    Quiet& operator=(const Quiet&) = delete;
};

}  // namespace

std::string measurements_to_kml(std::span<const MeasurementRecord> records) {
    std::string text =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<kml xmlns=\"http://www.opengis.net/kml/2.2\">\n<Document>\n";
    for (const auto& [measurement, heights, results] : records) {
        text += "<Placemark><name>" + escaped(measurement.name) + "</name>\n";
        if (results.is_object() && !results.empty()) {
            text += "<ExtendedData>\n";
            for (const auto& [key, value] : results.items()) {
                const std::string shown = value.is_string() ? value.get<std::string>()
                                          : value.is_null() ? ""
                                                            : value.dump();
                text +=
                    fmt::format("<Data name=\"{}\"><value>{}</value></Data>\n", escaped(key), escaped(shown));
            }
            text += "</ExtendedData>\n";
        }
        text += geometry(measurement) + "\n</Placemark>\n";
    }
    return text + "</Document>\n</kml>\n";
}

Result<std::vector<Measurement>> measurements_from_kml(const std::filesystem::path& file) {
    const Quiet quiet;
    GDALAllRegister();
    const char* const drivers[] = {"LIBKML", "KML", nullptr};
    const GDALDatasetUniquePtr dataset(
        GDALDataset::Open(file.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, drivers, nullptr, nullptr));
    if (!dataset) return wrong(fmt::format("GDAL cannot read it as KML. {}", CPLGetLastErrorMsg()));
    std::vector<Measurement> all;
    for (OGRLayer* const layer : dataset->GetLayers()) {
        for (const OGRFeatureUniquePtr& feature : *layer) {
            const OGRGeometry* const shape = feature->GetGeometryRef();
            if (shape == nullptr) continue;
            const int field = feature->GetFieldIndex("Name");
            const std::string name =
                field >= 0 && feature->IsFieldSetAndNotNull(field) ? feature->GetFieldAsString(field) : "";
            if (auto done = add(*shape, name, all); !done) return done.error();
        }
    }
    if (CPLGetLastErrorType() == CE_Failure)
        return wrong(fmt::format("GDAL cannot read it to its end. {}", CPLGetLastErrorMsg()));
    return all;
}

}  // namespace relevo::output
