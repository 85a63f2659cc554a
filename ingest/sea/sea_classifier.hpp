#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "geo/frame.hpp"
#include "geo/result.hpp"
#include "ingest/affine.hpp"
#include "ingest/sea/sea_areas.hpp"
#include "ingest/sea/sea_mask.hpp"
#include "ingest/sea/sea_rule.hpp"
#include "lod/scene/post_mark.hpp"
#include "lod/scene/raster.hpp"
#include "lod/scene/scene_info.hpp"
#include "lod/scene/sea_info.hpp"

namespace relevo::ingest {

/// What is asked of the classes land and sea.
struct SeaRequest {
    lod::SeaInfo::Request kind = lod::SeaInfo::Request::unasked;
    std::string mask_file;  ///< of a mask: polygons or a raster
    Trust trust;            ///< of the mask's file
    /// Heights are above a datum near the level of the sea. Above the ellipsoid they are not: the sea is then
    /// at tens of metres, and only a mask finds it.
    bool zero_is_sea_level = true;
};
/// From the command line's word: "auto", "none", "depths", or else a file's name.
SeaRequest sea_request_from(const std::string& word);

/// Finds the sea of a scene in two passes over its blocks, with bounded memory: between the passes it holds
/// the areas that reach the sides of blocks, and the sides of blocks whose neighbour is yet to come.
/// The same posts become sea however the scene is cut into blocks.
class SeaClassifier {
  public:
    /// \param block_side  posts a side of a block, in the manner of lod::BlockGrid::of_heights
    static Result<SeaClassifier> create(const geo::GridFrame& frame, const SeaRequest& request,
                                        int block_side = lod::SceneInfo::kBlockSide);

    /// Without it nothing has to be added: the mask decides, or no sea is looked for.
    bool needs_blocks() const;

    /// The first pass: each block once, in any order, from any thread (in rows least is held).
    /// Voids are where the marks say so; sea is looked for in void posts and in heights <= 0.
    void add_block(int block_column, int block_row, const lod::Raster<float>& heights,
                   const lod::Raster<lod::PostMark>& marks);

    /// After the first pass: which rule decided.
    const lod::SeaInfo& decide();

    /// The second pass, after decide(); from any thread. Sets the class of posts that are sea. Their heights
    /// stay as they are; a void post that is sea is marked as modelled and has no height yet: give the block
    /// to model_sea_bed (sea_bed.hpp).
    /// \param marks  as they were in the first pass
    /// \return the number of void posts that became sea; or an error of reading the mask
    Result<std::uint64_t> mark_block(int block_column, int block_row, const lod::Raster<float>& heights,
                                     lod::Raster<lod::PostMark>& marks) const;

  private:
    static constexpr std::uint32_t kNoArea = 0xffffffff;

    struct SidePost {
        std::uint32_t area = kNoArea;
        SeaBand band = SeaBand::high;
    };
    using Side = std::vector<SidePost>;

    SeaClassifier(const geo::GridFrame& frame, const SeaRequest& request, int block_side);

    struct Block {
        int column;
        int row;
    };
    std::size_t index(Block block) const {
        return static_cast<std::size_t>(block.row) * static_cast<std::size_t>(across_) +
               static_cast<std::size_t>(block.column);
    }
    Window window(Block block) const;
    DataBorder border(Block block) const;
    void keep_sides(Block block, const BlockAreas& found, const lod::Raster<float>& heights,
                    const lod::Raster<lod::PostMark>& marks);
    void meet(std::size_t boundary, Side side);
    void join(const Side& one, const Side& other);
    void join(const SidePost& a, const SidePost& b);
    std::uint32_t root(std::uint32_t area) const;
    std::vector<bool> decide_in_block(Block block, const BlockAreas& found) const;

    geo::GridFrame frame_;
    SeaRequest request_;
    int block_side_;
    int across_;
    int down_;
    std::unique_ptr<SeaMask> mask_;
    std::unique_ptr<std::mutex> adding_ = std::make_unique<std::mutex>();

    std::vector<SeaArea> areas_;  // what is shared; whole where parent_ is the area itself
    mutable std::vector<std::uint32_t> parent_;
    std::vector<SeaContact> contacts_;
    std::vector<std::vector<std::uint32_t>> shared_;  // by block: its shared areas, in their order
    std::vector<Side> sides_;  // by boundary between blocks: the side that came first, then nothing
    bool decided_ = false;
    SeaRule rule_;
};

}  // namespace relevo::ingest
