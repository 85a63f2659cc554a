#include "lod/scene/block_store.hpp"

#include <sstream>

#include <fmt/format.h>

#include "lod/scene/scene_files.hpp"
#include "lod/scene/sha256.hpp"

namespace relevo::lod {
namespace {

/// A line of the journal: "row column bytes sha256\n"; a block that holds nothing has 0 bytes and "-".
std::string line_of(const BlockInfo& block) {
    return fmt::format("{} {} {} {}\n", block.row, block.column, block.bytes,
                       block.bytes == 0 ? "-" : block.sha256);
}

std::vector<BlockInfo> blocks_in(const std::string& journal, const char* layer) {
    std::vector<BlockInfo> blocks;
    std::size_t start = 0;
    // A last line without an end was being written when the writer was killed.
    for (std::size_t end = 0; (end = journal.find('\n', start)) != std::string::npos; start = end + 1) {
        std::istringstream line(journal.substr(start, end - start));
        BlockInfo block;
        if (!(line >> block.row >> block.column >> block.bytes >> block.sha256)) continue;
        block.file = block_file_name(layer, block.column, block.row);
        blocks.push_back(std::move(block));
    }
    return blocks;
}

}  // namespace

BlockStore::BlockStore(const Folder& scene, std::string layer)
    : scene_(&scene), layer_(std::move(layer)), mutex_(std::make_unique<std::mutex>()) {}

std::string BlockStore::journal() const {
    return layer_ + ".journal";
}

Result<BlockStore> BlockStore::open(const Folder& scene, const std::string& layer) {
    BlockStore store(scene, layer);
    if (const auto made = scene.make_folder(layer); !made) return made.error();
    const auto bytes = scene.read(store.journal());
    if (!bytes) return store;  // a new layer
    const std::string text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    for (BlockInfo& block : blocks_in(text, layer.c_str())) {
        if (store.is_whole(block)) store.blocks_[{block.row, block.column}] = std::move(block);
    }
    // Written anew, so that a line which was cut short does not join the next one.
    std::string whole;
    for (const auto& [place, block] : store.blocks_) whole += line_of(block);
    if (const auto done = scene.write(store.journal(), std::as_bytes(std::span(whole))); !done)
        return done.error();
    return store;
}

bool BlockStore::is_whole(const BlockInfo& block) const {
    if (block.bytes == 0) return true;
    const auto bytes = scene_->read(block.file, block.bytes);
    return bytes && bytes->size() == block.bytes && sha256_hex(*bytes) == block.sha256;
}

bool BlockStore::has(int column, int row) const {
    const std::lock_guard lock(*mutex_);
    return blocks_.contains({row, column});
}

Result<void> BlockStore::record(BlockInfo block) {
    const std::string line = line_of(block);
    const std::lock_guard lock(*mutex_);
    if (auto done = scene_->append(journal(), std::as_bytes(std::span(line))); !done) return done;
    blocks_[{block.row, block.column}] = std::move(block);
    return {};
}

Result<void> BlockStore::write(int column, int row, std::span<const std::byte> bytes) {
    BlockInfo block;
    block.column = column;
    block.row = row;
    block.file = block_file_name(layer_.c_str(), column, row);
    block.bytes = bytes.size();
    if (!bytes.empty()) {
        block.sha256 = sha256_hex(bytes);
        if (auto done = scene_->write(block.file, bytes); !done) return done;
    }
    return record(std::move(block));
}

Result<void> BlockStore::take(int column, int row, const BlockStore& from) {
    BlockInfo block;
    {
        const std::lock_guard lock(*from.mutex_);
        block = from.blocks_.at({row, column});
    }
    const std::string file = block_file_name(layer_.c_str(), column, row);
    if (block.bytes > 0 && !scene_->link(block.file, file)) {
        const auto bytes = from.read(column, row);
        if (!bytes) return bytes.error();
        return write(column, row, *bytes);
    }
    block.file = file;
    return record(std::move(block));
}

Result<std::vector<std::byte>> BlockStore::read(int column, int row) const {
    BlockInfo block;
    {
        const std::lock_guard lock(*mutex_);
        block = blocks_.at({row, column});
    }
    if (block.bytes == 0) return std::vector<std::byte>{};
    auto bytes = scene_->read(block.file, block.bytes);
    if (bytes && sha256_hex(*bytes) != block.sha256) {
        return Error{
            ErrorKind::internal,
            fmt::format("{} changed while the scene was being made: is the disk sound?", block.file)};
    }
    return bytes;
}

std::vector<BlockInfo> BlockStore::blocks() const {
    const std::lock_guard lock(*mutex_);
    std::vector<BlockInfo> stored;
    for (const auto& [place, block] : blocks_) {
        if (block.bytes > 0) stored.push_back(block);
    }
    return stored;
}

Result<void> BlockStore::close() {
    return scene_->remove(journal());
}

Result<void> BlockStore::remove() {
    if (auto done = scene_->remove(journal()); !done) return done;  // first: without it, files are nothing
    return scene_->remove_folder(layer_);
}

}  // namespace relevo::lod
