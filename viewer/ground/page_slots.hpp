#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "viewer/ground/page.hpp"

namespace relevo::viewer {

/// Which page lies in which slot of a cache of fixed size. A page that must go is the one that was wanted
/// longest ago, the finest of those; never one that is wanted now.
class PageSlots {
  public:
    explicit PageSlots(int count) : slots_(static_cast<std::size_t>(count)) {}

    int count() const { return static_cast<int>(slots_.size()); }

    /// Begins a new round: no page is wanted yet.
    void next_round() { ++round_; }

    /// The page's slot, if it has one, and wanted in this round.
    std::optional<int> want(const Page& page);

    /// Is the page there?
    bool has(const Page& page) const { return of_page_.count(page) != 0; }

    /// Gives the page a slot, and wants it in this round only if `wanted`. None where all slots are wanted.
    /// \pre it has none
    std::optional<int> place(const Page& page, bool wanted);

  private:
    struct Slot {
        std::optional<Page> page;
        std::uint64_t last_wanted = 0;
    };
    std::vector<Slot> slots_;
    std::unordered_map<Page, int, PageHash> of_page_;
    std::uint64_t round_ = 1;
};

}  // namespace relevo::viewer
