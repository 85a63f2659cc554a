#include "ingest/file_content.hpp"

#include <filesystem>

#include <gdal_priv.h>

#include "ingest/source/gdal_messages.hpp"
#include "ingest/source/open_dataset.hpp"
#include "ingest/vector_file.hpp"

namespace relevo::ingest {
namespace {

std::vector<FileContent> contents_of(GDALDataset& raster) {
    int bands = 0;
    bool palette = false;
    bool bytes = true;
    for (int i = 1; i <= raster.GetRasterCount(); ++i) {
        GDALRasterBand& band = *raster.GetRasterBand(i);
        palette = palette || band.GetColorTable() != nullptr;
        if (band.GetColorInterpretation() == GCI_AlphaBand) continue;
        ++bands;
        bytes = bytes && band.GetRasterDataType() == GDT_Byte;
    }
    if (palette || bands >= 3) return {FileContent::imagery};
    if (bytes && bands > 0) return {FileContent::imagery, FileContent::elevation};
    return {FileContent::elevation};
}

}  // namespace

std::vector<FileContent> contents_of(const std::string& file) {
    std::error_code failed;
    if (std::filesystem::is_directory(file, failed)) return {FileContent::elevation};
    const GdalMessages messages;
    const auto raster = open_dataset({file, {}, {}, {}}, messages);
    if (raster) return contents_of(*raster->dataset);
    if (is_vector_file(file)) return {FileContent::vectors};
    return {FileContent::elevation};
}

}  // namespace relevo::ingest
