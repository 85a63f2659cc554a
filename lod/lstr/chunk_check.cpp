#include "lod/lstr/chunk_check.hpp"

#include <map>
#include <tuple>

#include <fmt/format.h>

namespace relevo::lod {

namespace {

std::string name_of(const ChunkId& id) {
    return fmt::format("node {}/{}/{}", id.level, id.column, id.row);
}

/// A side's vertices: place, height, and whether the level above has it.
struct OnSide {
    GridPoint at;
    float H;
    bool kept;
    friend bool operator==(const OnSide&, const OnSide&) = default;
};

std::vector<OnSide> side_of(const ChunkMesh& mesh, Side side) {
    std::vector<OnSide> found;
    for (const SideVertex& v : mesh.sides[static_cast<std::size_t>(side)])
        found.push_back({mesh.vertices[v.vertex].at, mesh.vertices[v.vertex].H, v.kept});
    return found;
}

}  // namespace

std::vector<std::string> check_chunks(const ChunkFile& chunks, const std::function<void(double)>& progress) {
    std::vector<std::string> faults;
    // What awaits its eastern and its southern neighbour.
    std::map<ChunkId, std::vector<OnSide>> east, south;
    std::size_t done = 0;
    chunks.index().for_each([&](const ChunkId& id) {
        progress(static_cast<double>(++done) / static_cast<double>(chunks.index().size()));
        const auto mesh = chunks.mesh(id);
        if (!mesh) {
            faults.push_back(mesh.error().message);
            return;
        }
        const auto compare = [&](auto& awaiting, Side near, Side far) {
            const auto known = awaiting.find(id.beside(near));
            if (known != awaiting.end()) {
                if (known->second != side_of(**mesh, near))
                    faults.push_back(fmt::format("{}: {} and {} do not fit", chunks.name(), name_of(id),
                                                 name_of(known->first)));
                awaiting.erase(known);
            }
            awaiting[id] = side_of(**mesh, far);
        };
        compare(east, Side::west, Side::east);
        compare(south, Side::north, Side::south);
    });
    return faults;
}

}  // namespace relevo::lod
