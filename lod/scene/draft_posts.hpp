#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "geo/frame.hpp"
#include "geo/result.hpp"
#include "lod/scene/block_grid.hpp"
#include "lod/scene/block_store.hpp"
#include "lod/scene/post_block.hpp"

namespace relevo::lod {

/// Heights (void = NaN) and marks of some posts.
struct Posts {
    Raster<float> heights;
    Raster<PostMark> marks;
};

/// The posts of a scene that is being made, block by block, from any thread. What was read lately is kept, up
/// to a bound: the blocks around one that is worked on are wanted again with its neighbours.
class DraftPosts {
  public:
    DraftPosts(BlockStore heights, BlockStore marks, const geo::GridFrame& frame, const HeightCoding& coding,
               std::uint64_t cache_bytes);

    const BlockGrid& grid() const { return grid_; }

    bool has(int block_column, int block_row) const;
    Result<void> write(int block_column, int block_row, Posts posts);
    /// The same where the heights are those of another draft: their file is shared and not made again.
    Result<void> write_marks(int block_column, int block_row, Posts posts, const DraftPosts& heights_from);
    /// Are heights stored in the same way, so that drafts can share their files?
    bool codes_as(const DraftPosts& other) const {
        return coding_.type == other.coding_.type && coding_.max_error_m == other.coding_.max_error_m;
    }

    /// \pre has(block_column, block_row)
    Result<std::shared_ptr<const Posts>> read(int block_column, int block_row) const;

    /// The posts in a box, as far as the data goes. \pre all blocks that it meets are there
    Result<Posts> read(const BlockGrid::Box& box) const;

    BlockStore& heights() { return heights_; }
    BlockStore& marks() { return marks_; }

  private:
    using Place = std::pair<int, int>;  // row, column
    struct Cached {
        std::shared_ptr<const Posts> posts;
        std::list<Place>::iterator age;
    };
    struct Cache {
        std::mutex mutex;
        std::map<Place, Cached> blocks;
        std::list<Place> ages;  // the last used first
    };

    std::shared_ptr<const Posts> cached(Place place) const;
    void keep(Place place, std::shared_ptr<const Posts> posts) const;
    Result<Posts> load(int block_column, int block_row) const;
    Result<void> finish(Place place, Posts posts);

    BlockStore heights_;
    BlockStore marks_;
    geo::GridFrame frame_;
    HeightCoding coding_;
    BlockGrid grid_;
    std::size_t most_cached_;
    std::unique_ptr<Cache> cache_;
};

}  // namespace relevo::lod
