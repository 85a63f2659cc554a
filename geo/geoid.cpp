#include "geo/geoid.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <span>
#include <system_error>

#include <fmt/format.h>
#include <proj.h>

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

/// Turns samples of a periodic function into the coefficients of its interpolating cubic B-spline (Unser
/// 1999): one recursive filter forward, one back, both begun with the sum over the whole period.
void to_spline_coefficients(std::span<double> samples) {
    const double pole = std::sqrt(3.0) - 2;
    const std::size_t n = samples.size();
    // |pole|^40 < 1e-22: more terms add nothing.
    const std::size_t terms = std::min<std::size_t>(n, 40);
    const double period = 1 / (1 - std::pow(pole, static_cast<double>(n)));

    double sum = 0;
    double power = 1;
    for (std::size_t k = 0; k < terms; ++k, power *= pole) sum += power * samples[(n - k) % n];
    samples[0] = sum * period;
    for (std::size_t k = 1; k < n; ++k) samples[k] += pole * samples[k - 1];

    sum = 0;
    power = 1;
    for (std::size_t k = 0; k < terms; ++k, power *= pole) sum += power * samples[(n - 1 + k) % n];
    samples[n - 1] = -pole * sum * period;
    for (std::size_t k = n - 1; k-- > 0;) samples[k] = pole * (samples[k + 1] - samples[k]);

    for (double& c : samples) c *= 6;
}

/// Weights of the four coefficients around a place, t in [0, 1) past the second of them.
std::array<double, 4> spline_weights(double t) {
    const double s = 1 - t;
    return {s * s * s / 6, 2.0 / 3 - 0.5 * t * t * (2 - t), 2.0 / 3 - 0.5 * s * s * (2 - s), t * t * t / 6};
}

Error bad_grid(const std::filesystem::path& file, std::string_view what) {
    return {ErrorKind::input, fmt::format("{}: {}. It must be a .gtx geoid grid of the whole earth, such as "
                                          "egm96_15.gtx of the Debian package proj-data.",
                                          file.string(), what)};
}

/// What a .gtx file begins with.
struct Header {
    double south, west, step_lat, step_lon;
    std::int32_t rows, columns;
};

Header read_header(const char* bytes) {
    return {big_endian<double, std::uint64_t>(bytes),
            big_endian<double, std::uint64_t>(bytes + 8),
            big_endian<double, std::uint64_t>(bytes + 16),
            big_endian<double, std::uint64_t>(bytes + 24),
            big_endian<std::int32_t, std::uint32_t>(bytes + 32),
            big_endian<std::int32_t, std::uint32_t>(bytes + 36)};
}

/// Does the grid cover the whole earth, from pole to pole, in an even number of columns? (A meridian goes on
/// beyond the pole as the opposite one, which must have nodes too.) The closing column may be there or not.
bool covers_the_earth(const Header& h) {
    constexpr double kSlack = 1e-6;  // degrees; steps such as 1/12 are rounded
    if (!(h.step_lat > 0 && h.step_lon > 0 && std::isfinite(h.west))) return false;
    if (h.rows < 3 || h.columns < 4) return false;
    const double north = h.south + (h.rows - 1) * h.step_lat;
    if (!(std::abs(h.south + 90) < kSlack && std::abs(north - 90) < kSlack)) return false;
    const double turn = h.columns * h.step_lon;
    if (std::abs(turn - 360) < kSlack) return h.columns % 2 == 0;
    return std::abs(turn - h.step_lon - 360) < kSlack && h.columns % 2 == 1;
}

}  // namespace

Result<Geoid> Geoid::egm96() {
    const PJ_GRID_INFO info = proj_grid_info("egm96_15.gtx");
    if (info.filename[0] == '\0') {
        return Error{
            ErrorKind::input,
            "The geoid grid egm96_15.gtx is not installed: it says how far mean sea level is from the "
            "ellipsoid. Install the Debian package proj-data, or put the file into a folder that PROJ_LIB "
            "names."};
    }
    return from_gtx(info.filename);
}

Result<Geoid> Geoid::from_gtx(const std::filesystem::path& file) {
    std::error_code failure;
    const std::uintmax_t size = std::filesystem::file_size(file, failure);
    if (failure) return bad_grid(file, fmt::format("cannot be read ({})", failure.message()));
    if (size < kHeaderBytes) return bad_grid(file, "too short for a header");

    std::ifstream in(file, std::ios::binary);
    std::array<char, kHeaderBytes> header_bytes{};
    if (!in.read(header_bytes.data(), kHeaderBytes)) return bad_grid(file, "cannot be read");
    const Header header = read_header(header_bytes.data());
    if (!covers_the_earth(header))
        return bad_grid(file, "its header is not that of a grid of the whole earth");

    const auto file_columns = static_cast<std::size_t>(header.columns);
    const auto rows = static_cast<std::size_t>(header.rows);
    // Before anything is allocated: a damaged header may ask for any amount.
    const std::uintmax_t expected = kHeaderBytes + std::uintmax_t{4} * rows * file_columns;
    if (size != expected) return bad_grid(file, fmt::format("{} bytes instead of {}", size, expected));

    Geoid geoid;
    geoid.columns_ = header.columns - header.columns % 2;  // without the closing column
    geoid.rows_ = header.rows;
    geoid.west_ = header.west;
    const auto columns = static_cast<std::size_t>(geoid.columns_);
    std::vector<double>& c = geoid.coefficients_;
    c.resize(columns * rows);
    std::vector<char> line(4 * file_columns);
    for (std::size_t row = 0; row < rows; ++row) {
        if (!in.read(line.data(), static_cast<std::streamsize>(line.size())))
            return bad_grid(file, "cannot be read");
        for (std::size_t column = 0; column < columns; ++column) {
            const auto N = static_cast<double>(big_endian<float, std::uint32_t>(&line[4 * column]));
            // The geoid stays within 107 m of the ellipsoid; -88.8888 marks a hole by the format's
            // convention.
            if (!(std::abs(N) < 200) || N == static_cast<double>(-88.8888F))
                return bad_grid(file, fmt::format("no undulation at row {}, column {}", row, column));
            c[row * columns + column] = N;
        }
    }
    for (const std::size_t pole : {std::size_t{0}, rows - 1}) {
        for (std::size_t column = 1; column < columns; ++column) {
            // The pole is one point. Storing it is rounded the same way in all columns.
            if (c[pole * columns + column] != c[pole * columns])
                return bad_grid(file, "more than one value at a pole");
        }
    }

    for (std::size_t row = 0; row < rows; ++row)
        to_spline_coefficients(std::span(c).subspan(row * columns, columns));
    // A meridian and its opposite make one periodic line over both poles.
    std::vector<double> circle(2 * (rows - 1));
    for (std::size_t column = 0; column < columns / 2; ++column) {
        const std::size_t opposite = column + columns / 2;
        for (std::size_t row = 0; row < rows; ++row) circle[row] = c[row * columns + column];
        for (std::size_t row = rows - 2; row > 0; --row)
            circle[2 * (rows - 1) - row] = c[row * columns + opposite];
        to_spline_coefficients(circle);
        for (std::size_t row = 0; row < rows; ++row) c[row * columns + column] = circle[row];
        for (std::size_t row = 0; row < rows; ++row)
            c[row * columns + opposite] = circle[(2 * (rows - 1) - row) % circle.size()];
    }
    return geoid;
}

Undulation Geoid::undulation(LatLon place) const {
    assert(std::abs(place.lat.value) <= 90 && std::isfinite(place.lon.value));
    const double x = wrapped_360(place.lon - Degrees{west_}).value / 360 * columns_;
    const double y = (place.lat.value + 90) / 180 * (rows_ - 1);
    const int column = static_cast<int>(x);  // x may round up to columns_: the sum below wraps round
    const int row = std::min(static_cast<int>(y), rows_ - 2);
    const auto along = spline_weights(x - column);
    const auto up = spline_weights(y - row);

    double sum = 0;
    for (int j = 0; j < 4; ++j) {
        int r = row - 1 + j;
        int first = column - 1 + columns_;  // positive, for %
        const bool beyond_pole = r < 0 || r >= rows_;
        if (beyond_pole) {
            r = r < 0 ? -r : 2 * (rows_ - 1) - r;
            first += columns_ / 2;
        }
        const double* line = coefficients_.data() + static_cast<std::ptrdiff_t>(r) * columns_;
        double line_sum = 0;
        for (int i = 0; i < 4; ++i)
            line_sum += along[static_cast<std::size_t>(i)] * line[(first + i) % columns_];
        sum += up[static_cast<std::size_t>(j)] * line_sum;
    }
    return {sum};
}

}  // namespace relevo::geo
