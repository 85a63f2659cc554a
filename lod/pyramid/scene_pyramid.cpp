#include "lod/pyramid/scene_pyramid.hpp"

#include <algorithm>
#include <cmath>
#include <compare>
#include <limits>
#include <optional>
#include <utility>

#include "geo/post_positions.hpp"
#include "lod/mesh_heights.hpp"
#include "lod/pyramid/block_cache.hpp"
#include "lod/pyramid/ground_normals.hpp"
#include "lod/pyramid/memory_pyramid.hpp"
#include "lod/scene/block_grid.hpp"
#include "lod/scene/level_grid.hpp"
#include "lod/soar/fine_metrics.hpp"
#include "lod/soar/metric_tile.hpp"
#include "lod/soar/metrics.hpp"

namespace relevo::lod {

namespace {

using Box = BlockGrid::Box;

constexpr float kVoid = std::numeric_limits<float>::quiet_NaN();

bool is_void(float H) {
    return std::isnan(H);
}

constexpr int kCells = Pyramid::kBlockCells;
static_assert(kCells == LevelGrid::kCells);
constexpr int kSide = kCells + 1;

/// The posts of a block in its level's grid.
Box box_of(const PyramidBlock& block) {
    return {kCells * block.column, kCells * block.row, kSide, kSide};
}

/// What of a block of the finest data is wanted again: heights, or 255 where there is sea.
struct FineBlock {
    Raster<float> heights;
    Raster<std::uint8_t> sea;
};

struct FineKey {
    enum class Kind { heights, sea, level_1 } kind;
    int column;
    int row;
    auto operator<=>(const FineKey&) const = default;
};

Raster<std::uint8_t> sea_of(const Raster<PostMark>& marks) {
    Raster<std::uint8_t> sea(marks.columns(), marks.rows());
    std::ranges::transform(marks.samples(), sea.samples().begin(), [](PostMark mark) {
        return static_cast<std::uint8_t>(mark.post_class() == PostClass::sea ? 255 : 0);
    });
    return sea;
}

/// Of a grid so small that it is one block.
Result<MemoryPyramid> read_whole(const Scene& scene, const UndulationGrid& undulations) {
    auto heights = scene.read_heights(0, 0);
    if (!heights) return heights.error();
    const auto marks = scene.read_marks(0, 0, *heights);
    if (!marks) return marks.error();
    const auto errors = scene.info().bounded_errors ? ObjectErrors::both : ObjectErrors::incremental;
    MetricRasters metrics = build_metrics(scene.info().frame, undulations, *heights, errors);
    return MemoryPyramid(scene.info().frame, *std::move(heights), std::move(metrics), sea_of(*marks));
}

}  // namespace

struct ScenePyramid::State {
    Scene scene;
    geo::PostPositions positions;
    UndulationGrid undulations;
    GroundNormals normals;
    std::optional<MemoryPyramid> whole;  // where top() is 0
    mutable BlockCache<FineKey, FineBlock> cache;

    State(Scene opened, std::uint64_t cache_bytes)
        : scene(std::move(opened)),
          positions(scene.info().frame),
          undulations(scene.undulations()),
          normals(scene.info().frame),
          cache(cache_bytes) {}

    const geo::GridFrame& frame() const { return scene.info().frame; }

    Result<std::shared_ptr<const FineBlock>> fine_block(const FineKey& key) const;
    Result<FineBlock> load(const FineKey& key) const;
    template <class T>
    Result<Raster<T>> read_posts(FineKey::Kind kind, Raster<T> FineBlock::*samples, const Box& box,
                                 T fill) const;
    Result<void> fill_even_posts(const PyramidBlock& own, const Box& window, Raster<float>& heights) const;
    struct Window {
        Box box;
        Raster<float> data;
        Raster<float> filled;
    };
    Result<Window> finest_window(const PyramidBlock& block, int halo) const;
    Result<VertexPosts> finest_vertices(const PyramidBlock& block, ErrorMetric metric) const;
    Result<GroundPosts> finest_ground(const PyramidBlock& block) const;
};

Result<FineBlock> ScenePyramid::State::load(const FineKey& key) const {
    FineBlock block;
    if (key.kind == FineKey::Kind::level_1) {
        if (!scene.has_level_block(1, key.column, key.row)) {
            block.heights = Raster<float>(kSide, kSide);
            return block;
        }
        auto heights = scene.read_level_heights(1, key.column, key.row);
        if (!heights) return heights.error();
        block.heights = *std::move(heights);
        return block;
    }
    if (key.kind == FineKey::Kind::heights) {
        auto heights = scene.read_heights(key.column, key.row);
        if (!heights) return heights.error();
        block.heights = *std::move(heights);
        return block;
    }
    const auto fine = fine_block({FineKey::Kind::heights, key.column, key.row});
    if (!fine) return fine.error();
    const auto marks = scene.read_marks(key.column, key.row, (*fine)->heights);
    if (!marks) return marks.error();
    block.sea = sea_of(*marks);
    return block;
}

Result<std::shared_ptr<const FineBlock>> ScenePyramid::State::fine_block(const FineKey& key) const {
    constexpr std::uint64_t kPosts = std::uint64_t{SceneInfo::kBlockSide} * SceneInfo::kBlockSide;
    std::uint64_t bytes = kPosts * sizeof(float);
    if (key.kind == FineKey::Kind::sea) bytes = kPosts;
    if (key.kind == FineKey::Kind::level_1) bytes = std::uint64_t{kSide} * kSide * sizeof(float);
    return cache.get(key, bytes, [&] { return load(key); });
}

/// What the data has in a box of its posts. \pre the box begins in the padded grid
template <class T>
Result<Raster<T>> ScenePyramid::State::read_posts(FineKey::Kind kind, Raster<T> FineBlock::*samples,
                                                  const Box& box, T fill) const {
    Raster<T> posts(box.columns, box.rows, fill);
    constexpr int side = SceneInfo::kBlockSide;
    const int right = std::min(box.column + box.columns, frame().columns);
    const int bottom = std::min(box.row + box.rows, frame().rows);
    for (int block_row = box.row / side; block_row * side < bottom; ++block_row) {
        for (int block_column = box.column / side; block_column * side < right; ++block_column) {
            const auto block = fine_block({kind, block_column, block_row});
            if (!block) return block.error();
            const Raster<T>& from = (**block).*samples;
            const int first_column = std::max(block_column * side, box.column);
            const int first_row = std::max(block_row * side, box.row);
            const Raster<T> part =
                part_of(from, {first_column - block_column * side, first_row - block_row * side,
                               box.column + box.columns - first_column, box.row + box.rows - first_row});
            if (part.columns() > 0) paste(part, {first_column - box.column, first_row - box.row}, posts);
        }
    }
    return posts;
}

/// Posts at even columns and rows that have no height take that of level 1: on the border of blocks that of
/// the block of level 1 which holds the window's own, as its neighbour may not be stored.
Result<void> ScenePyramid::State::fill_even_posts(const PyramidBlock& own, const Box& window,
                                                  Raster<float>& heights) const {
    const auto holding = [](int post, int own_block) {
        const int from_own = post - kCells * own_block;
        return from_own >= 0 && from_own <= kCells ? own_block : post / kCells;
    };
    std::shared_ptr<const FineBlock> known;
    int known_column = -1;
    int known_row = -1;
    for (int row = window.row % 2; row < window.rows; row += 2) {
        for (int column = window.column % 2; column < window.columns; column += 2) {
            float& H = heights.at(column, row);
            if (!std::isnan(H)) continue;
            const int x = (window.column + column) / 2;
            const int y = (window.row + row) / 2;
            const int block_column = holding(x, own.column / 2);
            const int block_row = holding(y, own.row / 2);
            if (block_column != known_column || block_row != known_row) {
                auto block = fine_block({FineKey::Kind::level_1, block_column, block_row});
                if (!block) return block.error();
                known = *std::move(block);
                known_column = block_column;
                known_row = block_row;
            }
            H = known->heights.at(x - kCells * block_column, y - kCells * block_row);
        }
    }
    return {};
}

/// The block's posts and some around them.
Result<ScenePyramid::State::Window> ScenePyramid::State::finest_window(const PyramidBlock& block,
                                                                       int halo) const {
    Window window{MetricTile::window_of(box_of(block), frame().padded_side(), halo), {}, {}};
    auto data = read_posts(FineKey::Kind::heights, &FineBlock::heights, window.box, kVoid);
    if (!data) return data.error();
    window.data = *std::move(data);
    window.filled = window.data;
    if (std::ranges::any_of(window.filled.samples(), is_void)) {
        if (auto done = fill_even_posts(block, window.box, window.filled); !done) return done.error();
        fill_odd_posts({window.box.column, window.box.row}, frame().levels(), window.filled);
    }
    return window;
}

Result<VertexPosts> ScenePyramid::State::finest_vertices(const PyramidBlock& block,
                                                         ErrorMetric metric) const {
    VertexPosts posts{Raster<float>(kSide, kSide), Raster<std::uint16_t>(kSide, kSide),
                      Raster<std::uint16_t>(kSide, kSide)};
    if (!scene.has_level_block(1, block.column / 2, block.row / 2)) return posts;
    // The vertices' diamonds reach one post beyond the block, and posts there lie between others where they
    // are void.
    constexpr int kHalo = 2;
    const auto window = finest_window(block, kHalo);
    if (!window) return window.error();
    const Box box = box_of(block);
    const Box inside{box.column - window->box.column, box.row - window->box.row, kSide, kSide};
    posts.heights = part_of(window->filled, inside);
    if (std::ranges::all_of(window->data.samples(), is_void)) return posts;
    const MetricTile tile(positions, undulations, window->box, window->data, window->filled);
    const bool bounded = metric == ErrorMetric::bounded;
    const MetricRasters codes =
        fine_metrics(tile, frame().levels(), 1, bounded ? ObjectErrors::both : ObjectErrors::incremental);
    posts.error = part_of(bounded ? codes.bounded : codes.incremental, inside);
    posts.radius = part_of(codes.radius, inside);
    return posts;
}

Result<GroundPosts> ScenePyramid::State::finest_ground(const PyramidBlock& block) const {
    GroundPosts posts{Raster<float>(kSide, kSide, kVoid), Raster<GroundPosts::Normal>(kSide, kSide),
                      Raster<std::uint8_t>(kSide, kSide)};
    Box box = box_of(block);
    box.columns = std::min(box.columns, frame().columns - box.column);
    box.rows = std::min(box.rows, frame().rows - box.row);
    if (box.columns <= 0 || box.rows <= 0) return posts;
    const auto around = with_border(frame(), box, [&](const Box& part) {
        return read_posts(FineKey::Kind::heights, &FineBlock::heights, part, kVoid);
    });
    if (!around) return around.error();
    paste(part_of(*around, {1, 1, box.columns, box.rows}), {}, posts.heights);
    paste(normals.of(box, *around), {}, posts.normals);
    if (scene.info().sea_posts == 0) return posts;
    const auto sea = read_posts(FineKey::Kind::sea, &FineBlock::sea, box, std::uint8_t{0});
    if (!sea) return sea.error();
    paste(*sea, {}, posts.is_sea);
    return posts;
}

ScenePyramid::ScenePyramid(std::unique_ptr<State> state) : state_(std::move(state)) {}
ScenePyramid::ScenePyramid(ScenePyramid&&) noexcept = default;
ScenePyramid& ScenePyramid::operator=(ScenePyramid&&) noexcept = default;
ScenePyramid::~ScenePyramid() = default;

Result<ScenePyramid> ScenePyramid::open(Scene scene, std::uint64_t cache_bytes) {
    auto state = std::make_unique<State>(std::move(scene), cache_bytes);
    if (LevelGrid::top(state->frame().levels()) == 0) {
        auto whole = read_whole(state->scene, state->undulations);
        if (!whole) return whole.error();
        state->whole.emplace(*std::move(whole));
    }
    return ScenePyramid(std::move(state));
}

const geo::GridFrame& ScenePyramid::frame() const {
    return state_->frame();
}

Result<VertexPosts> ScenePyramid::read_vertices(const PyramidBlock& block, ErrorMetric metric) const {
    const Scene& scene = state_->scene;
    if (!scene.info().bounded_errors) metric = ErrorMetric::incremental;
    if (state_->whole) return state_->whole->read_vertices(block, metric);
    if (block.level == 0) return state_->finest_vertices(block, metric);
    if (!scene.has_level_block(block.level, block.column, block.row)) {
        return VertexPosts{Raster<float>(kSide, kSide), Raster<std::uint16_t>(kSide, kSide),
                           Raster<std::uint16_t>(kSide, kSide)};
    }
    auto heights = scene.read_level_heights(block.level, block.column, block.row);
    if (!heights) return heights.error();
    auto codes = scene.read_codes(block.level, block.column, block.row, metric);
    if (!codes) return codes.error();
    return VertexPosts{*std::move(heights), std::move(codes->error), std::move(codes->radius)};
}

Result<GroundPosts> ScenePyramid::read_ground(const PyramidBlock& block) const {
    const Scene& scene = state_->scene;
    if (state_->whole) return state_->whole->read_ground(block);
    if (block.level == 0) return state_->finest_ground(block);
    GroundPosts posts{Raster<float>(kSide, kSide, kVoid), Raster<GroundPosts::Normal>(kSide, kSide),
                      Raster<std::uint8_t>(kSide, kSide)};
    if (!scene.has_level_block(block.level, block.column, block.row)) return posts;
    const auto heights = scene.read_level_heights(block.level, block.column, block.row);
    if (!heights) return heights.error();
    auto ground = scene.read_level_ground(block.level, block.column, block.row);
    if (!ground) return ground.error();
    posts.normals = std::move(ground->normals);
    for (std::size_t i = 0; i < ground->classes.samples().size(); ++i) {
        const auto known = static_cast<PostClass>(ground->classes.samples()[i]);
        if (known != PostClass::void_post) posts.heights.samples()[i] = heights->samples()[i];
        if (known == PostClass::sea) posts.is_sea.samples()[i] = 255;
    }
    return posts;
}

Result<BlockHeights> ScenePyramid::read_heights(const PyramidBlock& block) const {
    const Scene& scene = state_->scene;
    if (state_->whole) return state_->whole->read_heights(block);
    const int parent = 1 << std::max(1 - block.level, 0);
    if (!scene.has_level_block(std::max(block.level, 1), block.column / parent, block.row / parent))
        return BlockHeights{Raster<float>(kSide, kSide), Raster<float>(kSide, kSide, kVoid)};
    if (block.level == 0) {
        // Posts at odd places lie between others where they are void.
        const auto window = state_->finest_window(block, 2);
        if (!window) return window.error();
        const Box box = box_of(block);
        const Box inside{box.column - window->box.column, box.row - window->box.row, kSide, kSide};
        return BlockHeights{part_of(window->filled, inside), part_of(window->data, inside)};
    }
    auto heights = scene.read_level_heights(block.level, block.column, block.row);
    if (!heights) return heights.error();
    const auto ground = scene.read_level_ground(block.level, block.column, block.row);
    if (!ground) return ground.error();
    Raster<float> data = *heights;
    for (std::size_t i = 0; i < data.samples().size(); ++i) {
        if (ground->classes.samples()[i] == static_cast<std::uint8_t>(PostClass::void_post))
            data.samples()[i] = kVoid;
    }
    return BlockHeights{*std::move(heights), std::move(data)};
}

}  // namespace relevo::lod
