#include "output/cog.hpp"

#include "output/scene_dataset.hpp"
#include <cpl_string.h>
#include <fmt/format.h>
#include <gdal_frmts.h>

namespace relevo::output {
namespace {

int CPL_STDCALL tell(double done, const char*, void* progress) {
    const auto& told = *static_cast<const std::function<bool(double)>*>(progress);
    return !told || told(done) ? TRUE : FALSE;
}

/// GDAL's messages are told as ours; its cache has the size asked for; both as before at the end.
class GdalSettings {
  public:
    explicit GdalSettings(std::uint64_t cache_bytes) : cache_(GDALGetCacheMax64()) {
        CPLPushErrorHandler(CPLQuietErrorHandler);
        CPLErrorReset();
        GDALSetCacheMax64(static_cast<GIntBig>(cache_bytes));
        CPLSetThreadLocalConfigOption("GDAL_PAM_ENABLED",
                                      "NO");  // no second file for what the first cannot say
    }
    ~GdalSettings() {
        CPLSetThreadLocalConfigOption("GDAL_PAM_ENABLED", nullptr);
        GDALSetCacheMax64(cache_);
        CPLPopErrorHandler();
    }
    GdalSettings(const GdalSettings&) = delete;
    GdalSettings& operator=(const GdalSettings&) = delete;

  private:
    GIntBig cache_;
};

}  // namespace

Result<void> write_cog(const lod::Scene& scene, const lod::BlockGrid::Box& box, const CogRequest& request,
                       PartialFile& file) {
    const GdalSettings settings(request.cache_bytes);
    GDALRegister_GTiff();
    GDALRegister_COG();
    GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("COG");
    if (driver == nullptr)
        return Error{ErrorKind::internal, "this GDAL has no driver for cloud-optimised GeoTIFF"};
    CPLStringList options;
    options.SetNameValue("COMPRESS", request.compression.c_str());
    if (request.compression == "ZSTD") options.SetNameValue("LEVEL", "6");  // as in scenes (block_file.cpp)
    options.SetNameValue("PREDICTOR", "YES");
    options.SetNameValue("BLOCKSIZE", "512");
    options.SetNameValue("OVERVIEW_RESAMPLING", "NEAREST");
    options.SetNameValue("BIGTIFF", "IF_SAFER");
    options.SetNameValue("NUM_THREADS", "ALL_CPUS");

    SceneDataset from(scene, box);
    auto progress = request.progress;
    bool stopped = false;
    std::function<bool(double)> told = [&](double done) {
        stopped = stopped || (progress && !progress(done));
        return !stopped;
    };
    const std::string name = file.hidden().string();
    GDALDatasetUniquePtr written(driver->CreateCopy(name.c_str(), &from, TRUE, options.List(), tell, &told));
    const bool made = written != nullptr;
    written.reset();
    if (from.failure()) return *from.failure();
    if (stopped) return Error{ErrorKind::internal, "stopped: nothing was written"};
    if (!made || CPLGetLastErrorType() == CE_Failure)
        return Error{ErrorKind::internal,
                     fmt::format("GDAL cannot write the file: {}", CPLGetLastErrorMsg())};
    return {};
}

}  // namespace relevo::output
