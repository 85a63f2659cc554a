#include <algorithm>
#include <charconv>
#include <cmath>

#include "output/measurement_formats.hpp"
#include <fmt/format.h>

namespace relevo::output {
namespace {

using lod::Measurement;
using lod::MeasurementKind;
using Row = std::vector<std::string>;

Error wrong(std::string what) {
    return {ErrorKind::input, std::move(what)};
}

/// RFC 4180: in quotes where it has to be, quotes doubled.
std::string field(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"') quoted += '"';
        quoted += c;
    }
    return quoted + '"';
}

/// A row with the line that it begins in, counted from 1.
struct Line {
    int number = 0;
    Row fields;
};

Result<std::vector<Line>> lines_of(const std::string& text) {
    std::vector<Line> lines;
    int number = 1;
    std::size_t at = 0;
    while (at < text.size()) {
        Line line{number, {""}};
        bool ends = false;
        while (!ends) {
            if (at < text.size() && text[at] == '"' && line.fields.back().empty()) {
                for (++at;; ++at) {
                    if (at >= text.size())
                        return wrong(fmt::format("line {}: a quote is not closed", line.number));
                    if (text[at] == '\n') ++number;
                    if (text[at] == '"') {
                        if (at + 1 >= text.size() || text[at + 1] != '"') break;
                        ++at;
                    }
                    line.fields.back() += text[at];
                }
                ++at;
            }
            const char c = at < text.size() ? text[at] : '\n';
            ++at;
            if (c == ',') {
                line.fields.emplace_back();
            } else if (c == '\n') {
                ends = true;
                ++number;
            } else if (c != '\r') {
                line.fields.back() += c;
            }
        }
        if (line.fields.size() > 1 || !line.fields.front().empty()) lines.push_back(std::move(line));
    }
    return lines;
}

/// A number in any locale; the whole text but blanks.
template <class Number>
std::optional<Number> number_of(std::string_view text) {
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
    if (!text.empty() && text.front() == '+') text.remove_prefix(1);
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return {};
    return value;
}

/// Which column has what; -1: none.
struct Columns {
    int name = -1;
    int kind = -1;
    int vertex = -1;
    int lat = -1;
    int lon = -1;
};

Result<Columns> columns_of(const Row& header) {
    Columns columns;
    for (std::size_t i = 0; i < header.size(); ++i) {
        std::string title = header[i];
        std::transform(title.begin(), title.end(), title.begin(),
                       [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
        const int index = static_cast<int>(i);
        if (title == "name") columns.name = index;
        if (title == "kind") columns.kind = index;
        if (title == "vertex") columns.vertex = index;
        if (title == "lat" || title == "latitude") columns.lat = index;
        if (title == "lon" || title == "lng" || title == "longitude") columns.lon = index;
    }
    if (columns.lat < 0 || columns.lon < 0)
        return wrong(
            "the first line must name the columns; `lat` and `lon` are needed, as in "
            "name,kind,vertex,lat,lon");
    if (columns.kind >= 0 && columns.vertex < 0)
        return wrong(
            "a column `kind` needs a column `vertex`, counted from 1, to tell one path from the next");
    return columns;
}

}  // namespace

std::string measurements_to_csv(std::span<const MeasurementRecord> records) {
    std::string text = "name,kind,vertex,lat,lon,H_m\n";
    for (const auto& [measurement, heights, results] : records) {
        for (std::size_t i = 0; i < measurement.vertices.size(); ++i) {
            const geo::LatLon& place = measurement.vertices[i];
            text += fmt::format("{},{},{},{},{},{}\n", field(measurement.name), to_string(measurement.kind),
                                i + 1, place.lat.value, std::remainder(place.lon.value, 360.0),
                                i < heights.size() && heights[i] ? fmt::format("{}", *heights[i]) : "");
        }
    }
    return text;
}

Result<std::vector<Measurement>> measurements_from_csv(const std::string& text) {
    const auto lines = lines_of(text);
    if (!lines) return lines.error();
    if (lines->empty()) return wrong("the file is empty");
    const auto columns = columns_of(lines->front().fields);
    if (!columns) return columns.error();
    std::vector<Measurement> all;
    for (std::size_t i = 1; i < lines->size(); ++i) {
        const auto& [number, fields] = (*lines)[i];
        const auto get = [&fields = fields](int column) {
            return column >= 0 && static_cast<std::size_t>(column) < fields.size()
                       ? fields[static_cast<std::size_t>(column)]
                       : std::string();
        };
        const auto lat = number_of<double>(get(columns->lat));
        const auto lon = number_of<double>(get(columns->lon));
        if (!lat || !lon)
            return wrong(
                fmt::format("line {}: \"{}\", \"{}\" is no latitude and longitude in decimal degrees", number,
                            get(columns->lat), get(columns->lon)));
        auto kind = MeasurementKind::point;
        int vertex = 1;
        if (columns->kind >= 0) {
            const auto known = lod::measurement_kind(get(columns->kind));
            if (!known)
                return wrong(fmt::format("line {}: \"{}\" is no kind: point, path or polygon", number,
                                         get(columns->kind)));
            kind = *known;
            const auto counted = number_of<int>(get(columns->vertex));
            const auto expected = all.empty() ? 1 : static_cast<int>(all.back().vertices.size()) + 1;
            if (!counted || (*counted != 1 && (*counted != expected || all.back().kind != kind)))
                return wrong(
                    fmt::format("line {}: vertices are counted 1, 2, ... within each measurement", number));
            vertex = *counted;
        }
        if (vertex == 1) all.push_back({get(columns->name), kind, {}});
        all.back().vertices.push_back({geo::Degrees{*lat}, geo::Degrees{*lon}});
    }
    return all;
}

}  // namespace relevo::output
