#include "ingest/image_file.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gdal_alg.h>
#include <gdal_priv.h>
#include <gdal_utils.h>
#include <ogr_spatialref.h>

#include "ingest/byte_raster.hpp"
#include "ingest/refusal.hpp"
#include "ingest/source/gdal_messages.hpp"

namespace relevo::ingest {
namespace {

/// Which bands are shown: red, green, blue or the only one, and alpha.
struct Bands {
    std::vector<int> colours;
    int alpha = 0;  // 0: none
    bool palette = false;
};

Bands bands_of(GDALDataset& dataset) {
    Bands found;
    std::array<int, 3> named{};
    std::vector<int> others;
    for (int i = 1; i <= dataset.GetRasterCount(); ++i) {
        GDALRasterBand& band = *dataset.GetRasterBand(i);
        const GDALColorInterp meaning = band.GetColorInterpretation();
        if (meaning == GCI_AlphaBand) {
            found.alpha = i;
            continue;
        }
        others.push_back(i);
        if (meaning == GCI_RedBand) named[0] = i;
        if (meaning == GCI_GreenBand) named[1] = i;
        if (meaning == GCI_BlueBand) named[2] = i;
        found.palette = found.palette || band.GetColorTable() != nullptr;
    }
    if (named[0] != 0 && named[1] != 0 && named[2] != 0) {
        found.colours.assign(named.begin(), named.end());
    } else {
        found.colours.assign(
            others.begin(),
            others.begin() + (others.size() >= 3 ? 3 : std::min<int>(1, static_cast<int>(others.size()))));
    }
    return found;
}

Result<void> check(GDALDataset& dataset, const std::string& name) {
    const Bands bands = bands_of(dataset);
    if (bands.colours.empty())
        return refusal(name, "it has no band of colours", "Give a raster of one or three bands");
    if (auto fine = check_bytes(dataset, name, bands.colours, "pictures are of bytes"); !fine)
        return fine.error();
    return check_georeference(dataset, name);
}

/// The bands that are shown and no others, palettes as colours.
DatasetPtr as_colours(GDALDataset& dataset) {
    const Bands bands = bands_of(dataset);
    CPLStringList words;
    for (const char* word : {"-of", "VRT"}) words.AddString(word);
    if (bands.palette) {
        for (const char* word : {"-b", "1", "-expand", "rgba"}) words.AddString(word);
    } else {
        std::vector<int> all = bands.colours;
        if (bands.alpha != 0) all.push_back(bands.alpha);
        for (const int band : all) {
            words.AddString("-b");
            words.AddString(std::to_string(band).c_str());
        }
    }
    auto* options = GDALTranslateOptionsNew(words.List(), nullptr);
    DatasetPtr made(
        GDALDataset::FromHandle(GDALTranslate("", GDALDataset::ToHandle(&dataset), options, nullptr)));
    GDALTranslateOptionsFree(options);
    return made;
}

/// Where a picture lies in a CRS: its bounds, and how long a pixel is, in units of that.
struct Lie {
    double pixel = 0;
    double west = 0;
    double east = 0;
};
Result<Lie> lie_in(GDALDataset& dataset, const char* crs, const std::string& name,
                   const GdalMessages& messages) {
    OGRSpatialReference to;
    to.SetFromUserInput(crs);
    char* wkt = nullptr;
    to.exportToWkt(&wkt);
    void* transformer =
        GDALCreateGenImgProjTransformer(GDALDataset::ToHandle(&dataset), nullptr, nullptr, wkt, FALSE, 0, 1);
    CPLFree(wkt);
    std::array<double, 6> affine{};
    std::array<double, 4> bounds{};
    int columns = 0;
    int rows = 0;
    const bool done =
        transformer != nullptr &&
        GDALSuggestedWarpOutput2(GDALDataset::ToHandle(&dataset), GDALGenImgProjTransform, transformer,
                                 affine.data(), &columns, &rows, bounds.data(), 0) == CE_None;
    if (transformer != nullptr) GDALDestroyGenImgProjTransformer(transformer);
    if (!done || !(affine[1] > 0))
        return refusal(name, fmt::format("it cannot be brought to the scene's grid ({})", messages.text()),
                       "Check its coordinate reference system: gdalinfo");
    return Lie{affine[1], bounds[0], bounds[2]};
}

/// Colours and how far they are there: one or three bands, then alpha.
Result<void> warp_onto(GDALDataset& from, const std::string& name, const geo::GridFrame& frame,
                       const GridSquare& square, double turned, ImageTexels& texels) {
    const GdalMessages messages;
    const double x_step = square.step * frame.step_x;
    const double y_step = square.step * frame.step_y;
    const double west = frame.west + square.column * frame.step_x - 0.5 * x_step + turned;
    const double north = frame.north - square.row * frame.step_y + 0.5 * y_step;
    const auto warped =
        warp_bytes(from, frame.kind, {west, north - square.side * y_step, west + square.side * x_step, north},
                   square.side, square.side, {"-et", "0.02", "-wo", "UNIFIED_SRC_NODATA=YES"});
    const int bands = warped ? warped->bands : 0;
    if (bands != 2 && bands != 4)
        return refusal(name, fmt::format("a part of it cannot be read ({})", messages.text()),
                       "Check the file: gdalinfo -checksum");
    const std::uint8_t* pixel = warped->bytes.data();
    for (auto& texel : texels) {
        const unsigned alpha = pixel[bands - 1];
        if (alpha > texel[3]) {
            for (int i = 0; i < 3; ++i) {
                const unsigned colour = pixel[bands == 4 ? i : 0];
                texel[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>((colour * alpha + 127) / 255);
            }
            texel[3] = static_cast<std::uint8_t>(alpha);
        }
        pixel += bands;
    }
    return {};
}

}  // namespace

Result<ImageFile::Handle> ImageFile::open_handle() const {
    const GdalMessages messages;
    auto opened = open_dataset({file_, {}, {}, {}}, messages);
    if (!opened) return opened.error();
    Handle handle;
    handle.file = std::move(opened->dataset);
    if (auto fine = check(*handle.file, opened->name); !fine) return fine.error();
    handle.colours = as_colours(*handle.file);
    if (!handle.colours)
        return refusal(opened->name, fmt::format("its bands cannot be read ({})", messages.text()),
                       "Check it: gdalinfo");
    return handle;
}

Result<ImageFile::Handle> ImageFile::take() const {
    {
        const std::lock_guard lock(mutex_);
        if (!free_.empty()) {
            Handle taken = std::move(free_.back());
            free_.pop_back();
            return taken;
        }
    }
    return open_handle();
}

Result<std::shared_ptr<const ImageFile>> ImageFile::open(const std::string& file,
                                                         const geo::GridFrame& frame) {
    std::shared_ptr<ImageFile> made(new ImageFile);
    made->file_ = file;
    made->name_ = std::filesystem::path(file).filename().string();
    made->frame_ = frame;
    auto handle = made->open_handle();
    if (!handle) return handle.error();
    const GdalMessages messages;
    const auto lie = lie_in(*handle->file, crs_of(frame.kind), made->name_, messages);
    if (!lie) return lie.error();
    made->pixel_posts_ = lie->pixel / std::min(frame.step_x, frame.step_y);
    made->beyond_180_ = !frame.is_polar() && lie->east > 180;
    made->free_.push_back(std::move(*handle));

    // All of the grid in a few hundred texels. Where a picture is smaller than one of these, its mean still
    // shows.
    constexpr int kSide = 512;
    const double step = std::max(frame.columns, frame.rows) / static_cast<double>(kSide - 1);
    const auto all = made->read({0, 0, std::max(step, 1e-6), kSide});
    if (!all) return all.error();
    const bool any = std::any_of(all->begin(), all->end(), [](const auto& texel) { return texel[3] != 0; });
    if (!any)
        return refusal(made->name_, "nothing of it is in the scene",
                       "Compare its extent with that of the scene: gdalinfo, relevo info");
    return std::shared_ptr<const ImageFile>(std::move(made));
}

Result<ImageTexels> ImageFile::read(const GridSquare& square) const {
    auto handle = take();
    if (!handle) return handle.error();
    ImageTexels texels(static_cast<std::size_t>(square.side) * static_cast<std::size_t>(square.side));
    std::vector<double> turns{0};
    if (!frame_.is_polar()) {
        // A grid's longitudes run on across the antimeridian; a file's may begin there.
        const double west = frame_.west + square.column * frame_.step_x;
        if (west + square.side * square.step * frame_.step_x > 180) turns.push_back(-360);
        if (beyond_180_ && west < 0) turns.push_back(360);
    }
    Result<void> done;
    for (const double turn : turns) {
        done = warp_onto(*handle->colours, name_, frame_, square, turn, texels);
        if (!done) break;
    }
    {
        const std::lock_guard lock(mutex_);
        free_.push_back(std::move(*handle));
    }
    if (!done) return done.error();
    return texels;
}

}  // namespace relevo::ingest
