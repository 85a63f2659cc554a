#include "lod/lstr/chunk_file_writer.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "lod/lstr/chunk_codec.hpp"
#include "lod/lstr/chunk_file.hpp"

namespace relevo::lod {

namespace {

/// Are they the same file?
bool is_at(const Descriptor& file, const std::filesystem::path& path) {
    struct stat own {
    }, there{};
    return fstat(file.number(), &own) == 0 && stat(path.c_str(), &there) == 0 && own.st_ino == there.st_ino &&
           own.st_dev == there.st_dev;
}

}  // namespace

ChunkFileWriter::ChunkFileWriter(std::filesystem::path place, const ChunkIndex& index)
    : place_(std::move(place)), path_(place_.string() + ".part"), index_(&index), rows_(index.size()) {}

Error ChunkFileWriter::failed() const {
    return {ErrorKind::input, fmt::format("{}: cannot be written: {}; `--lod soar` needs no such file",
                                          path_.string(), last_system_error())};
}

Result<void> ChunkFileWriter::lock() {
    bool waited = false;
    while (true) {
        file_ = Descriptor(::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
        if (!file_) return failed();
        if (flock(file_.number(), LOCK_EX | LOCK_NB) != 0) {
            if (errno != EWOULDBLOCK && errno != EINTR) return failed();
            waited = true;
            while (flock(file_.number(), LOCK_EX) != 0) {
                if (errno != EINTR) return failed();
            }
        }
        if (is_at(file_, path_)) break;
        // Who had it has finished, or given up.
    }
    late_ = waited && std::filesystem::exists(place_);
    return {};
}

Result<void> ChunkFileWriter::write(std::uint64_t at, const void* data, std::size_t bytes) {
    const char* from = static_cast<const char*>(data);
    while (bytes > 0) {
        const ssize_t done = pwrite(file_.number(), from, bytes, static_cast<off_t>(at));
        if (done < 0 && errno == EINTR) continue;
        if (done <= 0) return failed();
        from += done;
        at += static_cast<std::uint64_t>(done);
        bytes -= static_cast<std::size_t>(done);
    }
    return {};
}

Result<void> ChunkFileWriter::begin(const ChunkFileHead& head) {
    head_ = head;
    head_.nodes = rows_.size();
    head_.end = sizeof(head_) + rows_.size() * sizeof(ChunkRow);
    head_.finished = 0;
    std::fill(rows_.begin(), rows_.end(), ChunkRow{});
    there_ = 0;
    if (ftruncate(file_.number(), 0) != 0 || ftruncate(file_.number(), static_cast<off_t>(head_.end)) != 0)
        return failed();
    return write(0, &head_, sizeof(head_));
}

/// Is what is in the file a part of what is to be made? Then it is gone on with.
bool ChunkFileWriter::resume(const ChunkFileHead& head) {
    const auto start = read_at(file_, 0, sizeof(head), path_.string());
    if (!start) return false;
    std::memcpy(&head_, start->data(), sizeof(head_));
    struct stat status {};
    if (head_.magic != head.magic || head_.scene != head.scene || head_.first_error_m != head.first_error_m ||
        head_.filter != head.filter || head_.nodes != rows_.size() || fstat(file_.number(), &status) != 0 ||
        head_.end > static_cast<std::uint64_t>(status.st_size))
        return false;
    const auto table = read_at(file_, sizeof(head_), rows_.size() * sizeof(ChunkRow), path_.string());
    if (!table) return false;
    std::memcpy(rows_.data(), table->data(), table->size());
    there_ = 0;
    for (ChunkRow& row : rows_) {
        if ((row.flags & ChunkRow::kThere) == 0) continue;
        if (row.own_checksum != row.own() || row.offset > head_.end || row.bytes > head_.end - row.offset)
            return false;
        ++there_;
    }
    head_.finished = 0;
    return ftruncate(file_.number(), static_cast<off_t>(head_.end)) == 0;
}

Result<ChunkFileWriter> ChunkFileWriter::open(const std::filesystem::path& place, const ChunkFileHead& head,
                                              const ChunkIndex& index) {
    ChunkFileWriter made(place, index);
    if (auto done = made.lock(); !done) return done.error();
    if (made.late_ || made.resume(head)) return made;
    if (auto done = made.begin(head); !done) return done.error();
    return made;
}

Result<ChunkFileWriter> ChunkFileWriter::on_copy(const std::filesystem::path& place,
                                                 const ChunkIndex& index) {
    ChunkFileWriter made(place, index);
    if (auto done = made.lock(); !done) return done.error();
    const Descriptor from(::open(place.c_str(), O_RDONLY | O_CLOEXEC));
    const auto start = read_at(from, 0, sizeof(ChunkFileHead), place.string());
    if (!start) return start.error();
    ChunkFileHead head;
    std::memcpy(&head, start->data(), sizeof(head));
    constexpr std::uint64_t kPart = std::uint64_t{8} << 20;
    for (std::uint64_t at = 0; at < head.end; at += kPart) {
        const auto bytes = read_at(from, at, std::min(kPart, head.end - at), place.string());
        if (!bytes) return bytes.error();
        if (auto done = made.write(at, bytes->data(), bytes->size()); !done) return done.error();
    }
    if (!made.resume(head)) {
        made.give_up();
        return Error{ErrorKind::damaged,
                     fmt::format("{}: damaged; delete it, and it is made anew", place.string())};
    }
    return made;
}

ChunkFileWriter::PackedNode ChunkFileWriter::packed(const Terrain& terrain, const ChunkMesh& mesh,
                                                    std::uint32_t flags) const {
    PackedNode packed{index_->place(mesh.id), {}, {}};
    const double allowed_m = ChunkErrors{head_.first_error_m}.of_level(mesh.id.level);
    packed.bytes = encode_chunk(mesh, allowed_m);
    const ChunkNode node = chunk_node(terrain, mesh);
    ChunkRow& row = packed.row;
    row.bytes = packed.bytes.size();
    row.checksum = start_of<16>(sha256_hex(packed.bytes));
    row.flags = ChunkRow::kThere | flags;
    row.vertices = node.vertices;
    row.error_m = node.error_m;
    row.moved_error_m = node.moved_error_m + rise_rounding_m(mesh, allowed_m);
    row.most_H_m = node.most_H_m;
    for (int axis = 0; axis < 3; ++axis) {
        row.middle[static_cast<std::size_t>(axis)] = node.box.middle[axis];
        row.half[static_cast<std::size_t>(axis)] = node.box.half[axis];
    }
    return packed;
}

Result<void> ChunkFileWriter::put(const PackedNode& node) {
    if (auto done = write(head_.end, node.bytes.data(), node.bytes.size()); !done) return done;
    ChunkRow& row = rows_[node.place];
    if ((row.flags & ChunkRow::kThere) == 0) ++there_;
    row = node.row;
    row.offset = head_.end;
    row.own_checksum = row.own();
    head_.end += node.bytes.size();
    changed_.insert(node.place);
    return {};
}

Result<void> ChunkFileWriter::commit() {
    for (const std::size_t place : changed_) {
        if (auto done = write(sizeof(head_) + place * sizeof(ChunkRow), &rows_[place], sizeof(ChunkRow));
            !done)
            return done;
    }
    changed_.clear();
    // The head last: without it what was written since the last commit does not count.
    if (fdatasync(file_.number()) != 0) return failed();
    if (auto done = write(0, &head_, sizeof(head_)); !done) return done;
    if (fdatasync(file_.number()) != 0) return failed();
    return {};
}

Result<std::optional<ChunkMesh>> ChunkFileWriter::find(const ChunkId& id) const {
    if (!index_->has(id)) return std::optional<ChunkMesh>();
    const ChunkRow& row = rows_[index_->place(id)];
    if ((row.flags & ChunkRow::kThere) == 0) return std::optional<ChunkMesh>();
    const auto bytes = read_at(file_, row.offset, row.bytes, path_.string());
    const Error damaged{ErrorKind::damaged, fmt::format("{}: damaged; delete it", path_.string())};
    if (!bytes || start_of<16>(sha256_hex(*bytes)) != row.checksum) return damaged;
    auto mesh = decode_chunk(*bytes, id, ChunkErrors{head_.first_error_m}.of_level(id.level), path_.string());
    if (!mesh) return mesh.error();
    mesh->error_m = row.error_m;
    mesh->moved_error_m = row.moved_error_m;
    return std::optional<ChunkMesh>(*std::move(mesh));
}

Result<void> ChunkFileWriter::finish() {
    head_.finished = 1;
    if (auto done = commit(); !done) return done;
    if (std::rename(path_.c_str(), place_.c_str()) != 0) return failed();
    return {};
}

void ChunkFileWriter::give_up() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
}

}  // namespace relevo::lod
