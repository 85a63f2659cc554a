#include "lod/scene/scene.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "lod/scene/block_file.hpp"
#include "lod/scene/block_grid.hpp"
#include "lod/scene/folder.hpp"
#include "lod/scene/geoid_block.hpp"
#include "lod/scene/parallel_blocks.hpp"
#include "lod/scene/post_block.hpp"
#include "lod/scene/scene_files.hpp"
#include "lod/scene/sha256.hpp"

namespace relevo::lod {
namespace {

constexpr float kVoid = std::numeric_limits<float>::quiet_NaN();

/// The entry of a block in a list ordered by row and column; nothing where the block is not stored.
const BlockInfo* find_block(const std::vector<BlockInfo>& blocks, int column, int row) {
    const auto before = [](const BlockInfo& block, std::pair<int, int> place) {
        return std::pair(block.row, block.column) < place;
    };
    const auto found = std::lower_bound(blocks.begin(), blocks.end(), std::pair(row, column), before);
    return found != blocks.end() && found->row == row && found->column == column ? &*found : nullptr;
}

Error damaged(const std::filesystem::path& path, const std::string& what) {
    return {ErrorKind::damaged, fmt::format("{} is damaged: {}", path.string(), what)};
}

/// The folder, marked as being read. A writer that replaces the scene between the two steps makes us begin
/// again.
Result<Folder> open_for_reading(const std::filesystem::path& path) {
    for (;;) {
        Result<Folder> folder = Folder::open(path);
        if (!folder) return folder;
        folder->mark_in_use();
        if (folder->has_its_name()) return folder;
    }
}

}  // namespace

Result<Scene> Scene::open(const std::filesystem::path& path) {
    Result<Folder> folder = open_for_reading(path);
    if (!folder) return folder.error();
    std::error_code ignored;
    if (!std::filesystem::exists(path / kSceneFile, ignored)) {
        return Error{
            ErrorKind::input,
            fmt::format("{} is not a scene: it has no {}; `relevo ingest` makes scenes from elevation files",
                        path.string(), kSceneFile)};
    }
    Scene scene;
    scene.path_ = path;
    scene.folder_ = std::make_shared<const Folder>(std::move(*folder));

    const Result<std::vector<std::byte>> bytes = scene.folder_->read(kSceneFile);
    if (!bytes) return bytes.error();
    Result<SceneInfo> info =
        scene_info_from_text({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
    if (!info) {
        const std::string what = fmt::format("{}: {}", (path / kSceneFile).string(), info.error().message);
        return Error{info.error().kind, what};
    }
    scene.info_ = std::move(*info);
    const GeoidInfo& stored = scene.info_.geoid;
    if (stored.file.file.empty()) return scene;

    const auto nodes = scene.read_block(stored.file);
    if (!nodes) return nodes.error();
    auto geoid = decode_geoid(*nodes, stored, (path / kGeoidFile).string());
    if (!geoid) return geoid.error();
    scene.geoid_ = std::make_shared<const geo::Geoid>(*std::move(geoid));
    return scene;
}

Result<std::vector<std::byte>> Scene::read_block(const BlockInfo& block) const {
    Result<std::vector<std::byte>> bytes = folder_->read(block.file, block.bytes);
    if (bytes && sha256_hex(*bytes) != block.sha256) {
        return damaged(path_, fmt::format("{}: its checksum is wrong", block.file));
    }
    return bytes;
}

Result<std::vector<std::byte>> Scene::read_block(const std::vector<BlockInfo>& layer, int column,
                                                 int row) const {
    const BlockInfo* block = find_block(layer, column, row);
    if (block == nullptr) return std::vector<std::byte>{};
    return read_block(*block);
}

Result<Raster<float>> Scene::read_heights(int block_column, int block_row) const {
    const BlockGrid grid = BlockGrid::of_heights(info_.frame.columns, info_.frame.rows);
    const auto bytes = read_block(info_.heights, block_column, block_row);
    if (!bytes) return bytes.error();
    return decode_heights(*bytes, info_.height_type, grid.box(block_column, block_row),
                          name_of(kHeightsFolder, block_column, block_row));
}

Result<Raster<float>> Scene::read_all_heights() const {
    const BlockGrid grid = BlockGrid::of_heights(info_.frame.columns, info_.frame.rows);
    Raster<float> heights(info_.frame.columns, info_.frame.rows, kVoid);
    const Result<void> done =
        for_each_block(static_cast<int>(info_.heights.size()), [&](int i) -> Result<void> {
            const BlockInfo& block = info_.heights[static_cast<std::size_t>(i)];
            const Result<Raster<float>> part = read_heights(block.column, block.row);
            if (!part) return part.error();
            paste(*part, grid.box(block.column, block.row), heights);
            return {};
        });
    if (!done) return done.error();
    return heights;
}

Result<Raster<PostMark>> Scene::read_marks(int block_column, int block_row,
                                           const Raster<float>& heights) const {
    const auto bytes = read_block(info_.marks, block_column, block_row);
    if (!bytes) return bytes.error();
    return decode_marks(*bytes, heights, name_of(kMarksFolder, block_column, block_row));
}

bool Scene::has_level_block(int level, int block_column, int block_row) const {
    return find_block(info_.level(level).vertices, block_column, block_row) != nullptr;
}

Result<Raster<float>> Scene::read_level_heights(int level, int block_column, int block_row) const {
    assert(has_level_block(level, block_column, block_row));
    const auto bytes = read_block(info_.level(level).heights, block_column, block_row);
    if (!bytes) return bytes.error();
    return decode_level_heights(*bytes, info_.height_type,
                                name_of(level_folder(kHeightsFolder, level), block_column, block_row));
}

Result<VertexCodes> Scene::read_codes(int level, int block_column, int block_row, ErrorMetric metric) const {
    assert(has_level_block(level, block_column, block_row));
    const auto bytes = read_block(info_.level(level).vertices, block_column, block_row);
    if (!bytes) return bytes.error();
    return decode_codes(*bytes, metric,
                        name_of(level_folder(kVerticesFolder, level), block_column, block_row));
}

Result<Ground> Scene::read_level_ground(int level, int block_column, int block_row) const {
    assert(has_level_block(level, block_column, block_row));
    const auto bytes = read_block(info_.level(level).vertices, block_column, block_row);
    if (!bytes) return bytes.error();
    return decode_ground(*bytes, name_of(level_folder(kVerticesFolder, level), block_column, block_row));
}

std::string Scene::name_of(const std::string& layer, int block_column, int block_row) const {
    return (path_ / block_file_name(layer, block_column, block_row)).string();
}

std::vector<std::string> Scene::verify() const {
    std::vector<const BlockInfo*> blocks;
    const auto add = [&](const std::vector<BlockInfo>& layer) {
        for (const BlockInfo& block : layer) blocks.push_back(&block);
    };
    add(info_.heights);
    add(info_.marks);
    for (const LevelInfo& level : info_.levels) {
        add(level.heights);
        add(level.vertices);
    }
    if (!info_.geoid.file.file.empty()) blocks.push_back(&info_.geoid.file);

    std::vector<std::string> messages(blocks.size() + 1);
    // Failures are kept one by one here: every damaged block is to be named, not the first alone.
    const Result<void> ignored = for_each_block(static_cast<int>(blocks.size()), [&](int i) -> Result<void> {
        const auto index = static_cast<std::size_t>(i);
        const Result<std::vector<std::byte>> bytes = read_block(*blocks[index]);
        if (!bytes) messages[index] = bytes.error().message;
        return {};
    });
    (void)ignored;

    const Result<std::vector<std::byte>> mosaic = folder_->read(kMosaicFile);
    if (!mosaic) {
        messages.back() = mosaic.error().message;
    } else if (!joins_all_blocks({reinterpret_cast<const char*>(mosaic->data()), mosaic->size()}, info_)) {
        messages.back() = damaged(path_, fmt::format("{}: it does not join all blocks", kMosaicFile)).message;
    }
    std::erase(messages, "");
    return messages;
}

}  // namespace relevo::lod
