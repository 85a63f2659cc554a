#include "lod/pyramid/ground_normals.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "lod/scene/post_mark.hpp"

namespace relevo::lod {

namespace {

using Normal = Ground::Normal;

std::int16_t snorm(double value) {
    return static_cast<std::int16_t>(std::lround(std::clamp(value, -1.0, 1.0) * 32767));
}

/// Rise of the surface from `before` to `after` through `here`, metres a metre; a void on one side leaves the
/// other.
double slope(float before, float here, float after, double spacing) {
    if (!(spacing > 1e-6)) return 0;  // a pole's row is one point
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

/// A weighted mean of normals.
class Mean {
  public:
    void add(const Normal& normal, int weight) {
        along_ += weight * normal[0];
        up_ += weight * normal[1];
        weights_ += weight;
    }
    /// \pre something was added
    Normal value() const { return {rounded(along_), rounded(up_)}; }

  private:
    std::int16_t rounded(int sum) const {
        const int half = sum < 0 ? -weights_ / 2 : weights_ / 2;
        return static_cast<std::int16_t>((sum + half) / weights_);
    }

    int along_ = 0;
    int up_ = 0;
    int weights_ = 0;
};

constexpr auto kVoidClass = static_cast<std::uint8_t>(PostClass::void_post);

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
        for (int column = 0; column < box.columns; ++column) {
            if (std::isnan(here[column])) continue;
            if (polar_) spacing = polar_->spacing(box.column + column, box.row + row);
            out[column] = normal_of(slope(here[column - 1], here[column], here[column + 1], spacing.column_m),
                                    slope(south[column], here[column], north[column], spacing.row_m));
        }
    }
    return normals;
}

Ground every_second(const Ground& fine, const BlockGrid::Box& box) {
    Ground kept(box.columns, box.rows);
    for (int row = 0; row < box.rows; ++row) {
        const int y = box.row + 2 * row;
        for (int column = 0; column < box.columns; ++column) {
            const int x = box.column + 2 * column;
            kept.classes.at(column, row) = fine.classes.at(x, y);
            if (fine.classes.at(x, y) == kVoidClass) continue;
            Mean mean;
            for (int v = std::max(y - 1, 0); v <= std::min(y + 1, fine.classes.rows() - 1); ++v) {
                const std::uint8_t* classes = fine.classes.row(v);
                const Normal* normals = fine.normals.row(v);
                for (int u = std::max(x - 1, 0); u <= std::min(x + 1, fine.classes.columns() - 1); ++u) {
                    if (classes[u] != kVoidClass) mean.add(normals[u], (u == x ? 2 : 1) * (v == y ? 2 : 1));
                }
            }
            kept.normals.at(column, row) = mean.value();
        }
    }
    return kept;
}

}  // namespace relevo::lod
