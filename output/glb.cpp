#include <cmath>
#include <limits>

#include "output/mesh_stream.hpp"
#include <fmt/format.h>

#include "lod/scene/parallel_blocks.hpp"

namespace relevo::output {
namespace {

using Json = nlohmann::ordered_json;
using FloatPlace = std::array<float, 3>;

FloatPlace rounded(const glm::dvec3& place, const glm::dvec3& origin) {
    const glm::dvec3 near = place - origin;
    return {static_cast<float>(near.x), static_cast<float>(near.y), static_cast<float>(near.z)};
}

/// The accessor of positions must say what they are between; and one wants to know what floats cost.
struct Extent {
    FloatPlace least{};
    FloatPlace most{};
    double rounding = 0;

    Extent() {
        least.fill(std::numeric_limits<float>::infinity());
        most.fill(-std::numeric_limits<float>::infinity());
    }
    void add(const glm::dvec3& place, const glm::dvec3& origin) {
        const FloatPlace p = rounded(place, origin);
        for (std::size_t i = 0; i < 3; ++i) {
            least[i] = std::min(least[i], p[i]);
            most[i] = std::max(most[i], p[i]);
            const auto axis = static_cast<int>(i);
            rounding = std::max(rounding, std::abs(place[axis] - origin[axis] - static_cast<double>(p[i])));
        }
    }
    void add(const Extent& other) {
        for (std::size_t i = 0; i < 3; ++i) {
            least[i] = std::min(least[i], other.least[i]);
            most[i] = std::max(most[i], other.most[i]);
        }
        rounding = std::max(rounding, other.rounding);
    }
};

Result<Extent> extent_of(const MeshFile& from, const glm::dvec3& origin) {
    const RowBands bands(from.heights);
    std::vector<Extent> extents(bands.count());
    const auto done = lod::for_each_block(static_cast<int>(bands.count()), [&](int i) {
        const auto band = static_cast<std::size_t>(i);
        return for_each_vertex(from, bands, band,
                               [&](const glm::dvec3& place) { extents[band].add(place, origin); });
    });
    if (!done) return done.error();
    Extent whole;
    for (const Extent& extent : extents) whole.add(extent);
    return whole;
}

constexpr std::uint32_t kMagic = 0x46546c67;  // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4e4f534a;
constexpr std::uint32_t kBinaryChunk = 0x004e4942;
constexpr int kFloat = 5126;
constexpr int kUnsignedInt = 5125;
constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;

Json document(const MeshFile& from, const Extent& extent, std::uint64_t vertex_bytes,
              std::uint64_t index_bytes) {
    Json extras = from.about;
    const glm::dvec3 origin = from.places.origin();
    extras["positions_relative_to"] = {origin.x, origin.y, origin.z};
    extras["position_rounding"] = extent.rounding;
    const double half = std::sqrt(0.5);
    const auto view = [](std::uint64_t begin, std::uint64_t length, int target) {
        return Json{{"buffer", 0}, {"byteOffset", begin}, {"byteLength", length}, {"target", target}};
    };
    Json positions = {{"bufferView", 0}, {"componentType", kFloat}, {"count", from.mesh.vertices()}};
    positions["type"] = "VEC3";
    positions["min"] = extent.least;
    positions["max"] = extent.most;
    Json corners = {{"bufferView", 1}, {"componentType", kUnsignedInt}, {"count", 3 * from.mesh.triangles()}};
    corners["type"] = "SCALAR";
    Json primitive;
    primitive["attributes"]["POSITION"] = 0;
    primitive["indices"] = 1;

    Json json;
    json["asset"] = {{"version", "2.0"}, {"generator", from.about.value("generator", "relevo")}};
    json["asset"]["extras"] = extras;
    json["scene"] = 0;
    json["scenes"][0]["nodes"] = Json::array({0});
    json["nodes"][0]["mesh"] = 0;
    json["nodes"][0]["rotation"] = {-half, 0.0, 0.0, half};  // x, y, z become x, z, -y: in glTF y is up
    json["meshes"][0]["primitives"][0] = primitive;
    json["buffers"][0]["byteLength"] = vertex_bytes + index_bytes;
    json["bufferViews"] = Json::array(
        {view(0, vertex_bytes, kArrayBuffer), view(vertex_bytes, index_bytes, kElementArrayBuffer)});
    json["accessors"] = Json::array({positions, corners});
    return json;
}

}  // namespace

Result<void> write_glb(const MeshFile& from, PartialFile& file) {
    const glm::dvec3 origin = from.places.origin();
    const auto extent = extent_of(from, origin);
    if (!extent) return extent.error();
    const std::uint64_t vertex_bytes = from.mesh.vertices() * sizeof(FloatPlace);
    const std::uint64_t index_bytes = from.mesh.triangles() * 3 * sizeof(std::uint32_t);
    std::string json = document(from, *extent, vertex_bytes, index_bytes)
                           .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    json.resize((json.size() + 3) / 4 * 4, ' ');
    constexpr std::uint64_t kHeaders = 12 + 8 + 8;
    const std::uint64_t total = kHeaders + json.size() + vertex_bytes + index_bytes;
    if (total > std::numeric_limits<std::uint32_t>::max()) {
        return Error{ErrorKind::usage,
                     fmt::format("a .glb file holds at most 4 GiB, and this mesh takes {:.1f}: write "
                                 ".ply, allow a larger --max-error, or export parts with --bounds",
                                 static_cast<double>(total) / (1U << 30U))};
    }
    Bytes bytes;
    const auto add = [&](std::uint64_t number) { append(bytes, static_cast<std::uint32_t>(number)); };
    add(kMagic);
    add(2);
    add(total);
    add(json.size());
    add(kJsonChunk);
    append(bytes, json);
    add(vertex_bytes + index_bytes);
    add(kBinaryChunk);
    if (auto done = file.write(bytes); !done) return done;
    const auto vertex = [&](const glm::dvec3& place, Bytes& out) {
        for (const float coordinate : rounded(place, origin)) append(out, coordinate);
    };
    if (auto done = write_vertices(from, file, vertex); !done) return done;
    return write_triangles(from, file, [](const std::array<std::uint32_t, 3>& t, Bytes& out) {
        for (const std::uint32_t i : t) append(out, i);
    });
}

}  // namespace relevo::output
