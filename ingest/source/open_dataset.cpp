#include "ingest/source/open_dataset.hpp"

#include <cstring>
#include <fstream>
#include <vector>

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <fmt/format.h>

#include "ingest/refusal.hpp"
#include "ingest/source/vrt_sources.hpp"
#include "ingest/source/zip_archive.hpp"

namespace relevo::ingest {
namespace {

namespace fs = std::filesystem;

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

DatasetPtr open_raster(const std::string& name) {
    if (is_unreadable_hgt(name)) return nullptr;
    return DatasetPtr{GDALDataset::Open(
        name.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR, elevation_drivers())};
}

Result<void> check_file(const fs::path& file, const std::string& name) {
    std::error_code failed;
    const auto status = fs::status(file, failed);
    if (failed || !fs::exists(status)) return {};  // not a plain path: GDAL decides
    if (fs::is_directory(status)) return {};       // some formats are folders
    // A pipe would be waited for, by us or by GDAL.
    if (!fs::is_regular_file(status))
        return refusal(name, "it is a pipe or a device, not a file", "Save it as a file first");
    if (!std::ifstream(file))
        return refusal(name, "cannot be read: no permission", "Change the file's permissions");
    if (fs::file_size(file, failed) == 0) return refusal(name, "the file is empty", "Fetch it again");
    return {};
}

/// The rasters in a zip archive, as GDAL names.
std::vector<std::string> rasters_in_archive(const std::string& archive) {
    std::vector<std::string> rasters;
    const CPLStringList entries{VSIReadDirRecursive(("/vsizip/" + archive).c_str())};
    for (int i = 0; i < entries.size(); ++i) {
        const std::string entry = fmt::format("/vsizip/{}/{}", archive, entries[i]);
        if (GDALIdentifyDriverEx(entry.c_str(), GDAL_OF_RASTER, elevation_drivers(), nullptr) != nullptr)
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

/// "elevation" of NETCDF:"file.nc":elevation, "grid/elevation" of HDF5:"file.h5"://grid/elevation.
std::string short_name(const Variable& variable) {
    const auto start = variable.name.find_first_not_of('/', variable.name.rfind(':') + 1);
    return start == std::string::npos ? variable.name : variable.name.substr(start);
}

std::string list_of(const std::vector<Variable>& variables) {
    std::string names;
    for (const auto& variable : variables)
        names += fmt::format("\n  {}  {}", short_name(variable), variable.description);
    return names;
}

bool is_zip(const std::string& input) {
    return input.size() > 4 && EQUAL(input.c_str() + input.size() - 4, ".zip");
}

/// Puts a variable in the place of the container that is open.
Result<void> choose_variable(OpenDataset& opened, const std::optional<std::string>& wanted,
                             const GdalMessages& messages) {
    GDALDataset& container = *opened.dataset;
    const auto found = variables(container);
    std::string chosen;
    if (wanted) {
        for (const auto& variable : found)
            if (short_name(variable) == *wanted) chosen = variable.name;
        // The only variable of a NetCDF file is opened with the file, and not listed.
        if (const char* own = container.GetRasterCount() > 0
                                  ? container.GetRasterBand(1)->GetMetadataItem("NETCDF_VARNAME")
                                  : nullptr;
            own != nullptr && *wanted == own)
            return {};
        if (chosen.empty())
            return refusal(opened.name, fmt::format("it has no variable '{}'", *wanted),
                           found.empty() ? "Leave it out" : "Give one of these:" + list_of(found));
    } else {
        if (container.GetRasterCount() > 0) return {};
        if (found.empty()) return refusal(opened.name, "it holds no raster", "Give another file");
        if (found.size() > 1)
            return refusal(
                opened.name, "it holds several variables",
                fmt::format("Give the one with the heights with --variable NAME, or {}:NAME as INPUT:{}",
                            opened.name, list_of(found)));
        chosen = found[0].name;
    }
    opened.dataset = open_raster(chosen);
    if (!opened.dataset) return refusal(opened.name, messages.text(), "Fetch it again");
    if (wanted) opened.name += ":" + *wanted;
    return {};
}

/// Splits FILE:VARIABLE where FILE is one.
void take_variable(std::string& input, std::optional<std::string>& variable) {
    std::error_code ignored;
    const auto colon = input.rfind(':');
    if (variable || colon == std::string::npos || colon == 0 || colon + 1 == input.size() ||
        fs::exists(input, ignored) || !fs::is_regular_file(input.substr(0, colon), ignored))
        return;
    variable = input.substr(colon + 1);
    input.resize(colon);
}

std::optional<std::uint64_t> bytes_of(const std::string& name) {
    VSIStatBufL status{};
    if (VSIStatExL(name.c_str(), &status, VSI_STAT_EXISTS_FLAG | VSI_STAT_NATURE_FLAG | VSI_STAT_SIZE_FLAG) !=
            0 ||
        VSI_ISDIR(status.st_mode))
        return {};
    return static_cast<std::uint64_t>(status.st_size);
}

Result<DatasetPtr> open_trusted(const std::string& gdal_name, const std::string& shown, const Trust& trust) {
    if (auto trusted = check_vrt_sources(gdal_name, shown, trust); !trusted) return trusted.error();
    return open_raster(gdal_name);
}

Error not_read(const std::string& input, const OpenDataset& opened, const GdalMessages& messages) {
    std::error_code ignored;
    if (opened.file.empty() && !fs::exists(input, ignored) && input.find(':') == std::string::npos)
        return refusal(input, "there is no such file", "Check the path");
    const std::string said = messages.text();
    const GDALDriverH other = GDALIdentifyDriverEx(input.c_str(), GDAL_OF_RASTER, nullptr, nullptr);
    if (other != nullptr && !is_elevation_driver(GDALGetDriverShortName(other)))
        return refusal(
            opened.name,
            fmt::format("it is in a format that is not for heights ({})", GDALGetDriverLongName(other)),
            "If it holds heights, make a GeoTIFF of it first, with gdal_translate");
    return refusal(opened.name, fmt::format("GDAL cannot read it as a raster ({})", said),
                   "Check that it is a whole elevation file in a format of `gdalinfo --formats`");
}

}  // namespace

Result<void> check_size(GDALDataset& dataset, const std::string& name, std::optional<std::uint64_t> bytes) {
    const auto posts = static_cast<std::uint64_t>(dataset.GetRasterXSize()) *
                       static_cast<std::uint64_t>(dataset.GetRasterYSize());
    // Constant heights pack a few thousand posts into a byte at best; small files may say what they like.
    constexpr std::uint64_t kMostPostsPerByte = 20000;
    constexpr std::uint64_t kFew = 1 << 24;
    if (bytes && posts > kFew && posts / kMostPostsPerByte > *bytes)
        return refusal(name,
                       fmt::format("its header claims {} x {} posts in a file of {} bytes",
                                   dataset.GetRasterXSize(), dataset.GetRasterYSize(), *bytes),
                       "It is damaged, or cut short: fetch it again");
    for (int i = 1; i <= dataset.GetRasterCount(); ++i) {
        GDALRasterBand& band = *dataset.GetRasterBand(i);
        int columns = 0;
        int rows = 0;
        band.GetBlockSize(&columns, &rows);
        const auto block = static_cast<std::uint64_t>(columns) * static_cast<std::uint64_t>(rows) *
                           static_cast<std::uint64_t>(GDALGetDataTypeSizeBytes(band.GetRasterDataType()));
        if (block > kMostBlockBytes)
            return refusal(
                name,
                fmt::format("it is stored in blocks of {} x {} posts, {} MiB each, and can only be "
                            "read in whole blocks",
                            columns, rows, block >> 20),
                "Make a tiled GeoTIFF of it first: gdal_translate -co TILED=YES");
    }
    return {};
}

Result<OpenDataset> open_dataset(const OpenRequest& request, const GdalMessages& messages) {
    GDALAllRegister();
    const OptionInScope half_pixel{"GTIFF_POINT_GEO_IGNORE", "NO"};
    const OptionInScope no_python{"GDAL_VRT_ENABLE_PYTHON", "NO"};
    // Companions are looked for by name: listing a folder of thousands of tiles for each of them takes longer
    // than opening it.
    const char* listing = "GDAL_DISABLE_READDIR_ON_OPEN";
    const OptionInScope no_listing{listing, CPLGetConfigOption(listing, "TRUE")};

    std::string input = request.input;
    std::optional<std::string> variable = request.variable;
    if (auto named = check_input_name(input, request.trust); !named) return named.error();
    if (input.find("://") != std::string::npos && is_remote(input) && input.rfind("http", 0) == 0)
        input = "/vsicurl/" + input;
    take_variable(input, variable);

    OpenDataset opened;
    std::error_code ignored;
    if (fs::is_regular_file(input, ignored)) opened.file = input;
    opened.name = opened.file.empty() ? input : opened.file.filename().string();
    if (const auto readable = check_file(input, opened.name); !readable) return readable.error();

    if (request.raw) {
        const auto text = raw_dataset(input, *request.raw);
        if (!text) return text.error();
        opened.dataset = open_raster(*text);
        if (!opened.dataset) return refusal(opened.name, messages.text(), "Check --raw");
        return opened;
    }

    auto dataset = open_trusted(input, opened.name, request.trust);
    if (!dataset) return dataset.error();
    opened.dataset = std::move(*dataset);
    if (!opened.dataset && is_zip(input)) {
        const auto rasters = rasters_in_archive(input);
        if (rasters.size() > 1)
            return refusal(opened.name, "the archive holds several rasters",
                           fmt::format("Give one of them as INPUT: {}", fmt::join(rasters, ", ")));
        if (rasters.size() == 1) {
            input = rasters[0];
            auto entry = open_trusted(input, opened.name, request.trust);
            if (!entry) return entry.error();
            opened.dataset = std::move(*entry);
        }
    }
    if (!opened.dataset) return not_read(input, opened, messages);
    if (auto chosen = choose_variable(opened, variable, messages); !chosen) return chosen.error();
    // A VRT is as large as its sources.
    const bool is_vrt = EQUAL(opened.dataset->GetDriverName(), "VRT");
    if (auto sound = check_size(*opened.dataset, opened.name, is_vrt ? std::nullopt : bytes_of(input));
        !sound)
        return sound.error();

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
