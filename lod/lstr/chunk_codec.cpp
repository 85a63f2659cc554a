#include "lod/lstr/chunk_codec.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>

#include "lod/lstr/triangle_coding.hpp"
#include "lod/scene/deflate.hpp"

namespace relevo::lod {

namespace {

constexpr double kRiseSteps = 512;

/// Heights are whole multiples of a power of two from this one on, else their bits.
constexpr int kFinestUnit = -7;
constexpr int kCoarsestUnit = 13;
constexpr int kNoUnit = kFinestUnit - 1;

/// Which triangles are coded (triangle_coding.hpp).
constexpr std::int64_t kList = 0;
constexpr std::int64_t kStrips = 1;

std::int64_t rise_steps(const ChunkVertex& v, double allowed_m) {
    const double rise_m = static_cast<double>(v.coarse_H) - static_cast<double>(v.H);
    return std::llround(rise_m / allowed_m * kRiseSteps);
}

float risen(float H, std::int64_t steps, double allowed_m) {
    const double rise_m = static_cast<double>(steps) * allowed_m / kRiseSteps;
    return static_cast<float>(static_cast<double>(H) + rise_m);
}

std::int64_t bits_of(float H) {
    return std::bit_cast<std::int32_t>(H);
}

/// Exponent of the largest power of two of which all heights are whole multiples, small enough for whole
/// numbers; kNoUnit: there is none.
int unit_of(const ChunkMesh& mesh) {
    int unit = kCoarsestUnit;
    for (const ChunkVertex& v : mesh.vertices) {
        const auto is_whole = [&] {
            const float whole = std::ldexp(v.H, -unit);
            return whole == std::trunc(whole) && std::abs(whole) < 0x1p24F &&
                   !(v.H == 0 && std::signbit(v.H));
        };
        while (unit > kNoUnit && !is_whole()) --unit;
    }
    return unit;
}

/// Row by row how many there are, then their columns from the one before on.
void write_posts(const ChunkMesh& mesh, NumberWriter& numbers) {
    const GridPoint first = mesh.id.first();
    NumberWriter columns;
    auto v = mesh.vertices.begin();
    for (int row = first.row; row <= first.row + mesh.id.cells(); ++row) {
        std::int64_t count = 0;
        int last = first.column;
        for (; v != mesh.vertices.end() && v->at.row == row; ++v, ++count) {
            columns.add(v->at.column - last);
            last = v->at.column;
        }
        numbers.add(count);
    }
    numbers.add_bytes(columns.bytes());
}

bool read_posts(NumberReader& numbers, ChunkMesh& mesh) {
    const GridPoint first = mesh.id.first();
    const int cells = mesh.id.cells();
    auto v = mesh.vertices.begin();
    for (int row = first.row; row <= first.row + cells; ++row) {
        const std::int64_t count = numbers.next();
        if (count < 0 || count > mesh.vertices.end() - v) return false;
        for (const auto end = v + count; v != end; ++v) v->at = {first.column, row};
    }
    if (v != mesh.vertices.end()) return false;
    std::int64_t last = 0;
    for (v = mesh.vertices.begin(); v != mesh.vertices.end(); ++v) {
        if (v == mesh.vertices.begin() || (v - 1)->at.row != v->at.row) last = first.column;
        last += numbers.next();
        if (last < first.column || last > first.column + cells) return false;
        v->at.column = static_cast<int>(last);
    }
    return true;
}

void write_triangles(const std::vector<IndexTriangle>& triangles, NumberWriter& numbers) {
    NumberWriter list, strips;
    write_list(triangles, list);
    write_strips(triangles, strips);
    const bool is_list = deflated(list.bytes()).size() < deflated(strips.bytes()).size();
    numbers.add(is_list ? kList : kStrips);
    numbers.add_bytes((is_list ? list : strips).bytes());
}

bool read_triangles(NumberReader& numbers, ChunkMesh& mesh) {
    const std::int64_t coding = numbers.next();
    if (coding != kList && coding != kStrips) return false;
    const auto vertices = static_cast<std::int64_t>(mesh.vertices.size());
    return coding == kList ? read_list(numbers, vertices, mesh.triangles)
                           : read_strips(numbers, vertices, mesh.triangles);
}

}  // namespace

double rise_rounding_m(const ChunkMesh& mesh, double allowed_m) {
    double most = 0;
    for (const ChunkVertex& v : mesh.vertices) {
        const float kept = risen(v.H, rise_steps(v, allowed_m), allowed_m);
        most = std::max(most, std::abs(static_cast<double>(kept) - static_cast<double>(v.coarse_H)));
    }
    return most;
}

std::vector<std::byte> encode_chunk(const ChunkMesh& mesh, double allowed_m) {
    NumberWriter numbers;
    numbers.add(static_cast<std::int64_t>(mesh.vertices.size()));
    numbers.add(static_cast<std::int64_t>(mesh.triangles.size()));
    write_posts(mesh, numbers);
    const int unit = unit_of(mesh);
    numbers.add(unit);
    std::int64_t last_H = 0;
    for (const ChunkVertex& v : mesh.vertices) {
        const std::int64_t H = unit == kNoUnit ? bits_of(v.H) : std::llround(std::ldexp(v.H, -unit));
        numbers.add(H - last_H);
        last_H = H;
    }
    for (const ChunkVertex& v : mesh.vertices) numbers.add(rise_steps(v, allowed_m));
    write_triangles(mesh.triangles, numbers);
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
    if (!read_posts(numbers, mesh)) return damaged;
    const std::int64_t unit = numbers.next();
    if (unit < kNoUnit || unit > kCoarsestUnit) return damaged;
    std::int64_t H = 0;
    for (ChunkVertex& v : mesh.vertices) {
        H += numbers.next();
        v.H = unit == kNoUnit ? std::bit_cast<float>(static_cast<std::int32_t>(H))
                              : std::ldexp(static_cast<float>(H), static_cast<int>(unit));
        if (!std::isfinite(v.H)) return damaged;
    }
    for (ChunkVertex& v : mesh.vertices) {
        v.coarse_H = risen(v.H, numbers.next(), allowed_m);
        if (!std::isfinite(v.coarse_H)) return damaged;
    }
    if (!read_triangles(numbers, mesh)) return damaged;
    const auto is_vertex = [&](std::int64_t i) { return i >= 0 && i < vertices; };
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
