#include "ingest/resample/resample.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace relevo::ingest {
namespace {

constexpr double kVoid = std::numeric_limits<double>::quiet_NaN();

constexpr std::array<std::pair<Resampling, const char*>, 4> kNames{{
    {Resampling::cubic, "cubic"},
    {Resampling::bilinear, "bilinear"},
    {Resampling::nearest, "nearest"},
    {Resampling::average, "average"},
}};

/// The cell of a place: the post north-west of it, in the part, and how far the place is from it.
struct Cell {
    int column;
    int row;
    double u;
    double v;
};

Cell cell_of(const SourcePart& part, Place place) {
    const double left = std::floor(place.x);
    const double top = std::floor(place.y);
    return {static_cast<int>(left) - part.window.column, static_cast<int>(top) - part.window.row,
            place.x - left, place.y - top};
}

double nearest(const SourcePart& part, const Cell& cell) {
    return part.heights.at(cell.column + (cell.u >= 0.5 ? 1 : 0), cell.row + (cell.v >= 0.5 ? 1 : 0));
}

/// NaN where one of the 16 posts is.
double cubic(const SourcePart& part, const Cell& cell) {
    const auto across = keys_weights(cell.u);
    const auto down = keys_weights(cell.v);
    double sum = 0;
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -lowest;
    for (int j = 0; j < 4; ++j) {
        const double* h = part.heights.row(cell.row - 1 + j) + (cell.column - 1);
        sum += down[static_cast<std::size_t>(j)] *
               (across[0] * h[0] + across[1] * h[1] + across[2] * h[2] + across[3] * h[3]);
        lowest = std::min({lowest, h[0], h[1], h[2], h[3]});
        highest = std::max({highest, h[0], h[1], h[2], h[3]});
    }
    // A NaN among the posts makes the sum NaN, whatever it does to the bounds.
    return std::isnan(sum) ? kVoid : std::clamp(sum, lowest, highest);
}

/// Bilinear from the valid ones of a cell's posts; NaN where the nearest is void.
double linear(const SourcePart& part, const Cell& cell) {
    const double* north = part.heights.row(cell.row) + cell.column;
    const double* south = part.heights.row(cell.row + 1) + cell.column;
    const std::array<double, 4> h{north[0], north[1], south[0], south[1]};
    const std::array<double, 4> weight{(1 - cell.u) * (1 - cell.v), cell.u * (1 - cell.v),
                                       (1 - cell.u) * cell.v, cell.u * cell.v};
    double sum = 0;
    double total = 0;
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -lowest;
    int valid = 0;
    std::size_t missing = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        if (std::isnan(h[i])) {
            missing = i;
            continue;
        }
        ++valid;
        sum += weight[i] * h[i];
        total += weight[i];
        lowest = std::min(lowest, h[i]);
        highest = std::max(highest, h[i]);
    }
    if (valid < 4 && std::isnan(nearest(part, cell))) return kVoid;
    if (valid == 3) {
        // The plane of the three: a void's border is then as exact as the plane is.
        const double fourth = h[missing ^ 1] + h[missing ^ 2] - h[missing ^ 3];
        sum += weight[missing] * fourth;
        total = 1;
    }
    return std::clamp(valid == 4 ? sum : sum / total, lowest, highest);
}

/// Overlap of post i's interval [i - 1/2, i + 1/2] with [low, high].
double overlap(int i, double low, double high) {
    return std::min(i + 0.5, high) - std::max(i - 0.5, low);
}

double average(const SourcePart& part, Place place, Footprint footprint) {
    const double left = place.x - footprint.half_columns;
    const double right = place.x + footprint.half_columns;
    const double top = place.y - footprint.half_rows;
    const double bottom = place.y + footprint.half_rows;
    const int first_column = static_cast<int>(std::floor(left + 0.5));
    const int last_column = static_cast<int>(std::ceil(right - 0.5));
    const int first_row = static_cast<int>(std::floor(top + 0.5));
    const int last_row = static_cast<int>(std::ceil(bottom - 0.5));
    double sum = 0;
    double valid = 0;
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -lowest;
    for (int row = first_row; row <= last_row; ++row) {
        const double height = overlap(row, top, bottom);
        const double* h = part.heights.row(row - part.window.row);
        for (int column = first_column; column <= last_column; ++column) {
            const double value = h[column - part.window.column];
            const double weight = height * overlap(column, left, right);
            if (std::isnan(value) || weight <= 0) continue;
            sum += weight * value;
            valid += weight;
            lowest = std::min(lowest, value);
            highest = std::max(highest, value);
        }
    }
    const double area = 4 * footprint.half_columns * footprint.half_rows;
    if (!(valid >= 0.5 * area * (1 - 1e-9))) return kVoid;
    return std::clamp(sum / valid, lowest, highest);
}

}  // namespace

std::string to_string(Resampling method) {
    for (const auto& [value, name] : kNames)
        if (value == method) return name;
    return {};
}

std::optional<Resampling> resampling_from(const std::string& text) {
    for (const auto& [value, name] : kNames)
        if (text == name) return value;
    return {};
}

std::array<double, 4> keys_weights(double t) {
    return {t * (-0.5 + t * (1 - 0.5 * t)), 1 + t * t * (-2.5 + 1.5 * t), t * (0.5 + t * (2 - 1.5 * t)),
            t * t * (-0.5 + 0.5 * t)};
}

int reach(Resampling method, Footprint footprint) {
    if (method != Resampling::average) return 2;
    return static_cast<int>(std::ceil(std::max(footprint.half_columns, footprint.half_rows))) + 1;
}

double resample(const SourcePart& part, Place place, Resampling method, Footprint footprint) {
    if (method == Resampling::average) return average(part, place, footprint);
    const Cell cell = cell_of(part, place);
    if (method == Resampling::nearest) return nearest(part, cell);
    if (method == Resampling::cubic) {
        const double height = cubic(part, cell);
        if (!std::isnan(height)) return height;
    }
    return linear(part, cell);
}

}  // namespace relevo::ingest
