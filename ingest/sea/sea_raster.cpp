#include "ingest/sea/sea_raster.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include "ingest/refusal.hpp"
#include "ingest/source/gdal_messages.hpp"
#include "ingest/source/georeference.hpp"

namespace relevo::ingest {
namespace {

/// Posts whose pixels are read together: neighbours in a row, so that the pixels lie close together.
constexpr int kRun = 64;

struct Pixel {
    int column = -1;  // -1: there is none
    int row = -1;

    bool exists() const { return column >= 0; }
};

/// The smallest window that holds the pixels; of no columns where there are none.
Window window_of(const std::vector<Pixel>& pixels) {
    Window window;
    int east = -1;
    int south = -1;
    for (const Pixel pixel : pixels) {
        if (!pixel.exists()) continue;
        const bool first = east < 0;
        window.column = first ? pixel.column : std::min(window.column, pixel.column);
        window.row = first ? pixel.row : std::min(window.row, pixel.row);
        east = std::max(east, pixel.column);
        south = std::max(south, pixel.row);
    }
    if (east >= 0) {
        window.columns = east - window.column + 1;
        window.rows = south - window.row + 1;
    }
    return window;
}

/// A part of a band and of its mask.
struct Part {
    Window window;
    std::vector<double> values;
    std::vector<std::uint8_t> valid;

    bool read(GDALRasterBand& band) {
        const auto size = static_cast<std::size_t>(window.columns) * static_cast<std::size_t>(window.rows);
        if (size == 0) return true;
        values.resize(size);
        valid.resize(size);
        const auto [column, row, columns, rows] = window;
        return band.RasterIO(GF_Read, column, row, columns, rows, values.data(), columns, rows, GDT_Float64,
                             0, 0, nullptr) == CE_None &&
               band.GetMaskBand()->RasterIO(GF_Read, column, row, columns, rows, valid.data(), columns, rows,
                                            GDT_Byte, 0, 0, nullptr) == CE_None;
    }

    bool is_sea(Pixel pixel) const {
        if (!pixel.exists()) return false;
        const auto at =
            static_cast<std::size_t>(pixel.row - window.row) * static_cast<std::size_t>(window.columns) +
            static_cast<std::size_t>(pixel.column - window.column);
        return valid[at] != 0 && values[at] != 0 && !std::isnan(values[at]);
    }
};

}  // namespace

SeaRaster::SeaRaster(OpenDataset opened, Crs crs, Operation operation, const Affine& to_pixel,
                     const geo::GridFrame& frame)
    : opened_(std::move(opened)),
      crs_(std::move(crs)),
      operation_(std::move(operation)),
      to_pixel_(to_pixel),
      frame_(frame) {}

Result<SeaRaster> SeaRaster::open(const std::string& file, const Trust& trust, const geo::GridFrame& frame) {
    const GdalMessages messages;
    OpenRequest request;
    request.input = file;
    request.trust = trust;
    auto opened = open_dataset(request, messages);
    if (!opened) return opened.error();
    auto reference = georeference(*opened, {}, {}, messages);
    if (!reference) return reference.error();
    const int columns = opened->dataset->GetRasterXSize();
    const int rows = opened->dataset->GetRasterYSize();
    std::vector<Place> corners;
    for (const int row : {0, rows - 1}) {
        for (const int column : {0, columns - 1})
            corners.push_back(reference->posts.at({static_cast<double>(column), static_cast<double>(row)}));
    }
    auto operation = Operation::to_wgs84(reference->crs, corners);
    if (!operation) return refusal(opened->name, operation.error().message, "");
    const auto to_pixel = reference->posts.inverse();
    if (!to_pixel) return refusal(opened->name, "its georeference puts all pixels on a line", "");
    return SeaRaster{std::move(*opened), std::move(reference->crs), std::move(*operation), *to_pixel, frame};
}

Result<void> SeaRaster::read(Window window, lod::Raster<std::uint8_t>& is_sea) const {
    const std::lock_guard lock{*reading_};
    const GdalMessages messages;
    GDALRasterBand& band = *opened_.dataset->GetRasterBand(1);
    const double turn = crs_.geographic() ? crs_.full_turn() : 0;
    const auto pixel_at = [&](Place place) {
        for (const double x : {place.x, place.x + turn, place.x - turn}) {
            const Place at = to_pixel_.at({x, place.y});
            const double column = std::floor(at.x + 0.5);
            const double row = std::floor(at.y + 0.5);
            if (column >= 0 && row >= 0 && column < band.GetXSize() && row < band.GetYSize())
                return Pixel{static_cast<int>(column), static_cast<int>(row)};
        }
        return Pixel{};
    };

    std::vector<Place> places;
    std::vector<Pixel> pixels;
    Part part;
    for (int r = 0; r < window.rows; ++r) {
        for (int first = 0; first < window.columns; first += kRun) {
            const int end = std::min(first + kRun, window.columns);
            places.clear();
            for (int c = first; c < end; ++c) {
                const auto there = frame_.lat_lon(
                    {static_cast<double>(window.column + c), static_cast<double>(window.row + r)});
                places.push_back({there.lon.value, there.lat.value});
            }
            operation_.inverse(places);
            pixels.clear();
            std::transform(places.begin(), places.end(), std::back_inserter(pixels), pixel_at);
            part.window = window_of(pixels);
            if (!part.read(band))
                return refusal(opened_.name, "GDAL cannot read it (" + messages.text() + ")",
                               "Fetch it again");
            for (int c = first; c < end; ++c)
                is_sea.at(c, r) = part.is_sea(pixels[static_cast<std::size_t>(c - first)]) ? 1 : 0;
        }
    }
    return {};
}

}  // namespace relevo::ingest
