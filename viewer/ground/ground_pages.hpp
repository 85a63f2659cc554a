#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "geo/post_positions.hpp"
#include "lod/undulation_grid.hpp"
#include "viewer/ground/ground_data.hpp"
#include "viewer/ground/page_cache.hpp"
#include "viewer/ground/page_sea.hpp"
#include "viewer/ground/page_texels.hpp"

namespace relevo::viewer {

/// The pages of the ground (page_cache.hpp), and which of their posts are sea.
class GroundPages {
  public:
    using Fill = std::function<void(int slot, const PageTexels& texels)>;

    /// Loads the top page. What is referred to must outlive the pages. Fails where the top cannot be read.
    /// \param slots  at least 1; more than PageTable::kMostSlots, or than the terrain has pages, are not used
    static Result<std::unique_ptr<GroundPages>> create(const GroundData& data,
                                                       const geo::PostPositions& positions,
                                                       const lod::UndulationGrid& undulations, int slots,
                                                       Fill fill);

    /// Pages of all levels.
    static std::uint64_t count(const geo::GridFrame& frame, int top) {
        return PageCache<PageTexels>::count(frame, top);
    }

    // As PageCache has them.
    void want(const Sight& sight, double exaggeration) { cache_->want(sight, exaggeration); }
    void take_ready(std::chrono::microseconds at_most) { cache_->take_ready(at_most); }
    Result<void> complete() { return cache_->complete(); }
    std::size_t pending() const { return cache_->pending(); }
    std::uint64_t loaded() const { return cache_->loaded(); }
    bool fits(const Sight& sight, double exaggeration) const { return cache_->fits(sight, exaggeration); }
    const PageTable& table() const { return cache_->table(); }
    const std::vector<PageTable::Resident>& shown() const { return cache_->shown(); }
    bool table_changed() { return cache_->table_changed(); }

    /// Of the page in a slot.
    const PageSea& sea(int slot) const { return sea_[static_cast<std::size_t>(slot)]; }

  private:
    GroundPages() = default;

    std::vector<PageSea> sea_;  // by slot
    std::unique_ptr<PageCache<PageTexels>> cache_;
};

}  // namespace relevo::viewer
