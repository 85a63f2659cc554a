#include "output/measurement_file.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>

#include "output/measurement_formats.hpp"
#include "output/partial_file.hpp"
#include <fmt/format.h>

namespace relevo::output {
namespace {

namespace fs = std::filesystem;

enum class Format { geojson, csv, kml };

std::optional<Format> format_of(const fs::path& file) {
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (ending == ".geojson" || ending == ".json") return Format::geojson;
    if (ending == ".csv") return Format::csv;
    if (ending == ".kml") return Format::kml;
    return {};
}

Error unknown_format(const fs::path& file) {
    return {ErrorKind::usage,
            fmt::format("{}: measurements are in files that end in .geojson, .json, .csv or .kml",
                        file.string())};
}

Error in_file(const fs::path& file, const Error& error) {
    return {error.kind, fmt::format("{}: {}", file.string(), error.message)};
}

Result<std::vector<lod::Measurement>> read(const fs::path& file, Format format) {
    std::error_code no_file;
    if (!fs::is_regular_file(file, no_file)) return Error{ErrorKind::input, "there is no such file"};
    if (format == Format::kml) return measurements_from_kml(file);
    std::ifstream stream(file, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (stream.bad() || !stream) return Error{ErrorKind::input, "the file cannot be read"};
    if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);  // a byte order mark
    return format == Format::csv ? measurements_from_csv(text) : measurements_from_geojson(text);
}

}  // namespace

bool is_measurement_file(const fs::path& file) {
    return format_of(file).has_value();
}

Result<std::vector<lod::Measurement>> load_measurements(const fs::path& file) {
    const auto format = format_of(file);
    if (!format) return unknown_format(file);
    auto all = read(file, *format);
    if (!all) return in_file(file, all.error());
    for (lod::Measurement& measurement : *all) {
        if (const auto good = lod::check(measurement); !good) return in_file(file, good.error());
    }
    return all;
}

Result<void> save_measurements(const fs::path& file, std::span<const MeasurementRecord> records,
                               bool overwrite) {
    const auto format = format_of(file);
    if (!format) return unknown_format(file);
    for (const MeasurementRecord& record : records) {
        if (auto good = lod::check(record.measurement); !good) return good;
    }
    auto whole = PartialFile::create(file, overwrite);
    if (!whole) return whole.error();
    const std::string text = *format == Format::geojson ? measurements_to_geojson(records)
                             : *format == Format::csv   ? measurements_to_csv(records)
                                                        : measurements_to_kml(records);
    if (auto written = whole->write(std::as_bytes(std::span(text))); !written) return written;
    return whole->take();
}

}  // namespace relevo::output
