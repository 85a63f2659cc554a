#include "lod/lstr/chunk_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <type_traits>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "geo/position.hpp"
#include "lod/lstr/chunk_codec.hpp"
#include "lod/scene/scene_files.hpp"
#include "lod/scene/sha256.hpp"

namespace relevo::lod {

namespace {

constexpr std::array<char, 8> kMagic{'r', 'e', 'l', 'c', 'h', 'n', 'k', '3'};

/// At the file's beginning; little-endian, as the machines that this runs on are.
struct Head {
    std::array<char, 8> magic = kMagic;
    std::array<char, 64> scene{};  // SHA-256 of its scene.json
    double first_error_m = 0;
    std::uint64_t nodes = 0;
    std::uint64_t table = 0;          // where it is
    std::array<char, 64> checksum{};  // SHA-256 of the table
};
static_assert(std::is_trivially_copyable_v<Head> && sizeof(Head) == 160);

struct Row {
    std::int32_t level, column, row;
    std::uint32_t vertices;
    std::uint64_t offset, bytes;
    std::array<char, 16> checksum;
    double error_m, moved_error_m, most_H_m;
    std::array<double, 3> middle, half;
};
static_assert(std::is_trivially_copyable_v<Row> && sizeof(Row) == 120);

template <std::size_t N>
std::array<char, N> start_of(const std::string& text) {
    std::array<char, N> start{};
    std::copy_n(text.begin(), std::min(N, text.size()), start.begin());
    return start;
}

std::filesystem::path path_of(const Scene& scene) {
    return scene.path() / ChunkFile::kName;
}

Result<std::array<char, 64>> identity(const Scene& scene) {
    const auto sum = sha256_of_file(scene.path() / kSceneFile);
    if (!sum) return sum.error();
    return start_of<64>(*sum);
}

double finest_spacing_m(const Terrain& terrain) {
    const geo::GridFrame& frame = terrain.frame();
    const auto spacing = frame.spacing({0.5 * (frame.columns - 1), 0.5 * (frame.rows - 1)});
    return std::min(spacing.column_m, spacing.row_m);
}

/// Nodes of level 1 and coarser that hold data.
std::uint64_t count_nodes(const geo::GridFrame& frame) {
    std::uint64_t count = 0;
    for (int level = 1; level <= top_chunk_level(frame); ++level) {
        const auto along = [&](int posts) {
            const int cells = ChunkId::kLeafCells << level;
            return static_cast<std::uint64_t>((std::max(posts - 1, 1) + cells - 1) / cells);
        };
        count += along(frame.columns) * along(frame.rows);
    }
    return count;
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

/// A file that goes away unless it takes its place.
class Draft {
  public:
    explicit Draft(std::filesystem::path place)
        : place_(std::move(place)), path_(place_.string() + fmt::format(".{}", getpid())) {
        file_.open(path_, std::ios::binary | std::ios::trunc);
    }
    Draft(const Draft&) = delete;
    Draft& operator=(const Draft&) = delete;
    ~Draft() {
        std::error_code ignored;
        if (!taken_) std::filesystem::remove(path_, ignored);
    }

    Result<void> write(const void* data, std::size_t bytes) {
        file_.write(static_cast<const char*>(data), static_cast<std::streamsize>(bytes));
        if (!file_) return failed();
        return {};
    }
    Result<void> take(const Head& head) {
        file_.seekp(0);
        if (auto done = write(&head, sizeof(head)); !done) return done;
        file_.close();
        if (!file_) return failed();
        const Descriptor written(open(path_.c_str(), O_RDONLY | O_CLOEXEC));
        if (!written || fsync(written.number()) != 0 || std::rename(path_.c_str(), place_.c_str()) != 0)
            return failed();
        taken_ = true;
        return {};
    }

  private:
    Error failed() const {
        return {ErrorKind::input, fmt::format("{}: cannot be written: {}; `--lod soar` needs no such file",
                                              path_.string(), last_system_error())};
    }

    std::filesystem::path place_;
    std::filesystem::path path_;
    std::ofstream file_;
    bool taken_ = false;
};

}  // namespace

bool ChunkFile::is_there(const Scene& scene) {
    const auto own = identity(scene);
    std::ifstream file(path_of(scene), std::ios::binary);
    Head head;
    return own && file.read(reinterpret_cast<char*>(&head), sizeof(head)) && head.magic == kMagic &&
           head.scene == *own;
}

Result<void> ChunkFile::build(const Scene& scene, const Terrain& terrain,
                              const std::function<void(double)>& progress) {
    const auto own = identity(scene);
    if (!own) return own.error();
    const ChunkErrors errors = ChunkErrors::for_spacing(finest_spacing_m(terrain));
    Head head;
    head.scene = *own;
    head.first_error_m = errors.first_m;
    Draft draft(path_of(scene));
    if (auto done = draft.write(&head, sizeof(head)); !done) return done;
    std::vector<Row> rows;
    std::uint64_t offset = sizeof(head);
    const auto all = static_cast<double>(std::max<std::uint64_t>(count_nodes(terrain.frame()), 1));
    const auto keep = [&](const ChunkMesh& mesh) -> Result<void> {
        const ChunkNode node = chunk_node(terrain, mesh);
        const std::vector<std::byte> bytes = encode_chunk(mesh, errors.of_level(mesh.id.level));
        Row row{};
        row.level = mesh.id.level;
        row.column = mesh.id.column;
        row.row = mesh.id.row;
        row.offset = offset;
        row.bytes = bytes.size();
        row.checksum = start_of<16>(sha256_hex(bytes));
        row.error_m = node.error_m;
        row.moved_error_m = node.moved_error_m;
        row.vertices = node.vertices;
        row.most_H_m = node.most_H_m;
        for (int axis = 0; axis < 3; ++axis) {
            row.middle[static_cast<std::size_t>(axis)] = node.box.middle[axis];
            row.half[static_cast<std::size_t>(axis)] = node.box.half[axis];
        }
        rows.push_back(row);
        offset += bytes.size();
        progress(static_cast<double>(rows.size()) / all);
        return draft.write(bytes.data(), bytes.size());
    };
    if (auto done = ChunkBuilder(terrain, errors).build(keep); !done) return done;
    const auto table = std::as_bytes(std::span(rows));
    if (auto done = draft.write(table.data(), table.size()); !done) return done;
    head.nodes = rows.size();
    head.table = offset;
    head.checksum = start_of<64>(sha256_hex(table));
    return draft.take(head);
}

Result<ChunkFile> ChunkFile::open(const Scene& scene, const Terrain& terrain) {
    ChunkFile made;
    made.name_ = path_of(scene).string();
    made.file_ = Descriptor(::open(made.name_.c_str(), O_RDONLY | O_CLOEXEC));
    struct stat status {};
    if (!made.file_ || fstat(made.file_.number(), &status) != 0)
        return Error{ErrorKind::damaged, fmt::format("{}: {}", made.name_, last_system_error())};
    made.bytes_ = static_cast<std::uint64_t>(status.st_size);
    const Error damaged{ErrorKind::damaged,
                        fmt::format("{}: damaged; delete it, and it is made anew", made.name_)};
    const auto start = read_at(made.file_, 0, sizeof(Head), made.name_);
    if (!start) return damaged;
    Head head;
    std::memcpy(&head, start->data(), sizeof(head));
    const auto own = identity(scene);
    if (!own) return own.error();
    if (head.magic != kMagic || head.scene != *own)
        return Error{ErrorKind::damaged, fmt::format("{}: of another scene; delete it", made.name_)};
    if (!(head.first_error_m > 0) || head.nodes != count_nodes(terrain.frame()) || head.table > made.bytes_ ||
        made.bytes_ - head.table != head.nodes * sizeof(Row))
        return damaged;
    const auto table = read_at(made.file_, head.table, head.nodes * sizeof(Row), made.name_);
    if (!table || start_of<64>(sha256_hex(*table)) != head.checksum) return damaged;
    made.first_error_m_ = head.first_error_m;
    for (std::uint64_t i = 0; i < head.nodes; ++i) {
        Row row{};
        std::memcpy(&row, table->data() + i * sizeof(Row), sizeof(row));
        const ChunkId id{row.level, row.column, row.row};
        if (id.level < 1 || id.level > top_chunk_level(terrain.frame()) ||
            row.offset > head.table || row.bytes > head.table - row.offset)
            return damaged;
        Entry entry;
        entry.place = {row.offset, row.bytes, row.checksum};
        entry.node.error_m = row.error_m;
        entry.node.moved_error_m = row.moved_error_m;
        entry.node.vertices = row.vertices;
        entry.node.most_H_m = row.most_H_m;
        entry.node.box.axes = ChunkBox::axes_at(terrain, id);
        for (int axis = 0; axis < 3; ++axis) {
            entry.node.box.middle[axis] = row.middle[static_cast<std::size_t>(axis)];
            entry.node.box.half[axis] = row.half[static_cast<std::size_t>(axis)];
        }
        made.entries_[id] = entry;
    }
    return made;
}

const ChunkNode* ChunkFile::node(const ChunkId& id) const {
    const auto found = entries_.find(id);
    return found == entries_.end() ? nullptr : &found->second.node;
}

std::vector<ChunkId> ChunkFile::nodes() const {
    std::vector<ChunkId> all;
    for (const auto& [id, entry] : entries_) all.push_back(id);
    return all;
}

Result<std::shared_ptr<const ChunkMesh>> ChunkFile::mesh(const ChunkId& id) const {
    const Entry& entry = entries_.at(id);
    const auto bytes = read_at(file_, entry.place.offset, entry.place.bytes, name_);
    if (!bytes) return bytes.error();
    if (start_of<16>(sha256_hex(*bytes)) != entry.place.checksum) {
        return Error{ErrorKind::damaged,
                     fmt::format("{}: node {}/{}/{} is damaged; delete the file, and it is made "
                                 "anew",
                                 name_, id.level, id.column, id.row)};
    }
    auto mesh = decode_chunk(*bytes, id, ChunkErrors{first_error_m_}.of_level(id.level), name_);
    if (!mesh) return mesh.error();
    mesh->error_m = entry.node.error_m;
    mesh->moved_error_m = entry.node.moved_error_m;
    return std::make_shared<const ChunkMesh>(*std::move(mesh));
}

Result<void> provide_chunks(const Scene& scene, Terrain& terrain,
                            const std::function<void(double)>& progress) {
    if (!ChunkFile::is_there(scene)) {
        if (const auto built = ChunkFile::build(scene, terrain, progress); !built) {
            if (built.error().kind != ErrorKind::input) return built.error();
            auto chunks = MemoryChunks::build(terrain, ChunkErrors::for_spacing(finest_spacing_m(terrain)));
            if (!chunks) return chunks.error();
            terrain.use_chunks(std::make_shared<const MemoryChunks>(*std::move(chunks)));
            return {};
        }
    }
    auto chunks = ChunkFile::open(scene, terrain);
    if (!chunks) return chunks.error();
    terrain.use_chunks(std::make_shared<const ChunkFile>(*std::move(chunks)));
    return {};
}

}  // namespace relevo::lod
