#include "ingest/sea/sea_mask.hpp"

#include <filesystem>
#include <utility>

#include "ingest/refusal.hpp"
#include "ingest/source/gdal_messages.hpp"

namespace relevo::ingest {

SeaMask::SeaMask(std::string name, Shape shape) : name_(std::move(name)), shape_(std::move(shape)) {}

Result<SeaMask> SeaMask::open(const std::string& file, const Trust& trust, const geo::GridFrame& frame) {
    if (auto named = check_input_name(file, trust); !named) return named.error();
    const std::string name = std::filesystem::path(file).filename().string();
    std::error_code ignored;
    if (!is_remote(file) && !std::filesystem::exists(file, ignored))
        return refusal(file, "there is no such file",
                       "--sea takes auto, none, depths, or a file of polygons or a raster");
    const GdalMessages messages;
    if (const DatasetPtr polygons = open_polygons(file); polygons && polygons->GetLayerCount() > 0) {
        auto read = SeaPolygons::read(*polygons, name, frame);
        if (!read) return read.error();
        return SeaMask{name, std::move(*read)};
    }
    auto raster = SeaRaster::open(file, trust, frame);
    if (!raster) return raster.error();
    return SeaMask{name, std::move(*raster)};
}

Result<void> SeaMask::read(Window window, lod::Raster<std::uint8_t>& is_sea) const {
    return std::visit([&](const auto& shape) { return shape.read(window, is_sea); }, shape_);
}

}  // namespace relevo::ingest
