#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "viewer/ground/page.hpp"

namespace relevo::viewer {

/// For each page of each level: what is drawn there. Its own texels, or those of its nearest ancestor that is
/// there.
class PageTable {
  public:
    /// Of the finest of all levels that are there: its slot, that of its parent (the top's own), its level.
    struct Entry {
        int slot;
        int parent_slot;
        int level;
    };
    static constexpr int kSlotBits = 12;
    static constexpr int kMostSlots = 1 << kSlotBits;

    /// The grid of level 0 has 2^top pages a side.
    explicit PageTable(int top);

    struct Resident {
        Page page;
        int slot;

        friend bool operator==(const Resident&, const Resident&) = default;
    };
    /// \param residents  parents before their children; what has no parent among them is left out, for it
    /// would be drawn without anything to blend to. Empty: the table stays as it is
    void fill(const std::vector<Resident>& residents);

    Entry at(const Page& page) const;

    int top() const { return top_; }

    /// As the shader reads them: the slot in the lowest kSlotBits, then the parent's, then the level. The
    /// top's first, then level by level, each row by row.
    const std::vector<std::uint32_t>& entries() const { return entries_; }

  private:
    std::size_t first(int level) const;  // entry of the level

    int top_;
    std::vector<std::uint32_t> entries_;
};

}  // namespace relevo::viewer
