#include "lod/lstr/chunk_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "lod/lstr/chunk_codec.hpp"
#include "lod/scene/scene_files.hpp"

namespace relevo::lod {

Result<std::array<char, 64>> chunk_identity(const Scene& scene) {
    const auto sum = sha256_of_file(scene.path() / kSceneFile);
    if (!sum) return sum.error();
    return start_of<64>(*sum);
}

ChunkErrors chunk_errors(const Terrain& terrain) {
    const geo::GridFrame& frame = terrain.frame();
    const auto spacing = frame.spacing({0.5 * (frame.columns - 1), 0.5 * (frame.rows - 1)});
    return ChunkErrors::for_spacing(std::min(spacing.column_m, spacing.row_m));
}

ChunkNode node_of(const Terrain& terrain, const ChunkId& id, const ChunkRow& row) {
    ChunkNode node;
    node.error_m = row.error_m;
    node.moved_error_m = row.moved_error_m;
    node.most_H_m = row.most_H_m;
    node.vertices = row.vertices;
    node.box.axes = ChunkBox::axes_at(terrain, id);
    for (int axis = 0; axis < 3; ++axis) {
        node.box.middle[axis] = row.middle[static_cast<std::size_t>(axis)];
        node.box.half[axis] = row.half[static_cast<std::size_t>(axis)];
    }
    return node;
}

Result<std::vector<std::byte>> read_at(const Descriptor& file, std::uint64_t offset, std::uint64_t bytes,
                                       const std::string& name) {
    std::vector<std::byte> read(static_cast<std::size_t>(bytes));
    std::size_t done = 0;
    while (done < read.size()) {
        const ssize_t got =
            pread(file.number(), read.data() + done, read.size() - done, static_cast<off_t>(offset + done));
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) {
            return Error{ErrorKind::damaged,
                         fmt::format("{}: {}", name, got < 0 ? last_system_error() : "it is cut short")};
        }
        done += static_cast<std::size_t>(got);
    }
    return read;
}

bool ChunkFile::is_there(const Scene& scene) {
    const auto own = chunk_identity(scene);
    std::ifstream file(scene.path() / kName, std::ios::binary);
    ChunkFileHead head;
    return own && file.read(reinterpret_cast<char*>(&head), sizeof(head)) && head.magic == kChunkMagic &&
           head.scene == *own;
}

Result<ChunkFile> ChunkFile::open(const Scene& scene, const Terrain& terrain) {
    ChunkFile made(terrain.frame());
    made.name_ = (scene.path() / kName).string();
    made.file_ = Descriptor(::open(made.name_.c_str(), O_RDONLY | O_CLOEXEC));
    struct stat status {};
    if (!made.file_ || fstat(made.file_.number(), &status) != 0)
        return Error{ErrorKind::damaged, fmt::format("{}: {}", made.name_, last_system_error())};
    made.bytes_ = static_cast<std::uint64_t>(status.st_size);
    const Error damaged{ErrorKind::damaged,
                        fmt::format("{}: damaged; delete it, and it is made anew", made.name_)};
    const auto start = read_at(made.file_, 0, sizeof(ChunkFileHead), made.name_);
    if (!start) return damaged;
    ChunkFileHead head;
    std::memcpy(&head, start->data(), sizeof(head));
    const auto own = chunk_identity(scene);
    if (!own) return own.error();
    if (head.magic != kChunkMagic || head.scene != *own)
        return Error{ErrorKind::damaged, fmt::format("{}: of another scene; delete it", made.name_)};
    if (!(head.first_error_m > 0) || head.finished != 1 || head.nodes != made.index_.size() ||
        head.end != made.bytes_ || made.bytes_ < sizeof(head) + head.nodes * sizeof(ChunkRow))
        return damaged;
    made.errors_ = {head.first_error_m};
    const auto table = read_at(made.file_, sizeof(head), head.nodes * sizeof(ChunkRow), made.name_);
    if (!table) return damaged;
    made.entries_.resize(made.index_.size());
    bool whole = true;
    made.index_.for_each([&](const ChunkId& id) {
        const std::size_t place = made.index_.place(id);
        ChunkRow row;
        std::memcpy(&row, table->data() + place * sizeof(row), sizeof(row));
        if (row.own_checksum != row.own() || (row.flags & ChunkRow::kThere) == 0 ||
            (row.flags & ChunkRow::kDraft) != 0 || row.offset > made.bytes_ ||
            row.bytes > made.bytes_ - row.offset) {
            whole = false;
            return;
        }
        made.entries_[place] = {node_of(terrain, id, row), row.offset, row.bytes, row.checksum,
                                (row.flags & ChunkRow::kReplaced) != 0};
    });
    if (!whole) return damaged;
    return made;
}

const ChunkNode* ChunkFile::node(const ChunkId& id) const {
    return index_.has(id) ? &entries_[index_.place(id)].node : nullptr;
}

bool ChunkFile::is_replaced(const ChunkId& id) const {
    return index_.has(id) && entries_[index_.place(id)].replaced;
}

Result<std::shared_ptr<const ChunkMesh>> ChunkFile::mesh(const ChunkId& id) const {
    const Entry& entry = entries_[index_.place(id)];
    const auto bytes = read_at(file_, entry.offset, entry.bytes, name_);
    if (!bytes) return bytes.error();
    if (start_of<16>(sha256_hex(*bytes)) != entry.checksum) {
        return Error{ErrorKind::damaged,
                     fmt::format("{}: node {}/{}/{} is damaged; delete the file, and it is made "
                                 "anew",
                                 name_, id.level, id.column, id.row)};
    }
    auto mesh = decode_chunk(*bytes, id, errors_.of_level(id.level), name_);
    if (!mesh) return mesh.error();
    mesh->error_m = entry.node.error_m;
    mesh->moved_error_m = entry.node.moved_error_m;
    return std::make_shared<const ChunkMesh>(*std::move(mesh));
}

}  // namespace relevo::lod
