#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "ingest/affine.hpp"
#include "lod/scene/draft_posts.hpp"
#include "lod/scene/scene_info.hpp"

namespace relevo::ingest {

/// What is counted and measured in a scene's posts. Surveys of blocks are joined in the order of blocks, so
/// that sums do not depend on threads.
class Survey {
  public:
    /// Around a block, posts.
    static constexpr int kHalo = 1;

    Survey() = default;

    /// \param posts   of the block and what is around it, as far as the data goes
    /// \param inside  the block in them. Pairs and cells across its right and bottom side are its own
    Survey(const lod::Posts& posts, Window inside);

    void join(const Survey& next);

    /// Fills in the range of heights; the numbers of valid, void, sea, filled and modelled posts; the largest
    /// steps across seams; and the largest difference between the bilinear surface and the two triangles of a
    /// cell: |z00 + z11 - z01 - z10| / 4, in the cell's middle, over cells without voids.
    void put_into(lod::SceneInfo& info) const;

    std::uint64_t valid_posts() const { return valid_; }

  private:
    struct Seam {
        std::uint64_t pairs = 0;
        double max_m = 0;
        double sum2_m2 = 0;
    };

    void count(float height, lod::PostMark mark);
    void compare(float one, lod::PostMark of_one, float other, lod::PostMark of_other);

    std::uint64_t valid_ = 0;
    std::uint64_t void_ = 0;
    std::uint64_t sea_ = 0;
    std::uint64_t filled_ = 0;
    std::uint64_t modelled_ = 0;
    float lowest_ = std::numeric_limits<float>::infinity();
    float highest_ = -std::numeric_limits<float>::infinity();
    double twist_ = 0;  // largest |z00 + z11 - z01 - z10|
    std::map<std::pair<int, int>, Seam> seams_;
};

/// Can all heights be stored as int16? \pre they are whole numbers
bool fits_int16(const lod::Raster<float>& heights);

}  // namespace relevo::ingest
