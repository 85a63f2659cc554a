#include "lod/pyramid/ground_normals.hpp"

#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

#include "lod/machine_clones.hpp"
#include "lod/scene/post_mark.hpp"

namespace relevo::lod {

namespace {

using Normal = Ground::Normal;

/// Of a component of a unit normal.
std::int16_t snorm(double value) {
    const double scaled = value * 32767;
    return static_cast<std::int16_t>(static_cast<int>(scaled + (scaled < 0 ? -0.5 : 0.5)));
}

constexpr double kPointM = 1e-6;  // a pole's row is one point

/// Rise of the surface from `before` to `after` through `here`, metres a metre; a void on one side leaves the
/// other.
double slope(float before, float here, float after, double spacing) {
    if (!(spacing > kPointM)) return 0;
    const bool has_before = !std::isnan(before);
    const bool has_after = !std::isnan(after);
    if (has_before && has_after) return static_cast<double>(after - before) / (2 * spacing);
    if (has_after) return static_cast<double>(after - here) / spacing;
    return has_before ? static_cast<double>(here - before) / spacing : 0;
}

Normal normal_of(double along, double up) {
    const double length = std::sqrt(1 + along * along + up * up);
    return {snorm(-along / length), snorm(-up / length)};
}

/// One row, where all of the posts around each are valid; elsewhere the surface is taken to be flat.
[[RELEVO_CLONES("avx2", "default")]] void normals_inside(const float* north, const float* here,
                                                         const float* south, int count, double per_column,
                                                         double per_row, Normal* out) {
    for (int i = 0; i < count; ++i) {
        const float rise_along = here[i + 1] - here[i - 1];
        const float rise_up = north[i] - south[i];
        const double along = static_cast<double>(rise_along == rise_along ? rise_along : 0) * per_column;
        const double up = static_cast<double>(rise_up == rise_up ? rise_up : 0) * per_row;
        const double scale = -32767 / std::sqrt(1 + along * along + up * up);
        const double x = along * scale;
        const double y = up * scale;
        out[i] = {static_cast<std::int16_t>(static_cast<int>(x + (x < 0 ? -0.5 : 0.5))),
                  static_cast<std::int16_t>(static_cast<int>(y + (y < 0 ? -0.5 : 0.5)))};
    }
}

/// Sums of three posts of a row around every second one, weighted 1 2 1; voids weigh nothing, and are 0.
struct RowSums {
    std::vector<int> along;
    std::vector<int> up;
    std::vector<int> weight;

    RowSums(const Ground& fine, int row, int first, int count)
        : along(static_cast<std::size_t>(count)), up(along), weight(along) {
        if (row < 0 || row >= fine.classes.rows()) return;
        const Normal* normals = fine.normals.row(row);
        const std::uint8_t* classes = fine.classes.row(row);
        const int columns = fine.classes.columns();
        const auto add = [&](std::size_t i, int column, int times) {
            along[i] += times * normals[column][0];
            up[i] += times * normals[column][1];
            weight[i] += classes[column] != 0 ? times : 0;
        };
        for (int i = 0; i < count; ++i) {
            const int column = first + 2 * i;
            const auto k = static_cast<std::size_t>(i);
            add(k, column, 2);
            if (column > 0) add(k, column - 1, 1);
            if (column + 1 < columns) add(k, column + 1, 1);
        }
    }
};

std::int16_t rounded_mean(int sum, int weight) {
    constexpr int kAll = 16;
    if (weight == kAll) return static_cast<std::int16_t>((sum + (sum < 0 ? -kAll / 2 : kAll / 2)) / kAll);
    return static_cast<std::int16_t>((sum + (sum < 0 ? -weight / 2 : weight / 2)) / weight);
}

static_assert(static_cast<int>(PostClass::void_post) == 0);

}  // namespace

GroundNormals::GroundNormals(const geo::GridFrame& frame) : frame_(frame) {
    if (frame.is_polar()) polar_.emplace(frame);
}

Raster<Normal> GroundNormals::of(const BlockGrid::Box& box, const Raster<float>& around) const {
    assert(around.columns() == box.columns + 2 && around.rows() == box.rows + 2);
    Raster<Normal> normals(box.columns, box.rows);
    for (int row = 0; row < box.rows; ++row) {
        geo::GridFrame::Spacing spacing;
        if (!polar_) spacing = frame_.spacing({0, static_cast<double>(box.row + row)});
        const float* north = around.row(row) + 1;
        const float* here = around.row(row + 1) + 1;
        const float* south = around.row(row + 2) + 1;
        Normal* out = normals.row(row);
        const bool on_pole = !(spacing.column_m > kPointM);
        if (!polar_)
            normals_inside(north, here, south, box.columns, on_pole ? 0 : 0.5 / spacing.column_m,
                           0.5 / spacing.row_m, out);
        for (int column = 0; column < box.columns; ++column) {
            if (std::isnan(here[column])) {
                out[column] = {};
                continue;
            }
            const float around_it = here[column - 1] + here[column + 1] + south[column] + north[column];
            if (!polar_ && !std::isnan(around_it)) continue;
            if (polar_) spacing = polar_->spacing(box.column + column, box.row + row);
            out[column] = normal_of(slope(here[column - 1], here[column], here[column + 1], spacing.column_m),
                                    slope(south[column], here[column], north[column], spacing.row_m));
        }
    }
    return normals;
}

Ground every_second(const Ground& fine, const BlockGrid::Box& box) {
    Ground kept(box.columns, box.rows);
    RowSums above(fine, box.row - 1, box.column, box.columns);
    for (int row = 0; row < box.rows; ++row) {
        const int y = box.row + 2 * row;
        const RowSums here(fine, y, box.column, box.columns);
        RowSums below(fine, y + 1, box.column, box.columns);
        const std::uint8_t* classes = fine.classes.row(y) + box.column;
        for (int column = 0; column < box.columns; ++column) {
            kept.classes.at(column, row) = classes[2 * column];
            if (classes[2 * column] == 0) continue;
            const auto i = static_cast<std::size_t>(column);
            const int weight = above.weight[i] + 2 * here.weight[i] + below.weight[i];
            kept.normals.at(column, row) = {
                rounded_mean(above.along[i] + 2 * here.along[i] + below.along[i], weight),
                rounded_mean(above.up[i] + 2 * here.up[i] + below.up[i], weight)};
        }
        above = std::move(below);
    }
    return kept;
}

}  // namespace relevo::lod
