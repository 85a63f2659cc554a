#include "viewer/ground/ground_pages.hpp"

#include <algorithm>
#include <thread>
#include <utility>

namespace relevo::viewer {

namespace {

/// Reading and decoding is most of the work; one thread is left to the picture.
int loader_threads() {
    return std::clamp(static_cast<int>(std::thread::hardware_concurrency()) - 1, 1, 4);
}

}  // namespace

std::uint64_t GroundPages::count(const geo::GridFrame& frame, int top) {
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

Result<std::unique_ptr<GroundPages>> GroundPages::create(const GroundData& data,
                                                         const geo::PostPositions& positions,
                                                         const lod::UndulationGrid& undulations, int slots,
                                                         Fill fill) {
    const std::uint64_t all = count(data.pyramid->frame(), data.pyramid->top());
    const auto useful = static_cast<int>(std::min<std::uint64_t>(all, PageTable::kMostSlots));
    std::unique_ptr<GroundPages> made(
        new GroundPages(data, positions, undulations, std::clamp(slots, 1, useful), std::move(fill)));
    const Page top{data.pyramid->top(), 0, 0};
    auto texels = made->load(top);
    if (!texels) return texels.error();
    made->wanted_.pages = {top};
    made->is_wanted_ = {top};
    made->put({top, *std::move(texels)});
    made->update_table();
    return made;
}

GroundPages::GroundPages(const GroundData& data, const geo::PostPositions& positions,
                         const lod::UndulationGrid& undulations, int slots, Fill fill)
    : data_(data),
      bounds_(data_.pyramid->frame(), positions, undulations, data_.facts),
      fill_(std::move(fill)),
      slots_(slots),
      sea_(static_cast<std::size_t>(slots)),
      table_(data_.pyramid->top()),
      loader_(
          std::make_unique<PageLoader>([this](const Page& page) { return load(page); }, loader_threads())) {}

Result<PageTexels> GroundPages::load(const Page& page) const {
    const auto posts = data_.pyramid->read_ground(page);
    if (!posts) return posts.error();
    return page_texels(page, *posts, data_.pyramid->frame(), data_.facts);
}

WantedPages GroundPages::wanted(const Sight& sight, double exaggeration) const {
    return wanted_pages(sight, bounds_, data_.pyramid->frame(), data_.pyramid->top(), exaggeration,
                        static_cast<std::size_t>(slots_.count()),
                        [this](const Page& page) { return damaged_.count(page) != 0; });
}

void GroundPages::want(const Sight& sight, double exaggeration) {
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

void GroundPages::put(PageLoader::Loaded loaded) {
    const bool wanted = is_wanted_.count(loaded.key) != 0;
    if (!loaded.piece) {
        if (damaged_.insert(loaded.key).second) {
            data_.report(loaded.piece.error().message);
            if (!damage_) damage_ = loaded.piece.error();
        }
        if (wanted) {
            wanted_.damaged = true;
            --missing_;
        }
        return;
    }
    // Wanted pages never outnumber the slots, so that one that is wanted finds one.
    if (const auto slot = slots_.place(loaded.key, wanted)) {
        fill_(*slot, *loaded.piece);
        sea_[static_cast<std::size_t>(*slot)] = PageSea(loaded.piece->shore);
        if (wanted && missing_ > 0) --missing_;
    }
}

void GroundPages::take_ready(std::chrono::microseconds at_most) {
    const auto start = std::chrono::steady_clock::now();
    bool any = false;
    while (auto loaded = loader_->take()) {
        put(*std::move(loaded));
        any = true;
        if (std::chrono::steady_clock::now() - start >= at_most) break;
    }
    if (any) update_table();
}

Result<void> GroundPages::complete() {
    while (missing_ > 0) {
        auto loaded = loader_->wait();
        if (!loaded) break;
        put(*std::move(loaded));
    }
    update_table();
    if (wanted_.damaged) return *damage_;
    return {};
}

void GroundPages::update_table() {
    std::vector<PageTable::Resident> shown;
    for (const Page& page : wanted_.pages) {
        if (const auto slot = slots_.want(page)) shown.push_back({page, *slot});
    }
    if (shown == shown_) return;
    shown_ = std::move(shown);
    table_.fill(shown_);
    table_changed_ = true;
}

}  // namespace relevo::viewer
