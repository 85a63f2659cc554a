#include "ingest/wave_map_file.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include <fmt/format.h>
#include <gdal_priv.h>

#include "geo/cubic_spline.hpp"
#include "ingest/reference/vertical.hpp"
#include "ingest/refusal.hpp"
#include "ingest/source/gdal_messages.hpp"
#include "ingest/source/open_dataset.hpp"

namespace relevo::ingest {
namespace {

struct Band {
    GDALRasterBand* band = nullptr;
    double metres = 1;  // a unit
    double offset_m = 0;
};

Result<GDALRasterBand*> only_band(GDALDataset& dataset, const std::string& name) {
    std::vector<GDALRasterBand*> bands;
    for (int i = 1; i <= dataset.GetRasterCount(); ++i) {
        GDALRasterBand* band = dataset.GetRasterBand(i);
        if (band->GetColorInterpretation() != GCI_AlphaBand) bands.push_back(band);
    }
    if (bands.empty()) return refusal(name, "it has no band of heights", "Give a raster of one band");
    if (bands.size() > 1)
        return refusal(name, fmt::format("it has {} bands, and heights are one", bands.size()),
                       "Make a raster of one of them first: gdal_translate -b 1");
    if (bands[0]->GetColorTable() != nullptr)
        return refusal(name, "its values are colours of a palette, not heights",
                       "Make shades of grey of them first: gdal_translate -expand gray");
    if (GDALDataTypeIsComplex(bands[0]->GetRasterDataType()) != 0)
        return refusal(name, "its values are complex numbers, not heights", "Give another raster");
    return bands[0];
}

Result<Band> band_of(GDALDataset& dataset, const std::string& name, bool range_given) {
    const auto found = only_band(dataset, name);
    if (!found) return found.error();
    GDALRasterBand& band = **found;
    const std::string unit = band.GetUnitType();
    const auto length = unit.empty() ? std::optional(1.0) : length_unit(unit);
    if (!length && !range_given)
        return refusal(name, fmt::format("its unit '{}' is not one of length", unit),
                       "Give the metres from its lowest to its highest height: --waves MAP,TILE_M,HEIGHT_M");
    const bool is_bare = unit.empty() && band.GetScale() == 1 && band.GetOffset() == 0;
    const GDALDataType type = band.GetRasterDataType();
    if (is_bare && !range_given && GDALDataTypeIsInteger(type) != 0 && GDALGetDataTypeSizeBits(type) <= 16)
        return refusal(name, "its values are shades of grey: nothing says how many metres they are",
                       "Give the metres from its lowest to its highest height: --waves MAP,TILE_M,HEIGHT_M");
    return Band{&band, band.GetScale() * length.value_or(1), band.GetOffset() * length.value_or(1)};
}

/// Metres, row by row as stored.
Result<std::vector<double>> read_heights(const Band& band, const std::string& name,
                                         const GdalMessages& messages) {
    const int columns = band.band->GetXSize();
    const int rows = band.band->GetYSize();
    std::vector<double> heights(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    std::vector<std::uint8_t> valid(heights.size(), 255);
    const auto read = [&](GDALRasterBand& from, void* to, GDALDataType type) {
        return from.RasterIO(GF_Read, 0, 0, columns, rows, to, columns, rows, type, 0, 0, nullptr) == CE_None;
    };
    if (!read(*band.band, heights.data(), GDT_Float64) ||
        ((band.band->GetMaskFlags() & GMF_ALL_VALID) == 0 &&
         !read(*band.band->GetMaskBand(), valid.data(), GDT_Byte)))
        return refusal(name, fmt::format("it is cut short or damaged ({})", messages.text()),
                       "Fetch it again");
    std::size_t holes = 0;
    for (std::size_t i = 0; i < heights.size(); ++i) {
        heights[i] = heights[i] * band.metres + band.offset_m;
        holes += valid[i] == 0 || !std::isfinite(heights[i]);
    }
    if (holes > 0)
        return refusal(name, fmt::format("{} of its {} posts have no height", holes, heights.size()),
                       "Fill them first: gdal_fillnodata.py");
    return heights;
}

/// A period sampled at equal steps, each sample in the middle of its own, at `count` steps instead.
std::vector<double> resampled(std::vector<double> line, std::size_t count) {
    const std::size_t finer = std::bit_ceil(line.size());
    if (finer != line.size() || finer < count) {
        const std::size_t wanted = std::max(finer, count);
        const auto old = static_cast<double>(line.size());
        geo::to_periodic_spline_coefficients(line);
        std::vector<double> fine;
        for (std::size_t i = 0; i < wanted; ++i) {
            const double at = (static_cast<double>(i) + 0.5) * old / static_cast<double>(wanted) - 0.5;
            const double before = std::floor(at);
            const auto weights = geo::spline_weights(at - before);
            const auto first = static_cast<std::size_t>(before + old * 2 - 1);  // of four, not below 0
            double sum = 0;
            for (std::size_t k = 0; k < weights.size(); ++k)
                sum += weights[k] * line[(first + k) % line.size()];
            fine.push_back(sum);
        }
        line = std::move(fine);
    }
    while (line.size() > count) {
        for (std::size_t i = 0; i < line.size() / 2; ++i) line[i] = 0.5 * (line[2 * i] + line[2 * i + 1]);
        line.resize(line.size() / 2);
    }
    return line;
}

/// The power of two that is next to it, as a ratio.
int nearest_power(int number) {
    return 1 << static_cast<int>(std::lround(std::log2(static_cast<double>(number))));
}

WaveMapPosts squared(const std::vector<double>& heights, int columns, int rows) {
    WaveMapPosts posts;
    posts.columns = columns;
    posts.rows = rows;
    posts.side = std::min(nearest_power(std::max(columns, rows)), kMostWaveMapSide);
    const auto side = static_cast<std::size_t>(posts.side);
    const auto length = static_cast<std::size_t>(columns);
    std::vector<std::vector<double>> lines;  // along the rows
    for (std::size_t first = 0; first < heights.size(); first += length) {
        const auto begin = heights.begin() + static_cast<std::ptrdiff_t>(first);
        lines.push_back(resampled({begin, begin + columns}, side));
    }
    posts.heights_m.resize(side * side);
    for (std::size_t column = 0; column < side; ++column) {
        std::vector<double> line;
        line.reserve(lines.size());
        for (const auto& row : lines) line.push_back(row[column]);
        line = resampled(std::move(line), side);
        for (std::size_t row = 0; row < side; ++row)
            posts.heights_m[(side - 1 - row) * side + column] = static_cast<float>(line[row]);
    }
    return posts;
}

}  // namespace

Result<WaveMapPosts> read_wave_map(const std::string& file, double range_m) {
    const GdalMessages messages;
    auto opened = open_dataset({file, {}, {}, {}}, messages);
    if (!opened) return opened.error();
    GDALDataset& dataset = *opened->dataset;
    const std::string& name = opened->name;
    const int columns = dataset.GetRasterXSize();
    const int rows = dataset.GetRasterYSize();
    if (std::max(columns, rows) > kMostWaveMapRasterSide)
        return refusal(name,
                       fmt::format("{} x {} posts are too many: {} a side at most", columns, rows,
                                   kMostWaveMapRasterSide),
                       fmt::format("Make it smaller first: gdal_translate -outsize {0} {0} -r average",
                                   kMostWaveMapSide));
    const auto band = band_of(dataset, name, range_m > 0);
    if (!band) return band.error();
    auto heights = read_heights(*band, name, messages);
    if (!heights) return heights.error();
    const auto [lowest, highest] = std::minmax_element(heights->begin(), heights->end());
    const double range = *highest - *lowest;
    if (!(range > 0))
        return refusal(name, "all its heights are the same",
                       "Give a map of waves, or a flat sea with --wind 0 and without --waves");
    if (!(range_m > 0) && range > kMostWaveMapRange)
        return refusal(name,
                       fmt::format("{:.6g} m from its lowest to its highest height are no waves: {} at most",
                                   range, kMostWaveMapRange),
                       "Give what they are to be: --waves MAP,TILE_M,HEIGHT_M");
    if (range_m > 0) {
        for (double& h : *heights) h *= range_m / range;
    }
    return squared(*heights, columns, rows);
}

}  // namespace relevo::ingest
