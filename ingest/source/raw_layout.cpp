#include "ingest/source/raw_layout.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <limits>
#include <string_view>
#include <system_error>

#include <cpl_conv.h>
#include <cpl_string.h>
#include <fmt/format.h>

#include "ingest/refusal.hpp"

namespace relevo::ingest {
namespace {

struct Type {
    std::string_view name;
    const char* gdal;
    int bytes;
};
constexpr std::array kTypes{Type{"uint8", "Byte", 1},      Type{"int16", "Int16", 2},
                            Type{"uint16", "UInt16", 2},   Type{"int32", "Int32", 4},
                            Type{"float32", "Float32", 4}, Type{"float64", "Float64", 8}};

const Type* type_named(std::string_view name) {
    const auto* found =
        std::find_if(kTypes.begin(), kTypes.end(), [&](const Type& t) { return t.name == name; });
    return found == kTypes.end() ? nullptr : found;
}

/// A whole number in front of the text, which it is cut from; 0 where there is none.
int take_number(std::string_view& text) {
    int number = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
    if (read.ec != std::errc{} || number < 0) return 0;
    text.remove_prefix(static_cast<std::size_t>(read.ptr - text.data()));
    return number;
}

bool take(std::string_view& text, char c) {
    if (text.empty() || text.front() != c) return false;
    text.remove_prefix(1);
    return true;
}

}  // namespace

Result<RawLayout> raw_layout(const std::string& text) {
    const Error unreadable{ErrorKind::usage,
                           fmt::format("'{}': give columns x rows, type and byte order, such as "
                                       "3601x3601,int16,be; types are uint8, int16, uint16, int32, float32, "
                                       "float64, orders le and be",
                                       text)};
    RawLayout layout;
    std::string_view rest = text;
    layout.columns = take_number(rest);
    if (!take(rest, 'x')) return unreadable;
    layout.rows = take_number(rest);
    if (!take(rest, ',') || layout.columns < 1 || layout.rows < 1) return unreadable;
    constexpr std::int64_t kMostPosts = std::int64_t{1} << 40;  // so that no product of sizes overflows
    if (std::int64_t{layout.columns} * layout.rows > kMostPosts) return unreadable;
    const auto comma = rest.find(',');
    layout.type = rest.substr(0, comma);
    const Type* type = type_named(layout.type);
    const std::string_view order = comma == std::string_view::npos ? "" : rest.substr(comma + 1);
    const bool none_needed = type != nullptr && type->bytes == 1 && order.empty();
    if (type == nullptr || (order != "le" && order != "be" && !none_needed)) return unreadable;
    layout.little_endian = order != "be";
    return layout;
}

Result<std::string> raw_dataset(const std::filesystem::path& file, const RawLayout& layout) {
    const std::string name = file.filename().string();
    const Type* type = type_named(layout.type);
    if (type == nullptr)
        return Error{ErrorKind::usage, fmt::format("'{}' is not a type of --raw", layout.type)};
    std::error_code failed;
    const auto size = std::filesystem::file_size(file, failed);
    if (failed) return refusal(name, "there is no such file", "Check the path");
    const auto needed =
        std::uint64_t(layout.columns) * std::uint64_t(layout.rows) * std::uint64_t(type->bytes);
    if (size != needed)
        return refusal(name,
                       fmt::format("it has {} bytes, but {} x {} posts of {} are {}", size, layout.columns,
                                   layout.rows, layout.type, needed),
                       "Give what it holds with --raw WxH,TYPE,le|be");
    const auto line = std::int64_t{layout.columns} * type->bytes;
    if (line > std::numeric_limits<int>::max())
        return refusal(name, fmt::format("rows of {} bytes are too long", line), "Cut it into parts");
    char* escaped = CPLEscapeString(std::filesystem::absolute(file).c_str(), -1, CPLES_XML);
    std::string text =
        fmt::format(R"(<VRTDataset rasterXSize="{}" rasterYSize="{}"><VRTRasterBand dataType="{}" band="1" )"
                    R"(subClass="VRTRawRasterBand"><SourceFilename relativeToVRT="0">{}</SourceFilename>)"
                    R"(<ImageOffset>0</ImageOffset><PixelOffset>{}</PixelOffset><LineOffset>{}</LineOffset>)"
                    R"(<ByteOrder>{}</ByteOrder></VRTRasterBand></VRTDataset>)",
                    layout.columns, layout.rows, type->gdal, escaped, type->bytes, line,
                    layout.little_endian ? "LSB" : "MSB");
    CPLFree(escaped);
    return text;
}

}  // namespace relevo::ingest
