#include "ingest/sea/sea_polygons.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include <fmt/format.h>
#include <gdal_alg.h>

#include "ingest/reference/crs.hpp"
#include "ingest/reference/operation.hpp"
#include "ingest/refusal.hpp"
#include "ingest/source/gdal_messages.hpp"

namespace relevo::ingest {
namespace {

/// From a layer's CRS to the grid.
class ToGrid {
  public:
    ToGrid(const Crs& crs, const Operation& operation, const geo::GridFrame& frame)
        : crs_(crs), operation_(operation), frame_(frame) {}

    /// Length of edges, in the CRS's unit, that may be taken for straight in the grid; nothing: any.
    std::optional<double> longest_edge(const OGREnvelope& box) const {
        if (crs_.geographic() && !frame_.is_polar()) return {};
        const auto spacing = frame_.spacing({0.5 * frame_.columns, 0.5 * frame_.rows});
        const double metres = 8 * std::max(std::min(spacing.column_m, spacing.row_m), 0.1);
        constexpr double kMetresOfDegree = 111320;
        const double length = crs_.geographic() ? metres / kMetresOfDegree : metres / crs_.unit_factor();
        // Polygons as large as the earth are not cut finer than they can matter.
        return std::max(length, std::max(box.MaxX - box.MinX, box.MaxY - box.MinY) / 50000);
    }

    void convert(OGRLinearRing& ring) const {
        std::vector<Place> places(static_cast<std::size_t>(ring.getNumPoints()));
        for (std::size_t i = 0; i < places.size(); ++i)
            places[i] = {ring.getX(static_cast<int>(i)), ring.getY(static_cast<int>(i))};
        std::vector<double> own_lons;  // degrees, in the turn that the file gives them
        if (crs_.geographic()) {
            for (const Place place : places) own_lons.push_back(place.x * 360 / crs_.full_turn());
        }
        operation_.forward(places);
        std::vector<Place> grid;
        double turn_around = NAN;
        for (std::size_t i = 0; i < places.size(); ++i) {
            Place place = places[i];
            if (!std::isfinite(place.x) || !std::isfinite(place.y)) continue;
            if (!own_lons.empty()) turn_around = own_lons[i];
            if (std::isnan(turn_around)) turn_around = place.x;
            place.x += 360 * std::round((turn_around - place.x) / 360);
            turn_around = place.x;
            grid.push_back(in_grid(place));
        }
        ring.setNumPoints(static_cast<int>(grid.size()));
        for (std::size_t i = 0; i < grid.size(); ++i)
            ring.setPoint(static_cast<int>(i), grid[i].x, grid[i].y);
        ring.closeRings();
    }

  private:
    Place in_grid(Place lon_lat) const {
        if (!frame_.is_polar())
            return {(lon_lat.x - frame_.west) / frame_.step_x, (frame_.north - lon_lat.y) / frame_.step_y};
        const auto place = frame_.grid_position({geo::Degrees{lon_lat.y}, geo::Degrees{lon_lat.x}});
        return {place.column, place.row};
    }

    const Crs& crs_;
    const Operation& operation_;
    const geo::GridFrame& frame_;
};

bool is_polygons(OGRwkbGeometryType type) {
    const auto flat = wkbFlatten(type);
    return flat == wkbPolygon || flat == wkbMultiPolygon || flat == wkbCurvePolygon ||
           flat == wkbMultiSurface || flat == wkbUnknown || flat == wkbGeometryCollection;
}

void collect(const OGRGeometry& geometry, std::vector<std::unique_ptr<OGRPolygon>>& polygons) {
    const auto type = wkbFlatten(geometry.getGeometryType());
    if (type == wkbPolygon) {
        polygons.emplace_back(geometry.toPolygon()->clone());
    } else if (type == wkbMultiPolygon || type == wkbGeometryCollection) {
        for (const OGRGeometry* part : *geometry.toGeometryCollection()) collect(*part, polygons);
    }
}

Result<Crs> crs_of(OGRLayer& layer, const std::string& name) {
    const OGRSpatialReference* reference = layer.GetSpatialRef();
    if (reference == nullptr || reference->IsEmpty())
        return refusal(name, "its polygons have no coordinate reference system",
                       "Write them again with one, e.g. `ogr2ogr -a_srs EPSG:4326`");
    char* text = nullptr;
    const char* const options[] = {"FORMAT=WKT2_2019", nullptr};
    std::string wkt;
    if (reference->exportToWkt(&text, options) == OGRERR_NONE && text != nullptr) wkt = text;
    CPLFree(text);
    auto crs = Crs::parse(wkt);
    if (!crs) return refusal(name, crs.error().message, "Write it again in another CRS, with `ogr2ogr`");
    return crs;
}

/// Corners and middle of what the layer covers.
std::vector<Place> places_of(OGRLayer& layer) {
    OGREnvelope box;
    if (layer.GetExtent(&box, TRUE) != OGRERR_NONE) return {};
    return {{box.MinX, box.MinY},
            {box.MinX, box.MaxY},
            {box.MaxX, box.MinY},
            {box.MaxX, box.MaxY},
            {0.5 * (box.MinX + box.MaxX), 0.5 * (box.MinY + box.MaxY)}};
}

bool overlap(const OGREnvelope& a, const OGREnvelope& b) {
    return a.Intersects(b) != 0;
}

OGREnvelope envelope_of(const Window& window) {
    OGREnvelope box;
    box.MinX = window.column - 0.5;
    box.MaxX = window.column + window.columns - 0.5;
    box.MinY = window.row - 0.5;
    box.MaxY = window.row + window.rows - 0.5;
    return box;
}

void shift(OGRPolygon& polygon, double columns) {
    for (OGRLinearRing* ring : polygon) {
        for (int i = 0; i < ring->getNumPoints(); ++i)
            ring->setPoint(i, ring->getX(i) + columns, ring->getY(i));
    }
}

}  // namespace

DatasetPtr open_polygons(const std::string& file) {
    GDALAllRegister();
    // Files of their own; nothing that reads from networks or databases.
    static constexpr const char* kDrivers[] = {"ESRI Shapefile", "GPKG",    "GeoJSON", "GeoJSONSeq",
                                               "FlatGeobuf",     "KML",     "LIBKML",  "GML",
                                               "MapInfo File",   "OGR_GMT", nullptr};
    const auto open = [&](const std::string& name) {
        return DatasetPtr{GDALDataset::Open(name.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, kDrivers)};
    };
    DatasetPtr dataset = open(file);
    if (!dataset && std::filesystem::path(file).extension() == ".zip") dataset = open("/vsizip/" + file);
    return dataset;
}

Result<SeaPolygons> SeaPolygons::read(GDALDataset& dataset, const std::string& name,
                                      const geo::GridFrame& frame) {
    SeaPolygons read;
    const OGREnvelope grid = envelope_of({0, 0, frame.columns, frame.rows});
    const double full_turn = frame.is_polar() ? 0 : 360 / frame.step_x;
    bool any = false;
    for (OGRLayer* layer : dataset.GetLayers()) {
        if (!is_polygons(layer->GetGeomType())) continue;
        const auto crs = crs_of(*layer, name);
        if (!crs) return crs.error();
        const auto operation = Operation::to_wgs84(*crs, places_of(*layer));
        if (!operation) return refusal(name, operation.error().message, "");
        const ToGrid to_grid{*crs, *operation, frame};
        for (auto& feature : *layer) {
            const OGRGeometry* geometry = feature->GetGeometryRef();
            if (geometry == nullptr) continue;
            const std::unique_ptr<OGRGeometry> linear{geometry->getLinearGeometry()};
            std::vector<std::unique_ptr<OGRPolygon>> polygons;
            collect(*linear, polygons);
            for (auto& polygon : polygons) {
                any = true;
                OGREnvelope box;
                polygon->getEnvelope(&box);
                if (const auto longest = to_grid.longest_edge(box)) polygon->segmentize(*longest);
                for (OGRLinearRing* ring : *polygon) to_grid.convert(*ring);
                for (int turn = frame.is_polar() ? 0 : -1; turn <= (frame.is_polar() ? 0 : 1); ++turn) {
                    std::unique_ptr<OGRPolygon> copy{polygon->clone()};
                    shift(*copy, turn * full_turn);
                    copy->getEnvelope(&box);
                    if (overlap(box, grid)) read.polygons_.push_back({std::move(copy), box});
                }
            }
        }
    }
    if (!any)
        return refusal(name, "it holds no polygons",
                       "Give polygons that are sea inside, or a raster that is not 0 where sea is");
    return read;
}

Result<void> SeaPolygons::read(Window window, lod::Raster<std::uint8_t>& inside) const {
    std::fill(inside.samples().begin(), inside.samples().end(), std::uint8_t{0});
    const OGREnvelope box = envelope_of(window);
    std::vector<OGRGeometryH> there;
    for (const Polygon& polygon : polygons_) {
        if (overlap(polygon.box, box)) there.push_back(OGRGeometry::ToHandle(polygon.geometry.get()));
    }
    if (there.empty()) return {};

    const GdalMessages messages;
    auto* memory = GetGDALDriverManager()->GetDriverByName("MEM");
    const DatasetPtr dataset{
        memory == nullptr ? nullptr : memory->Create("", window.columns, window.rows, 1, GDT_Byte, nullptr)};
    // GDAL burns pixels whose centres are inside: a post is the centre of its pixel.
    double transform[] = {box.MinX, 1, 0, box.MinY, 0, 1};
    std::vector<double> ones(there.size(), 1);
    int band = 1;
    const bool done =
        dataset && dataset->SetGeoTransform(transform) == CE_None &&
        GDALRasterizeGeometries(dataset.get(), 1, &band, static_cast<int>(there.size()), there.data(),
                                nullptr, nullptr, ones.data(), nullptr, nullptr, nullptr) == CE_None &&
        dataset->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, window.columns, window.rows,
                                            inside.samples().data(), window.columns, window.rows, GDT_Byte, 0,
                                            0, nullptr) == CE_None;
    if (!done) return Error{ErrorKind::internal, "drawing the sea's polygons failed: " + messages.text()};
    return {};
}

}  // namespace relevo::ingest
