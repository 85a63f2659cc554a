#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "geo/geoid.hpp"
#include "geo/result.hpp"
#include "lod/scene/level_block.hpp"
#include "lod/scene/post_mark.hpp"
#include "lod/scene/raster.hpp"
#include "lod/scene/scene_info.hpp"
#include "lod/undulation_grid.hpp"

namespace relevo::lod {

class Folder;

/// A scene on disk, open for reading. Every block is checked against its checksum when it is read. What was
/// opened stays readable when another scene takes its place.
///
/// This class and SceneWriter are the only places that know how a scene lies on disk (docs/scene-format.md).
class Scene {
  public:
    /// Fails with ErrorKind::input where there is no scene at the path, ErrorKind::damaged where it cannot be
    /// trusted.
    static Result<Scene> open(const std::filesystem::path& path);

    const SceneInfo& info() const { return info_; }
    const std::filesystem::path& path() const { return path_; }
    /// The geoid of the scene's heights, over the scene and its padding; null where they are above the
    /// ellipsoid.
    const geo::Geoid* geoid() const { return geoid_.get(); }

    /// N at the posts, made anew at each call: for many posts.
    UndulationGrid undulations() const { return {geoid_, info_.frame}; }

    /// Heights H of one block, metres, row by row, void = NaN. Blocks at the right and bottom edge are
    /// smaller. \pre the block is one of the scene's
    Result<Raster<float>> read_heights(int block_column, int block_row) const;

    /// All heights of the data, void = NaN.
    Result<Raster<float>> read_all_heights() const;

    /// Marks of one block; those of voids say void. \param heights  as read_heights gave them
    Result<Raster<PostMark>> read_marks(int block_column, int block_row, const Raster<float>& heights) const;

    /// Is a block of a level of the pyramid stored (from level 1 on)? Else nothing of it is ever drawn: in
    /// the diamonds of the vertices that are new in it there is no valid post.
    bool has_level_block(int level, int block_column, int block_row) const;

    /// Heights H of such a block, voids and padding filled for meshes. \pre it is stored; as for both below
    Result<Raster<float>> read_level_heights(int level, int block_column, int block_row) const;

    /// Codes of the vertices that are new at the level, at odd columns or rows of its grid; at the coarsest
    /// level of all. Others are 0.
    Result<VertexCodes> read_codes(int level, int block_column, int block_row, ErrorMetric metric) const;

    /// Classes and mean normals of the block's posts; padding is void.
    Result<Ground> read_level_ground(int level, int block_column, int block_row) const;

    /// Reads every file and compares it with its checksum; the messages name each damaged block. Empty: all
    /// is well.
    std::vector<std::string> verify() const;

  private:
    Scene() = default;

    Result<std::vector<std::byte>> read_block(const BlockInfo& block) const;
    /// Empty where the layer does not store the block.
    Result<std::vector<std::byte>> read_block(const std::vector<BlockInfo>& layer, int column, int row) const;
    std::string name_of(const std::string& layer, int block_column, int block_row) const;

    std::filesystem::path path_;
    std::shared_ptr<const Folder> folder_;
    SceneInfo info_;
    std::shared_ptr<const geo::Geoid> geoid_;
};

}  // namespace relevo::lod
