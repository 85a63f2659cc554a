#include "viewer/ground/page_slots.hpp"

#include <cassert>

namespace relevo::viewer {

std::optional<int> PageSlots::want(const Page& page) {
    const auto found = of_page_.find(page);
    if (found == of_page_.end()) return std::nullopt;
    slots_[static_cast<std::size_t>(found->second)].last_wanted = round_;
    return found->second;
}

std::optional<int> PageSlots::place(const Page& page, bool wanted) {
    assert(!has(page));
    const auto goes_before = [](const Slot& a, const Slot& b) {
        if (!a.page || !b.page) return !a.page && b.page;
        if (a.last_wanted != b.last_wanted) return a.last_wanted < b.last_wanted;
        return a.page->level < b.page->level;
    };
    std::size_t best = 0;
    for (std::size_t i = 1; i < slots_.size(); ++i) {
        if (goes_before(slots_[i], slots_[best])) best = i;
    }
    Slot& slot = slots_[best];
    if (slot.page && slot.last_wanted == round_) return std::nullopt;
    if (slot.page) of_page_.erase(*slot.page);
    slot = {page, wanted ? round_ : round_ - 1};
    of_page_.emplace(page, static_cast<int>(best));
    return static_cast<int>(best);
}

}  // namespace relevo::viewer
