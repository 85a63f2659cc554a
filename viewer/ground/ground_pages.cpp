#include "viewer/ground/ground_pages.hpp"

namespace relevo::viewer {

Result<std::unique_ptr<GroundPages>> GroundPages::create(const GroundData& data,
                                                         const geo::PostPositions& positions,
                                                         const lod::UndulationGrid& undulations, int slots,
                                                         Fill fill) {
    std::unique_ptr<GroundPages> made(new GroundPages);
    made->sea_.resize(static_cast<std::size_t>(std::max(slots, 1)));
    const geo::GridFrame& frame = data.pyramid->frame();
    auto cache = PageCache<PageTexels>::create(
        {.frame = frame,
         .bounds = PageBounds(frame, positions, undulations, data.facts),
         .load = [pyramid = data.pyramid, facts = data.facts](const Page& page) -> Result<PageTexels> {
             const auto posts = pyramid->read_ground(page);
             if (!posts) return posts.error();
             return page_texels(page, *posts, pyramid->frame(), facts);
         },
         .fill =
             [pages = made.get(), fill = std::move(fill)](int slot, const PageTexels& texels) {
                 fill(slot, texels);
                 pages->sea_[static_cast<std::size_t>(slot)] = PageSea(texels.shore);
             },
         .report = data.report},
        slots);
    if (!cache) return cache.error();
    made->cache_ = *std::move(cache);
    return made;
}

}  // namespace relevo::viewer
