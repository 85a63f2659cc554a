#include "ingest/ground_map_file.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <gdal_priv.h>
#include <gdal_utils.h>

#include "ingest/refusal.hpp"
#include "ingest/source/gdal_messages.hpp"
#include "ingest/source/open_dataset.hpp"

namespace relevo::ingest {
namespace {

constexpr int kMaterials = 4;

Result<void> check(GDALDataset& dataset, const std::string& name) {
    if (dataset.GetRasterCount() != kMaterials)
        return refusal(name,
                       fmt::format("it has {} band{}, and a ground map has 4: grass, rock, gravel, snow",
                                   dataset.GetRasterCount(), dataset.GetRasterCount() == 1 ? "" : "s"),
                       "Choose or join bands first: gdal_translate -b, gdalbuildvrt -separate");
    for (int i = 1; i <= kMaterials; ++i) {
        const GDALDataType type = dataset.GetRasterBand(i)->GetRasterDataType();
        if (type != GDT_Byte)
            return refusal(name,
                           fmt::format("its band {} is {}, and weights are bytes, 0 to 255", i,
                                       GDALGetDataTypeName(type)),
                           "Convert it first: gdal_translate -ot Byte -scale");
    }
    std::array<double, 6> affine{};
    const bool placed = dataset.GetGeoTransform(affine.data()) == CE_None || dataset.GetGCPCount() > 0;
    const bool has_crs = dataset.GetSpatialRef() != nullptr || dataset.GetGCPSpatialRef() != nullptr;
    if (!placed || !has_crs)
        return refusal(name, placed ? "it has no coordinate reference system" : "it has no georeference",
                       "Add one first: gdal_translate -a_srs EPSG:4326 -a_ullr WEST NORTH EAST SOUTH");
    return {};
}

const char* crs_of(geo::FrameKind kind) {
    switch (kind) {
        case geo::FrameKind::ups_north:
            return "EPSG:5041";
        case geo::FrameKind::ups_south:
            return "EPSG:5042";
        case geo::FrameKind::geographic:
            break;
    }
    return "EPSG:4326";
}

/// Columns times rows of four weights and how far they are there, 0 to 255.
using Warped = std::vector<std::array<std::uint8_t, kMaterials + 1>>;

/// \param turned  degrees that are added to the grid's longitudes
Result<Warped> warp(GDALDataset& from, const std::string& name, const geo::GridFrame& frame, int columns,
                    int rows, double turned, const GdalMessages& messages) {
    const double west = frame.west - 0.5 * frame.step_x + turned;
    const double north = frame.north + 0.5 * frame.step_y;
    const double east = west + frame.columns * frame.step_x;
    const double south = north - frame.rows * frame.step_y;
    CPLStringList words;  // GDAL's bilinear kernel grows with the texels: it also averages
    for (const char* word : {"-of", "MEM", "-ot", "Byte", "-r", "bilinear", "-nosrcalpha", "-dstalpha",
                             "-t_srs", crs_of(frame.kind), "-te"})
        words.AddString(word);
    for (const double bound : {west, south, east, north})
        words.AddString(fmt::format("{:.17g}", bound).c_str());
    words.AddString("-ts");
    for (const int side : {columns, rows}) words.AddString(std::to_string(side).c_str());

    auto* options = GDALWarpAppOptionsNew(words.List(), nullptr);
    GDALDatasetH source = GDALDataset::ToHandle(&from);
    const DatasetPtr made(GDALDataset::FromHandle(GDALWarp("", nullptr, 1, &source, options, nullptr)));
    GDALWarpAppOptionsFree(options);
    Warped warped(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    constexpr int kBands = kMaterials + 1;
    if (!made || made->GetRasterCount() != kBands ||
        made->RasterIO(GF_Read, 0, 0, columns, rows, warped.data(), columns, rows, GDT_Byte, kBands, nullptr,
                       kBands, static_cast<GSpacing>(kBands) * columns, 1, nullptr) != CE_None)
        return refusal(name, fmt::format("it cannot be brought to the scene's grid ({})", messages.text()),
                       "Check its coordinate reference system: gdalinfo");
    return warped;
}

/// As parts of what is there. What rounding leaves goes to the largest.
std::array<std::uint8_t, 4> shares_of(const std::array<std::uint8_t, kMaterials + 1>& warped) {
    const int sum = std::accumulate(warped.begin(), warped.end() - 1, 0);
    std::array<std::uint8_t, 4> shares{};
    if (sum == 0) return shares;
    const int whole = warped[kMaterials];
    int left = whole;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        shares[i] = static_cast<std::uint8_t>(warped[i] * whole / sum);
        left -= shares[i];
    }
    auto& largest = *std::max_element(shares.begin(), shares.end());
    largest = static_cast<std::uint8_t>(largest + left);
    return shares;
}

}  // namespace

Result<GroundMapTexels> read_ground_map(const std::string& file, const geo::GridFrame& frame) {
    const GdalMessages messages;
    const auto opened = open_dataset({file, {}, {}, {}}, messages);
    if (!opened) return opened.error();
    if (auto fine = check(*opened->dataset, opened->name); !fine) return fine.error();

    GroundMapTexels map;
    map.columns = std::min(frame.columns, kMostGroundMapSide);
    map.rows = std::min(frame.rows, kMostGroundMapSide);
    map.shares.resize(static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows));
    // A grid's longitudes run on across the antimeridian; a file's may begin there.
    std::vector<double> turns{0};
    if (frame.kind == geo::FrameKind::geographic) {
        if (frame.west + frame.columns * frame.step_x > 180) turns.push_back(-360);
        if (frame.west < 0) turns.push_back(360);  // files from 0 to 360
    }
    bool any = false;
    for (const double turn : turns) {
        const auto warped =
            warp(*opened->dataset, opened->name, frame, map.columns, map.rows, turn, messages);
        if (!warped) return warped.error();
        for (std::size_t i = 0; i < map.shares.size(); ++i) {
            auto& shares = map.shares[i];
            if (shares == std::array<std::uint8_t, 4>{}) shares = shares_of((*warped)[i]);
            any = any || shares != std::array<std::uint8_t, 4>{};
        }
    }
    if (!any)
        return refusal(opened->name, "it has no weights anywhere in the scene",
                       "Compare its extent with that of the scene: gdalinfo, relevo info");
    return map;
}

}  // namespace relevo::ingest
