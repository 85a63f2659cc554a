#include "geo/geoid.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <span>

#include <fmt/format.h>
#include <proj.h>

#include "geo/cubic_spline.hpp"
#include "geo/gtx_file.hpp"

namespace relevo::geo {
namespace {

constexpr double kSlack = 1e-6;  // degrees; steps such as 1/12 are rounded

bool from_pole_to_pole(const GeoidNodes& g) {
    const double north = g.south + (g.rows - 1) * g.step_lat;
    return std::abs(g.south + 90) < kSlack && std::abs(north - 90) < kSlack;
}

bool all_round(const GeoidNodes& g) {
    return g.columns * g.step_lon > 360 - kSlack;
}

/// A grid of the whole earth needs an even number of columns, and its closing column may be there or not: a
/// meridian goes on beyond the pole as the opposite one, which must have nodes too.
bool has_opposite_meridians(const GeoidNodes& g) {
    const double turn = g.columns * g.step_lon;
    if (std::abs(turn - 360) < kSlack) return g.columns % 2 == 0;
    return std::abs(turn - g.step_lon - 360) < kSlack && g.columns % 2 == 1;
}

Error bad_nodes(const std::string& name, std::string_view what) {
    return {ErrorKind::input, fmt::format("{}: {}. Give a geoid grid of latitude and longitude, of a region "
                                          "or of the whole earth",
                                          name, what)};
}

Result<void> check(const GeoidNodes& g, const std::string& name) {
    assert(g.undulations.size() == static_cast<std::size_t>(g.rows) * static_cast<std::size_t>(g.columns));
    const double north = g.south + (g.rows - 1) * g.step_lat;
    if (!(g.step_lat > 0 && g.step_lon > 0 && std::isfinite(g.west)) || g.rows < 3 || g.columns < 4 ||
        !(g.south >= -90 - kSlack && north <= 90 + kSlack) || !(g.columns * g.step_lon < 720))
        return bad_nodes(name, "its header is not that of a geoid grid");
    if (all_round(g) && std::abs(std::round(360 / g.step_lon) * g.step_lon - 360) > kSlack)
        return bad_nodes(name, "its columns do not meet again round the earth");
    const bool earth = from_pole_to_pole(g) && all_round(g);
    if (earth && !has_opposite_meridians(g))
        return bad_nodes(name, "its meridians have no opposite ones, as beyond the poles they need");
    if (!earth && (g.rows < 4 || g.columns < 4))
        return bad_nodes(name, fmt::format("{} x {} nodes are too few", g.columns, g.rows));

    bool any = false;
    for (int row = 0; row < g.rows; ++row) {
        const double* line = g.undulations.data() + static_cast<std::ptrdiff_t>(row) * g.columns;
        for (int column = 0; column < g.columns; ++column) {
            // The geoid stays within 107 m of the ellipsoid; datums of depths may lie a little lower.
            const bool hole = std::isnan(line[column]) && !earth;
            if (!hole && !(std::abs(line[column]) < 200))
                return bad_nodes(name, fmt::format("no undulation at row {}, column {}", row, column));
            any = any || !hole;
            // The pole is one point. Storing it is rounded the same way in all columns.
            if (earth && (row == 0 || row == g.rows - 1) && line[column] != line[0])
                return bad_nodes(name, "more than one value at a pole");
        }
    }
    if (!any) return bad_nodes(name, "it holds no undulations");
    return {};
}

/// Gives holes the mean of their neighbours, from their rims inwards, so that a spline through them stays
/// calm. Afterwards no node is NaN: deep inside they are 0.
void fill_holes(std::vector<double>& nodes, int columns, int rows) {
    const auto at = [&](int column, int row) -> double& {
        return nodes[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                     static_cast<std::size_t>(column)];
    };
    struct Filled {
        int column, row;
        double value;
    };
    constexpr int kDeep = 30;  // what is farther in has no influence on nodes with a value
    std::vector<Filled> rim;
    for (int pass = 0; pass < kDeep; ++pass) {
        rim.clear();
        for (int row = 0; row < rows; ++row)
            for (int column = 0; column < columns; ++column) {
                if (!std::isnan(at(column, row))) continue;
                double sum = 0;
                int count = 0;
                for (int r = std::max(row - 1, 0); r <= std::min(row + 1, rows - 1); ++r)
                    for (int c = std::max(column - 1, 0); c <= std::min(column + 1, columns - 1); ++c)
                        if (!std::isnan(at(c, r))) {
                            sum += at(c, r);
                            ++count;
                        }
                if (count > 0) rim.push_back({column, row, sum / count});
            }
        for (const Filled& f : rim) at(f.column, f.row) = f.value;
        if (rim.empty()) return;
    }
    for (double& value : nodes)
        if (std::isnan(value)) value = 0;
}

/// A band round the earth, as a region that overlaps itself: its own border is then far from any place asked
/// for.
GeoidNodes overlapping(const GeoidNodes& g) {
    constexpr int kOverlap = 20;  // the border's influence falls by 0.27 a node
    const int turn = static_cast<int>(std::lround(360 / g.step_lon));
    GeoidNodes wide = g;
    wide.columns = turn + 1 + 2 * kOverlap;
    wide.west = g.west - kOverlap * g.step_lon;
    wide.undulations.clear();
    for (int row = 0; row < g.rows; ++row)
        for (int column = 0; column < wide.columns; ++column)
            wide.undulations.push_back(
                g.undulations[static_cast<std::size_t>(row) * static_cast<std::size_t>(g.columns) +
                              static_cast<std::size_t>(((column - kOverlap) % turn + turn) % turn)]);
    return wide;
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
    const auto nodes = read_gtx(file);
    if (!nodes) return nodes.error();
    return from_nodes(*nodes, file.string());
}

Result<Geoid> Geoid::from_nodes(const GeoidNodes& nodes, const std::string& name) {
    if (auto sound = check(nodes, name); !sound) return sound.error();
    if (!all_round(nodes)) return region(nodes);
    return from_pole_to_pole(nodes) ? whole_earth(nodes) : region(overlapping(nodes));
}

Geoid Geoid::whole_earth(const GeoidNodes& nodes) {
    Geoid geoid;
    geoid.whole_earth_ = true;
    geoid.columns_ = nodes.columns - nodes.columns % 2;  // without the closing column
    geoid.rows_ = nodes.rows;
    geoid.south_ = -90;
    geoid.west_ = nodes.west;
    geoid.step_lat_ = 180.0 / (geoid.rows_ - 1);
    geoid.step_lon_ = 360.0 / geoid.columns_;
    const auto columns = static_cast<std::size_t>(geoid.columns_);
    const auto rows = static_cast<std::size_t>(geoid.rows_);
    std::vector<double>& c = geoid.coefficients_;
    c.resize(columns * rows);
    for (std::size_t row = 0; row < rows; ++row) {
        const auto* line = nodes.undulations.data() + row * static_cast<std::size_t>(nodes.columns);
        std::copy(line, line + columns, c.data() + row * columns);
    }
    for (std::size_t row = 0; row < rows; ++row)
        to_periodic_spline_coefficients(std::span(c).subspan(row * columns, columns));
    // A meridian and its opposite make one periodic line over both poles.
    std::vector<double> circle(2 * (rows - 1));
    for (std::size_t column = 0; column < columns / 2; ++column) {
        const std::size_t opposite = column + columns / 2;
        for (std::size_t row = 0; row < rows; ++row) circle[row] = c[row * columns + column];
        for (std::size_t row = rows - 2; row > 0; --row)
            circle[2 * (rows - 1) - row] = c[row * columns + opposite];
        to_periodic_spline_coefficients(circle);
        for (std::size_t row = 0; row < rows; ++row) c[row * columns + column] = circle[row];
        for (std::size_t row = 0; row < rows; ++row)
            c[row * columns + opposite] = circle[(2 * (rows - 1) - row) % circle.size()];
    }
    return geoid;
}

Geoid Geoid::region(const GeoidNodes& nodes) {
    Geoid geoid;
    geoid.south_ = nodes.south;
    geoid.west_ = nodes.west;
    geoid.step_lat_ = nodes.step_lat;
    geoid.step_lon_ = nodes.step_lon;
    geoid.band_ = all_round(nodes);
    geoid.columns_ = nodes.columns;
    geoid.rows_ = nodes.rows;
    std::vector<double> N = nodes.undulations;
    if (std::any_of(N.begin(), N.end(), [](double value) { return std::isnan(value); })) {
        for (const double value : N) geoid.has_value_.push_back(std::isnan(value) ? 0 : 1);
        fill_holes(N, nodes.columns, nodes.rows);
    }
    const auto columns = static_cast<std::size_t>(nodes.columns);
    const auto rows = static_cast<std::size_t>(nodes.rows);
    const std::size_t stride = columns + 2;
    std::vector<double>& c = geoid.coefficients_;
    c.resize(stride * (rows + 2));
    for (std::size_t row = 0; row < rows; ++row) {
        const auto line = line_spline_coefficients(std::span(N).subspan(row * columns, columns));
        std::copy(line.begin(), line.end(), c.data() + (row + 1) * stride);
    }
    std::vector<double> meridian(rows);
    for (std::size_t column = 0; column < stride; ++column) {
        for (std::size_t row = 0; row < rows; ++row) meridian[row] = c[(row + 1) * stride + column];
        const auto line = line_spline_coefficients(meridian);
        for (std::size_t row = 0; row < rows + 2; ++row) c[row * stride + column] = line[row];
    }
    return geoid;
}

/// Column of a longitude in a region's grid: between 0 and columns - 1 where it is inside, else nearer to one
/// side or the other, as the place is.
double Geoid::column_of(Degrees lon) const {
    const double width = (columns_ - 1) * step_lon_;
    const double from_middle = (wrapped_360(lon - Degrees{west_ + width / 2 - 180}) - Degrees{180}).value;
    const double column = (from_middle + width / 2) / step_lon_;
    // What rounding has put a hair outside.
    constexpr double kHair = 1e-9;
    if (column < 0 && column > -kHair) return 0;
    if (column > columns_ - 1 && column < columns_ - 1 + kHair) return columns_ - 1;
    return column;
}

bool Geoid::covers(LatLon place) const {
    if (whole_earth_) return true;
    const double x = column_of(place.lon);
    const double y = (place.lat.value - south_) / step_lat_;
    constexpr double kHair = 1e-9;
    if (!(x >= 0 && x <= columns_ - 1 && y >= -kHair && y <= rows_ - 1 + kHair)) return false;
    if (has_value_.empty()) return true;
    // All nodes of its piece of the spline and of the pieces around.
    const int column = static_cast<int>(x);
    const int row = static_cast<int>(std::max(y, 0.0));
    for (int r = std::max(row - 1, 0); r <= std::min(row + 2, rows_ - 1); ++r)
        for (int c = std::max(column - 1, 0); c <= std::min(column + 2, columns_ - 1); ++c)
            if (has_value_[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) +
                           static_cast<std::size_t>(c)] == 0)
                return false;
    return true;
}

GeoidNodes Geoid::nodes_around(const GridFrame::Extent& area) const {
    constexpr int kSpare = 20;  // the influence of what is beyond falls by 0.27 a node
    const auto node_below = [](double nodes) { return static_cast<int>(std::floor(nodes + kSlack)); };
    const int lowest = node_below((area.south - south_) / step_lat_) - kSpare;
    const int highest = node_below((area.north - south_) / step_lat_) + 1 + kSpare;
    const double west = whole_earth_ ? (area.west - west_) / step_lon_ : column_of(Degrees{area.west});
    const int leftmost = node_below(west) - kSpare;
    const int rightmost = node_below(west + (area.east - area.west) / step_lon_) + 1 + kSpare;
    const bool all_rows = whole_earth_ && (lowest < 0 || highest >= rows_);
    const bool all_columns = all_rows || band_ || rightmost - leftmost + 1 >= columns_;
    const bool turns = whole_earth_ && !all_columns;  // else columns end with the grid's

    GeoidNodes nodes;
    nodes.step_lat = step_lat_;
    nodes.step_lon = step_lon_;
    const int first_row = all_rows ? 0 : std::clamp(lowest, 0, rows_ - 4);
    const int last_row = all_rows ? rows_ - 1 : std::clamp(highest, first_row + 3, rows_ - 1);
    const int first_column = all_columns ? 0 : turns ? leftmost : std::clamp(leftmost, 0, columns_ - 4);
    const int last_column = all_columns ? columns_ - 1
                            : turns     ? rightmost
                                        : std::clamp(rightmost, first_column + 3, columns_ - 1);
    nodes.south = south_ + first_row * step_lat_;
    nodes.west = west_ + first_column * step_lon_;
    nodes.rows = last_row - first_row + 1;
    nodes.columns = last_column - first_column + 1;
    for (int row = first_row; row <= last_row; ++row) {
        for (int column = first_column; column <= last_column; ++column)
            nodes.undulations.push_back(static_cast<double>(static_cast<float>(node(column, row))));
    }
    return nodes;
}

/// N at a node; NaN where it has none. \pre the row is one of the grid's; the column too, or its grid turns
double Geoid::node(int column, int row) const {
    if (!has_value_.empty() && has_value_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                                          static_cast<std::size_t>(column)] == 0)
        return std::numeric_limits<double>::quiet_NaN();
    // A pole is one point, but rounding differs between its columns.
    const bool at_pole = whole_earth_ && (row == 0 || row == rows_ - 1);
    const double lat = std::clamp(south_ + row * step_lat_, -90.0, 90.0);
    return undulation({Degrees{lat}, Degrees{west_ + (at_pole ? 0 : column) * step_lon_}}).m;
}

Undulation Geoid::undulation(LatLon place) const {
    assert(std::abs(place.lat.value) <= 90 && std::isfinite(place.lon.value));
    if (whole_earth_) return undulation_on_earth(place);
    const double x = std::clamp(column_of(place.lon), 0.0, columns_ - 1.0);
    const double y = std::clamp((place.lat.value - south_) / step_lat_, 0.0, rows_ - 1.0);
    const int column = std::min(static_cast<int>(x), columns_ - 2);
    const int row = std::min(static_cast<int>(y), rows_ - 2);
    const auto along = spline_weights(x - column);
    const auto up = spline_weights(y - row);
    double sum = 0;
    for (int j = 0; j < 4; ++j) {
        const double* line =
            coefficients_.data() + static_cast<std::ptrdiff_t>(row + j) * (columns_ + 2) + column;
        double line_sum = 0;
        for (int i = 0; i < 4; ++i) line_sum += along[static_cast<std::size_t>(i)] * line[i];
        sum += up[static_cast<std::size_t>(j)] * line_sum;
    }
    return {sum};
}

Undulation Geoid::undulation_on_earth(LatLon place) const {
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
