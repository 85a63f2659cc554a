#include "ingest/source/zip_archive.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include <cpl_string.h>
#include <cpl_vsi.h>

#include "ingest/refusal.hpp"
#include "ingest/source/gdal_messages.hpp"

namespace relevo::ingest {
namespace {

constexpr const char* kArchive = "/vsizip/";

std::string lower_case(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

auto open_file(const std::string& name) {
    const auto close = [](VSILFILE* file) { VSIFCloseL(file); };
    return std::unique_ptr<VSILFILE, decltype(close)>(VSIFOpenL(name.c_str(), "rb"), close);
}

bool is_folder(const std::string& name) {
    VSIStatBufL status{};
    return VSIStatL(name.c_str(), &status) == 0 && VSI_ISDIR(status.st_mode);
}

std::vector<std::string> entries_of(const std::string& archive) {
    std::vector<std::string> entries;
    const CPLStringList names{VSIReadDirRecursive((kArchive + archive).c_str())};
    for (int i = 0; i < names.size(); ++i) {
        std::string entry = kArchive + archive + "/" + names[i];
        if (!is_folder(entry)) entries.push_back(std::move(entry));
    }
    return entries;
}

/// What GDAL says of an entry that it reads to the end; "" where all is well.
std::string fault_of(const std::string& entry) {
    const GdalMessages messages;
    const auto file = open_file(entry);
    if (!file) return "it cannot be opened";
    std::vector<char> piece(std::size_t{1} << 20);
    std::uint64_t bytes = 0;
    for (std::size_t count = piece.size(); count == piece.size(); bytes += count)
        count = VSIFReadL(piece.data(), 1, piece.size(), file.get());
    VSIStatBufL status{};
    const bool whole =
        VSIStatL(entry.c_str(), &status) == 0 && bytes == static_cast<std::uint64_t>(status.st_size);
    if (messages.empty() && !whole) return "an entry is shorter or longer than the archive says";
    return messages.text();
}

}  // namespace

bool is_unreadable_hgt(const std::string& gdal_name) {
    const std::string name = lower_case(gdal_name);
    if (name.ends_with(".hgt") || name.ends_with(".raw")) return open_file(gdal_name) == nullptr;
    if (!name.ends_with(".hgt.zip") && !name.ends_with(".raw.zip")) return false;
    return !std::ranges::all_of(entries_of(gdal_name),
                                [](const std::string& entry) { return open_file(entry) != nullptr; });
}

Result<void> check_archive(const std::string& input) {
    std::vector<std::string> entries;
    if (input.starts_with(kArchive)) {
        entries = {input};
    } else if (lower_case(input).ends_with(".zip")) {
        entries = entries_of(input);
    }
    for (const std::string& entry : entries) {
        if (const std::string fault = fault_of(entry); !fault.empty())
            return refusal(std::filesystem::path(input).filename().string(),
                           "the archive is damaged (" + fault + ")", "Fetch it again");
    }
    return {};
}

}  // namespace relevo::ingest
