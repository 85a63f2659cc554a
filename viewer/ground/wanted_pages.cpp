#include "viewer/ground/wanted_pages.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <queue>

#include <glm/geometric.hpp>

namespace relevo::viewer {

Sight::Sight(const lod::View& view, const PicturePart& part, double pixels)
    : eye_(view.eye().m), forward_(view.forward()), focal_px_(view.focal_px() / pixels), least_cosine_(1) {
    const double left = part.x;
    const double right = part.x + part.width;
    const double top = part.y;
    const double bottom = part.y + part.height;
    const std::array<glm::dvec3, 4> corners{view.ray({left, top}), view.ray({right, top}),
                                            view.ray({right, bottom}), view.ray({left, bottom})};
    for (std::size_t i = 0; i < 4; ++i) {
        // In the order above, the cross product of neighbours points out of the part.
        planes_[i] = glm::normalize(glm::cross(corners[(i + 1) % 4], corners[i]));
        least_cosine_ = std::min(least_cosine_, glm::dot(corners[i], forward_));
    }
}

bool Sight::sees(const glm::dvec3& centre, double radius_m) const {
    const glm::dvec3 offset = centre - eye_;
    return std::all_of(planes_.begin(), planes_.end(),
                       [&](const glm::dvec3& plane) { return glm::dot(plane, offset) <= radius_m; });
}

double Sight::finest_pixel_m(const glm::dvec3& centre, double radius_m) const {
    // A pixel is depth / focal across, and depth is at least the distance times the cosine.
    const glm::dvec3 offset = centre - eye_;
    const double by_depth = glm::dot(offset, forward_) - radius_m;
    const double by_distance = least_cosine_ * (glm::length(offset) - radius_m);
    return std::max(by_depth, by_distance) / focal_px_;
}

namespace {

struct Candidate {
    double urgency;  // mip levels by which the parent is too coarse
    Page page;

    bool operator<(const Candidate& other) const {
        if (urgency != other.urgency) return urgency < other.urgency;
        if (page.level != other.page.level) return page.level < other.page.level;
        return page > other.page;  // any order, but always the same
    }
};

}  // namespace

WantedPages wanted_pages(const Sight& sight, const PageBounds& bounds, const geo::GridFrame& frame, int top,
                         double exaggeration, std::size_t most,
                         const std::function<bool(const Page&)>& damaged) {
    assert(most >= 1);
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    WantedPages wanted;
    std::priority_queue<Candidate> queue;
    queue.push({kInfinity, {top, 0, 0}});
    while (!queue.empty()) {
        if (wanted.pages.size() == most) {
            wanted.complete = false;
            break;
        }
        const Page page = queue.top().page;
        queue.pop();
        wanted.pages.push_back(page);
        if (page.level == 0) continue;
        for (int i = 0; i < 4; ++i) {
            const Page child{page.level - 1, 2 * page.column + i % 2, 2 * page.row + i / 2};
            if (!has_data(child, frame)) continue;
            const PageBounds::Bounds around = bounds.of(child, exaggeration);
            if (!sight.sees(around.centre, around.radius_m)) continue;
            const double pixel_m = sight.finest_pixel_m(around.centre, around.radius_m);
            const double level = pixel_m > 0 && around.spacing_m > 0
                                     ? std::log2(pixel_m / around.spacing_m) + kSharper
                                     : -kInfinity;
            if (level >= page.level) continue;
            if (damaged(child)) {
                wanted.damaged = true;
                continue;
            }
            queue.push({page.level - level, child});
        }
    }
    return wanted;
}

}  // namespace relevo::viewer
