#include "ingest/ground_map_file.hpp"

#include <algorithm>
#include <numeric>
#include <span>

#include <fmt/format.h>
#include <gdal_priv.h>

#include "ingest/byte_raster.hpp"
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
    if (auto fine = check_bytes(dataset, name, {1, 2, 3, 4}, "weights are bytes, 0 to 255"); !fine)
        return fine.error();
    return check_georeference(dataset, name);
}

/// \param turned  degrees that are added to the grid's longitudes
Result<WarpedBytes> warp(GDALDataset& from, const std::string& name, const geo::GridFrame& frame, int columns,
                         int rows, double turned, const GdalMessages& messages) {
    const double west = frame.west - 0.5 * frame.step_x + turned;
    const double north = frame.north + 0.5 * frame.step_y;
    const double east = west + frame.columns * frame.step_x;
    const double south = north - frame.rows * frame.step_y;
    auto warped = warp_bytes(from, frame.kind, {west, south, east, north}, columns, rows, {"-nosrcalpha"});
    if (!warped || warped->bands != kMaterials + 1)
        return refusal(name, fmt::format("it cannot be brought to the scene's grid ({})", messages.text()),
                       "Check its coordinate reference system: gdalinfo");
    return *std::move(warped);
}

/// Four weights, and how far they are there, as parts of what is there. What rounding leaves goes to the
/// largest.
std::array<std::uint8_t, 4> shares_of(std::span<const std::uint8_t, kMaterials + 1> warped) {
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
            if (shares == std::array<std::uint8_t, 4>{}) shares = shares_of(warped->pixel<kMaterials + 1>(i));
            any = any || shares != std::array<std::uint8_t, 4>{};
        }
    }
    if (!any)
        return refusal(opened->name, "it has no weights anywhere in the scene",
                       "Compare its extent with that of the scene: gdalinfo, relevo info");
    return map;
}

}  // namespace relevo::ingest
