#include "ingest/source/vrt_sources.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include <cpl_minixml.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <fmt/format.h>
#include <gdal_priv.h>

#include "ingest/refusal.hpp"
#include "ingest/source/zip_archive.hpp"

namespace relevo::ingest {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostText = std::size_t{64} << 20;
constexpr int kMostNested = 16;

struct CloseFile {
    void operator()(VSILFILE* file) const { VSIFCloseL(file); }
};

/// The start of a file, or all of it where `most` allows. Nothing where it cannot be opened.
std::optional<std::string> text_of(const std::string& name, std::size_t most) {
    const std::unique_ptr<VSILFILE, CloseFile> file{VSIFOpenL(name.c_str(), "rb")};
    if (!file) return {};
    std::string text;
    std::vector<char> piece(std::min<std::size_t>(most, 65536));
    while (text.size() < most) {
        const auto read = VSIFReadL(piece.data(), 1, std::min(piece.size(), most - text.size()), file.get());
        text.append(piece.data(), read);
        if (read < piece.size()) break;
    }
    return text;
}

bool is_virtual(const std::string& name) {
    return name.rfind("/vsi", 0) == 0;
}

bool is_below(const fs::path& path, const fs::path& folder) {
    const auto [end, _] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
    return end == folder.end() || (end->empty() && std::next(end) == folder.end());
}

/// A path without links and "..", as far as it exists.
fs::path real(const fs::path& path) {
    std::error_code ignored;
    auto found = fs::weakly_canonical(path, ignored);
    return found.empty() ? path.lexically_normal() : found;
}

/// A file on disk that a GDAL name reads, and what follows it inside an archive ("/vsizip/a.zip/b.tif").
struct Location {
    fs::path file;
    std::string inside;
};

/// Nothing for names that are neither paths nor entries of one archive on disk.
std::optional<Location> locate(const std::string& name) {
    if (!is_virtual(name)) return Location{fs::absolute(name), {}};
    for (const std::string_view prefix : {"/vsizip/", "/vsitar/", "/vsigzip/"}) {
        if (name.compare(0, prefix.size(), prefix) != 0) continue;
        const std::string rest = name.substr(prefix.size());
        if (rest.find('{') != std::string::npos || is_virtual(rest)) return {};
        // The shortest part of it that is a file is the archive.
        for (std::size_t end = rest.find('/', 1);; end = rest.find('/', end + 1)) {
            std::error_code ignored;
            if (fs::is_regular_file(rest.substr(0, end), ignored))
                return Location{fs::absolute(rest.substr(0, end)),
                                end == std::string::npos ? std::string{} : rest.substr(end + 1)};
            if (end == std::string::npos) return {};
        }
    }
    return {};
}

/// Where a VRT's own folder is.
struct Home {
    std::string folder;  ///< as GDAL names it, for relative names
    Location location;   ///< of the folder, or of the archive and the folder inside it
};

Home home_of(const std::string& vrt) {
    auto location = locate(vrt);
    if (location && location->inside.empty() && !is_virtual(vrt)) {
        // GDAL too follows a link to the VRT itself before it looks for its sources.
        const fs::path folder = real(location->file).parent_path();
        return {folder.string(), {folder, {}}};
    }
    const std::string folder = CPLGetPath(vrt.c_str());
    if (!location) return {folder, {}};
    return {folder, {real(location->file), fs::path(location->inside).parent_path().string()}};
}

bool may_read(const Location& source, const Home& home, const Trust& trust) {
    const fs::path file = real(source.file);
    const fs::path inside = fs::path(source.inside).lexically_normal();
    if (!inside.empty() && (*inside.begin() == ".." || inside.is_absolute())) return false;
    if (!home.location.file.empty() && is_below(file, home.location.file) &&
        (home.location.inside.empty() || is_below(inside, fs::path(home.location.inside))))
        return true;
    return std::any_of(trust.allow_paths.begin(), trust.allow_paths.end(),
                       [&](const fs::path& allowed) { return is_below(file, real(fs::absolute(allowed))); });
}

/// The file in a name of a data set inside a file: NETCDF:"file.nc":variable; else the name itself.
std::string file_in(const std::string& name) {
    for (const std::string_view prefix : {"NETCDF:", "HDF5:", "BAG:"}) {
        if (name.compare(0, prefix.size(), prefix) != 0) continue;
        std::string rest = name.substr(prefix.size());
        if (!rest.empty() && rest[0] == '"') {
            const auto end = rest.find('"', 1);
            return rest.substr(1, end == std::string::npos ? end : end - 1);
        }
        return rest.substr(0, rest.find(':'));
    }
    return name;
}

class Check {
  public:
    Check(std::string shown, const Trust& trust) : shown_(std::move(shown)), trust_(trust) {}

    Result<void> file(const std::string& name, int nested) {
        const auto start = text_of(name, 65536);
        if (!start || start->find("<VRTDataset") == std::string::npos) return {};
        if (!seen_.insert(name).second) return {};
        if (nested > kMostNested)
            return refusal(shown_, "its VRTs are nested too deep", "Give the files that they join");
        auto text = text_of(name, kMostText);
        if (!text || text->size() >= kMostText)
            return refusal(shown_, "its VRT is too long to be checked", "Give the files that it joins");
        const CPLXMLTreeCloser tree{CPLParseXMLString(text->c_str())};
        if (tree.get() == nullptr) return refusal(shown_, "its VRT is not well-formed XML", "Make it anew");
        return nodes(tree.get(), home_of(name), nested, 0);
    }

  private:
    Result<void> nodes(const CPLXMLNode* node, const Home& home, int nested, int depth) {
        if (depth > 100) return refusal(shown_, "its VRT's elements are nested too deep", "Make it anew");
        for (; node != nullptr; node = node->psNext) {
            if (node->eType != CXT_Element) continue;
            if (auto done = element(*node, home, nested); !done) return done;
            if (auto done = nodes(node->psChild, home, nested, depth + 1); !done) return done;
        }
        return {};
    }

    Result<void> element(const CPLXMLNode& node, const Home& home, int nested) {
        const char* tag = node.pszValue;
        if (EQUAL(tag, "PixelFunctionLanguage") && !EQUAL(CPLGetXMLValue(&node, "", "C"), "C"))
            return refusal(shown_, "its VRT computes pixels by a program of its own",
                           "Bring it into a file first, with gdal_translate, if you trust it");
        const char* key = CPLGetXMLValue(&node, "key", "");
        if (EQUAL(tag, "DEMPath") ||
            (EQUAL(tag, "MDI") && (EQUAL(key, "X_DATASET") || EQUAL(key, "Y_DATASET"))))
            return refusal(shown_, "its VRT warps by means of other files",
                           "Bring it into a file first, with gdal_translate, if you trust it");
        if (!EQUAL(tag, "SourceFilename") && !EQUAL(tag, "SourceDataset")) return {};
        const bool relative = CPLTestBool(CPLGetXMLValue(&node, "relativeToVRT", "0"));
        return source(CPLGetXMLValue(&node, "", ""), relative, home, nested);
    }

    Result<void> source(const std::string& text, bool relative, const Home& home, int nested) {
        if (is_remote(text)) {
            if (trust_.allow_remote) return {};
            return refusal(shown_, fmt::format("its VRT reads '{}' from a network", text),
                           "Fetch that first, or give --allow-remote");
        }
        std::string name = file_in(text);
        if (relative && !name.empty() && !is_virtual(name) && !fs::path(name).is_absolute())
            name = home.folder + "/" + name;
        const auto location = locate(name);
        if (!location || !may_read(*location, home, trust_))
            return refusal(shown_, fmt::format("its VRT reads '{}', which is not below its own folder", text),
                           "If that is meant, allow the folder with --allow-path DIR");
        // A name that is no file could be anything to GDAL, a database for instance.
        VSIStatBufL status{};
        if (VSIStatL(name.c_str(), &status) != 0 || (!relative && name.find(':') != std::string::npos))
            return refusal(shown_, fmt::format("its VRT reads '{}', and there is no such file", text),
                           "Fetch it, or make the VRT anew");
        if (is_unreadable_hgt(name))
            return refusal(shown_, fmt::format("its VRT reads '{}', which cannot be opened", text),
                           "Fetch it again, or change its permissions");
        const auto start = text_of(name, 1024);
        const auto first = start ? start->find_first_not_of(" \t\r\n\xef\xbb\xbf") : std::string::npos;
        const bool is_text = first != std::string::npos && ((*start)[first] == '<' || (*start)[first] == '{');
        const bool is_vrt = start && start->find("<VRTDataset") != std::string::npos;
        if (is_text && !is_vrt)  // descriptions of services in a network are of that kind
            return refusal(shown_, fmt::format("its VRT reads '{}', which is not an elevation raster", text),
                           "Give the files with heights");
        return is_vrt ? file(name, nested + 1) : Result<void>{};
    }

    std::string shown_;
    const Trust& trust_;
    std::set<std::string> seen_;
};

}  // namespace

Result<void> check_vrt_sources(const std::string& name, const std::string& shown, const Trust& trust) {
    return Check{shown, trust}.file(name, 0);
}

}  // namespace relevo::ingest
