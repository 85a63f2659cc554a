#include "viewer/ground/page_sea.hpp"

namespace relevo::viewer {

PageSea::PageSea(const std::vector<PageTexels::Shore>& shore) : all_{false, true} {
    if (shore.empty()) return;
    rows_.resize(kPagePosts);
    const PageTexels::Shore* post = shore.data();
    for (auto& row : rows_) {
        for (unsigned column = 0; column < kPagePosts; ++column, ++post)
            row[column / 64] |= std::uint64_t{(*post)[0] != 0} << (column % 64);
    }
    all_ = in(0, 0, kPagePosts - 1, kPagePosts - 1);
}

PageSea::Content PageSea::in(int west, int north, int east, int south) const {
    if (rows_.empty()) return {false, true};
    constexpr std::uint64_t kAll = ~std::uint64_t{0};
    Content found;
    for (int word = west / 64; word <= east / 64; ++word) {
        std::uint64_t asked = kAll;
        if (word == west / 64) asked &= kAll << (west % 64);
        if (word == east / 64) asked &= kAll >> (63 - east % 64);
        for (int row = north; row <= south; ++row) {
            const std::uint64_t posts = rows_[static_cast<std::size_t>(row)][static_cast<std::size_t>(word)];
            found = {found.sea || (posts & asked) != 0, found.land || (~posts & asked) != 0};
            if (found.sea && found.land) return found;
        }
    }
    return found;
}

}  // namespace relevo::viewer
