#include "ingest/job.hpp"

#include <gdal.h>
#include <nlohmann/json.hpp>
#include <proj.h>

namespace relevo::ingest {
namespace {

template <class T>
nlohmann::json or_null(const std::optional<T>& value) {
    return value ? nlohmann::json(*value) : nlohmann::json();
}

nlohmann::json bounds_json(const std::optional<Bounds>& bounds) {
    if (!bounds) return {};
    return {bounds->west, bounds->south, bounds->east, bounds->north};
}

nlohmann::json layout_json(const std::optional<RawLayout>& raw) {
    if (!raw) return {};
    return {raw->columns, raw->rows, raw->type, raw->little_endian};
}

nlohmann::json request_json(const SourceRequest& request) {
    return {{"input", request.input},
            {"crs", or_null(request.crs)},
            {"bounds", bounds_json(request.bounds)},
            {"nodata", or_null(request.nodata)},
            {"height_scale", or_null(request.height_scale)},
            {"height_offset", request.height_offset},
            {"band", or_null(request.band)},
            {"variable", or_null(request.variable)},
            {"raw", layout_json(request.raw)},
            {"encoding", request.encoding ? nlohmann::json(*request.encoding) : nlohmann::json()},
            {"vertical",
             request.vertical ? nlohmann::json(lod::to_string(*request.vertical)) : nlohmann::json()}};
}

FileState state_of(const std::filesystem::path& file) {
    std::error_code unknown;
    return {std::filesystem::absolute(file, unknown), std::filesystem::file_size(file, unknown),
            std::filesystem::last_write_time(file, unknown)};
}

nlohmann::json file_json(const FileState& file) {
    return {file.path.string(), file.size, file.time.time_since_epoch().count()};
}

}  // namespace

std::vector<FileState> states_of(const std::vector<std::filesystem::path>& files) {
    std::vector<FileState> states;
    for (const auto& file : files)
        if (!file.empty()) states.push_back(state_of(file));
    return states;
}

std::string job_text(const ImportOptions& options, const std::vector<FileState>& files,
                     lod::HeightType type) {
    const MosaicRequest& mosaic = options.mosaic;
    nlohmann::json job{{"format", lod::SceneInfo::kFormatVersion},
                       {"gdal", GDALVersionInfo("RELEASE_NAME")},
                       {"proj", proj_info().release},
                       {"type", lod::to_string(type)},
                       {"max_height_error_m", options.max_height_error_m},
                       {"bounded_errors", options.bounded_errors},
                       {"frame", static_cast<int>(mosaic.target.frame)},
                       {"crop", bounds_json(mosaic.target.crop)},
                       {"resolution", or_null(mosaic.target.resolution)},
                       {"resampling", mosaic.resampling ? to_string(*mosaic.resampling) : ""},
                       {"priority", mosaic.priority == Priority::order ? "order" : "finest"},
                       {"feather_m", mosaic.feather_m},
                       {"datum", mosaic.datum ? mosaic.datum->name : ""},
                       {"geoid", mosaic.geoid ? mosaic.geoid->string() : ""}};
    job["sea"] = lod::to_string(options.sea.kind);
    if (!options.sea.mask_file.empty()) job["sea_mask"] = file_json(state_of(options.sea.mask_file));
    job["fill"] = options.fill_width;
    job["despike"] = options.despike;
    for (const SourceRequest& request : mosaic.sources) job["sources"].push_back(request_json(request));
    for (const auto& file : files) job["files"].push_back(file_json(file));
    return job.dump(1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace relevo::ingest
