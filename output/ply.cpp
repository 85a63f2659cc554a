#include "output/mesh_stream.hpp"
#include <fmt/format.h>

namespace relevo::output {

Result<void> write_ply(const MeshFile& from, PartialFile& file) {
    std::string header = "ply\nformat binary_little_endian 1.0\n";
    for (const auto& [key, value] : from.about.items())
        header += fmt::format("comment {}: {}\n", key, line_of(value));
    header += fmt::format(
        "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
        "element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
        from.mesh.vertices(), from.mesh.triangles());
    Bytes bytes;
    append(bytes, header);
    if (auto done = file.write(bytes); !done) return done;
    const auto vertex = [](const glm::dvec3& p, Bytes& out) {
        append(out, p.x);
        append(out, p.y);
        append(out, p.z);
    };
    if (auto done = write_vertices(from, file, vertex); !done) return done;
    return write_triangles(from, file, [](const std::array<std::uint32_t, 3>& t, Bytes& out) {
        append(out, std::uint8_t{3});
        for (const std::uint32_t i : t) append(out, i);
    });
}

}  // namespace relevo::output
