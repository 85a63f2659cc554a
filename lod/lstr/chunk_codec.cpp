#include "lod/lstr/chunk_codec.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>

#include "lod/scene/deflate.hpp"

namespace relevo::lod {

namespace {

constexpr double kRiseSteps = 512;

/// Whole numbers, small ones in few bytes: seven bits a byte, the sign in the lowest bit.
class NumberWriter {
  public:
    void add(std::int64_t value) {
        auto bits = (static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63);
        for (; bits > 0x7F; bits >>= 7) bytes_.push_back(static_cast<std::byte>(bits | 0x80));
        bytes_.push_back(static_cast<std::byte>(bits));
    }
    const std::vector<std::byte>& bytes() const { return bytes_; }

  private:
    std::vector<std::byte> bytes_;
};

class NumberReader {
  public:
    explicit NumberReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

    /// 0 and failed() from the first on that is not there.
    std::int64_t next() {
        std::uint64_t bits = 0;
        for (int shift = 0; shift < 64; shift += 7) {
            if (at_ == bytes_.size()) break;
            const auto byte = static_cast<std::uint64_t>(bytes_[at_++]);
            bits |= (byte & 0x7F) << shift;
            if (byte < 0x80)
                return static_cast<std::int64_t>(bits >> 1) ^ -static_cast<std::int64_t>(bits & 1);
        }
        failed_ = true;
        return 0;
    }
    bool failed() const { return failed_; }
    bool at_end() const { return at_ == bytes_.size(); }

  private:
    std::span<const std::byte> bytes_;
    std::size_t at_ = 0;
    bool failed_ = false;
};

std::int64_t bits_of(float H) {
    return std::bit_cast<std::int32_t>(H);
}

}  // namespace

std::vector<std::byte> encode_chunk(const ChunkMesh& mesh, double allowed_m) {
    NumberWriter numbers;
    const GridPoint first = mesh.id.first();
    numbers.add(static_cast<std::int64_t>(mesh.vertices.size()));
    numbers.add(static_cast<std::int64_t>(mesh.triangles.size()));
    GridPoint last = first;
    for (const ChunkVertex& v : mesh.vertices) {
        numbers.add(v.at.row - last.row);
        numbers.add(v.at.column - last.column);
        last = v.at;
    }
    std::int64_t last_H = 0;
    for (const ChunkVertex& v : mesh.vertices) {
        numbers.add(bits_of(v.H) - last_H);
        last_H = bits_of(v.H);
    }
    for (const ChunkVertex& v : mesh.vertices) {
        const double rise_m = static_cast<double>(v.coarse_H) - static_cast<double>(v.H);
        numbers.add(std::llround(rise_m / allowed_m * kRiseSteps));
    }
    std::int64_t last_a = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        numbers.add(static_cast<std::int64_t>(a) - last_a);
        numbers.add(static_cast<std::int64_t>(b) - a);
        numbers.add(static_cast<std::int64_t>(c) - b);
        last_a = a;
    }
    for (const auto& side : mesh.sides) {
        numbers.add(static_cast<std::int64_t>(side.size()));
        std::int64_t last_vertex = 0;
        for (const SideVertex& at : side) {
            numbers.add(2 * (static_cast<std::int64_t>(at.vertex) - last_vertex) + (at.kept ? 1 : 0));
            last_vertex = at.vertex;
        }
    }
    std::vector<std::byte> bytes(sizeof(std::uint64_t));
    const auto size = static_cast<std::uint64_t>(numbers.bytes().size());
    std::memcpy(bytes.data(), &size, sizeof(size));
    const std::vector<std::byte> packed = deflated(numbers.bytes());
    bytes.insert(bytes.end(), packed.begin(), packed.end());
    return bytes;
}

Result<ChunkMesh> decode_chunk(std::span<const std::byte> bytes, const ChunkId& id, double allowed_m,
                               const std::string& name) {
    const Error damaged{ErrorKind::damaged,
                        fmt::format("{}: node {}/{}/{} makes no mesh", name, id.level, id.column, id.row)};
    constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 32;
    std::uint64_t size = 0;
    if (bytes.size() < sizeof(size)) return damaged;
    std::memcpy(&size, bytes.data(), sizeof(size));
    if (size > std::min(kMostBytes, std::uint64_t{2000} * bytes.size())) return damaged;
    const auto unpacked = inflated(bytes.subspan(sizeof(size)), static_cast<std::size_t>(size), name);
    if (!unpacked) return unpacked.error();
    NumberReader numbers(*unpacked);

    ChunkMesh mesh{id, 0, 0, {}, {}, {}};
    const std::int64_t vertices = numbers.next();
    const std::int64_t triangles = numbers.next();
    // Each takes a byte at least.
    const auto most = static_cast<std::int64_t>(size);
    if (vertices < 0 || vertices > most || triangles < 0 || triangles > most) return damaged;
    mesh.vertices.resize(static_cast<std::size_t>(vertices));
    mesh.triangles.resize(static_cast<std::size_t>(triangles));
    const GridPoint first = id.first();
    std::int64_t row = first.row;
    std::int64_t column = first.column;
    for (ChunkVertex& v : mesh.vertices) {
        row += numbers.next();
        column += numbers.next();
        const bool inside = row >= first.row && row <= first.row + id.cells() && column >= first.column &&
                            column <= first.column + id.cells();
        if (!inside) return damaged;
        v.at = {static_cast<int>(column), static_cast<int>(row)};
    }
    std::int64_t H = 0;
    for (ChunkVertex& v : mesh.vertices) {
        H += numbers.next();
        v.H = std::bit_cast<float>(static_cast<std::int32_t>(H));
        if (!std::isfinite(v.H)) return damaged;
    }
    for (ChunkVertex& v : mesh.vertices) {
        const double rise_m = static_cast<double>(numbers.next()) * allowed_m / kRiseSteps;
        v.coarse_H = static_cast<float>(static_cast<double>(v.H) + rise_m);
        if (!std::isfinite(v.coarse_H)) return damaged;
    }
    const auto is_vertex = [&](std::int64_t i) { return i >= 0 && i < vertices; };
    std::int64_t a = 0;
    for (IndexTriangle& t : mesh.triangles) {
        a += numbers.next();
        const std::int64_t b = a + numbers.next();
        const std::int64_t c = b + numbers.next();
        if (!is_vertex(a) || !is_vertex(b) || !is_vertex(c)) return damaged;
        t = {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(c)};
    }
    for (auto& side : mesh.sides) {
        const std::int64_t count = numbers.next();
        if (count < 0 || count > vertices) return damaged;
        std::int64_t vertex = 0;
        for (std::int64_t i = 0; i < count; ++i) {
            const std::int64_t step = numbers.next();
            vertex += step >> 1;
            if (!is_vertex(vertex)) return damaged;
            side.push_back({static_cast<std::uint32_t>(vertex), (step & 1) != 0});
        }
    }
    if (numbers.failed() || !numbers.at_end()) return damaged;
    return mesh;
}

}  // namespace relevo::lod
