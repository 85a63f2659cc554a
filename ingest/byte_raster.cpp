#include "ingest/byte_raster.hpp"

#include <array>

#include <fmt/format.h>
#include <gdal_utils.h>

#include "ingest/refusal.hpp"
#include "ingest/source/open_dataset.hpp"

namespace relevo::ingest {

Result<void> check_bytes(GDALDataset& dataset, const std::string& name, const std::vector<int>& bands,
                         std::string_view rule) {
    for (const int i : bands) {
        const GDALDataType type = dataset.GetRasterBand(i)->GetRasterDataType();
        if (type != GDT_Byte)
            return refusal(name, fmt::format("its band {} is {}, and {}", i, GDALGetDataTypeName(type), rule),
                           "Convert it first: gdal_translate -ot Byte -scale");
    }
    return {};
}

Result<void> check_georeference(GDALDataset& dataset, const std::string& name) {
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

std::optional<WarpedBytes> warp_bytes(GDALDataset& from, geo::FrameKind kind, const Edges& edges, int columns,
                                      int rows, std::initializer_list<const char*> options) {
    CPLStringList words;  // GDAL's bilinear kernel grows with the pixels asked for: it also averages
    for (const char* word : {"-of", "MEM", "-ot", "Byte", "-r", "bilinear", "-dstalpha"})
        words.AddString(word);
    for (const char* word : options) words.AddString(word);
    for (const char* word : {"-t_srs", crs_of(kind), "-te"}) words.AddString(word);
    for (const double edge : {edges.west, edges.south, edges.east, edges.north})
        words.AddString(fmt::format("{:.17g}", edge).c_str());
    words.AddString("-ts");
    for (const int side : {columns, rows}) words.AddString(std::to_string(side).c_str());

    auto* parsed = GDALWarpAppOptionsNew(words.List(), nullptr);
    GDALDatasetH source = GDALDataset::ToHandle(&from);
    const DatasetPtr made(GDALDataset::FromHandle(GDALWarp("", nullptr, 1, &source, parsed, nullptr)));
    GDALWarpAppOptionsFree(parsed);
    if (!made) return std::nullopt;
    WarpedBytes warped;
    warped.bands = made->GetRasterCount();
    const auto pixel_bytes = static_cast<std::size_t>(warped.bands);
    warped.bytes.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows) * pixel_bytes);
    if (made->RasterIO(GF_Read, 0, 0, columns, rows, warped.bytes.data(), columns, rows, GDT_Byte,
                       warped.bands, nullptr, warped.bands, static_cast<GSpacing>(warped.bands) * columns, 1,
                       nullptr) != CE_None)
        return std::nullopt;
    return warped;
}

}  // namespace relevo::ingest
