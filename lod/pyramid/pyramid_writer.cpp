#include "lod/pyramid/pyramid_writer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

#include "lod/scene/level_grid.hpp"
#include "lod/scene/parallel_blocks.hpp"
#include "lod/scene/scene_files.hpp"

namespace relevo::lod {

namespace {

using Box = BlockGrid::Box;
using Codes = Raster<std::uint16_t>;

constexpr int kTile = SceneInfo::kBlockSide;
static_assert(kTile == 2 * LevelGrid::kCells, "a tile is a block of level 1");
constexpr int kTilesOfGroup = 4;
constexpr int kLatticeLevel = 3;
static_assert(BlockGrid::kLatticeSpacing == 1 << kLatticeLevel);
constexpr std::array kMetrics{&MetricRasters::bounded, &MetricRasters::incremental, &MetricRasters::radius};

/// What is stored of a block of a level, or of a part of it.
struct LevelPosts {
    Raster<float> heights;
    MetricRasters codes;
    Ground ground;

    explicit LevelPosts(int side = LevelGrid::kPosts)
        : heights(side, side),
          codes{Codes(side, side), Codes(side, side), Codes(side, side)},
          ground(side, side) {}
};

void paste_all(const LevelPosts& part, const Box& box, LevelPosts& into) {
    paste(part.heights, box, into.heights);
    for (const auto metric : kMetrics) paste(part.codes.*metric, box, into.codes.*metric);
    paste(part.ground.normals, box, into.ground.normals);
    paste(part.ground.classes, box, into.ground.classes);
}

Ground part_of(const Ground& ground, const Box& box) {
    Ground part;
    part.normals = part_of(ground.normals, box);
    part.classes = part_of(ground.classes, box);
    return part;
}

void paste(const Ground& part, const Box& box, Ground& into) {
    if (part.classes.columns() == 0) return;
    paste(part.normals, box, into.normals);
    paste(part.classes, box, into.classes);
}

Ground every_second(const Ground& fine) {
    return every_second(fine, {0, 0, (fine.classes.columns() + 1) / 2, (fine.classes.rows() + 1) / 2});
}

/// Takes each 2^shift-th code, beginning at a post.
void take(const MetricRasters& from, int column, int row, int shift, MetricRasters& to) {
    for (const auto metric : kMetrics) {
        Codes& codes = to.*metric;
        for (int y = 0; y < codes.rows(); ++y) {
            const std::uint16_t* line = (from.*metric).row(row + (y << shift)) + column;
            for (int x = 0; x < codes.columns(); ++x) codes.at(x, y) = line[x << shift];
        }
    }
}

/// What coarser levels have is theirs alone.
void keep_new_vertices(MetricRasters& codes) {
    for (const auto metric : kMetrics) {
        Codes& all = codes.*metric;
        for (int row = 0; row < all.rows(); row += 2) {
            for (int column = 0; column < all.columns(); column += 2) all.at(column, row) = 0;
        }
    }
}

/// The finest posts of a tile with its borders, and around it as far as means of its posts reach.
struct Finest {
    Box box{};              ///< of the data; of no size where the tile has none
    Raster<float> heights;  ///< with a border, as of with_border
    Ground ground;

    /// NaN outside of the data.
    float height(int column, int row) const {
        const int x = column - box.column;
        const int y = row - box.row;
        return x < box.columns && y < box.rows ? heights.at(x + 1, y + 1)
                                               : std::numeric_limits<float>::quiet_NaN();
    }
};

}  // namespace

struct PyramidWriter::State {
    struct Layers {
        BlockStore heights;
        BlockStore vertices;
    };
    struct Group {
        LevelPosts block;
        int tiles = 0;
    };

    geo::GridFrame frame;
    int top;
    HeightType type;
    const MeshHeights& fill;
    ReadPosts read;
    GroundNormals normals;
    std::vector<Layers> layers;                                    // from level 1
    Ground lattice;                                                // of the data's posts on it
    std::mutex mutex;                                              // of the groups
    std::map<std::pair<int, int>, std::unique_ptr<Group>> groups;  // by row and column of a block of level 2
    std::optional<LevelPosts> coarsest;  // a top above the lattice's level, until that is known

    Result<Finest> finest_of(const Box& tile) const;
    Result<void> write(int level, int column, int row, const LevelPosts& block);
    Result<void> write_or_keep(int level, int column, int row, LevelPosts block);
    Result<void> add_to_group(int tile_column, int tile_row, const LevelPosts& part);
    Result<void> write_lattice_level(int level, const Ground& ground, const MetricRasters& codes);
};

PyramidWriter::PyramidWriter(std::unique_ptr<State> state) : state_(std::move(state)) {}
PyramidWriter::PyramidWriter(PyramidWriter&&) noexcept = default;
PyramidWriter& PyramidWriter::operator=(PyramidWriter&&) noexcept = default;
PyramidWriter::~PyramidWriter() = default;

Result<PyramidWriter> PyramidWriter::open(const SceneWriter& writer, const geo::GridFrame& frame,
                                          HeightType type, const MeshHeights& fill, ReadPosts read) {
    const int top = LevelGrid::top(frame.levels());
    std::vector<State::Layers> layers;
    for (int level = 1; level <= top; ++level) {
        auto heights = writer.layer(level_folder(kHeightsFolder, level));
        if (!heights) return heights.error();
        auto vertices = writer.layer(level_folder(kVerticesFolder, level));
        if (!vertices) return vertices.error();
        layers.push_back({*std::move(heights), *std::move(vertices)});
    }
    Ground lattice(LevelGrid::posts_at(frame.columns, kLatticeLevel),
                   LevelGrid::posts_at(frame.rows, kLatticeLevel));
    return PyramidWriter(std::unique_ptr<State>(new State{frame,
                                                          top,
                                                          type,
                                                          fill,
                                                          std::move(read),
                                                          GroundNormals(frame),
                                                          std::move(layers),
                                                          std::move(lattice),
                                                          {},
                                                          {},
                                                          {}}));
}

PyramidWriter::Tile PyramidWriter::tile_in_order(const BlockGrid& tiles, int i) {
    if (tiles.across == 1) return {0, 0};
    const int group = i / kTilesOfGroup;
    const int groups_across = tiles.across / 2;
    return {2 * (group % groups_across) + i % 2, 2 * (group / groups_across) + i % kTilesOfGroup / 2};
}

Result<void> PyramidWriter::add_tile(int tile_column, int tile_row, const MetricRasters& codes) {
    State& state = *state_;
    if (state.top == 0) return {};
    const Box tile{tile_column * kTile, tile_row * kTile, kTile + 1, kTile + 1};
    const auto finest = state.finest_of(tile);
    if (!finest) return finest.error();

    LevelPosts first;
    for (int y = 0; y < LevelGrid::kPosts; ++y) {
        for (int x = 0; x < LevelGrid::kPosts; ++x) {
            const int column = tile.column + 2 * x;
            const int row = tile.row + 2 * y;
            const float H = finest->height(column, row);
            first.heights.at(x, y) = std::isnan(H) ? state.fill.fill(column, row) : H;
        }
    }
    take(codes, 0, 0, 1, first.codes);
    LevelPosts second(LevelGrid::kCells / 2 + 1);
    for (int y = 0; y < second.heights.rows(); ++y) {
        for (int x = 0; x < second.heights.columns(); ++x)
            second.heights.at(x, y) = first.heights.at(2 * x, 2 * y);
    }
    take(codes, 0, 0, 2, second.codes);

    if (finest->box.columns > 0) {
        const int left = tile.column - finest->box.column;
        const int above = tile.row - finest->box.row;
        const auto tile_at = [&](int level) {
            return Box{left >> level, above >> level, (kTile >> level) + 1, (kTile >> level) + 1};
        };
        const Ground at_first = every_second(finest->ground);
        paste(part_of(at_first, tile_at(1)), {}, first.ground);
        const Ground at_second = every_second(at_first);
        paste(part_of(at_second, tile_at(2)), {}, second.ground);
        // Each tile its own posts of the lattice; the grid's last ones are the last tiles'.
        Box own = tile_at(kLatticeLevel);
        if (tile.column + tile.columns < state.frame.padded_side()) --own.columns;
        if (tile.row + tile.rows < state.frame.padded_side()) --own.rows;
        paste(part_of(every_second(at_second), own),
              {tile.column >> kLatticeLevel, tile.row >> kLatticeLevel}, state.lattice);
    }
    if (state.top > 1) {
        if (auto done = state.add_to_group(tile_column, tile_row, second); !done) return done;
        keep_new_vertices(first.codes);
    }
    return state.write_or_keep(1, tile_column, tile_row, std::move(first));
}

Result<Finest> PyramidWriter::State::finest_of(const Box& tile) const {
    Finest finest;
    if (tile.column >= frame.columns || tile.row >= frame.rows) return finest;
    // Means of means of means reach 1 + 2 + 4 posts around one of the lattice, which is one of eight.
    constexpr int kReach = BlockGrid::kLatticeSpacing;
    Box& box = finest.box;
    box.column = std::max(tile.column - kReach, 0);
    box.row = std::max(tile.row - kReach, 0);
    box.columns = std::min(tile.column + tile.columns + kReach, frame.columns) - box.column;
    box.rows = std::min(tile.row + tile.rows + kReach, frame.rows) - box.row;
    finest.ground = Ground(box.columns, box.rows);
    bool has_classes = false;
    auto heights = with_border(frame, box, [&](const Box& part) -> Result<Raster<float>> {
        auto posts = read(part);
        if (!posts) return posts.error();
        if (!has_classes) {  // the first part is all but what lies beyond a seam
            for (int row = 0; row < box.rows; ++row) {
                const PostMark* marks =
                    posts->marks.row(box.row - part.row + row) + (box.column - part.column);
                std::uint8_t* classes = finest.ground.classes.row(row);
                for (int column = 0; column < box.columns; ++column)
                    classes[column] = static_cast<std::uint8_t>(marks[column].post_class());
            }
            has_classes = true;
        }
        return std::move(posts->heights);
    });
    if (!heights) return heights.error();
    finest.heights = *std::move(heights);
    finest.ground.normals = normals.of(box, finest.heights);
    return finest;
}

/// Nothing is stored of a block in whose vertices' diamonds nothing is valid.
Result<void> PyramidWriter::State::write(int level, int column, int row, const LevelPosts& block) {
    Layers& layer = layers[static_cast<std::size_t>(level) - 1];
    std::vector<std::byte> heights;
    std::vector<std::byte> vertices;
    if (std::ranges::any_of(block.codes.radius.samples(), [](std::uint16_t code) { return code != 0; })) {
        auto encoded_heights = encode_level_heights(block.heights, type);
        if (!encoded_heights) return encoded_heights.error();
        heights = *std::move(encoded_heights);
        auto encoded_vertices = encode_vertices(block.codes, block.ground);
        if (!encoded_vertices) return encoded_vertices.error();
        vertices = *std::move(encoded_vertices);
    }
    if (auto done = layer.heights.write(column, row, heights); !done) return done;
    return layer.vertices.write(column, row, vertices);
}

Result<void> PyramidWriter::State::write_or_keep(int level, int column, int row, LevelPosts block) {
    if (level < top) return write(level, column, row, block);
    coarsest = std::move(block);
    return {};
}

Result<void> PyramidWriter::State::add_to_group(int tile_column, int tile_row, const LevelPosts& part) {
    const int column = tile_column / 2;
    const int row = tile_row / 2;
    const int half = LevelGrid::kCells / 2;
    std::unique_ptr<Group> whole;
    {
        // Borders are given twice, alike.
        const std::lock_guard lock(mutex);
        std::unique_ptr<Group>& group = groups[{row, column}];
        if (!group) group = std::make_unique<Group>();
        paste_all(part, {half * (tile_column % 2), half * (tile_row % 2)}, group->block);
        if (++group->tiles < kTilesOfGroup) return {};
        whole = std::move(group);
        groups.erase({row, column});
    }
    if (top > 2) keep_new_vertices(whole->block.codes);
    return write_or_keep(2, column, row, std::move(whole->block));
}

Result<void> PyramidWriter::State::write_lattice_level(int level, const Ground& ground,
                                                       const MetricRasters& codes) {
    const int across = LevelGrid::blocks(frame.levels(), level);
    return for_each_block(across * across, [&](int i) {
        const int column = LevelGrid::kCells * (i % across);
        const int row = LevelGrid::kCells * (i / across);
        LevelPosts block;
        for (int y = 0; y < LevelGrid::kPosts; ++y) {
            for (int x = 0; x < LevelGrid::kPosts; ++x)
                block.heights.at(x, y) = fill.lattice((column + x) << level, (row + y) << level);
        }
        const int shift = level - kLatticeLevel;
        take(codes, column << shift, row << shift, shift, block.codes);
        if (level < top) keep_new_vertices(block.codes);
        paste(part_of(ground, {column, row, LevelGrid::kPosts, LevelGrid::kPosts}), {}, block.ground);
        return write(level, i % across, i / across, block);
    });
}

Result<void> PyramidWriter::finish(const MetricRasters& codes) {
    State& state = *state_;
    if (state.coarsest) {
        const int spacing = 1 << (kLatticeLevel - state.top);
        for (const auto metric : kMetrics) {
            const Codes& lattice = codes.*metric;
            for (int y = 0; y < lattice.rows(); ++y) {
                for (int x = 0; x < lattice.columns(); ++x)
                    (state.coarsest->codes.*metric).at(spacing * x, spacing * y) = lattice.at(x, y);
            }
        }
        return state.write(state.top, 0, 0, *state.coarsest);
    }
    Ground ground = std::move(state.lattice);
    for (int level = kLatticeLevel; level <= state.top; ++level) {
        if (level > kLatticeLevel) ground = every_second(ground);
        if (auto done = state.write_lattice_level(level, ground, codes); !done) return done;
    }
    return {};
}

}  // namespace relevo::lod
