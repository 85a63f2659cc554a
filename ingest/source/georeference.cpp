#include "ingest/source/georeference.hpp"

#include <cmath>

#include <cpl_conv.h>
#include <cpl_string.h>
#include <fmt/format.h>
#include <ogr_spatialref.h>

#include "ingest/refusal.hpp"

namespace relevo::ingest {
namespace {

std::string wkt_of(const OGRSpatialReference& reference) {
    char* text = nullptr;
    const char* const options[] = {"FORMAT=WKT2_2019", nullptr};
    std::string wkt;
    if (reference.exportToWkt(&text, options) == OGRERR_NONE && text != nullptr) wkt = text;
    CPLFree(text);
    return wkt;
}

/// GDAL looks for NAME.prj beside a raster, but not beside the archive that the raster is in.
std::string wkt_beside(const std::filesystem::path& file) {
    auto prj = file;
    prj.replace_extension(".prj");
    std::error_code ignored;
    if (file.empty() || !std::filesystem::is_regular_file(prj, ignored)) return {};
    const CPLStringList lines{CSLLoad2(prj.c_str(), 100, 4096, nullptr)};
    OGRSpatialReference reference;
    if (lines.size() == 0 || reference.importFromESRI(const_cast<char**>(lines.List())) != OGRERR_NONE)
        return {};
    return wkt_of(reference);
}

Result<Affine> posts_from(const OpenDataset& opened, const std::optional<Bounds>& bounds) {
    GDALDataset& dataset = *opened.dataset;
    std::array<double, 6> transform{};
    if (bounds) {
        if (!(bounds->east > bounds->west) || !(bounds->north > bounds->south))
            return Error{ErrorKind::usage,
                         "--bounds: W,S,E,N with W < E and S < N, the outer edges of the pixels"};
        transform = {bounds->west,
                     (bounds->east - bounds->west) / dataset.GetRasterXSize(),
                     0,
                     bounds->north,
                     0,
                     (bounds->south - bounds->north) / dataset.GetRasterYSize()};
    } else if (dataset.GetGeoTransform(transform.data()) != CE_None) {
        const char* remedy = "Give the outer edges of its pixels with --bounds W,S,E,N";
        if (dataset.GetGCPCount() > 0)
            return refusal(opened.name, "it is tied to the ground by control points alone",
                           "Warp it first, with `gdalwarp -tps`, or give --bounds");
        if (dataset.GetMetadata("GEOLOCATION") != nullptr || dataset.GetMetadata("RPC") != nullptr)
            return refusal(opened.name, "its posts are not on a regular grid",
                           "Warp it first, with `gdalwarp`");
        return refusal(opened.name, "it does not say where it is (no georeference)", remedy);
    }
    const Affine posts = Affine::of_posts(transform);
    if (!posts.inverse())
        return refusal(opened.name, "its georeference puts all posts on a line", "Give --bounds W,S,E,N");
    return posts;
}

bool looks_like_degrees(const Affine& posts, const GDALDataset& dataset) {
    const Place first = posts.at({0, 0});
    const Place last = posts.at({const_cast<GDALDataset&>(dataset).GetRasterXSize() - 1.0,
                                 const_cast<GDALDataset&>(dataset).GetRasterYSize() - 1.0});
    return std::abs(first.x) <= 360 && std::abs(last.x) <= 360 && std::abs(first.y) <= 90 &&
           std::abs(last.y) <= 90;
}

}  // namespace

Result<Georeference> georeference(const OpenDataset& opened, const std::optional<std::string>& crs,
                                  const std::optional<Bounds>& bounds, const GdalMessages& gdal_says) {
    auto posts = posts_from(opened, bounds);
    if (!posts) return posts.error();

    std::string definition;
    std::string note;
    const OGRSpatialReference* own = opened.dataset->GetSpatialRef();
    if (crs) {
        definition = *crs;
        if (own != nullptr && !own->IsEmpty()) note = "the file's own CRS is overridden (--crs)";
    } else if (own != nullptr && !own->IsEmpty()) {
        definition = wkt_of(*own);
    } else if (definition = wkt_beside(opened.file); !definition.empty()) {
        note = "the CRS is from the .prj beside it";
    }
    if (definition.empty()) {
        const std::string why =
            gdal_says.empty() ? std::string{} : fmt::format(" (GDAL says: {})", gdal_says.text());
        return refusal(opened.name, "it does not name its coordinate reference system" + why,
                       looks_like_degrees(*posts, *opened.dataset)
                           ? "If its axes are longitude and latitude, give --crs EPSG:4326"
                           : "Give it with --crs, e.g. --crs EPSG:32611");
    }
    auto parsed = Crs::parse(definition);
    if (!parsed) return refusal(opened.name, parsed.error().message, "Give another with --crs");
    return Georeference{std::move(*parsed), *posts, std::move(note)};
}

}  // namespace relevo::ingest
