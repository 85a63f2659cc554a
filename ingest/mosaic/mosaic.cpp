#include "ingest/mosaic/mosaic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "ingest/mosaic/feather.hpp"
#include "ingest/mosaic/layer.hpp"
#include "ingest/mosaic/layer_error.hpp"
#include "ingest/mosaic/layer_in_scene.hpp"
#include "ingest/reference/vertical_datum.hpp"
#include "ingest/refusal.hpp"
#include "ingest/source/source_pool.hpp"
#include "lod/scene/parallel_blocks.hpp"

namespace relevo::ingest {

struct Mosaic::State {
    explicit State(SourcePool&& opened) : pool(std::move(opened)) {}

    SourcePool pool;
    std::vector<Layer> layers;  // as make_layers orders them
    std::vector<LayerInScene> in_scene;
    geo::GridFrame frame;
    lod::VerticalReference vertical;
    std::optional<Feather> feather;
    bool cropped = false;
    std::vector<std::string> notes;

    Result<MosaicPosts> posts(Window window) const;
    Result<MosaicPosts> joined(Window window) const;
    Result<MosaicPosts> blended(Window window) const;
    Result<void> join_edges(Window window, MosaicPosts& into) const;
};

namespace {

PostGrid post_grid(const Layer& layer) {
    PostGrid grid{&layer.crs(), layer.posts(), layer.map(), {}, layer.spacing_m()};
    for (const Layer::Member& member : layer.members()) grid.parts.push_back(layer.map_of(member));
    return grid;
}

/// The layer whose posts are closest.
const Layer& finest_of(const std::vector<Layer>& layers) {
    return *std::min_element(layers.begin(), layers.end(),
                             [](const Layer& a, const Layer& b) { return a.spacing_m() < b.spacing_m(); });
}

using GeoidPtr = std::shared_ptr<const geo::Geoid>;

/// The geoids that a mosaic needs, each read once.
class Geoids {
  public:
    Geoids(const std::optional<std::filesystem::path>& file, const geo::GridFrame& frame) : file_(file) {
        const auto e = frame.extent();
        area_ = {e.west, e.south, e.east, e.north};
    }

    Result<GeoidPtr> find(const lod::VerticalReference& reference) {
        const auto known = found_.find(reference.name);
        if (known != found_.end()) return known->second;
        // One file cannot be the geoid of two datums: a conversion between them would do nothing, silently.
        const bool by_file = file_ && reference.datum == lod::VerticalDatum::other;
        if (by_file && !served_by_file_.empty())
            return Error{
                ErrorKind::input,
                fmt::format("--geoid is one grid, but heights are above both {} and {}. Give --vertical "
                            "where a file's datum is known to be another, or convert one of them first",
                            served_by_file_, reference.name)};
        auto geoid = geoid_of(reference, file_, area_);
        if (!geoid) return geoid.error();
        if (by_file) served_by_file_ = reference.name;
        GeoidPtr shared = *geoid ? std::make_shared<const geo::Geoid>(std::move(**geoid)) : nullptr;
        found_.emplace(reference.name, shared);
        return shared;
    }

  private:
    std::optional<std::filesystem::path> file_;
    Bounds area_;
    std::map<std::string, GeoidPtr> found_;
    std::string served_by_file_;
};

Result<std::optional<DatumShift>> shift_between(const Layer& layer, const lod::VerticalReference& scene,
                                                Geoids& geoids) {
    if (same_datum(layer.vertical(), scene)) return std::optional<DatumShift>{};
    const auto failed = [&](const Error& error) {
        return Error{error.kind, fmt::format("{}: its heights are above {}, the scene's above {}, and {}",
                                             layer.name(), layer.vertical().name, scene.name, error.message)};
    };
    auto from = geoids.find(layer.vertical());
    if (!from) return failed(from.error());
    auto to = geoids.find(scene);
    if (!to) return failed(to.error());
    return std::optional{DatumShift{std::move(*from), std::move(*to)}};
}

/// What is said of several sources, once, with whom it is said of.
std::vector<std::string> notes_of(const SourcePool& pool) {
    std::vector<std::pair<std::string, std::vector<int>>> said;
    const auto say = [&](const std::string& note, int source) {
        auto at = std::find_if(said.begin(), said.end(), [&](const auto& s) { return s.first == note; });
        if (at == said.end()) at = said.insert(said.end(), {note, {}});
        at->second.push_back(source);
    };
    for (int i = 0; i < pool.count(); ++i) {
        for (const std::string& note : pool.facts(i).notes) say(note, i);
        if (pool.facts(i).value_type == "Float64") say("float64 heights are rounded to float32", i);
    }
    std::vector<std::string> notes;
    for (const auto& [note, sources] : said) {
        const int others = static_cast<int>(sources.size()) - 1;
        if (pool.count() == 1)
            notes.push_back(note);
        else if (others == 0)
            notes.push_back(fmt::format("{}: {}", pool.facts(sources[0]).name, note));
        else
            notes.push_back(fmt::format("{} and {} other{}: {}", pool.facts(sources[0]).name, others,
                                        others == 1 ? "" : "s", note));
    }
    return notes;
}

Result<std::optional<Feather>> feather_of(double width_m, const geo::GridFrame& frame) {
    if (width_m == 0) return std::optional<Feather>{};
    const auto spacing = frame.spacing({0.5 * (frame.columns - 1), 0.5 * (frame.rows - 1)});
    const double most = kMostFeatherPosts * std::min(spacing.column_m, spacing.row_m);
    if (!(width_m > 0) || width_m > most)
        return Error{ErrorKind::usage,
                     fmt::format("--feather {} m: give a width of at most {:.0f} m, which is {} posts",
                                 width_m, most, kMostFeatherPosts)};
    return std::optional{Feather{frame, width_m}};
}

MosaicPosts empty_posts(Window window) {
    return {lod::Raster<float>{window.columns, window.rows, std::numeric_limits<float>::quiet_NaN()},
            lod::Raster<lod::PostMark>{window.columns, window.rows}};
}

/// A part of some posts: `window` of those in `all`.
MosaicPosts cut(const MosaicPosts& posts, Window all, Window window) {
    MosaicPosts part = empty_posts(window);
    for (int r = 0; r < window.rows; ++r) {
        const int row = window.row - all.row + r;
        std::copy_n(posts.heights.row(row) + (window.column - all.column), window.columns,
                    part.heights.row(r));
        std::copy_n(posts.marks.row(row) + (window.column - all.column), window.columns, part.marks.row(r));
    }
    return part;
}

/// The tiles of a window in which a post is void still.
std::vector<bool> tiles_with_voids(const lod::Raster<float>& heights, Window window) {
    const TileCount count{window};
    std::vector<bool> tiles(count.all());
    for (int r = 0; r < window.rows; ++r)
        for (int c = 0; c < window.columns; ++c)
            if (std::isnan(heights.at(c, r)))
                tiles[static_cast<std::size_t>(r / kTransformTile) * static_cast<std::size_t>(count.across) +
                      static_cast<std::size_t>(c / kTransformTile)] = true;
    return tiles;
}

bool meet(Window a, Window b) {
    const Window common = common_part(a, b);
    return common.columns > 0 && common.rows > 0;
}

lod::PostMark land_of(std::uint16_t source) {
    return {lod::PostClass::land, source};
}

}  // namespace

Mosaic::Mosaic(std::unique_ptr<State> state) : state_(std::move(state)) {}
Mosaic::Mosaic(Mosaic&&) noexcept = default;
Mosaic& Mosaic::operator=(Mosaic&&) noexcept = default;
Mosaic::~Mosaic() = default;

Result<Mosaic> Mosaic::open(const MosaicRequest& request) {
    if (request.sources.empty()) return Error{ErrorKind::usage, "there is no INPUT"};
    auto pool = SourcePool::open(request.sources);
    if (!pool) return pool.error();
    auto state = std::make_unique<State>(std::move(*pool));
    auto layers = make_layers(state->pool, request.priority == Priority::order);
    if (!layers) return layers.error();
    state->layers = std::move(*layers);

    std::vector<PostGrid> grids;
    for (const Layer& layer : state->layers) grids.push_back(post_grid(layer));
    const std::string name =
        state->pool.count() == 1
            ? state->pool.facts(0).name
            : fmt::format("{} and {} more", state->pool.facts(0).name, state->pool.count() - 1);
    auto chosen = choose_frame(name, std::move(grids), request.target);
    if (!chosen) return chosen.error();
    state->frame = chosen->frame;
    state->cropped = request.target.crop.has_value();
    state->vertical = request.datum.value_or(finest_of(state->layers).vertical());
    auto feather = feather_of(request.feather_m, state->frame);
    if (!feather) return feather.error();
    state->feather = *feather;

    state->notes = notes_of(state->pool);
    state->notes.insert(state->notes.end(), chosen->notes.begin(), chosen->notes.end());
    Geoids geoids{request.geoid, state->frame};
    for (std::size_t i = 0; i < state->layers.size(); ++i) {
        const Layer& layer = state->layers[i];
        const ChosenFrame::Use& use = chosen->uses[i];
        auto shift = shift_between(layer, state->vertical, geoids);
        if (!shift) return shift.error();
        if (*shift)
            state->notes.push_back(fmt::format("{}: its heights above {} are brought to {}", layer.name(),
                                               layer.vertical().name, state->vertical.name));
        const Resampling automatic = use.downsamples ? Resampling::average : Resampling::cubic;
        if (use.own && request.resampling)
            state->notes.push_back(fmt::format(
                "{}: its own posts are kept, --resampling has nothing to do there", layer.name()));
        state->in_scene.emplace_back(layer, state->frame, use, request.resampling.value_or(automatic),
                                     std::move(*shift));
    }
    return Mosaic{std::move(state)};
}

const geo::GridFrame& Mosaic::frame() const {
    return state_->frame;
}

const lod::VerticalReference& Mosaic::vertical() const {
    return state_->vertical;
}

std::vector<lod::SourceInfo> Mosaic::sources() const {
    std::vector<lod::SourceInfo> infos;
    for (int i = 0; i < state_->pool.count(); ++i) {
        const SourceFacts& facts = state_->pool.facts(i);
        lod::SourceInfo info;
        info.name = facts.name;
        info.crs = facts.crs_name;
        info.crs_wkt = facts.crs_wkt;
        info.columns = facts.columns;
        info.rows = facts.rows;
        info.step_x = std::hypot(facts.posts.x_column, facts.posts.y_column);
        info.step_y = std::hypot(facts.posts.x_row, facts.posts.y_row);
        info.step_unit = facts.step_unit;
        info.notes = fmt::format("{}", fmt::join(facts.notes, "; "));
        infos.push_back(std::move(info));
    }
    for (const Layer& layer : state_->layers)
        for (const Layer::Member& member : layer.members()) {
            lod::SourceInfo& info = infos[static_cast<std::size_t>(member.source)];
            info.operation = layer.operation().name();
            info.operation_accuracy_m = layer.operation().accuracy_m();
            info.operation_note = layer.operation().note();
        }
    return infos;
}

std::vector<std::filesystem::path> Mosaic::files() const {
    std::vector<std::filesystem::path> files;
    for (int i = 0; i < state_->pool.count(); ++i) files.push_back(state_->pool.facts(i).file);
    return files;
}

std::vector<std::filesystem::path> Mosaic::all_files() const {
    std::vector<std::filesystem::path> files = this->files();
    for (int i = 0; i < state_->pool.count(); ++i) {
        const auto& more = state_->pool.facts(i).all_files;
        files.insert(files.end(), more.begin(), more.end());
    }
    return files;
}

std::string Mosaic::resampling_method() const {
    std::vector<std::string> methods;
    for (const LayerInScene& layer : state_->in_scene) {
        const std::string method = to_string(layer.method());
        if (!layer.own() && std::find(methods.begin(), methods.end(), method) == methods.end())
            methods.push_back(method);
    }
    return methods.empty() ? "none" : fmt::format("{}", fmt::join(methods, "+"));
}

bool Mosaic::fits_int16() const {
    if (state_->feather && state_->in_scene.size() > 1) return false;
    for (const LayerInScene& layer : state_->in_scene)
        if (!layer.own() || layer.shift()) return false;
    for (int i = 0; i < state_->pool.count(); ++i) {
        if (!state_->pool.facts(i).whole_metres) return false;
    }
    return true;
}

std::vector<std::string> Mosaic::notes() const {
    return state_->notes;
}

/// Per post the first layer that has a height.
Result<MosaicPosts> Mosaic::State::joined(Window window) const {
    MosaicPosts posts = empty_posts(window);
    for (const LayerInScene& layer : in_scene) {
        if (!meet(layer.reach(), window)) continue;
        const auto wanted = tiles_with_voids(posts.heights, window);
        if (std::none_of(wanted.begin(), wanted.end(), [](bool w) { return w; })) break;
        const auto its = layer.read(window, wanted);
        if (!its) return its.error();
        for (std::size_t i = 0; i < posts.heights.samples().size(); ++i) {
            const float height = its->heights.samples()[i];
            if (std::isnan(height) || !std::isnan(posts.heights.samples()[i])) continue;
            posts.heights.samples()[i] = height;
            posts.marks.samples()[i] = land_of(its->sources.samples()[i]);
        }
    }
    return posts;
}

/// From the lowest layer up, each blended into what is under it.
Result<MosaicPosts> Mosaic::State::blended(Window window) const {
    const Window halo = whole_tiles(feather->with_halo(window), frame);
    std::vector<const LayerInScene*> here;
    for (const LayerInScene& layer : in_scene)
        if (meet(layer.reach(), halo)) here.push_back(&layer);
    if (here.size() < 2) return joined(window);

    const std::vector<bool> all(TileCount{halo}.all(), true);
    MosaicPosts under = empty_posts(halo);
    for (auto layer = here.rbegin(); layer != here.rend(); ++layer) {
        const auto its = (*layer)->read(halo, all);
        if (!its) return its.error();
        const auto weights = feather->weights(its->heights, under.heights, halo, window);
        for (int r = 0; r < halo.rows; ++r)
            for (int c = 0; c < halo.columns; ++c) {
                const float height = its->heights.at(c, r);
                if (std::isnan(height)) continue;
                float& below = under.heights.at(c, r);
                const int column = halo.column + c - window.column;
                const int row = halo.row + r - window.row;
                const bool inside = column >= 0 && row >= 0 && column < window.columns && row < window.rows;
                // Around the window it only counts where there is a height.
                const float weight = inside && !std::isnan(below) ? weights.at(column, row) : 1.0F;
                below = weight == 1.0F ? height : weight * height + (1 - weight) * below;
                under.marks.at(c, r) = land_of(its->sources.at(c, r));
            }
    }
    return cut(under, halo, window);
}

/// What is one place on earth has one height: the posts of a pole's row, and the first and the last column of
/// a grid all round.
Result<void> Mosaic::State::join_edges(Window window, MosaicPosts& into) const {
    if (frame.is_polar()) return {};
    const auto source_posts = [&](Window first) { return feather ? blended(first) : joined(first); };
    const int last = frame.columns - 1;
    if (frame.closes() && window.column + window.columns > last) {
        const auto west = source_posts(whole_tiles({0, window.row, 1, window.rows}, frame));
        if (!west) return west.error();
        for (int r = 0; r < window.rows; ++r) {
            into.heights.at(last - window.column, r) = west->heights.at(0, r);
            into.marks.at(last - window.column, r) = west->marks.at(0, r);
        }
    }
    const double tiny = 1e-6 * frame.step_y;
    for (const int row : {0, frame.rows - 1}) {
        if (row < window.row || row >= window.row + window.rows) continue;
        if (std::abs(frame.north - row * frame.step_y) < 90 - tiny) continue;
        const Window tile = whole_tiles({0, row, 1, 1}, frame);
        const auto pole = source_posts(tile);
        if (!pole) return pole.error();
        const float height = pole->heights.at(0, row - tile.row);
        for (int c = 0; c < window.columns && !std::isnan(height); ++c)
            if (!std::isnan(into.heights.at(c, row - window.row)))
                into.heights.at(c, row - window.row) = height;
    }
    return {};
}

Result<MosaicPosts> Mosaic::State::posts(Window window) const {
    const Window tiles = whole_tiles(window, frame);
    auto found = feather ? blended(tiles) : joined(tiles);
    if (!found) return found;
    if (auto done = join_edges(tiles, *found); !done) return done.error();
    if (tiles.columns == window.columns && tiles.rows == window.rows) return found;
    return cut(*found, tiles, window);
}

Result<MosaicPosts> Mosaic::read(Window window) const {
    assert(window.column >= 0 && window.row >= 0 && window.column + window.columns <= frame().columns &&
           window.row + window.rows <= frame().rows);
    return state_->posts(window);
}

std::uint64_t Mosaic::memory_bytes() const {
    // Of the layer: heights and sources, and the heights of one file while they are copied.
    constexpr std::uint64_t kLayerPart = static_cast<std::uint64_t>(kMostSourcePosts) * (8 + 2 + 8);
    // Of the scene: two lots of posts, the larger halo's where there is one, and the tiles' meshes.
    constexpr std::uint64_t kPost = 2 * (4 + 2 + 4) + 8;
    const std::uint64_t halo = state_->feather ? 2 * kMostFeatherPosts : 0;
    const std::uint64_t side = lod::SceneInfo::kBlockSide + 2 * kTransformTile + halo;
    return kLayerPart + side * side * kPost;
}

Result<lod::ResamplingError> Mosaic::resampling_error(const SceneHeights& scene, const Stage& stage) const {
    struct Item {
        std::size_t layer;
        Window window;
    };
    std::vector<Item> items;
    const std::vector<LayerInScene>& layers = state_->in_scene;
    for (std::size_t i = 0; i < layers.size(); ++i)
        for (const Window& window : windows_to_compare(layers[i], frame(), state_->cropped))
            items.push_back({i, window});

    constexpr std::size_t kAtATime = 16;  // between two looks at the stage
    ErrorSum sum;
    for (std::size_t first = 0; first < items.size(); first += kAtATime) {
        const std::size_t count = std::min(kAtATime, items.size() - first);
        std::vector<ErrorSum> sums(count);
        auto done = lod::for_each_block(static_cast<int>(count), [&](int i) -> Result<void> {
            const Item& item = items[first + static_cast<std::size_t>(i)];
            const auto its = layer_error(layers[item.layer], std::span{layers}.first(item.layer), item.window,
                                         frame(), state_->cropped, scene);
            if (!its) return its.error();
            sums[static_cast<std::size_t>(i)] = *its;
            return {};
        });
        if (!done) return done.error();
        // In their order, so that the sum does not depend on threads.
        for (const ErrorSum& its : sums) sum.add(its);
        if (!stage(static_cast<double>(first + count) / static_cast<double>(items.size())))
            return interrupted();
    }
    lod::ResamplingError error;
    error.max_m = sum.largest;
    error.posts = sum.posts;
    error.lost_posts = sum.lost;
    if (sum.posts > 0) error.rms_m = std::sqrt(sum.squares / static_cast<double>(sum.posts));
    return error;
}

}  // namespace relevo::ingest
