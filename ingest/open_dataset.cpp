#include "ingest/open_dataset.hpp"

#include <cstring>
#include <fstream>
#include <vector>

#include <cpl_conv.h>
#include <cpl_string.h>
#include <fmt/format.h>

#include "ingest/refusal.hpp"

namespace relevo::ingest {
namespace {

namespace fs = std::filesystem;

DatasetPtr open_raster(const std::string& name) {
    return DatasetPtr{
        GDALDataset::Open(name.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR)};
}

/// The thread's setting of a GDAL option while this lives.
class OptionInScope {
  public:
    OptionInScope(const char* key, const char* value) : key_(key) {
        CPLSetThreadLocalConfigOption(key, value);
    }
    ~OptionInScope() { CPLSetThreadLocalConfigOption(key_, nullptr); }
    OptionInScope(const OptionInScope&) = delete;
    OptionInScope& operator=(const OptionInScope&) = delete;

  private:
    const char* key_;
};

Result<void> check_file(const fs::path& file, const std::string& name) {
    std::error_code failed;
    const auto status = fs::status(file, failed);
    if (failed || !fs::exists(status)) return {};  // not a plain path: GDAL decides
    if (fs::is_directory(status)) return {};       // some formats are folders
    if (!std::ifstream(file))
        return refusal(name, "cannot be read: no permission", "Change the file's permissions");
    if (fs::is_regular_file(status) && fs::file_size(file, failed) == 0)
        return refusal(name, "the file is empty", "Fetch it again");
    return {};
}

/// The rasters in a zip archive, as GDAL names.
std::vector<std::string> rasters_in_archive(const std::string& archive) {
    std::vector<std::string> rasters;
    const CPLStringList entries{VSIReadDirRecursive(("/vsizip/" + archive).c_str())};
    for (int i = 0; i < entries.size(); ++i) {
        const std::string entry = fmt::format("/vsizip/{}/{}", archive, entries[i]);
        if (GDALIdentifyDriverEx(entry.c_str(), GDAL_OF_RASTER, nullptr, nullptr) != nullptr)
            rasters.push_back(entry);
    }
    return rasters;
}

struct Variable {
    std::string name;
    std::string description;
};

std::vector<Variable> variables(GDALDataset& dataset) {
    std::vector<Variable> found;
    char** list = dataset.GetMetadata("SUBDATASETS");
    for (int i = 1;; ++i) {
        const char* name = CSLFetchNameValue(list, fmt::format("SUBDATASET_{}_NAME", i).c_str());
        if (name == nullptr) return found;
        const char* description = CSLFetchNameValue(list, fmt::format("SUBDATASET_{}_DESC", i).c_str());
        found.push_back({name, description == nullptr ? "" : description});
    }
}

bool is_zip(const std::string& input) {
    return input.size() > 4 && EQUAL(input.c_str() + input.size() - 4, ".zip");
}

}  // namespace

Result<OpenDataset> open_dataset(const std::string& input, const GdalMessages& messages) {
    GDALAllRegister();
    const OptionInScope half_pixel{"GTIFF_POINT_GEO_IGNORE", "NO"};

    OpenDataset opened;
    std::error_code ignored;
    if (fs::is_regular_file(input, ignored)) opened.file = input;
    opened.name = opened.file.empty() ? input : opened.file.filename().string();
    if (const auto readable = check_file(input, opened.name); !readable) return readable.error();

    opened.dataset = open_raster(input);
    if (!opened.dataset && is_zip(input)) {
        const auto rasters = rasters_in_archive(input);
        if (rasters.size() > 1)
            return refusal(opened.name, "the archive holds several rasters",
                           fmt::format("Give one of them as INPUT: {}", fmt::join(rasters, ", ")));
        if (rasters.size() == 1) opened.dataset = open_raster(rasters[0]);
    }
    if (!opened.dataset) {
        if (opened.file.empty() && !fs::exists(input, ignored) && input.find(':') == std::string::npos)
            return refusal(input, "there is no such file", "Check the path");
        return refusal(opened.name, fmt::format("GDAL cannot read it as a raster ({})", messages.text()),
                       "Check that it is a whole elevation file in a format of `gdalinfo --formats`");
    }

    if (opened.dataset->GetRasterCount() == 0) {
        const auto found = variables(*opened.dataset);
        if (found.size() != 1) {
            std::string names;
            for (const auto& variable : found)
                names += fmt::format("\n  {}  {}", variable.name, variable.description);
            return refusal(opened.name, found.empty() ? "it holds no raster" : "it holds several variables",
                           found.empty() ? "" : "Give the one with the heights as INPUT:" + names);
        }
        opened.dataset = open_raster(found[0].name);
        if (!opened.dataset) return refusal(opened.name, messages.text(), "");
    }

    if (opened.file.empty()) {  // NETCDF:"file":variable and the like
        const CPLStringList files{opened.dataset->GetFileList()};
        if (files.size() > 0 && fs::is_regular_file(files[0], ignored)) {
            opened.file = files[0];
            opened.name = opened.file.filename().string();
            const auto colon = input.rfind(':');
            if (colon != std::string::npos && colon > 0) opened.name += input.substr(colon);
        }
    }
    return opened;
}

}  // namespace relevo::ingest
