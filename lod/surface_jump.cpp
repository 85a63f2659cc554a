#include "lod/surface_jump.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

namespace relevo::lod {

namespace {

constexpr std::uint32_t kNone = ~std::uint32_t{0};

std::uint32_t key_of(const MeshVertex& v) {
    return (static_cast<std::uint32_t>(v.row) << 16) | v.column;
}

glm::dvec3 offset_of(const MeshVertex& v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

/// The vertices that a mesh's triangles have, by their posts.
class VertexTable {
  public:
    explicit VertexTable(const Mesh& mesh) : mesh_(mesh) {
        slots_.assign(std::bit_ceil(2 * mesh.vertices.size() + 2), kNone);
        std::vector<bool> seen(mesh.vertices.size());
        for (const std::uint32_t index : mesh.indices) {
            if (seen[index]) continue;
            seen[index] = true;
            std::uint32_t& slot = slot_of(key_of(mesh.vertices[index]));
            if (slot != kNone) continue;  // the same post a second time
            slot = index;
            indices_.push_back(index);
        }
    }

    /// Each post once.
    const std::vector<std::uint32_t>& indices() const { return indices_; }

    const MeshVertex* find(std::uint32_t key) {
        const std::uint32_t index = slot_of(key);
        return index == kNone ? nullptr : &mesh_.vertices[index];
    }

  private:
    std::uint32_t& slot_of(std::uint32_t key) {
        const std::size_t mask = slots_.size() - 1;
        std::size_t at = (key * 0x9e3779b1u >> 7) & mask;
        while (slots_[at] != kNone && key_of(mesh_.vertices[slots_[at]]) != key) at = (at + 1) & mask;
        return slots_[at];
    }

    const Mesh& mesh_;
    std::vector<std::uint32_t> slots_;
    std::vector<std::uint32_t> indices_;
};

/// A post of one mesh that is not a vertex of the other.
struct Loose {
    int column;
    int row;
    glm::dvec3 offset;  // of the mesh that has it
};

/// Calls `found(post, offset)` with the mesh's surface at each of the posts that is under a triangle, once.
template <class Found>
void locate(const Mesh& mesh, const std::vector<Loose>& posts, Found&& found) {
    if (posts.empty()) return;
    // The posts in squares of the grid, so that a triangle looks only at those nearby.
    int last = 0;
    for (const Loose& post : posts) last = std::max({last, post.column, post.row});
    const int shift = std::max(0, static_cast<int>(std::bit_width(static_cast<unsigned>(last))) - 10);
    const int side = (last >> shift) + 1;
    const auto square = [&](int column, int row) {
        return static_cast<std::size_t>(row >> shift) * static_cast<std::size_t>(side) +
               static_cast<std::size_t>(column >> shift);
    };
    std::vector<std::uint32_t> begin(static_cast<std::size_t>(side) * static_cast<std::size_t>(side) + 1);
    for (const Loose& post : posts) ++begin[square(post.column, post.row) + 1];
    for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
    std::vector<std::uint32_t> sorted(posts.size());
    auto next = begin;
    for (std::size_t i = 0; i < posts.size(); ++i)
        sorted[next[square(posts[i].column, posts[i].row)]++] = static_cast<std::uint32_t>(i);

    std::vector<bool> done(posts.size());
    for (std::size_t k = 0; k < mesh.indices.size(); k += 3) {
        const MeshVertex& a = mesh.vertices[mesh.indices[k]];
        const MeshVertex& b = mesh.vertices[mesh.indices[k + 1]];
        const MeshVertex& c = mesh.vertices[mesh.indices[k + 2]];
        const auto [left, right] = std::minmax<int>({a.column, b.column, c.column});
        const auto [top, bottom] = std::minmax<int>({a.row, b.row, c.row});
        const auto cross = [](const MeshVertex& p, const MeshVertex& q, int column, int row) {
            return static_cast<double>(q.column - p.column) * (row - p.row) -
                   static_cast<double>(q.row - p.row) * (column - p.column);
        };
        const double area = cross(a, b, c.column, c.row);
        for (int y = top >> shift; y <= std::min(bottom >> shift, side - 1); ++y) {
            for (int x = left >> shift; x <= std::min(right >> shift, side - 1); ++x) {
                const std::size_t s = static_cast<std::size_t>(y) * static_cast<std::size_t>(side) +
                                      static_cast<std::size_t>(x);
                for (std::uint32_t i = begin[s]; i < begin[s + 1]; ++i) {
                    const Loose& post = posts[sorted[i]];
                    if (done[sorted[i]]) continue;
                    const double u = cross(b, c, post.column, post.row) / area;
                    const double v = cross(c, a, post.column, post.row) / area;
                    const double w = cross(a, b, post.column, post.row) / area;
                    if (!(u >= 0 && v >= 0 && w >= 0)) continue;
                    done[sorted[i]] = true;
                    found(post, u * offset_of(a) + v * offset_of(b) + w * offset_of(c));
                }
            }
        }
    }
}

}  // namespace

std::optional<SurfaceJump> surface_jump(const Mesh& before, const geo::Ecef& eye_before, const Mesh& after,
                                        const View& view, int columns, int rows) {
    const glm::dvec3 shift = eye_before - view.eye();  // offsets of `before`, seen from the view's eye
    const double diagonal = std::hypot(view.camera().width, view.camera().height);
    std::vector<double> jumps;
    const auto compare = [&](const glm::dvec3& was, const glm::dvec3& is) {
        if (!view.sees(is)) return;
        jumps.push_back(view.depth(was) > View::kNearM ? glm::distance(view.pixel(was), view.pixel(is))
                                                       : diagonal);
    };
    const auto in_data = [&](const MeshVertex& v) { return v.column < columns && v.row < rows; };

    VertexTable old_table(before);
    VertexTable new_table(after);
    std::vector<Loose> appeared;
    for (const std::uint32_t index : new_table.indices()) {
        const MeshVertex& v = after.vertices[index];
        const glm::dvec3 offset = offset_of(v);
        if (!in_data(v) || !view.sees(offset)) continue;
        if (const MeshVertex* was = old_table.find(key_of(v))) {
            compare(offset_of(*was) + shift, offset);
        } else {
            appeared.push_back({v.column, v.row, offset});
        }
    }
    std::vector<Loose> gone;
    for (const std::uint32_t index : old_table.indices()) {
        const MeshVertex& v = before.vertices[index];
        if (!in_data(v) || new_table.find(key_of(v)) != nullptr) continue;
        gone.push_back({v.column, v.row, offset_of(v) + shift});
    }
    locate(before, appeared,
           [&](const Loose& post, const glm::dvec3& was) { compare(was + shift, post.offset); });
    locate(after, gone, [&](const Loose& post, const glm::dvec3& is) { compare(post.offset, is); });

    if (jumps.empty()) return std::nullopt;
    SurfaceJump result;
    result.vertices = jumps.size();
    result.max_px = *std::max_element(jumps.begin(), jumps.end());
    const auto p99 =
        jumps.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(jumps.size() - 1));
    std::nth_element(jumps.begin(), p99, jumps.end());
    result.p99_px = *p99;
    return result;
}

}  // namespace relevo::lod
