#include "ingest/reference/read_geoid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include "geo/gtx_file.hpp"
#include "ingest/reference/vertical.hpp"
#include "ingest/refusal.hpp"
#include "ingest/source/gdal_messages.hpp"
#include "ingest/source/open_dataset.hpp"

namespace relevo::ingest {
namespace {

constexpr const char* kRemedy = "Give a raster of geoid heights on a grid of degrees, or a .gtx file";

/// Columns and rows of a raster: first and count.
struct Part {
    int column = 0;
    int row = 0;
    int columns = 0;
    int rows = 0;
};

/// The part of a grid around an area; all columns where the area lies across the grid's own seam.
Part part_around(const Affine& posts, int columns, int rows, const Bounds& area) {
    constexpr int kMargin = 24;  // the influence of what is left out falls by 0.27 a node
    Part part{0, 0, columns, rows};
    const auto row_of = [&](double lat) { return (lat - posts.y0) / posts.y_row; };
    const double top = std::min(row_of(area.north), row_of(area.south)) - kMargin;
    const double bottom = std::max(row_of(area.north), row_of(area.south)) + kMargin;
    const double last_lat = std::max(std::abs(posts.y0), std::abs(posts.y0 + (rows - 1) * posts.y_row));
    if ((top < 0 || bottom > rows - 1) && last_lat > 89) return part;  // its meridians go on beyond the pole
    const int first_row = static_cast<int>(std::clamp(top, 0.0, rows - 1.0));
    const int last_row = static_cast<int>(std::clamp(bottom + 1, 0.0, rows - 1.0));
    if (last_row - first_row < 4) return part;
    part.row = first_row;
    part.rows = last_row - first_row + 1;
    const double west = area.west + 360 * std::ceil((posts.x0 - area.west) / 360);
    const double left = std::floor((west - posts.x0) / posts.x_column) - kMargin;
    const double right = std::ceil((west + area.east - area.west - posts.x0) / posts.x_column) + kMargin;
    if (left < 0 || right > columns - 1) return part;
    part.column = static_cast<int>(left);
    part.columns = static_cast<int>(right - left) + 1;
    return part;
}

Result<geo::GeoidNodes> read_nodes(GDALDataset& dataset, const Affine& posts, const Part& part,
                                   const std::string& name, const GdalMessages& messages) {
    GDALRasterBand& band = *dataset.GetRasterBand(1);
    const std::string unit = band.GetUnitType();
    const std::optional<double> metres = unit.empty() ? 1 : length_unit(unit);
    if (!metres) return refusal(name, fmt::format("its unit '{}' is not one of length", unit), kRemedy);
    if (static_cast<long long>(part.columns) * part.rows > geo::GeoidNodes::kMost)
        return refusal(name, fmt::format("{} x {} nodes are too many", part.columns, part.rows),
                       "Cut it to the place first, with `gdal_translate -projwin`");
    geo::GeoidNodes nodes;
    nodes.rows = part.rows;
    nodes.columns = part.columns;
    nodes.west = posts.x0 + part.column * posts.x_column;
    nodes.step_lon = posts.x_column;
    nodes.step_lat = std::abs(posts.y_row);
    const bool south_up = posts.y_row > 0;
    nodes.south = posts.y0 + (south_up ? part.row : part.row + part.rows - 1) * posts.y_row;
    nodes.undulations.resize(static_cast<std::size_t>(part.columns) * static_cast<std::size_t>(part.rows));
    int has_nodata = 0;
    const double nodata = band.GetNoDataValue(&has_nodata);
    for (int row = 0; row < part.rows; ++row) {
        double* line = nodes.undulations.data() + static_cast<std::ptrdiff_t>(row) * part.columns;
        const int from = part.row + (south_up ? row : part.rows - 1 - row);
        if (band.RasterIO(GF_Read, part.column, from, part.columns, 1, line, part.columns, 1, GDT_Float64, 0,
                          0, nullptr) != CE_None)
            return refusal(name, fmt::format("it is cut short or damaged ({})", messages.text()),
                           "Fetch it again");
        for (int column = 0; column < part.columns; ++column) {
            const bool hole =
                has_nodata != 0 && static_cast<float>(line[column]) == static_cast<float>(nodata);
            line[column] = hole ? std::numeric_limits<double>::quiet_NaN()
                                : (line[column] * band.GetScale() + band.GetOffset()) * *metres;
        }
    }
    return nodes;
}

}  // namespace

Result<geo::Geoid> read_geoid(const std::filesystem::path& file, const std::optional<Bounds>& area) {
    if (file.extension() == ".gtx") return geo::Geoid::from_gtx(file);
    const GdalMessages messages;
    auto opened = open_dataset({file.string(), {}, {}, {}}, messages);
    if (!opened) return opened.error();
    GDALDataset& dataset = *opened->dataset;
    const std::string& name = opened->name;
    std::array<double, 6> transform{};
    const OGRSpatialReference* crs = dataset.GetSpatialRef();
    if (dataset.GetGeoTransform(transform.data()) != CE_None || (crs != nullptr && crs->IsProjected() != 0))
        return refusal(name, "it is not on a grid of degrees", kRemedy);
    const Affine posts = Affine::of_posts(transform);
    if (posts.x_row != 0 || posts.y_column != 0 || !(posts.x_column > 0) || posts.y_row == 0)
        return refusal(name, "it is not on a grid of degrees", kRemedy);

    const int columns = dataset.GetRasterXSize();
    const int rows = dataset.GetRasterYSize();
    constexpr long long kSmall = 4'000'000;
    const bool cut = area && static_cast<long long>(columns) * rows > kSmall;
    const auto nodes =
        read_nodes(dataset, posts, cut ? part_around(posts, columns, rows, *area) : Part{0, 0, columns, rows},
                   name, messages);
    if (!nodes) return nodes.error();
    return geo::Geoid::from_nodes(*nodes, name);
}

}  // namespace relevo::ingest
