#include "ingest/source/inputs.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <string_view>

#include <fmt/format.h>
#include <gdal_priv.h>

#include "ingest/refusal.hpp"
#include "ingest/source/gdal_messages.hpp"

namespace relevo::ingest {
namespace {

namespace fs = std::filesystem;

bool is_raster(const std::string& name) {
    return GDALIdentifyDriverEx(name.c_str(), GDAL_OF_RASTER, nullptr, nullptr) != nullptr;
}

bool ends_with(const fs::path& file, std::string_view end) {
    const std::string name = file.filename().string();
    return name.size() >= end.size() &&
           std::equal(end.rbegin(), end.rend(), name.rbegin(), [](char a, char b) {
               return a == static_cast<char>(std::tolower(static_cast<unsigned char>(b)));
           });
}

/// Could it be elevation? Archives are: what is in them is looked at when they are opened. Lists of other
/// rasters (VRT) are not, as their tiles are most often in the same folder; nor are overviews and masks
/// beside rasters.
bool is_tile(const fs::path& file) {
    constexpr std::array kBeside{".aux.xml", ".ovr", ".msk", ".vrt", ".prj", ".txt"};
    if (std::any_of(kBeside.begin(), kBeside.end(), [&](auto end) { return ends_with(file, end); }))
        return false;
    return ends_with(file, ".zip") || is_raster(file.string());
}

Result<void> expand_folder(const fs::path& folder, std::vector<std::string>& into) {
    std::error_code failed;
    std::vector<fs::path> found;
    for (fs::directory_iterator at{folder, failed}, end; !failed && at != end; at.increment(failed)) {
        std::error_code ignored;
        if (at->is_regular_file(ignored) && is_tile(at->path())) found.push_back(at->path());
    }
    if (failed)
        return refusal(folder.string(), fmt::format("the folder cannot be read ({})", failed.message()),
                       "Check its permissions");
    if (found.empty())
        return refusal(folder.string(), "there is no elevation file in this folder",
                       "Give a folder of rasters; folders inside it are not looked at");
    std::sort(found.begin(), found.end());
    for (const auto& file : found) into.push_back(file.string());
    return {};
}

Result<void> expand_one(const std::string& input, std::vector<std::string>& into) {
    std::error_code ignored;
    // Some formats are folders.
    if (fs::is_directory(input, ignored) && !is_raster(input)) return expand_folder(input, into);
    into.push_back(input);
    return {};
}

std::string trimmed(const std::string& line) {
    const auto first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos) return {};
    return line.substr(first, line.find_last_not_of(" \t\r") - first + 1);
}

/// Is it a path, and not one of GDAL's other names (/vsizip/..., NETCDF:...)?
bool is_path(const std::string& name) {
    return name.rfind("/vsi", 0) != 0 && name.find(':') == std::string::npos;
}

Result<void> expand_list(const fs::path& list, std::vector<std::string>& into) {
    std::ifstream lines{list};
    if (!lines)
        return refusal(list.string(), "the list of inputs cannot be read", "Check its path and permissions");
    const std::size_t before = into.size();
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        std::string name = trimmed(line);
        if (name.empty() || name[0] == '#') continue;
        std::error_code ignored;
        if (is_path(name) && !fs::exists(name, ignored)) {
            const fs::path beside = list.parent_path() / name;
            if (!fs::exists(beside, ignored))
                return refusal(list.string(),
                               fmt::format("line {} names '{}', and there is no such file", number, name),
                               "Check the path: it is relative to the working folder, or to the list's");
            name = beside.string();
        }
        if (auto done = expand_one(name, into); !done) return done;
    }
    if (into.size() == before) return refusal(list.string(), "the list names no inputs", "Write one a line");
    return {};
}

}  // namespace

Result<std::vector<std::string>> expand_inputs(const std::vector<std::string>& inputs) {
    GDALAllRegister();
    const GdalMessages silent;
    std::vector<std::string> expanded;
    for (const std::string& input : inputs) {
        const bool list = input.size() > 1 && input[0] == '@';
        if (auto done = list ? expand_list(input.substr(1), expanded) : expand_one(input, expanded); !done)
            return done.error();
    }
    return expanded;
}

}  // namespace relevo::ingest
