#include "viewer/overlay/overlay_list.hpp"

#include <algorithm>

namespace relevo::viewer {

namespace {

bool same_file(const Overlay& a, const Overlay& b) {
    return a.kind == b.kind && a.file == b.file;
}

/// Lower ones are put lower.
int rank(const Overlay& overlay) {
    switch (overlay.kind) {
        case Overlay::Kind::imagery:
            return 0;
        case Overlay::Kind::vectors:
            return 1;
        case Overlay::Kind::contours:
        case Overlay::Kind::graticule:
            break;
    }
    return 2;
}

}  // namespace

bool is_of_file(const Overlay& overlay) {
    return overlay.kind == Overlay::Kind::imagery || overlay.kind == Overlay::Kind::vectors;
}

std::size_t index_of_file(const Overlays& overlays, int file) {
    const auto found = std::find_if(overlays.begin(), overlays.end(), [&](const Overlay& overlay) {
        return is_of_file(overlay) && overlay.file == file;
    });
    return static_cast<std::size_t>(found - overlays.begin());
}

void put_in_place(Overlays& overlays, const Overlay& overlay) {
    if (overlays.size() >= kMostOverlays ||
        std::any_of(overlays.begin(), overlays.end(),
                    [&](const Overlay& other) { return same_file(other, overlay); }))
        return;
    // Under the first that is to be above it: an order that its user chose stays.
    overlays.insert(std::find_if(overlays.begin(), overlays.end(),
                                 [&](const Overlay& other) { return rank(other) > rank(overlay); }),
                    overlay);
}

std::size_t move_overlay(Overlays& overlays, std::size_t index, int up) {
    if (index >= overlays.size()) return index;
    const auto last = static_cast<int>(overlays.size()) - 1;
    const auto to = static_cast<std::size_t>(std::clamp(static_cast<int>(index) + up, 0, last));
    const Overlay moved = overlays[index];
    overlays.erase(overlays.begin() + static_cast<std::ptrdiff_t>(index));
    overlays.insert(overlays.begin() + static_cast<std::ptrdiff_t>(to), moved);
    return to;
}

std::size_t raise_overlay(Overlays& overlays, std::size_t index) {
    const auto count = static_cast<int>(overlays.size());
    return move_overlay(overlays, index, index + 1 == overlays.size() ? -count : 1);
}

void forget_file(Overlays& overlays, int file) {
    std::erase_if(overlays,
                  [&](const Overlay& overlay) { return is_of_file(overlay) && overlay.file == file; });
    for (Overlay& overlay : overlays) {
        if (is_of_file(overlay) && overlay.file > file) --overlay.file;
    }
}

}  // namespace relevo::viewer
