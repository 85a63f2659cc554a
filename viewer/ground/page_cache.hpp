#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <unordered_set>
#include <utility>
#include <vector>

#include "lod/background_loader.hpp"
#include "viewer/ground/page_slots.hpp"
#include "viewer/ground/page_table.hpp"
#include "viewer/ground/wanted_pages.hpp"

namespace relevo::viewer {

/// Keeps those pages in a fixed number of slots that pictures want: has them loaded in the background, and
/// says what is where. It draws nothing: slots are filled by a function that it is given. What a page's piece
/// is, the ground's texels or a picture's, does not matter here.
template <class Piece>
class PageCache {
  public:
    using Loader = lod::BackgroundLoader<Page, Piece>;
    struct Source {
        geo::GridFrame frame;  ///< that the pages are of
        PageBounds bounds;
        std::function<Result<Piece>(const Page&)> load;  ///< called from several threads at a time
        std::function<void(int slot, const Piece&)> fill;
        std::function<void(const std::string&)> report;  ///< of each page that cannot be had, once
    };

    /// Loads the top page. Fails where that cannot be read.
    /// \param slots  at least 1; more than PageTable::kMostSlots, or than there are pages, are not used
    static Result<std::unique_ptr<PageCache>> create(Source source, int slots) {
        const int top_level = top_of(source.frame);
        const std::uint64_t all = count(source.frame, top_level);
        const auto useful = static_cast<int>(std::min<std::uint64_t>(all, PageTable::kMostSlots));
        std::unique_ptr<PageCache> made(
            new PageCache(std::move(source), std::clamp(slots, 1, useful), top_level));
        const Page top{top_level, 0, 0};
        auto piece = made->source_.load(top);
        if (!piece) return piece.error();
        made->wanted_.pages = {top};
        made->is_wanted_ = {top};
        made->put({top, *std::move(piece)});
        made->update_table();
        return made;
    }

    /// The level of one page.
    static int top_of(const geo::GridFrame& frame) { return std::max(frame.levels() - kPageShift, 0); }

    /// Pages of all levels.
    static std::uint64_t count(const geo::GridFrame& frame, int top) {
        std::uint64_t all = 0;
        for (int level = 0; level <= top; ++level) {
            const auto along = [&](int posts) {
                const auto cells = static_cast<std::uint64_t>(std::max(posts - 1, 1));
                return ((cells - 1) >> (kPageShift + level)) + 1;
            };
            all += along(frame.columns) * along(frame.rows);
        }
        return all;
    }

    /// What is drawn next. Asks for what is not there, instead of what was asked for before.
    void want(const Sight& sight, double exaggeration) {
        wanted_ = wanted(sight, exaggeration);
        is_wanted_.clear();
        is_wanted_.insert(wanted_.pages.begin(), wanted_.pages.end());
        slots_.next_round();
        std::vector<Page> missing;
        for (const Page& page : wanted_.pages) {
            if (!slots_.want(page)) missing.push_back(page);
        }
        missing_ = missing.size();
        loader_->request(std::move(missing));
        update_table();
    }

    /// Fills slots with what has come, for about so long.
    void take_ready(std::chrono::microseconds at_most) {
        const auto start = std::chrono::steady_clock::now();
        bool any = false;
        while (auto loaded = loader_->take()) {
            put(*std::move(loaded));
            any = true;
            if (std::chrono::steady_clock::now() - start >= at_most) break;
        }
        if (any) update_table();
    }

    /// Waits until all that is wanted is there. Fails where some of it is damaged; its parent is drawn then.
    Result<void> complete() {
        while (missing_ > 0) {
            auto loaded = loader_->wait();
            if (!loaded) break;
            put(*std::move(loaded));
        }
        update_table();
        if (wanted_.damaged) return *damage_;
        return {};
    }

    /// Pages that are wanted and not there yet.
    std::size_t pending() const { return missing_; }
    /// Pages that have been loaded so far.
    std::uint64_t loaded() const { return loaded_; }

    /// Is there a slot for all that a picture wants?
    bool fits(const Sight& sight, double exaggeration) const { return wanted(sight, exaggeration).complete; }

    /// What is drawn from where: of pages that are wanted and there. So a picture depends on its view and on
    /// what is still missing, but not on what was seen before.
    const PageTable& table() const { return table_; }
    const std::vector<PageTable::Resident>& shown() const { return shown_; }
    /// Has the table changed since this was last asked?
    bool table_changed() { return std::exchange(table_changed_, false); }

  private:
    PageCache(Source source, int slots, int top)
        : source_(std::move(source)),
          slots_(slots),
          table_(top),
          loader_(
              std::make_unique<Loader>([this](const Page& page) { return source_.load(page); }, threads())) {}

    /// Reading and decoding is most of the work; one thread is left to the picture.
    static int threads() {
        return std::clamp(static_cast<int>(std::thread::hardware_concurrency()) - 1, 1, 4);
    }

    WantedPages wanted(const Sight& sight, double exaggeration) const {
        return wanted_pages(sight, source_.bounds, source_.frame, table_.top(), exaggeration,
                            static_cast<std::size_t>(slots_.count()),
                            [this](const Page& page) { return damaged_.count(page) != 0; });
    }

    void put(typename Loader::Loaded loaded) {
        const bool wanted = is_wanted_.count(loaded.key) != 0;
        if (!loaded.piece) {
            if (damaged_.insert(loaded.key).second) {
                source_.report(loaded.piece.error().message);
                if (!damage_) damage_ = loaded.piece.error();
            }
            if (wanted) {
                wanted_.damaged = true;
                --missing_;
            }
            return;
        }
        ++loaded_;
        // Wanted pages never outnumber the slots, so that one that is wanted finds one.
        if (const auto slot = slots_.place(loaded.key, wanted)) {
            source_.fill(*slot, *loaded.piece);
            if (wanted && missing_ > 0) --missing_;
        }
    }

    void update_table() {
        std::vector<PageTable::Resident> shown;
        for (const Page& page : wanted_.pages) {
            if (const auto slot = slots_.want(page)) shown.push_back({page, *slot});
        }
        if (shown == shown_) return;
        shown_ = std::move(shown);
        table_.fill(shown_);
        table_changed_ = true;
    }

    Source source_;
    PageSlots slots_;
    PageTable table_;
    bool table_changed_ = true;
    std::vector<PageTable::Resident> shown_;
    WantedPages wanted_;
    std::unordered_set<Page, PageHash> is_wanted_;
    std::unordered_set<Page, PageHash> damaged_;
    std::optional<Error> damage_;  // the first
    std::size_t missing_ = 0;
    std::uint64_t loaded_ = 0;
    std::unique_ptr<Loader> loader_;  // last: its threads use the rest
};

}  // namespace relevo::viewer
