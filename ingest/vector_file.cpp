#include "ingest/vector_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include "ingest/refusal.hpp"
#include "ingest/source/gdal_messages.hpp"
#include "ingest/source/trust.hpp"

namespace relevo::ingest {
namespace {

/// Formats of files alone, not of data bases and services.
constexpr std::array<const char*, 15> kDrivers{
    "GPX",          "GeoJSON", "GeoJSONSeq", "TopoJSON",   "ESRI Shapefile",
    "GPKG",         "LIBKML",  "KML",        "FlatGeobuf", "GML",
    "MapInfo File", "CSV",     "DXF",        "OSM",        nullptr};

using Lines = std::vector<std::vector<geo::LatLon>>;

/// What a geometry is made of; a point is a line of one place.
void collect(const OGRGeometry& geometry, Lines& lines) {
    switch (wkbFlatten(geometry.getGeometryType())) {
        case wkbPoint: {
            const OGRPoint& point = *geometry.toPoint();
            if (!point.IsEmpty()) lines.push_back({{geo::Degrees{point.getY()}, geo::Degrees{point.getX()}}});
            return;
        }
        case wkbLineString: {
            std::vector<geo::LatLon> line;
            for (const OGRPoint& point : *geometry.toLineString())
                line.push_back({geo::Degrees{point.getY()}, geo::Degrees{point.getX()}});
            if (!line.empty()) lines.push_back(std::move(line));
            return;
        }
        case wkbPolygon:
            for (const OGRLinearRing* ring : *geometry.toPolygon()) {
                std::vector<geo::LatLon> line;
                for (const OGRPoint& point : *ring)
                    line.push_back({geo::Degrees{point.getY()}, geo::Degrees{point.getX()}});
                if (!line.empty()) lines.push_back(std::move(line));
            }
            return;
        default:
            if (OGR_GT_IsSubClassOf(geometry.getGeometryType(), wkbGeometryCollection)) {
                for (const OGRGeometry* part : *geometry.toGeometryCollection()) collect(*part, lines);
            }
            return;
    }
}

/// Straight lines of the file's CRS are cut so that the pieces are straight in the grid, too.
void cut(OGRGeometry& geometry) {
    OGREnvelope box;
    geometry.getEnvelope(&box);
    const double size = std::max(box.MaxX - box.MinX, box.MaxY - box.MinY);
    if (size > 0) geometry.segmentize(size / 500);
}

Result<Lines> read_lines(const std::string& file, const std::string& name) {
    if (auto fine = check_input_name(file, {}); !fine) return fine.error();
    GDALAllRegister();
    const GdalMessages messages;
    const GDALDatasetUniquePtr opened(GDALDataset::Open(
        file.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR, kDrivers.data()));
    if (!opened)
        return refusal(name,
                       fmt::format("it is no file of lines or points that GDAL reads ({})", messages.text()),
                       "Give a GPX, GeoJSON, Shapefile, GeoPackage or KML file");
    OGRSpatialReference degrees;
    degrees.importFromEPSG(4326);
    degrees.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    Lines lines;
    for (OGRLayer* layer : opened->GetLayers()) {
        const std::string layer_name = layer->GetName();
        if (layer_name == "track_points" || layer_name == "route_points") continue;  // those of the lines
        const OGRSpatialReference* crs = layer->GetSpatialRef();
        if (crs == nullptr) {
            if (layer->GetFeatureCount() == 0) continue;
            return refusal(name, "it has no coordinate reference system",
                           "Add one first: ogr2ogr -a_srs EPSG:4326");
        }
        OGRSpatialReference from(*crs);
        from.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
        const std::unique_ptr<OGRCoordinateTransformation> transform(
            OGRCreateCoordinateTransformation(&from, &degrees));
        if (!transform)
            return refusal(
                name, fmt::format("its coordinates cannot be brought to the scene's ({})", messages.text()),
                "Check its coordinate reference system: ogrinfo -so");
        for (const auto& feature : *layer) {
            OGRGeometry* geometry = feature->GetGeometryRef();
            if (geometry == nullptr || geometry->IsEmpty()) continue;
            const std::unique_ptr<OGRGeometry> linear(geometry->getLinearGeometry());
            cut(*linear);
            if (linear->transform(transform.get()) == OGRERR_NONE) collect(*linear, lines);
        }
    }
    return lines;
}

/// From a place to the nearest of a segment.
struct Way {
    double x = 0;
    double y = 0;
    double length() const { return std::hypot(x, y); }
};
Way way_to(const VectorFile::Segment& s, double x, double y) {
    const double dx = s.to.column - s.from.column;
    const double dy = s.to.row - s.from.row;
    const double square = dx * dx + dy * dy;
    const double t =
        square > 0 ? std::clamp(((x - s.from.column) * dx + (y - s.from.row) * dy) / square, 0.0, 1.0) : 0;
    return {s.from.column + t * dx - x, s.from.row + t * dy - y};
}

std::uint8_t code(double value, double steps) {
    return static_cast<std::uint8_t>(std::clamp(std::lround(128 + steps * value), 1L, 255L));
}

/// Of a line that is some way off.
std::array<std::uint8_t, 2> line_code(const Way& way, const VectorFile::Segment& s) {
    constexpr double kPi = 3.14159265358979323846;
    // Across what is very near one sees better from the line itself.
    const bool near = way.length() < 0.25;
    double across =
        near ? std::atan2(s.to.column - s.from.column, s.from.row - s.to.row) : std::atan2(way.y, way.x);
    if (across < 0) across += kPi;
    const auto angle = static_cast<unsigned>(std::lround(across / kPi * 256)) & 255U;
    const double turned = angle * kPi / 256;
    return {static_cast<std::uint8_t>(angle),
            code(way.x * std::cos(turned) + way.y * std::sin(turned), VectorFile::kLineSteps)};
}

}  // namespace

bool is_vector_file(const std::string& file) {
    if (!check_input_name(file, {})) return false;
    GDALAllRegister();
    const GdalMessages messages;
    const GDALDatasetUniquePtr opened(
        GDALDataset::Open(file.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, kDrivers.data()));
    if (!opened) return false;
    for (OGRLayer* layer : opened->GetLayers()) {
        if (layer->GetGeomType() != wkbNone) return true;
    }
    return false;
}

VectorFile::VectorFile(const geo::GridFrame& frame) : frame_(frame), bins_(kBins * kBins) {}

Result<std::shared_ptr<const VectorFile>> VectorFile::open(const std::string& file,
                                                           const geo::GridFrame& frame) {
    const std::string name = std::filesystem::path(file).filename().string();
    const auto lines = read_lines(file, name);
    if (!lines) return lines.error();
    std::shared_ptr<VectorFile> made(new VectorFile(frame));
    for (const auto& line : *lines) {
        for (std::size_t i = line.size() > 1 ? 1 : 0; i < line.size(); ++i) {
            const auto from = frame.grid_position(line[i == 0 ? 0 : i - 1]);
            const auto to = frame.grid_position(line[i]);
            // Who stands still makes no point.
            if (line.size() > 1 && from.column == to.column && from.row == to.row) continue;
            // Over the seam of the grid's longitudes there is no way that the grid shows.
            if (std::abs(to.column - from.column) * frame.step_x < 180 || frame.is_polar())
                made->add({from, to});
        }
    }
    if (made->segments_.empty())
        return refusal(name, "none of its lines and points is in the scene",
                       "Compare its extent with that of the scene: ogrinfo -so, relevo info");
    return std::shared_ptr<const VectorFile>(std::move(made));
}

void VectorFile::add(const Segment& segment) {
    const auto bin = [](double at, int posts) {
        return static_cast<int>(std::floor(std::clamp(at / std::max(posts - 1, 1), -1.0, 2.0) * kBins));
    };
    const auto [west, east] = std::minmax(segment.from.column, segment.to.column);
    const auto [north, south] = std::minmax(segment.from.row, segment.to.row);
    if (!(east >= 0 && west <= frame_.columns - 1 && south >= 0 && north <= frame_.rows - 1)) return;
    const auto number = static_cast<std::uint32_t>(segments_.size());
    segments_.push_back(segment);
    for (int r = std::max(bin(north, frame_.rows), 0); r <= std::min(bin(south, frame_.rows), kBins - 1);
         ++r) {
        for (int c = std::max(bin(west, frame_.columns), 0);
             c <= std::min(bin(east, frame_.columns), kBins - 1); ++c)
            bins_[static_cast<std::size_t>(r * kBins + c)].push_back(number);
    }
    // What lies on the grid's last row or column is in the last bins.
    if (bin(north, frame_.rows) >= kBins || bin(west, frame_.columns) >= kBins)
        bins_[static_cast<std::size_t>(std::clamp(bin(north, frame_.rows), 0, kBins - 1) * kBins +
                                       std::clamp(bin(west, frame_.columns), 0, kBins - 1))]
            .push_back(number);
}

std::vector<std::uint32_t> VectorFile::near(double west, double north, double east, double south) const {
    const auto bin = [](double at, int posts) {
        return std::clamp(static_cast<int>(std::floor(at / std::max(posts - 1, 1) * kBins)), 0, kBins - 1);
    };
    std::vector<std::uint32_t> found;
    for (int r = bin(north, frame_.rows); r <= bin(south, frame_.rows); ++r) {
        for (int c = bin(west, frame_.columns); c <= bin(east, frame_.columns); ++c) {
            const auto& in = bins_[static_cast<std::size_t>(r * kBins + c)];
            found.insert(found.end(), in.begin(), in.end());
        }
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

ImageTexels VectorFile::draw(const GridSquare& square) const {
    const auto side = static_cast<std::size_t>(square.side);
    constexpr double kReach = kPointReach + 1;
    ImageTexels texels(side * side);
    // How far the nearest line and the nearest point are that the texels tell of.
    std::vector<float> line_off(side * side, static_cast<float>(kLineReach));
    std::vector<float> point_off(side * side, static_cast<float>(kPointReach));
    const double reach = kReach * square.step;
    const double width = square.side * square.step;
    for (const std::uint32_t i : near(square.column - reach, square.row - reach,
                                      square.column + width + reach, square.row + width + reach)) {
        // In texels of the square.
        const auto to_texels = [&](const geo::GridPosition& p) {
            return geo::GridPosition{(p.column - square.column) / square.step,
                                     (p.row - square.row) / square.step};
        };
        const Segment all{to_texels(segments_[i].from), to_texels(segments_[i].to)};
        const double length = std::hypot(all.to.column - all.from.column, all.to.row - all.from.row);
        const bool is_point = length == 0;
        const double near_by = is_point ? kPointReach : kLineReach;
        // The part of it that is near the square.
        double begin = 0;
        double end = 1;
        const auto clip = [&](double from, double to) {
            const double low = -kReach;
            const double high = square.side + kReach;
            if (from == to) {
                if (from < low || from > high) end = -1;
                return;
            }
            const auto [first, last] = std::minmax({(low - from) / (to - from), (high - from) / (to - from)});
            begin = std::max(begin, first);
            end = std::min(end, last);
        };
        clip(all.from.column, all.to.column);
        clip(all.from.row, all.to.row);
        if (begin > end) continue;
        const int pieces = std::max(static_cast<int>((end - begin) * length / 8), 1);
        for (int piece = 0; piece < pieces; ++piece) {
            const auto at = [&](double part) {
                const double t = begin + (end - begin) * part / pieces;
                return geo::GridPosition{std::lerp(all.from.column, all.to.column, t),
                                         std::lerp(all.from.row, all.to.row, t)};
            };
            const Segment s{at(piece), at(piece + 1)};
            const auto first = [&](double a, double b) {
                return std::max(static_cast<int>(std::min(a, b) - near_by), 0);
            };
            const auto last = [&](double a, double b) {
                return std::min(static_cast<int>(std::max(a, b) + near_by) + 1, square.side - 1);
            };
            for (int r = first(s.from.row, s.to.row); r <= last(s.from.row, s.to.row); ++r) {
                for (int c = first(s.from.column, s.to.column); c <= last(s.from.column, s.to.column); ++c) {
                    const std::size_t i_texel =
                        static_cast<std::size_t>(r) * side + static_cast<std::size_t>(c);
                    const Way way = way_to(s, c, r);
                    const auto off = static_cast<float>(way.length());
                    float& nearest = (is_point ? point_off : line_off)[i_texel];
                    if (off >= nearest) continue;
                    nearest = off;
                    if (is_point) {
                        texels[i_texel][2] = code(way.x, kPointSteps);
                        texels[i_texel][3] = code(way.y, kPointSteps);
                    } else {
                        const auto line = line_code(way, s);
                        texels[i_texel][0] = line[0];
                        texels[i_texel][1] = line[1];
                    }
                }
            }
        }
    }
    return texels;
}

}  // namespace relevo::ingest
