#include "lod/oracle.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>
#include <mutex>
#include <new>
#include <numeric>
#include <vector>

#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace relevo::lod {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Corner {
    glm::dvec3 drawn;  // relative to the eye
    int column;
    int row;
};
using Triangle = std::array<Corner, 3>;

/// The truth, by ways of its own: heights as imported, positions by the exact path, no tables, metrics or
/// spheres. One a thread: it keeps the posts that it read last.
class Truth {
  public:
    Truth(const Terrain& terrain, const View& view, double exaggeration)
        : terrain_(terrain), posts_(terrain.posts()), eye_(view.eye()), exaggeration_(exaggeration) {}

    int columns() const { return terrain_.frame().columns; }
    int rows() const { return terrain_.frame().rows; }
    bool is_valid(int column, int row) { return posts_.is_valid(column, row); }

    bool is_valid_cell(int column, int row) { return posts_.is_valid_cell(column, row); }

    /// Offset of a valid post from the eye.
    glm::dvec3 post(int column, int row) {
        const geo::GridPosition place{static_cast<double>(column), static_cast<double>(row)};
        const double H = static_cast<double>(posts_.H(column, row));
        const double N = terrain_.undulations().at(place);
        return terrain_.frame().ecef(place, {N + exaggeration_ * H}) - eye_;
    }

    /// Offset of the full-resolution surface between posts; nothing in a void or outside the data.
    std::optional<glm::dvec3> between_posts(double x, double y) {
        const int column = std::min(static_cast<int>(std::floor(x)), columns() - 2);
        const int row = std::min(static_cast<int>(std::floor(y)), rows() - 2);
        if (!(x >= 0 && y >= 0 && x <= columns() - 1 && y <= rows() - 1) || column < 0 || row < 0)
            return std::nullopt;
        if (!posts_.is_valid_cell(column, row)) return std::nullopt;
        const double u = x - column;
        const double v = y - row;
        const glm::dvec3 north_west = post(column, row);
        const glm::dvec3 north_east = post(column + 1, row);
        const glm::dvec3 south_west = post(column, row + 1);
        const glm::dvec3 south_east = post(column + 1, row + 1);
        // The cell is cut from its even post to its odd one (both coordinates even, both odd).
        if ((column + row) % 2 == 0) {
            return u > v ? north_west + u * (north_east - north_west) + v * (south_east - north_east)
                         : north_west + v * (south_west - north_west) + u * (south_east - south_west);
        }
        return u + v < 1
                   ? north_west + u * (north_east - north_west) + v * (south_west - north_west)
                   : south_east + (1 - u) * (south_west - south_east) + (1 - v) * (north_east - south_east);
    }

  private:
    const Terrain& terrain_;
    TruePosts::Reader posts_;
    geo::Ecef eye_;
    double exaggeration_;
};

/// Pixels between a point of the picture and where another point appears; infinite behind the eye.
double pixel_distance(const View& view, const glm::dvec2& pixel, const glm::dvec3& offset) {
    if (view.depth(offset) <= 0) return kInfinity;
    return glm::distance(pixel, view.pixel(offset));
}

class Oracle {
  public:
    Oracle(const Terrain& terrain, const View& view, const Mesh& mesh, double exaggeration)
        : terrain_(terrain), view_(view), mesh_(mesh), exaggeration_(exaggeration) {}

    std::optional<MeasuredError> measure() {
        MeasuredError result;
        measure_posts(result);
        measure_pixels(result);
        if (errors_.empty() && result.uncovered_posts == 0) return std::nullopt;
        if (errors_.empty()) return result;
        result.max_px = *std::max_element(errors_.begin(), errors_.end());
        const double sum2 = std::transform_reduce(errors_.begin(), errors_.end(), 0.0, std::plus{},
                                                  [](double e) { return e * e; });
        result.rms_px = std::sqrt(sum2 / static_cast<double>(errors_.size()));
        const auto p99 =
            errors_.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(errors_.size() - 1));
        std::nth_element(errors_.begin(), p99, errors_.end());
        result.p99_px = *p99;
        return result;
    }

  private:
    Triangle triangle(std::size_t k) const {
        Triangle corners;
        for (std::size_t i = 0; i < 3; ++i) {
            const MeshVertex& v = mesh_.vertices[mesh_.indices[3 * k + i]];
            corners[i] = {
                glm::dvec3(static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)),
                v.column, v.row};
        }
        return corners;
    }

    void take(const std::vector<double>& errors) {
        const std::lock_guard lock(mutex_);
        errors_.insert(errors_.end(), errors.begin(), errors.end());
    }

    Truth truth() const { return {terrain_, view_, exaggeration_}; }
    int columns() const { return terrain_.frame().columns; }
    int rows() const { return terrain_.frame().rows; }

    /// A byte a post, of which those in view alone take memory.
    using Marks = std::unique_ptr<std::uint8_t[], decltype(&std::free)>;

    void measure_posts(MeasuredError& result) {
        const Marks covered(static_cast<std::uint8_t*>(std::calloc(static_cast<std::size_t>(columns()),
                                                                   static_cast<std::size_t>(rows()))),
                            &std::free);
        if (!covered) throw std::bad_alloc();
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh_.triangles(), 64), [&](const auto& range) {
            Truth truth = this->truth();
            std::vector<double> errors;
            for (std::size_t k = range.begin(); k < range.end(); ++k)
                compare_posts(triangle(k), truth, covered, errors);
            take(errors);
        });
        result.posts = errors_.size();

        std::atomic<std::uint64_t> uncovered = 0;
        constexpr int kSide = Pyramid::kBlockCells;
        const int across = (columns() + kSide - 1) / kSide;
        const int down = (rows() + kSide - 1) / kSide;
        tbb::parallel_for(0, across * down, [&](int block) {
            const int left = block % across * kSide;
            const int top = block / across * kSide;
            const int right = std::min(left + kSide, columns());
            const int bottom = std::min(top + kSide, rows());
            if (!may_be_seen(left, top, right, bottom)) return;
            Truth truth = this->truth();
            for (int row = top; row < bottom; ++row) {
                for (int column = left; column < right; ++column) {
                    if (covered[post_index(column, row)] == 0 && touches_ground(truth, column, row) &&
                        view_.sees(truth.post(column, row))) {
                        ++uncovered;
                    }
                }
            }
        });
        result.uncovered_posts = uncovered;
    }

    /// May posts in a box of the grid be in view? No, where all that is within 20 km of heights is not.
    bool may_be_seen(int left, int top, int right, int bottom) const {
        const auto at = [&](int column, int row) {
            return terrain_.frame().ecef({static_cast<double>(column), static_cast<double>(row)}, {0}) -
                   view_.eye();
        };
        const glm::dvec3 middle = at((left + right) / 2, (top + bottom) / 2);
        double radius = 0;
        for (const int column : {left, right})
            for (const int row : {top, bottom})
                radius = std::max(radius, glm::distance(middle, at(column, row)));
        radius = 1.1 * radius + 20e3 * std::max(exaggeration_, 1.0);
        for (const glm::dvec3& plane : view_.side_planes()) {
            if (glm::dot(plane, middle) > radius) return false;
        }
        return true;
    }

    std::size_t post_index(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns()) +
               static_cast<std::size_t>(column);
    }

    /// Is the post a corner of a cell that is drawn? A post alone among voids has no surface.
    static bool touches_ground(Truth& truth, int column, int row) {
        return truth.is_valid_cell(column - 1, row - 1) || truth.is_valid_cell(column, row - 1) ||
               truth.is_valid_cell(column - 1, row) || truth.is_valid_cell(column, row);
    }

    void compare_posts(const Triangle& t, Truth& truth, const Marks& covered,
                       std::vector<double>& errors) const {
        const auto [left, right] = std::minmax({t[0].column, t[1].column, t[2].column});
        const auto [top, bottom] = std::minmax({t[0].row, t[1].row, t[2].row});
        const auto cross = [](const Corner& a, const Corner& b, int x, int y) {
            return (b.column - a.column) * (y - a.row) - (b.row - a.row) * (x - a.column);
        };
        const double area = cross(t[0], t[1], t[2].column, t[2].row);
        if (area == 0) return;  // it stands on end: pixels judge it
        for (int row = top; row <= std::min(bottom, rows() - 1); ++row) {
            for (int column = left; column <= std::min(right, columns() - 1); ++column) {
                const double b0 = cross(t[1], t[2], column, row) / area;
                const double b1 = cross(t[2], t[0], column, row) / area;
                const double b2 = cross(t[0], t[1], column, row) / area;
                if (b0 < 0 || b1 < 0 || b2 < 0 || !truth.is_valid(column, row)) continue;
                std::atomic_ref<std::uint8_t> mark(covered[post_index(column, row)]);
                if (mark.exchange(1) != 0) continue;  // a neighbour has it: the surfaces meet there
                const glm::dvec3 exact = truth.post(column, row);
                if (!view_.sees(exact)) continue;
                const glm::dvec3 drawn = b0 * t[0].drawn + b1 * t[1].drawn + b2 * t[2].drawn;
                errors.push_back(pixel_distance(view_, view_.pixel(exact), drawn));
            }
        }
    }

    /// The drawn surface under a pixel: nearest to the eye, with its grid coordinates.
    struct Sample {
        double depth = kInfinity;
        double x = 0;
        double y = 0;
    };

    void measure_pixels(MeasuredError& result) {
        const int width = view_.camera().width;
        const int height = view_.camera().height;
        std::vector<Sample> picture(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
        const auto triangles = project();
        tbb::parallel_for(tbb::blocked_range<int>(0, height, 16), [&](const auto& rows) {
            for (const Projected& p : triangles) rasterise(p, rows.begin(), rows.end(), picture);
        });

        const std::size_t before = errors_.size();
        tbb::parallel_for(tbb::blocked_range<int>(0, height, 16), [&](const auto& rows) {
            Truth truth = this->truth();
            std::vector<double> errors;
            for (int y = rows.begin(); y < rows.end(); ++y) {
                for (int x = 0; x < width; ++x) {
                    const Sample& sample =
                        picture[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                static_cast<std::size_t>(x)];
                    if (sample.depth == kInfinity) continue;
                    if (const auto exact = truth.between_posts(sample.x, sample.y)) {
                        errors.push_back(pixel_distance(view_, {x + 0.5, y + 0.5}, *exact));
                    }
                }
            }
            take(errors);
        });
        result.pixels = errors_.size() - before;
    }

    /// A triangle in eye space with what rasterisation in homogeneous coordinates needs (Olano & Greer 1997):
    /// no clipping, so that triangles around the eye are as right as others.
    struct Projected {
        Triangle corners;
        std::array<glm::dvec3, 3> edge;  // dot(edge[k], ray) is proportional to the weight of corner k
        double volume;
        int left, right, top, bottom;  // pixels that it may cover, last excluded
    };

    std::vector<Projected> project() const {
        std::vector<Projected> result;
        for (std::size_t k = 0; k < mesh_.triangles(); ++k) {
            Projected p;
            p.corners = triangle(k);
            std::array<glm::dvec3, 3> e;
            for (std::size_t i = 0; i < 3; ++i) {
                e[i] = view_.to_eye_space() * p.corners[i].drawn;
                e[i].z = -e[i].z;
            }
            p.edge = {glm::cross(e[1], e[2]), glm::cross(e[2], e[0]), glm::cross(e[0], e[1])};
            p.volume = glm::dot(e[0], p.edge[0]);
            if (p.volume == 0 || !bounds(e, p)) continue;
            result.push_back(p);
        }
        return result;
    }

    /// The pixels around the part of a triangle that is in front of the eye.
    bool bounds(const std::array<glm::dvec3, 3>& e, Projected& p) const {
        constexpr double kNear = 1e-6;
        const double focal = view_.focal_px();
        const double width = view_.camera().width;
        const double height = view_.camera().height;
        glm::dvec2 low(kInfinity);
        glm::dvec2 high(-kInfinity);
        const auto cover = [&](const glm::dvec3& point) {
            const glm::dvec2 pixel(0.5 * width + focal * point.x / point.z,
                                   0.5 * height - focal * point.y / point.z);
            low = glm::min(low, pixel);
            high = glm::max(high, pixel);
        };
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec3& a = e[i];
            const glm::dvec3& b = e[(i + 1) % 3];
            if (a.z >= kNear) cover(a);
            if ((a.z < kNear) != (b.z < kNear)) {
                glm::dvec3 cut = a + (kNear - a.z) / (b.z - a.z) * (b - a);
                cut.z = kNear;
                cover(cut);
            }
        }
        if (low.x > high.x || high.x < 0 || high.y < 0 || low.x > width || low.y > height) return false;
        p.left = static_cast<int>(std::max(0.0, std::floor(low.x)));
        p.top = static_cast<int>(std::max(0.0, std::floor(low.y)));
        p.right = static_cast<int>(std::min(width, std::ceil(high.x) + 1));
        p.bottom = static_cast<int>(std::min(height, std::ceil(high.y) + 1));
        return true;
    }

    void rasterise(const Projected& p, int first_row, int end_row, std::vector<Sample>& picture) const {
        const double focal = view_.focal_px();
        const int width = view_.camera().width;
        const int height = view_.camera().height;
        const double sign = p.volume > 0 ? 1 : -1;
        for (int y = std::max(first_row, p.top); y < std::min(end_row, p.bottom); ++y) {
            for (int x = p.left; x < p.right; ++x) {
                const glm::dvec3 ray((x + 0.5 - 0.5 * width) / focal, (0.5 * height - y - 0.5) / focal, 1);
                const glm::dvec3 w(sign * glm::dot(p.edge[0], ray), sign * glm::dot(p.edge[1], ray),
                                   sign * glm::dot(p.edge[2], ray));
                if (w.x < 0 || w.y < 0 || w.z < 0) continue;
                const double sum = w.x + w.y + w.z;
                const double depth = std::abs(p.volume) / sum;
                Sample& sample = picture[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                         static_cast<std::size_t>(x)];
                if (!(depth < sample.depth) || depth < View::kNearM) continue;
                sample.depth = depth;
                sample.x =
                    (w.x * p.corners[0].column + w.y * p.corners[1].column + w.z * p.corners[2].column) / sum;
                sample.y = (w.x * p.corners[0].row + w.y * p.corners[1].row + w.z * p.corners[2].row) / sum;
            }
        }
    }

    const Terrain& terrain_;
    const View& view_;
    const Mesh& mesh_;
    const double exaggeration_;
    std::mutex mutex_;
    std::vector<double> errors_;
};

}  // namespace

std::optional<MeasuredError> measure_error(const Terrain& terrain, const View& view, const Mesh& mesh,
                                           double exaggeration) {
    return Oracle(terrain, view, mesh, exaggeration).measure();
}

}  // namespace relevo::lod
