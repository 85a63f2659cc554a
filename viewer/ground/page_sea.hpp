#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "viewer/ground/page_texels.hpp"

namespace relevo::viewer {

/// Which of a page's posts are sea.
class PageSea {
  public:
    struct Content {
        bool sea = false;
        bool land = false;
    };

    /// \param shore  of the page's texels; empty: no sea
    explicit PageSea(const std::vector<PageTexels::Shore>& shore = {});

    /// Of the posts between these, themselves included.
    Content in(int west, int north, int east, int south) const;

    const Content& all() const { return all_; }

  private:
    static constexpr int kWords = kPagePosts / 64 + 1;
    std::vector<std::array<std::uint64_t, kWords>> rows_;  // a bit a post; empty: no sea
    Content all_;
};

}  // namespace relevo::viewer
