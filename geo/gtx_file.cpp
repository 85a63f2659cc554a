#include "geo/gtx_file.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

namespace relevo::geo {
namespace {

constexpr std::size_t kHeaderBytes = 40;

/// A number at a place of a .gtx file: big-endian, whatever this machine is.
template <class T, class Bits>
T big_endian(const char* bytes) {
    Bits bits = 0;
    for (std::size_t i = 0; i < sizeof(Bits); ++i)
        bits = static_cast<Bits>(bits << 8) | static_cast<unsigned char>(bytes[i]);
    return std::bit_cast<T>(bits);
}

Error bad_grid(const std::filesystem::path& file, std::string_view what) {
    return {ErrorKind::input, fmt::format("{}: {}. It must be a .gtx geoid grid, such as egm96_15.gtx of the "
                                          "Debian package proj-data",
                                          file.string(), what)};
}

GeoidNodes read_header(const char* bytes) {
    GeoidNodes nodes;
    nodes.south = big_endian<double, std::uint64_t>(bytes);
    nodes.west = big_endian<double, std::uint64_t>(bytes + 8);
    nodes.step_lat = big_endian<double, std::uint64_t>(bytes + 16);
    nodes.step_lon = big_endian<double, std::uint64_t>(bytes + 24);
    nodes.rows = big_endian<std::int32_t, std::uint32_t>(bytes + 32);
    nodes.columns = big_endian<std::int32_t, std::uint32_t>(bytes + 36);
    return nodes;
}

}  // namespace

Result<GeoidNodes> read_gtx(const std::filesystem::path& file) {
    std::error_code failure;
    const std::uintmax_t size = std::filesystem::file_size(file, failure);
    if (failure) return bad_grid(file, fmt::format("cannot be read ({})", failure.message()));
    if (size < kHeaderBytes) return bad_grid(file, "too short for a header");

    std::ifstream in(file, std::ios::binary);
    std::array<char, kHeaderBytes> header{};
    if (!in.read(header.data(), kHeaderBytes)) return bad_grid(file, "cannot be read");
    GeoidNodes nodes = read_header(header.data());
    if (nodes.rows < 1 || nodes.columns < 1) return bad_grid(file, "its header makes no sense");

    const auto columns = static_cast<std::size_t>(nodes.columns);
    const auto rows = static_cast<std::size_t>(nodes.rows);
    // Before anything is allocated: a damaged header may ask for any amount.
    const std::uintmax_t expected = kHeaderBytes + std::uintmax_t{4} * rows * columns;
    if (size != expected) return bad_grid(file, fmt::format("{} bytes instead of {}", size, expected));
    if (rows * columns > static_cast<std::size_t>(GeoidNodes::kMost))
        return bad_grid(file, fmt::format("{} x {} nodes are too many", columns, rows));

    nodes.undulations.reserve(rows * columns);
    std::vector<char> line(4 * columns);
    for (std::size_t row = 0; row < rows; ++row) {
        if (!in.read(line.data(), static_cast<std::streamsize>(line.size())))
            return bad_grid(file, "cannot be read");
        for (std::size_t column = 0; column < columns; ++column) {
            const auto N = big_endian<float, std::uint32_t>(&line[4 * column]);
            // The format's convention for a node without a value.
            nodes.undulations.push_back(N == -88.8888F ? std::numeric_limits<double>::quiet_NaN()
                                                       : static_cast<double>(N));
        }
    }
    return nodes;
}

}  // namespace relevo::geo
