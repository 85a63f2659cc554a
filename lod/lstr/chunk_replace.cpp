#include "lod/lstr/chunk_replace.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "lod/lstr/chunk_file.hpp"
#include "lod/lstr/chunk_file_writer.hpp"
#include "lod/lstr/mesh_error.hpp"
#include "lod/static_mesh/grid_triangle.hpp"

namespace relevo::lod {

namespace {

Error wrong(std::string what) {
    return {ErrorKind::input, std::move(what)};
}

std::pair<int, int> by_row(const GridPoint& at) {
    return {at.row, at.column};
}

/// The geometry as a mesh of the node, or what keeps it from being one.
Result<ChunkShape> shape_in(const Terrain& terrain, const ChunkId& id, const ChunkGeometry& geometry) {
    const GridPoint first = id.first();
    const int cells = id.cells();
    ChunkShape shape{id, {}, {}, 0};
    std::map<std::pair<int, int>, float> heights;
    for (const auto& [at, H] : geometry.vertices) {
        if (at.column < first.column || at.row < first.row || at.column > first.column + cells ||
            at.row > first.row + cells)
            return wrong(fmt::format(
                "the vertex at column {}, row {} is outside the node, which has columns "
                "{} to {} and rows {} to {}",
                at.column, at.row, first.column, first.column + cells, first.row, first.row + cells));
        if (!std::isfinite(H)) return wrong("a vertex has no height");
        if (!heights.emplace(by_row(at), H).second)
            return wrong(fmt::format("two vertices are at column {}, row {}", at.column, at.row));
    }
    std::map<std::pair<int, int>, std::uint32_t> places;
    for (const auto& [at, H] : heights) {
        places.emplace(at, static_cast<std::uint32_t>(shape.posts.size()));
        shape.posts.push_back(
            {{at.second, at.first}, H, terrain.position(at.second, at.first, static_cast<double>(H), 1)});
    }
    std::int64_t area = 0;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const IndexTriangle& t : geometry.triangles) {
        IndexTriangle placed{};
        for (std::size_t i = 0; i < 3; ++i) placed[i] = places.at(by_row(geometry.vertices[t[i]].at));
        const auto at = [&](std::size_t i) -> const GridPoint& { return shape.posts[placed[i]].at; };
        const std::int64_t twice = turn(at(0), at(1), at(2));
        if (twice <= 0)
            return wrong(
                fmt::format("the triangle at column {}, row {} is not counter-clockwise seen from "
                            "above",
                            at(0).column, at(0).row));
        area += twice;
        for (std::size_t i = 0; i < 3; ++i) {
            if (!edges.emplace(std::pair(placed[i], placed[(i + 1) % 3]), 0).second)
                return wrong("two triangles lie on each other");
        }
        shape.triangles.push_back(placed);
    }
    if (area != 2 * std::int64_t{cells} * cells)
        return wrong("the triangles do not cover the node's square once");
    const auto on_one_side = [&](const GridPoint& a, const GridPoint& b) {
        return (a.column == b.column && (a.column == first.column || a.column == first.column + cells)) ||
               (a.row == b.row && (a.row == first.row || a.row == first.row + cells));
    };
    for (const auto& [edge, unused] : edges) {
        const auto& [a, b] = edge;
        if (!edges.contains({b, a}) && !on_one_side(shape.posts[a].at, shape.posts[b].at))
            return wrong(fmt::format("an edge from column {}, row {} has a triangle on one side alone",
                                     shape.posts[a].at.column, shape.posts[a].at.row));
    }
    return shape;
}

Result<void> check_sides(const ChunkShape& shape, const ChunkMesh& old) {
    for (int side = 0; side < kSides; ++side) {
        const auto ours = shape.side(static_cast<Side>(side));
        const auto& theirs = old.sides[static_cast<std::size_t>(side)];
        bool same = ours.size() == theirs.size();
        for (std::size_t i = 0; same && i < ours.size(); ++i) {
            const ChunkVertex& vertex = old.vertices[theirs[i].vertex];
            same = shape.posts[ours[i]].at == vertex.at && shape.posts[ours[i]].H == vertex.H;
        }
        constexpr const char* kNames[] = {"west", "east", "north", "south"};
        if (!same)
            return wrong(fmt::format(
                "the vertices on its {} side are not those of the node ({} there, {} here): its neighbours "
                "would not fit; `relevo chunks extract` gives them",
                kNames[side], theirs.size(), ours.size()));
    }
    return {};
}

}  // namespace

std::string to_obj(const ChunkGeometry& geometry) {
    std::string text = "# v COLUMN ROW H: posts of the padded grid, metres\n";
    for (const auto& [at, H] : geometry.vertices) text += fmt::format("v {} {} {}\n", at.column, at.row, H);
    for (const auto& [a, b, c] : geometry.triangles) text += fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
    return text;
}

Result<ChunkGeometry> from_obj(const std::string& text, const std::string& name) {
    ChunkGeometry geometry;
    std::istringstream lines(text);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        std::istringstream words(line);
        std::string word;
        const auto wrong_line = [&](const char* what) {
            return wrong(fmt::format("{}, line {}: {}: {}", name, number, what, line));
        };
        if (!(words >> word) || word[0] == '#') continue;
        if (word == "v") {
            double column = 0, row = 0, H = 0;
            if (!(words >> column >> row >> H)) return wrong_line("a vertex is `v COLUMN ROW H`");
            if (std::abs(column) > 1e6 || std::abs(row) > 1e6 || column != std::round(column) ||
                row != std::round(row))
                return wrong_line("a vertex lies at a post: column and row are whole numbers");
            geometry.vertices.push_back(
                {{static_cast<int>(column), static_cast<int>(row)}, static_cast<float>(H)});
        } else if (word == "f") {
            IndexTriangle t{};
            for (std::uint32_t& corner : t) {
                long index = 0;
                if (!(words >> word)) return wrong_line("a face is `f A B C`");
                const auto parsed = std::from_chars(word.data(), word.data() + word.size(), index);
                // A/T/N names texture and normal, too: they are passed over.
                if (parsed.ec != std::errc() || (*parsed.ptr != '\0' && *parsed.ptr != '/') || index < 1 ||
                    static_cast<std::size_t>(index) > geometry.vertices.size())
                    return wrong_line("a face names vertices that stand before it, from 1 on");
                corner = static_cast<std::uint32_t>(index - 1);
            }
            if (words >> word) return wrong_line("a face is a triangle");
            geometry.triangles.push_back(t);
        }
    }
    if (geometry.triangles.empty()) return wrong(fmt::format("{}: no triangles (`f A B C`)", name));
    return geometry;
}

Result<double> replace_chunk(const Scene& scene, const Terrain& terrain, const ChunkId& id,
                             const ChunkGeometry& geometry) {
    const auto file = ChunkFile::open(scene, terrain);
    if (!file) return file.error();
    if (!file->index().has(id))
        return wrong(fmt::format("{}/{}/{}: no such node (leaves, of level 0, are the posts themselves)",
                                 id.level, id.column, id.row));
    const auto old = file->mesh(id);
    if (!old) return old.error();
    auto shape = shape_in(terrain, id, geometry);
    if (!shape) return shape.error();
    if (auto same = check_sides(*shape, **old); !same) return same.error();

    // The node itself, as it moves to its parent.
    std::vector<ChunkShape> judged{*shape};
    std::optional<ChunkShape> parent;
    std::optional<CoarseSurface> above;
    if (file->index().has(id.parent())) {
        const auto mesh = file->mesh(id.parent());
        if (!mesh) return mesh.error();
        parent = shape_of(terrain, **mesh);
        above.emplace(*parent);
        judged.push_back(moved(terrain, *shape, *above));
    }
    // Its children, as they move to it.
    const CoarseSurface here(*shape);
    std::vector<ChunkMesh> children;
    for (int i = 0; i < 4 && id.level > 1; ++i) {
        if (!file->index().has(id.child(i))) continue;
        const auto child = file->mesh(id.child(i));
        if (!child) return child.error();
        const ChunkShape child_shape = shape_of(terrain, **child);
        children.push_back(finished(child_shape, &here));
        children.back().error_m = (*child)->error_m;
        judged.push_back(moved(terrain, child_shape, here));
    }
    const auto errors = errors_in(terrain, id, judged);
    if (!errors) return errors.error();
    auto next = errors->begin();
    ChunkMesh mesh = finished(*shape, above ? &*above : nullptr);
    mesh.error_m = mesh.moved_error_m = *next++;
    if (above) mesh.moved_error_m = *next++;
    for (ChunkMesh& child : children) child.moved_error_m = *next++;

    auto writer = ChunkFileWriter::on_copy(scene.path() / ChunkFile::kName, file->index());
    if (!writer) return writer.error();
    Result<void> done = writer->put(writer->packed(terrain, mesh, ChunkRow::kReplaced));
    for (const ChunkMesh& child : children) {
        if (!done) break;
        const std::uint32_t flags = file->is_replaced(child.id) ? ChunkRow::kReplaced : 0;
        done = writer->put(writer->packed(terrain, child, flags));
    }
    if (done) done = writer->finish();
    if (!done) {
        writer->give_up();
        return done.error();
    }
    return mesh.error_m;
}

}  // namespace relevo::lod
