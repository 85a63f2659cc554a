#include "lod/scene/scene_writer.hpp"

#include <array>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "lod/scene/folder.hpp"
#include "lod/scene/geoid_block.hpp"
#include "lod/scene/level_grid.hpp"
#include "lod/scene/scene_files.hpp"
#include "lod/scene/sha256.hpp"

namespace relevo::lod {

struct SceneWriter::State {
    ScenePlace place;
    GeoidInfo geoid;
    mutable std::vector<std::string> draft_layers;

    const Folder& folder() const { return place.partial(); }
};

SceneWriter::SceneWriter(std::unique_ptr<State> state) : state_(std::move(state)) {}
SceneWriter::SceneWriter(SceneWriter&&) noexcept = default;
SceneWriter& SceneWriter::operator=(SceneWriter&&) noexcept = default;
SceneWriter::~SceneWriter() = default;

Result<SceneWriter> SceneWriter::create(const std::filesystem::path& path, const SceneClaim& claim) {
    Result<ScenePlace> place = ScenePlace::claim(path, claim);
    if (!place) return place.error();
    return SceneWriter(std::unique_ptr<State>(new State{std::move(*place), {}, {}}));
}

bool SceneWriter::resumed() const {
    return state_->place.resumed();
}

bool SceneWriter::has_blocks() const {
    std::error_code error;
    for (std::filesystem::directory_iterator it(state_->folder().path(), error), end; !error && it != end;
         it.increment(error)) {
        if (it->path().extension() == ".journal" && it->file_size(error) > 0) return true;
    }
    return false;
}

void SceneWriter::keep_for_resume() {
    state_->place.keep();
}

Result<BlockStore> SceneWriter::layer(const std::string& name) const {
    return BlockStore::open(state_->folder(), name);
}

Result<DraftPosts> SceneWriter::posts(const geo::GridFrame& frame, const HeightCoding& coding,
                                      std::uint64_t cache_bytes) const {
    auto heights = layer(kHeightsFolder);
    if (!heights) return heights.error();
    auto marks = layer(kMarksFolder);
    if (!marks) return marks.error();
    return DraftPosts(std::move(*heights), std::move(*marks), frame, coding, cache_bytes);
}

Result<DraftPosts> SceneWriter::draft(const std::string& name, const geo::GridFrame& frame,
                                      const HeightCoding& coding, std::uint64_t cache_bytes) const {
    const std::array layers{name + "-" + kHeightsFolder, name + "-" + kMarksFolder};
    auto heights = layer(layers[0]);
    if (!heights) return heights.error();
    auto marks = layer(layers[1]);
    if (!marks) return marks.error();
    state_->draft_layers.insert(state_->draft_layers.end(), layers.begin(), layers.end());
    return DraftPosts(std::move(*heights), std::move(*marks), frame, coding, cache_bytes);
}

Result<void> SceneWriter::write_geoid(const geo::GeoidNodes& nodes) {
    const auto bytes = encode_geoid(nodes);
    if (!bytes) return bytes.error();
    if (auto done = state_->folder().write(kGeoidFile, *bytes); !done) return done;
    const BlockInfo file{0, 0, kGeoidFile, sha256_hex(*bytes), bytes->size()};
    state_->geoid = {file,           nodes.south, nodes.west,   nodes.step_lat,
                     nodes.step_lon, nodes.rows,  nodes.columns};
    return {};
}

Result<void> SceneWriter::commit(SceneInfo info) {
    info.levels.resize(static_cast<std::size_t>(LevelGrid::top(info.frame.levels())));
    std::vector<std::pair<std::string, std::vector<BlockInfo>*>> layers{{kHeightsFolder, &info.heights},
                                                                        {kMarksFolder, &info.marks}};
    for (int k = 1; k <= static_cast<int>(info.levels.size()); ++k) {
        LevelInfo& level = info.levels[static_cast<std::size_t>(k) - 1];
        layers.emplace_back(level_folder(kHeightsFolder, k), &level.heights);
        layers.emplace_back(level_folder(kVerticesFolder, k), &level.vertices);
    }
    std::vector<BlockStore> stores;
    for (const auto& [name, blocks] : layers) {
        auto store = BlockStore::open(state_->folder(), name);
        if (!store) return store.error();
        *blocks = store->blocks();
        stores.push_back(std::move(*store));
    }
    info.geoid = state_->geoid;

    const std::string text = scene_text(info);
    if (const auto readable = scene_info_from_text(text); !readable) {
        return Error{ErrorKind::internal,
                     fmt::format("the scene does not make sense: {}", readable.error().message)};
    }
    const Folder& folder = state_->folder();
    const std::string mosaic = mosaic_text(info);
    if (auto done = folder.write(kMosaicFile, std::as_bytes(std::span(mosaic))); !done) return done;
    if (auto done = folder.write(kSceneFile, std::as_bytes(std::span(text))); !done) return done;
    for (const std::string& name : state_->draft_layers) {
        auto store = BlockStore::open(folder, name);
        if (!store) return store.error();
        if (auto done = store->remove(); !done) return done;
    }
    for (BlockStore& store : stores) {
        if (auto done = store.close(); !done) return done;
    }
    if (auto done = state_->place.forget_job(); !done) return done;
    if (auto done = folder.sync_all(); !done) return done;
    return state_->place.take();
}

}  // namespace relevo::lod
