#include "output/viewshed_file.hpp"

#include "output/partial_file.hpp"
#include <cpl_string.h>
#include <fmt/format.h>
#include <gdal_frmts.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include "lod/scene/scene_files.hpp"

namespace relevo::output {
namespace {

/// GDAL's messages are told as ours, and it writes no second file.
class Quiet {
  public:
    Quiet() {
        CPLPushErrorHandler(CPLQuietErrorHandler);
        CPLErrorReset();
        CPLSetThreadLocalConfigOption("GDAL_PAM_ENABLED", "NO");
    }
    ~Quiet() {
        CPLSetThreadLocalConfigOption("GDAL_PAM_ENABLED", nullptr);
        CPLPopErrorHandler();
    }
    Quiet(const Quiet&) = delete;
    Quiet& operator=(const Quiet&) = delete;
};

bool fill(GDALDataset& dataset, const lod::GeoReference& where, const lod::Viewshed& shed) {
    double transform[6] = {
        where.west - where.step_x / 2, where.step_x, 0, where.north + where.step_y / 2, 0, -where.step_y};
    OGRSpatialReference crs;
    if (crs.importFromEPSG(where.epsg) != OGRERR_NONE || dataset.SetGeoTransform(transform) != CE_None ||
        dataset.SetSpatialRef(&crs) != CE_None)
        return false;
    dataset.SetMetadataItem("AREA_OR_POINT", "Point");
    GDALRasterBand& band = *dataset.GetRasterBand(1);
    band.SetNoDataValue(lod::Viewshed::none);
    GDALColorTable colours;
    const GDALColorEntry hidden{40, 40, 48, 160};
    const GDALColorEntry visible{90, 190, 80, 255};
    const GDALColorEntry unknown{220, 180, 60, 255};
    colours.SetColorEntry(lod::Viewshed::hidden, &hidden);
    colours.SetColorEntry(lod::Viewshed::visible, &visible);
    colours.SetColorEntry(lod::Viewshed::unknown, &unknown);
    band.SetColorTable(&colours);
    auto samples = shed.posts.samples();
    return band.RasterIO(GF_Write, 0, 0, shed.posts.columns(), shed.posts.rows(), samples.data(),
                         shed.posts.columns(), shed.posts.rows(), GDT_Byte, 0, 0, nullptr) == CE_None;
}

}  // namespace

Result<void> write_viewshed(const std::filesystem::path& file, const lod::SceneInfo& info,
                            const lod::Viewshed& shed, bool overwrite) {
    auto whole = PartialFile::create(file, overwrite);
    if (!whole) return whole.error();
    const Quiet quiet;
    GDALRegister_GTiff();
    CPLStringList options;
    options.SetNameValue("COMPRESS", "DEFLATE");
    options.SetNameValue("TILED", "YES");
    GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GTiff");
    GDALDatasetUniquePtr dataset(driver == nullptr
                                     ? nullptr
                                     : driver->Create(whole->hidden().c_str(), shed.posts.columns(),
                                                      shed.posts.rows(), 1, GDT_Byte, options.List()));
    const bool filled =
        dataset && fill(*dataset, lod::geo_reference(info.frame, shed.box.column, shed.box.row), shed);
    dataset.reset();
    if (!filled || CPLGetLastErrorType() == CE_Failure)
        return Error{ErrorKind::internal,
                     fmt::format("GDAL cannot write {}: {}", file.string(), CPLGetLastErrorMsg())};
    return whole->take();
}

}  // namespace relevo::output
