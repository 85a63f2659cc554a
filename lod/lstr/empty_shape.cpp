#include "lod/lstr/empty_shape.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "lod/lstr/border_line.hpp"

namespace relevo::lod {

ChunkShape empty_shape(const PostField& field, const ChunkId& id, const ChunkErrors& errors) {
    const GridPoint first = id.first();
    const int cells = id.cells();
    const auto side_of = [&](bool along_row, int line) {
        // Level by level, from all posts on.
        std::vector<PlacedPost> posts;
        for (int i = 0; i <= cells; i += field.stride()) {
            posts.push_back(
                field.post(along_row ? GridPoint{first.column + i, line} : GridPoint{line, first.row + i}));
        }
        for (int level = 1; level <= id.level; ++level) {
            std::vector<PlacedPost> coarser;
            const int step = ChunkId::kLeafCells << level;
            for (int begin = 0; begin < cells; begin += step) {
                std::vector<const PlacedPost*> part;
                for (const PlacedPost& post : posts) {
                    const int place = along_row ? post.at.column - first.column : post.at.row - first.row;
                    if (place >= begin && place <= begin + step) part.push_back(&post);
                }
                const std::vector<bool> kept = border_line(field, part, errors.of_side(level));
                for (std::size_t i = begin == 0 ? 0 : 1; i < part.size(); ++i) {
                    if (kept[i]) coarser.push_back(*part[i]);
                }
            }
            posts = std::move(coarser);
        }
        return posts;
    };
    // Counter-clockwise from the north-west.
    std::vector<PlacedPost> around = side_of(false, first.column);
    const auto append = [&](std::vector<PlacedPost> posts, bool backwards) {
        if (backwards) std::reverse(posts.begin(), posts.end());
        around.insert(around.end(), posts.begin() + 1, posts.end());
    };
    append(side_of(true, first.row + cells), false);
    append(side_of(false, first.column + cells), true);
    append(side_of(true, first.row), true);
    around.pop_back();

    ChunkShape shape{id, around, {}, 0};
    shape.posts.push_back(field.post({first.column + cells / 2, first.row + cells / 2}));
    std::sort(shape.posts.begin(), shape.posts.end(), is_before);
    const auto place = [&](const PlacedPost& post) { return place_of(shape.posts, post); };
    const std::uint32_t middle = place(field.post({first.column + cells / 2, first.row + cells / 2}));
    for (std::size_t i = 0; i < around.size(); ++i)
        shape.triangles.push_back({middle, place(around[i]), place(around[(i + 1) % around.size()])});
    return shape;
}

}  // namespace relevo::lod
