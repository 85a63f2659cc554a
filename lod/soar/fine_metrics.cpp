#include "lod/soar/fine_metrics.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "lod/scene/metric_code.hpp"

namespace relevo::lod {

namespace {

double distance2(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 d = a - b;
    return glm::dot(d, d);
}

class FineBuilder {
  public:
    FineBuilder(const MetricTile& tile, int levels, ObjectErrors errors)
        : tile_(tile),
          window_(tile.window()),
          levels_(levels),
          with_bounded_(errors == ObjectErrors::both),
          scanned_(with_bounded_ || !tile.all_valid()) {
        for (auto* raster : {&codes_.bounded, &codes_.incremental, &codes_.radius})
            *raster = Raster<std::uint16_t>(window_.columns, window_.rows);
    }

    MetricRasters build(int half_size_limit) {
        for (int level = 2 * levels_ - 1; level >= 0 && half_size(levels_, level) <= half_size_limit;
             --level) {
            const int s = half_size(levels_, level);
            for (int row = window_.row; row < window_.row + window_.rows; ++row) {
                for_each_vertex_in_row(levels_, level, row, [&](const GridPoint& v) {
                    if (is_inside(v, s)) build_vertex(v, level);
                });
            }
        }
        return std::move(codes_);
    }

  private:
    /// Is the diamond in the window, as far as it is in the grid?
    bool is_inside(const GridPoint& v, int s) const {
        const int last = 1 << levels_;
        return std::max(v.column - s, 0) >= window_.column && std::max(v.row - s, 0) >= window_.row &&
               std::min(v.column + s, last) < window_.column + window_.columns &&
               std::min(v.row + s, last) < window_.row + window_.rows;
    }

    void build_vertex(const GridPoint& v, int level) {
        const Diamond d = diamond(v, level, levels_);
        const glm::dvec3 here = tile_.position(v);
        const glm::dvec3 left = tile_.position(d.left);
        const glm::dvec3 right = tile_.position(d.right);
        const double incremental_m2 = tile_.is_valid(v) ? distance2(here, 0.5 * (left + right)) : -1;

        Deviation deviation;
        double radius_m2 = std::max(distance2(here, left), distance2(here, right));
        // At the last level the vertex is all that lies between the corners of its diamond.
        const bool last_level = level == 2 * levels_ - 1;
        if (last_level) deviation.max_m2 = incremental_m2;
        bool corner_is_valid = last_level && (tile_.is_valid(d.left) || tile_.is_valid(d.right));
        for (const GridPoint& apex : d.apexes) {
            const glm::dvec3 top = tile_.position(apex);
            radius_m2 = std::max(radius_m2, distance2(here, top));
            if (last_level) {
                corner_is_valid = corner_is_valid || tile_.is_valid(apex);
            } else if (scanned_) {
                deviation.join(tile_.deviation({{d.left, d.right, apex}, {left, right, top}}, window_));
            }
        }
        double radius = std::sqrt(radius_m2);
        const auto code_of = [](double m2) {
            const double m = m2 > 0 ? std::sqrt(m2) : 0;
            return m < kNegligibleM ? std::uint16_t{0} : encode_up(m);
        };
        std::uint16_t bounded = with_bounded_ ? code_of(deviation.max_m2) : std::uint16_t{0};
        std::uint16_t incremental = code_of(incremental_m2);
        bool empty = scanned_ && !deviation.any_post() && !corner_is_valid;
        for (const GridPoint& child : children(v, level, levels_)) {
            const int x = child.column - window_.column;
            const int y = child.row - window_.row;
            if (x < 0 || y < 0 || x >= window_.columns || y >= window_.rows) continue;  // beyond the halo
            const std::uint16_t child_radius = codes_.radius.at(x, y);
            if (child_radius == 0) continue;
            empty = false;
            bounded = std::max(bounded, codes_.bounded.at(x, y));
            incremental = std::max(incremental, codes_.incremental.at(x, y));
            radius = std::max(radius, std::sqrt(distance2(here, tile_.position(child))) +
                                          static_cast<double>(decode(child_radius)));
        }
        if (empty) return;  // the codes stay 0: never drawn, and no sphere to look into
        const int x = v.column - window_.column;
        const int y = v.row - window_.row;
        codes_.bounded.at(x, y) = bounded;
        codes_.incremental.at(x, y) = incremental;
        codes_.radius.at(x, y) = encode_up(radius + kRadiusMarginM);
    }

    const MetricTile& tile_;
    const BlockGrid::Box& window_;
    int levels_;
    bool with_bounded_;
    bool scanned_;  // for the bounded error, or to know which vertices have no valid post in their diamond
    MetricRasters codes_;
};

}  // namespace

MetricRasters fine_metrics(const MetricTile& tile, int levels, int half_size, ObjectErrors errors) {
    return FineBuilder(tile, levels, errors).build(half_size);
}

}  // namespace relevo::lod
