#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <unordered_set>
#include <vector>

#include "geo/post_positions.hpp"
#include "lod/background_loader.hpp"
#include "lod/undulation_grid.hpp"
#include "viewer/ground/ground_data.hpp"
#include "viewer/ground/page_sea.hpp"
#include "viewer/ground/page_slots.hpp"
#include "viewer/ground/page_table.hpp"
#include "viewer/ground/page_texels.hpp"
#include "viewer/ground/wanted_pages.hpp"

namespace relevo::viewer {

using PageLoader = lod::BackgroundLoader<Page, PageTexels>;

/// Keeps those pages of the ground in a fixed number of slots that pictures want: has them loaded in the
/// background, and says what is where. It draws nothing: slots are filled by a function that it is given.
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
    static std::uint64_t count(const geo::GridFrame& frame, int top);

    /// What is drawn next. Asks for what is not there, instead of what was asked for before.
    void want(const Sight& sight, double exaggeration);

    /// Fills slots with what has come, for about so long.
    void take_ready(std::chrono::microseconds at_most);

    /// Waits until all that is wanted is there. Fails where some of it is damaged; its parent is drawn then.
    Result<void> complete();

    /// Pages that are wanted and not there yet.
    std::size_t pending() const { return missing_; }

    /// Is there a slot for all that a picture wants?
    bool fits(const Sight& sight, double exaggeration) const { return wanted(sight, exaggeration).complete; }

    /// What is drawn from where: of pages that are wanted and there. So a picture depends on its view and on
    /// what is still missing, but not on what was seen before.
    const PageTable& table() const { return table_; }
    const std::vector<PageTable::Resident>& shown() const { return shown_; }
    /// Of the page in a slot.
    const PageSea& sea(int slot) const { return sea_[static_cast<std::size_t>(slot)]; }
    /// Has the table changed since this was last asked?
    bool table_changed() { return std::exchange(table_changed_, false); }

  private:
    GroundPages(const GroundData& data, const geo::PostPositions& positions,
                const lod::UndulationGrid& undulations, int slots, Fill fill);

    WantedPages wanted(const Sight& sight, double exaggeration) const;
    Result<PageTexels> load(const Page& page) const;
    void put(PageLoader::Loaded loaded);
    void update_table();

    GroundData data_;
    PageBounds bounds_;
    Fill fill_;
    PageSlots slots_;
    std::vector<PageSea> sea_;  // by slot
    PageTable table_;
    bool table_changed_ = true;
    std::vector<PageTable::Resident> shown_;
    WantedPages wanted_;
    std::unordered_set<Page, PageHash> is_wanted_;
    std::unordered_set<Page, PageHash> damaged_;
    std::optional<Error> damage_;  // the first
    std::size_t missing_ = 0;
    std::unique_ptr<PageLoader> loader_;  // last: its threads use the rest
};

}  // namespace relevo::viewer
