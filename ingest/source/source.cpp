#include "ingest/source/source.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "ingest/refusal.hpp"
#include "ingest/source/gdal_messages.hpp"
#include "ingest/source/georeference.hpp"

namespace relevo::ingest {
namespace {

constexpr double kVoid = std::numeric_limits<double>::quiet_NaN();

/// A palette whose colours are the greys 0, 1, 2, ...: BMP has no other way to say "grey".
bool is_grey_ramp(const GDALColorTable* palette) {
    if (palette == nullptr) return false;
    for (int i = 0; i < palette->GetColorEntryCount(); ++i) {
        const GDALColorEntry& colour = *palette->GetColorEntry(i);
        if (colour.c1 != i || colour.c2 != i || colour.c3 != i) return false;
    }
    return true;
}

bool is_picture(GDALRasterBand& band) {
    const auto interpretation = band.GetColorInterpretation();
    if (interpretation == GCI_PaletteIndex) return !is_grey_ramp(band.GetColorTable());
    return interpretation >= GCI_RedBand && interpretation <= GCI_BlueBand;
}

}  // namespace

Result<Source> Source::open(const SourceRequest& request) {
    Source source;
    const GdalMessages messages;
    auto opened = open_dataset({request.input, request.variable, request.raw, request.trust}, messages);
    if (!opened) return opened.error();
    source.opened_ = std::move(*opened);
    source.columns_ = source.opened_.dataset->GetRasterXSize();
    source.rows_ = source.opened_.dataset->GetRasterYSize();
    source.encoding_ = request.encoding;
    if (auto chosen = request.encoding ? source.choose_colours() : source.choose_band(request.band); !chosen)
        return chosen.error();
    GDALRasterBand& band = *source.band_;

    auto where = georeference(source.opened_, request.crs, request.bounds, messages);
    if (!where) return where.error();
    source.crs_ = std::move(where->crs);
    source.posts_ = where->posts;
    if (!where->note.empty()) source.notes_.push_back(where->note);

    int has_nodata = 0;
    const double own_nodata = band.GetNoDataValue(&has_nodata);
    if (has_nodata != 0 && !request.encoding) source.nodata_ = own_nodata;
    if (request.nodata) {
        source.nodata_ = request.nodata;
        source.notes_.push_back(fmt::format("{} is taken as void (--nodata)", *request.nodata));
    }
    const int mask = band.GetMaskFlags();
    source.masked_ = (mask & (GMF_PER_DATASET | GMF_ALPHA)) != 0;

    VerticalClues clues;
    if (!request.encoding) {
        clues.unit = band.GetUnitType();
        clues.scale = band.GetScale();
        clues.offset = band.GetOffset();
    }
    clues.crs = source.crs_->vertical();
    clues.height_scale = request.height_scale;
    clues.height_offset = request.height_offset;
    clues.datum = request.vertical;
    auto rule = height_rule(clues);
    if (!rule) return refusal(source.name(), rule.error().message, "");
    source.rule_ = std::move(*rule);
    source.notes_.insert(source.notes_.end(), source.rule_.notes.begin(), source.rule_.notes.end());
    return source;
}

Result<void> Source::choose_band(const std::optional<int>& wanted) {
    GDALDataset& dataset = *opened_.dataset;
    const int count = dataset.GetRasterCount();
    std::vector<int> candidates;
    bool picture = false;
    for (int i = 1; i <= count; ++i) {
        GDALRasterBand& band = *dataset.GetRasterBand(i);
        picture = picture || is_picture(band);
        if (band.GetColorInterpretation() != GCI_AlphaBand) candidates.push_back(i);
    }
    if (wanted) {
        if (*wanted < 1 || *wanted > count)
            return refusal(name(), fmt::format("it has no band {}", *wanted),
                           fmt::format("Give one from 1 to {} with --band", count));
        candidates = {*wanted};
        picture = false;
    }
    // Colours that are not named as such: nobody keeps heights in several bands of bytes.
    const bool bytes = count > 0 && dataset.GetRasterBand(1)->GetRasterDataType() == GDT_Byte;
    picture = picture || (candidates.size() >= 3 && bytes);
    if (picture)
        return refusal(
            name(), "it looks like an image, not like heights (colours or a palette)",
            "If heights are packed into its colours, say how with --encoding terrain-rgb (Mapbox) or "
            "--encoding terrarium; if one of its bands is heights, name it with --band");
    if (candidates.empty()) return refusal(name(), "it has no band of heights", "Give a file with heights");
    if (candidates.size() > 1) {
        std::string list;
        for (const int i : candidates) {
            GDALRasterBand& band = *dataset.GetRasterBand(i);
            list += fmt::format("\n  {}  {} {}", i, GDALGetDataTypeName(band.GetRasterDataType()),
                                band.GetDescription());
        }
        return refusal(name(),
                       fmt::format("it has {} bands, any of which could be heights", candidates.size()),
                       "Give one with --band:" + list);
    }
    band_ = dataset.GetRasterBand(candidates[0]);
    if (GDALDataTypeIsComplex(band_->GetRasterDataType()) != 0)
        return refusal(name(), "its values are complex numbers, not heights", "Give another band or file");
    return {};
}

Result<void> Source::choose_colours() {
    GDALDataset& dataset = *opened_.dataset;
    const int count = dataset.GetRasterCount();
    bool colours = count == 3 || count == 4;
    for (int i = 1; colours && i <= count; ++i)
        colours = dataset.GetRasterBand(i)->GetRasterDataType() == GDT_Byte;
    if (!colours)
        return refusal(name(), "it has no red, green and blue of 8 bits, so no heights are packed into them",
                       "Leave --encoding out, or give the tile as it was served");
    const char* compression = dataset.GetMetadataItem("COMPRESSION", "IMAGE_STRUCTURE");
    const bool lossy =
        EQUAL(dataset.GetDriverName(), "JPEG") ||
        (compression != nullptr && std::string_view{compression}.find("JPEG") != std::string::npos);
    if (lossy)
        return refusal(name(),
                       "it was compressed with loss, which ruins heights that are packed into colours",
                       "Fetch it as PNG or WebP without loss");
    band_ = dataset.GetRasterBand(1);
    return {};
}

std::vector<std::filesystem::path> Source::all_files() const {
    const CPLStringList names{opened_.dataset->GetFileList()};
    return {names.List(), names.List() + names.size()};
}

bool Source::whole_metres() const {
    return !encoding_ && rule_.identity() && GDALDataTypeIsInteger(band_->GetRasterDataType()) != 0;
}

std::string Source::value_type() const {
    if (encoding_) return "Float32";  // a tenth or a 256th of a metre
    return GDALGetDataTypeName(band_->GetRasterDataType());
}

Result<lod::Raster<double>> Source::read(Window window) const {
    lod::Raster<double> heights{window.columns, window.rows, kVoid};
    const int left = std::max(window.column, 0);
    const int top = std::max(window.row, 0);
    const int right = std::min(window.column + window.columns, columns_);
    const int bottom = std::min(window.row + window.rows, rows_);
    if (left < right && top < bottom) {
        const Window inside{left, top, right - left, bottom - top};
        if (auto done = read_values(inside, heights, left - window.column, top - window.row); !done)
            return done.error();
    }
    return heights;
}

Result<void> Source::read_band(Window window, double* into, GSpacing line,
                               const GdalMessages& messages) const {
    if (band_->RasterIO(GF_Read, window.column, window.row, window.columns, window.rows, into, window.columns,
                        window.rows, GDT_Float64, sizeof(double), line, nullptr) == CE_None)
        return {};
    return refusal(name(), fmt::format("it is cut short or damaged ({})", messages.text()), "Fetch it again");
}

Result<void> Source::read_colours(Window window, double* into, std::ptrdiff_t columns,
                                  const GdalMessages& messages) const {
    lod::Raster<std::array<std::uint8_t, 3>> colours{window.columns, window.rows};
    int bands[] = {1, 2, 3};
    const auto line = static_cast<GSpacing>(window.columns) * 3;
    if (opened_.dataset->RasterIO(GF_Read, window.column, window.row, window.columns, window.rows,
                                  colours.row(0), window.columns, window.rows, GDT_Byte, 3, bands, 3, line, 1,
                                  nullptr) != CE_None)
        return refusal(name(), fmt::format("it is cut short or damaged ({})", messages.text()),
                       "Fetch it again");
    for (int r = 0; r < window.rows; ++r)
        for (int c = 0; c < window.columns; ++c) {
            const auto [red, green, blue] = colours.at(c, r);
            into[r * columns + c] = decoded_height(*encoding_, red, green, blue);
        }
    return {};
}

Result<void> Source::read_values(Window window, lod::Raster<double>& into, int column, int row) const {
    const GdalMessages messages;
    double* first = &into.at(column, row);
    const auto line = static_cast<GSpacing>(into.columns()) * static_cast<GSpacing>(sizeof(double));
    if (auto done = encoding_ ? read_colours(window, first, into.columns(), messages)
                              : read_band(window, first, line, messages);
        !done)
        return done;

    lod::Raster<std::uint8_t> mask;
    if (masked_) {
        mask = lod::Raster<std::uint8_t>{window.columns, window.rows};
        if (band_->GetMaskBand()->RasterIO(GF_Read, window.column, window.row, window.columns, window.rows,
                                           mask.row(0), window.columns, window.rows, GDT_Byte, 0, 0,
                                           nullptr) != CE_None)
            return refusal(name(), fmt::format("its mask cannot be read ({})", messages.text()),
                           "Fetch it again");
    }
    for (int r = 0; r < window.rows; ++r) {
        double* values = &into.at(column, row + r);
        for (int c = 0; c < window.columns; ++c) {
            double& value = values[c];
            if (is_void(value) || (masked_ && mask.at(c, r) == 0)) {
                value = kVoid;
                continue;
            }
            if (!rule_.identity()) value = rule_(value);
            if (std::abs(value) > std::numeric_limits<float>::max()) value = kVoid;
        }
    }
    return {};
}

bool Source::is_void(double value) const {
    if (!std::isfinite(value)) return true;
    if (!nodata_) return false;
    if (value == *nodata_) return true;
    // A nodata value is stored as text, often with too few digits to be a float's own value.
    return band_->GetRasterDataType() == GDT_Float32 &&
           static_cast<float>(value) == static_cast<float>(*nodata_);
}

}  // namespace relevo::ingest
