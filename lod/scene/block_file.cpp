#include "lod/scene/block_file.hpp"

#include <cassert>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <type_traits>

#include <cpl_string.h>
#include <cpl_vsi.h>
#include <fmt/format.h>
#include <gdal_frmts.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include "lod/scene/scene_info.hpp"

namespace relevo::lod {
namespace {

template <class T>
constexpr GDALDataType gdal_type() {
    if constexpr (std::is_same_v<T, std::int16_t>) return GDT_Int16;
    if constexpr (std::is_same_v<T, std::uint16_t>) return GDT_UInt16;
    if constexpr (std::is_same_v<T, std::uint8_t>) return GDT_Byte;
    if constexpr (std::is_same_v<T, float>) return GDT_Float32;
    return GDT_Unknown;
}

/// GDAL's GeoTIFF driver alone: registering all of them takes tens of milliseconds and reads plugins from
/// disk.
GDALDriver* geotiff_driver() {
    static const bool registered = (GDALRegister_GTiff(), true);
    (void)registered;
    return GetGDALDriverManager()->GetDriverByName("GTiff");
}

/// Keeps GDAL's messages of this thread off stderr; the last one is ours to report.
class QuietGdal {
  public:
    QuietGdal() {
        CPLPushErrorHandler(CPLQuietErrorHandler);
        CPLErrorReset();
    }
    ~QuietGdal() { CPLPopErrorHandler(); }
    QuietGdal(const QuietGdal&) = delete;
    QuietGdal& operator=(const QuietGdal&) = delete;

    static std::string message() {
        const std::string text = CPLGetLastErrorMsg();
        return text.empty() ? "unknown reason" : text;
    }
};

/// A file in GDAL's memory, named after an object that lives as long: unique in the process without global
/// state.
class MemoryFile {
  public:
    MemoryFile() : name_(fmt::format("/vsimem/relevo-{}.tif", static_cast<const void*>(this))) {}
    explicit MemoryFile(std::span<const std::byte> bytes) : MemoryFile() {
        // GDAL wants a pointer to non-const bytes, and only reads what is opened for reading.
        auto* data = reinterpret_cast<GByte*>(const_cast<std::byte*>(bytes.data()));
        VSILFILE* file = VSIFileFromMemBuffer(name_.c_str(), data, bytes.size(), FALSE);
        if (file != nullptr) VSIFCloseL(file);
    }
    ~MemoryFile() { VSIUnlink(name_.c_str()); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    const char* name() const { return name_.c_str(); }

    std::vector<std::byte> bytes() const {
        vsi_l_offset size = 0;
        const GByte* data = VSIGetMemFileBuffer(name_.c_str(), &size, FALSE);
        const auto all = std::as_bytes(std::span(data, data == nullptr ? 0 : static_cast<std::size_t>(size)));
        return {all.begin(), all.end()};
    }

  private:
    std::string name_;
};

Error not_written(const std::string& why) {
    return {ErrorKind::internal, fmt::format("GDAL cannot make a block: {}", why)};
}

Error not_read(const std::string& name, const std::string& why) {
    return {ErrorKind::damaged, fmt::format("{} is damaged: {}", name, why)};
}

/// How samples are compressed without loss.
struct Compression {
    const char* predictor;
    const char* zstd_level;
};

template <class T>
constexpr Compression compression() {
    // Heights are near their neighbours. On SRTM and USGS data this level has the size of DEFLATE at 9 and of
    // ZSTD at 9 within 1 %, and is 3 to 8 times faster to write than the former.
    if constexpr (std::is_same_v<T, float>) return {"3", "6"};
    if constexpr (std::is_same_v<T, std::int16_t>) return {"2", "6"};
    // Metrics are not (neighbours are of different levels), and are smaller by a sixth without a predictor.
    // Their bands and marks are small: higher levels save 4 %, and clear tables of 12 MiB for each.
    return {"1", "3"};
}

constexpr const char* kLittleEffort = "3";

template <class T>
CPLStringList creation_options(BlockShape shape, double max_error, Effort effort) {
    CPLStringList options;
    options.SetNameValue("INTERLEAVE", "BAND");
    options.SetNameValue("BLOCKYSIZE", fmt::format("{}", shape.rows).c_str());
    options.SetNameValue("ENDIANNESS", "LITTLE");
    if (max_error > 0) {
        options.SetNameValue("COMPRESS", "LERC_ZSTD");
        options.SetNameValue("MAX_Z_ERROR", fmt::format("{}", max_error).c_str());
        return options;
    }
    options.SetNameValue("COMPRESS", "ZSTD");
    options.SetNameValue("ZSTD_LEVEL",
                         effort == Effort::little ? kLittleEffort : compression<T>().zstd_level);
    options.SetNameValue("PREDICTOR", compression<T>().predictor);
    return options;
}

template <class T>
bool write_meaning(GDALDataset& file, const std::optional<GeoReference>& where) {
    bool written = true;
    if (where) {
        OGRSpatialReference crs;
        crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
        written = crs.importFromEPSG(where->epsg) == OGRERR_NONE;
        double transform[6] = {where->west - where->step_x / 2,
                               where->step_x,
                               0,
                               where->north + where->step_y / 2,
                               0,
                               -where->step_y};
        written = written && file.SetSpatialRef(&crs) == CE_None &&
                  file.SetGeoTransform(transform) == CE_None &&
                  file.SetMetadataItem("AREA_OR_POINT", "Point") == CE_None;
    }
    if constexpr (std::is_same_v<T, std::int16_t>) {
        written = written && file.GetRasterBand(1)->SetNoDataValue(kVoidInt16) == CE_None;
    } else if constexpr (std::is_same_v<T, float>) {
        const double nan = std::numeric_limits<double>::quiet_NaN();
        written = written && file.GetRasterBand(1)->SetNoDataValue(nan) == CE_None;
    }
    return written;
}

GDALDatasetUniquePtr open_block(const MemoryFile& file) {
    geotiff_driver();
    const char* const drivers[] = {"GTiff", nullptr};
    return GDALDatasetUniquePtr(
        GDALDataset::Open(file.name(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_INTERNAL, drivers));
}

}  // namespace

template <class T>
Result<std::vector<std::byte>> encode_block(std::span<const T> samples, BlockShape shape,
                                            const std::optional<GeoReference>& where, double max_error,
                                            Effort effort) {
    assert(samples.size() == shape.samples());
    const QuietGdal quiet;
    GDALDriver* driver = geotiff_driver();
    if (driver == nullptr) return not_written("its GeoTIFF driver is missing");

    const MemoryFile memory;
    GDALDatasetUniquePtr file(driver->Create(memory.name(), shape.columns, shape.rows, shape.bands,
                                             gdal_type<T>(),
                                             creation_options<T>(shape, max_error, effort).List()));
    if (!file || !write_meaning<T>(*file, where)) return not_written(QuietGdal::message());
    auto* data = const_cast<T*>(samples.data());
    if (file->RasterIO(GF_Write, 0, 0, shape.columns, shape.rows, data, shape.columns, shape.rows,
                       gdal_type<T>(), shape.bands, nullptr, 0, 0, 0, nullptr) != CE_None) {
        return not_written(QuietGdal::message());
    }
    file.reset();  // what is still in GDAL's cache is written here, and can fail here
    if (CPLGetLastErrorType() == CE_Failure) return not_written(QuietGdal::message());
    return memory.bytes();
}

template <class T>
Result<std::vector<T>> decode_block(std::span<const std::byte> bytes, BlockShape shape,
                                    const std::string& name, std::span<const int> bands) {
    const QuietGdal quiet;
    const MemoryFile memory(bytes);
    const GDALDatasetUniquePtr file = open_block(memory);
    if (!file) return not_read(name, QuietGdal::message());
    if (file->GetRasterXSize() != shape.columns || file->GetRasterYSize() != shape.rows ||
        file->GetRasterCount() != shape.bands ||
        file->GetRasterBand(1)->GetRasterDataType() != gdal_type<T>()) {
        return not_read(name, fmt::format("it does not hold {} x {} samples of the scene's type in {} bands",
                                          shape.columns, shape.rows, shape.bands));
    }
    // GDAL wants a pointer to non-const numbers, and only reads them.
    int* const chosen = bands.empty() ? nullptr : const_cast<int*>(bands.data());
    if (!bands.empty()) shape.bands = static_cast<int>(bands.size());
    std::vector<T> samples(shape.samples());
    if (file->RasterIO(GF_Read, 0, 0, shape.columns, shape.rows, samples.data(), shape.columns, shape.rows,
                       gdal_type<T>(), shape.bands, chosen, 0, 0, 0, nullptr) != CE_None) {
        return not_read(name, QuietGdal::message());
    }
    return samples;
}

Result<BlockShape> block_shape(std::span<const std::byte> bytes, const std::string& name) {
    const QuietGdal quiet;
    const MemoryFile memory(bytes);
    const GDALDatasetUniquePtr file = open_block(memory);
    if (!file) return not_read(name, QuietGdal::message());
    return BlockShape{file->GetRasterXSize(), file->GetRasterYSize(), file->GetRasterCount()};
}

template Result<std::vector<std::byte>> encode_block(std::span<const std::int16_t>, BlockShape,
                                                     const std::optional<GeoReference>&, double, Effort);
template Result<std::vector<std::byte>> encode_block(std::span<const std::uint16_t>, BlockShape,
                                                     const std::optional<GeoReference>&, double, Effort);
template Result<std::vector<std::byte>> encode_block(std::span<const std::uint8_t>, BlockShape,
                                                     const std::optional<GeoReference>&, double, Effort);
template Result<std::vector<std::byte>> encode_block(std::span<const float>, BlockShape,
                                                     const std::optional<GeoReference>&, double, Effort);
template Result<std::vector<std::int16_t>> decode_block(std::span<const std::byte>, BlockShape,
                                                        const std::string&, std::span<const int>);
template Result<std::vector<std::uint16_t>> decode_block(std::span<const std::byte>, BlockShape,
                                                         const std::string&, std::span<const int>);
template Result<std::vector<std::uint8_t>> decode_block(std::span<const std::byte>, BlockShape,
                                                        const std::string&, std::span<const int>);
template Result<std::vector<float>> decode_block(std::span<const std::byte>, BlockShape, const std::string&,
                                                 std::span<const int>);

}  // namespace relevo::lod
