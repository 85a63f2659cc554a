#include <iterator>

#include "output/mesh_stream.hpp"
#include <fmt/format.h>

namespace relevo::output {

Result<void> write_obj(const MeshFile& from, PartialFile& file) {
    std::string header;
    for (const auto& [key, value] : from.about.items())
        header += fmt::format("# {}: {}\n", key, line_of(value));
    Bytes bytes;
    append(bytes, header);
    if (auto done = file.write(bytes); !done) return done;
    // The shortest numbers that read back as the same.
    const auto vertex = [](const glm::dvec3& p, Bytes& out) {
        append(out, fmt::format("v {} {} {}\n", p.x, p.y, p.z));
    };
    if (auto done = write_vertices(from, file, vertex); !done) return done;
    return write_triangles(from, file, [](const std::array<std::uint32_t, 3>& t, Bytes& out) {
        const auto one = [&](int i) { return std::uint64_t{t[static_cast<std::size_t>(i)]} + 1; };
        append(out, fmt::format("f {} {} {}\n", one(0), one(1), one(2)));
    });
}

Result<void> write_mesh(MeshFormat format, const MeshFile& from, PartialFile& file) {
    switch (format) {
        case MeshFormat::ply:
            return write_ply(from, file);
        case MeshFormat::glb:
            return write_glb(from, file);
        case MeshFormat::obj:
            break;
    }
    return write_obj(from, file);
}

}  // namespace relevo::output
