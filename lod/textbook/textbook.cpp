#include "lod/textbook/textbook.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include <glm/geometric.hpp>

namespace relevo::lod {

Textbook::Textbook(const Raster<float>& heights, double spacing_x_m, double spacing_y_m)
    : levels_(std::countr_zero(static_cast<unsigned>(heights.columns() - 1))),
      side_(heights.columns()),
      spacing_x_(spacing_x_m),
      spacing_y_(spacing_y_m) {
    posts_.reserve(heights.samples().size());
    for (const float z : heights.samples()) posts_.push_back({z, 0, 0});
    build_errors();
}

glm::dvec3 Textbook::position(int i) const {
    return {spacing_x_ * (i % side_), spacing_y_ * (i / side_),
            static_cast<double>(posts_[static_cast<std::size_t>(i)].z)};
}

void Textbook::build_errors() {
    for (int level = 2 * levels_ - 1; level >= 0; --level) {
        for (int row = 0; row < side_; ++row) {
            for_each_vertex_in_row(levels_, level, row, [&](const GridPoint& v) {
                const Diamond d = diamond(v, level, levels_);
                Post& post = posts_[static_cast<std::size_t>(index(v))];
                const double middle = 0.5 * (position(index(d.left)).z + position(index(d.right)).z);
                double error = std::abs(static_cast<double>(post.z) - middle);
                double radius = 0;
                for (const GridPoint& c : children(v, level, levels_)) {
                    const Post& child = posts_[static_cast<std::size_t>(index(c))];
                    error = std::max(error, static_cast<double>(child.error));
                    radius = std::max(radius, glm::distance(position(index(v)), position(index(c))) +
                                                  static_cast<double>(child.radius));
                }
                post.error = static_cast<float>(error);
                post.radius = static_cast<float>(radius);
            });
        }
    }
}

const std::vector<int>& Textbook::refine(const glm::dvec3& eye, const std::array<glm::dvec3, 4>& planes,
                                         double lambda_px, double tau_px) {
    eye_ = eye;
    planes_ = planes;
    reach_ = lambda_px / tau_px;
    const int last = side_ - 1;
    const int half = last / 2;
    const int centre = index({half, half});
    const int corners[] = {index({0, last}), index({last, last}), index({last, 0}), index({0, 0})};
    const int sides[] = {index({half, last}), index({last, half}), index({half, 0}), index({0, half})};
    strip_.assign({corners[0], corners[0]});
    parity_ = 0;
    for (int k = 0; k < 4; ++k) {
        refine_visible_part(centre, sides[k], 2 * levels_, 0);
        append(corners[(k + 1) % 4], 1);
    }
    return strip_;
}

std::size_t Textbook::triangles() const {
    std::size_t count = 0;
    for (std::size_t k = 2; k < strip_.size(); ++k) {
        if (strip_[k] != strip_[k - 1] && strip_[k] != strip_[k - 2] && strip_[k - 1] != strip_[k - 2])
            ++count;
    }
    return count;
}

bool Textbook::is_active(int i) const {
    const Post& post = posts_[static_cast<std::size_t>(i)];
    const double distance = glm::distance(position(i), eye_);
    return static_cast<double>(post.error) * reach_ > distance - static_cast<double>(post.radius);
}

bool Textbook::is_visible(int i, unsigned& inside) const {
    const double radius = static_cast<double>(posts_[static_cast<std::size_t>(i)].radius);
    for (unsigned k = 0; k < 4; ++k) {
        if ((inside & (1u << k)) != 0) continue;
        const double distance = glm::dot(planes_[k], position(i) - eye_);
        if (distance > radius) return false;
        if (distance < -radius) inside |= 1u << k;
    }
    return true;
}

/// The children of j in the triangle whose apex is i and whose long side j splits: the middles of its short
/// sides, in the order in which the strip goes along the long side. It has the apex on its left and on its
/// right in turn, level by level.
std::array<int, 2> Textbook::next(int i, int j, int level) const {
    const int dx = i % side_ - j % side_;
    const int dy = i / side_ - j / side_;
    const int column = j % side_;
    const int row = j / side_;
    const int left = index({column + (dx + dy) / 2, row + (dy - dx) / 2});
    const int right = index({column + (dx - dy) / 2, row + (dx + dy) / 2});
    if (level % 2 == 0) return {left, right};
    return {right, left};
}

void Textbook::refine_part(int i, int j, int level) {
    if (level == 0 || !is_active(i)) return;
    const auto [first, second] = next(i, j, level);
    refine_part(j, first, level - 1);
    append(i, level % 2);
    refine_part(j, second, level - 1);
}

void Textbook::refine_visible_part(int i, int j, int level, unsigned inside) {
    if (inside == 0xf) return refine_part(i, j, level);
    if (level == 0 || !is_active(i) || !is_visible(i, inside)) return;
    const auto [first, second] = next(i, j, level);
    refine_visible_part(j, first, level - 1, inside);
    append(i, level % 2);
    refine_visible_part(j, second, level - 1, inside);
}

void Textbook::append(int v, int parity) {
    const std::size_t n = strip_.size();
    if (v == strip_[n - 1] || v == strip_[n - 2]) return;
    if (parity != parity_) {
        parity_ = parity;
    } else {
        strip_.push_back(strip_[n - 2]);
    }
    strip_.push_back(v);
}

}  // namespace relevo::lod
