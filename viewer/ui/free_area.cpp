#include "viewer/ui/free_area.hpp"

#include <algorithm>

namespace relevo::viewer {

namespace {

bool touch(const Box& a, const Box& b) {
    return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

}  // namespace

bool Covered::touches(const Box& box) const {
    return std::any_of(boxes_.begin(), boxes_.end(), [&](const Box& other) { return touch(box, other); });
}

float Covered::height_free(const Box& box) const {
    float top = box.top;
    for (const Box& other : boxes_) {
        if (touch(box, other)) top = std::max(top, other.bottom);
    }
    return std::max(box.bottom - top, 0.0f);
}

}  // namespace relevo::viewer
