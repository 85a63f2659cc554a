#include "viewer/ground/page_table.hpp"

#include <cassert>

namespace relevo::viewer {

namespace {

constexpr std::uint32_t kSlotMask = PageTable::kMostSlots - 1;

std::uint32_t packed(const PageTable::Entry& entry) {
    return static_cast<std::uint32_t>(entry.slot) |
           static_cast<std::uint32_t>(entry.parent_slot) << PageTable::kSlotBits |
           static_cast<std::uint32_t>(entry.level) << (2 * PageTable::kSlotBits);
}

PageTable::Entry unpacked(std::uint32_t code) {
    return {static_cast<int>(code & kSlotMask), static_cast<int>(code >> PageTable::kSlotBits & kSlotMask),
            static_cast<int>(code >> (2 * PageTable::kSlotBits))};
}

}  // namespace

PageTable::PageTable(int top) : top_(top), entries_(first(-1)) {}

std::size_t PageTable::first(int level) const {
    // 1 + 4 + 16 + ... of the levels above.
    return ((std::size_t{1} << (2 * (top_ - level))) - 1) / 3;
}

PageTable::Entry PageTable::at(const Page& page) const {
    const std::size_t row = static_cast<std::size_t>(page.row) << (top_ - page.level);
    return unpacked(entries_[first(page.level) + row + static_cast<std::size_t>(page.column)]);
}

void PageTable::fill(const std::vector<Resident>& residents) {
    if (residents.empty()) return;
    assert(residents.front().page.level == top_);
    std::vector<std::vector<Resident>> by_level(static_cast<std::size_t>(top_) + 1);
    for (const Resident& resident : residents)
        by_level[static_cast<std::size_t>(resident.page.level)].push_back(resident);

    const int top_slot = residents.front().slot;
    entries_.front() = packed({top_slot, top_slot, top_});
    for (int level = top_ - 1; level >= 0; --level) {
        const std::size_t side = std::size_t{1} << (top_ - level);
        std::uint32_t* here = entries_.data() + first(level);
        const std::uint32_t* coarser = entries_.data() + first(level + 1);
        for (std::size_t row = 0; row < side; ++row) {
            const std::uint32_t* from = coarser + row / 2 * (side / 2);
            std::uint32_t* to = here + row * side;
            for (std::size_t column = 0; column < side; ++column) to[column] = from[column / 2];
        }
        for (const auto& [page, slot] : by_level[static_cast<std::size_t>(level)]) {
            std::uint32_t& entry =
                here[static_cast<std::size_t>(page.row) * side + static_cast<std::size_t>(page.column)];
            const Entry parent = unpacked(entry);
            if (parent.level == level + 1) entry = packed({slot, parent.slot, level});
        }
    }
}

}  // namespace relevo::viewer
