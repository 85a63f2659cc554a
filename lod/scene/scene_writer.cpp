#include "lod/scene/scene_writer.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "lod/scene/block_file.hpp"
#include "lod/scene/block_grid.hpp"
#include "lod/scene/folder.hpp"
#include "lod/scene/parallel_blocks.hpp"
#include "lod/scene/scene_files.hpp"
#include "lod/scene/scene_place.hpp"
#include "lod/scene/sha256.hpp"

namespace relevo::lod {
namespace {

template <class T>
std::span<const T> row_of(const Raster<T>& raster, const BlockGrid::Box& box, int row) {
    return {raster.row(box.row + row) + box.column, static_cast<std::size_t>(box.columns)};
}

/// The stored form of a height; false where the type cannot hold it.
bool store(float height, std::int16_t& sample) {
    if (std::isnan(height)) {
        sample = kVoidInt16;
        return true;
    }
    if (!(height > kVoidInt16 && height <= std::numeric_limits<std::int16_t>::max())) return false;
    sample = static_cast<std::int16_t>(height);
    return static_cast<float>(sample) == height;
}

bool store(float height, float& sample) {
    // One NaN: others differ in bits that nobody means.
    sample = std::isnan(height) ? std::numeric_limits<float>::quiet_NaN() : height;
    return !std::isinf(height);
}

template <class T>
Result<std::vector<T>> stored_heights(const Raster<float>& heights, const BlockGrid::Box& box) {
    std::vector<T> samples;
    samples.reserve(static_cast<std::size_t>(box.columns) * static_cast<std::size_t>(box.rows));
    for (int row = 0; row < box.rows; ++row) {
        for (const float height : row_of(heights, box, row)) {
            if (!store(height, samples.emplace_back())) {
                return Error{ErrorKind::internal,
                             fmt::format("a height of {} m does not fit the scene's type", height)};
            }
        }
    }
    return samples;
}

bool all_void(const Raster<float>& heights, const BlockGrid::Box& box) {
    for (int row = 0; row < box.rows; ++row) {
        if (!std::ranges::all_of(row_of(heights, box, row),
                                 [](float height) { return std::isnan(height); })) {
            return false;
        }
    }
    return true;
}

std::vector<std::uint16_t> stored_metrics(const MetricRasters& metrics, const BlockGrid::Box& box) {
    std::vector<std::uint16_t> samples;
    samples.reserve(3 * static_cast<std::size_t>(box.columns) * static_cast<std::size_t>(box.rows));
    for (const auto* raster : {&metrics.bounded, &metrics.incremental, &metrics.radius}) {
        for (int row = 0; row < box.rows; ++row) {
            const auto codes = row_of(*raster, box, row);
            samples.insert(samples.end(), codes.begin(), codes.end());
        }
    }
    return samples;
}

}  // namespace

struct SceneWriter::State {
    ScenePlace place;
    std::vector<BlockInfo> heights;
    std::vector<BlockInfo> metrics;
    BlockInfo undulation;
    HeightType height_type = HeightType::float32;

    const Folder& folder() const { return place.partial(); }

    Result<BlockInfo> write(const std::string& file, std::span<const std::byte> bytes) const {
        if (const Result<void> written = folder().write(file, bytes); !written) return written.error();
        BlockInfo block;
        block.file = file;
        block.sha256 = sha256_hex(bytes);
        block.bytes = bytes.size();
        return block;
    }

    /// Writes the blocks of a layer in parallel. encode(box) gives a block's bytes, nothing where it is not
    /// stored.
    template <class Encode>
    Result<std::vector<BlockInfo>> write_layer(const char* layer, const BlockGrid& grid,
                                               const Encode& encode) const {
        if (const Result<void> made = folder().make_folder(layer); !made) return made.error();
        std::vector<BlockInfo> blocks(static_cast<std::size_t>(grid.count()));
        std::atomic<bool> failed = false;
        const Result<void> done = for_each_block(grid.count(), [&](int i) -> Result<void> {
            if (failed) return {};  // a full disk need not be told of every block
            const int column = i % grid.across;
            const int row = i / grid.across;
            const Result<std::vector<std::byte>> bytes = encode(grid.box(column, row));
            if (bytes && bytes->empty()) return {};
            Result<BlockInfo> block =
                bytes ? write(block_file_name(layer, column, row), *bytes) : bytes.error();
            if (!block) {
                failed = true;
                return block.error();
            }
            block->column = column;
            block->row = row;
            blocks[static_cast<std::size_t>(i)] = std::move(*block);
            return {};
        });
        if (!done) return done.error();
        std::erase_if(blocks, [](const BlockInfo& block) { return block.file.empty(); });
        return blocks;
    }

    template <class T>
    Result<void> write_heights(const Raster<float>& all, const geo::GridFrame& frame) {
        using Bytes = Result<std::vector<std::byte>>;
        const BlockGrid grid = BlockGrid::of_heights(all.columns(), all.rows());
        auto written = write_layer(kHeightsFolder, grid, [&](const BlockGrid::Box& box) -> Bytes {
            if (all_void(all, box)) return std::vector<std::byte>{};
            const Result<std::vector<T>> samples = stored_heights<T>(all, box);
            if (!samples) return samples.error();
            return encode_block<T>(*samples, {box.columns, box.rows},
                                   geo_reference(frame, box.column, box.row));
        });
        if (!written) return written.error();
        heights = std::move(*written);
        return {};
    }
};

SceneWriter::SceneWriter(std::unique_ptr<State> state) : state_(std::move(state)) {}
SceneWriter::SceneWriter(SceneWriter&&) noexcept = default;
SceneWriter& SceneWriter::operator=(SceneWriter&&) noexcept = default;
SceneWriter::~SceneWriter() = default;

Result<SceneWriter> SceneWriter::create(const std::filesystem::path& path, bool overwrite) {
    Result<ScenePlace> place = ScenePlace::claim(path, overwrite);
    if (!place) return place.error();
    return SceneWriter(std::unique_ptr<State>(new State{std::move(*place), {}, {}, {}}));
}

Result<void> SceneWriter::write_heights(const Raster<float>& heights, HeightType type,
                                        const geo::GridFrame& frame) {
    assert(heights.columns() == frame.columns && heights.rows() == frame.rows);
    state_->height_type = type;
    return type == HeightType::int16 ? state_->write_heights<std::int16_t>(heights, frame)
                                     : state_->write_heights<float>(heights, frame);
}

Result<void> SceneWriter::write_metrics(const MetricRasters& metrics) {
    const BlockGrid grid = BlockGrid::of_metrics(metrics.bounded.columns());
    using Bytes = Result<std::vector<std::byte>>;
    auto written = state_->write_layer(kMetricsFolder, grid, [&](const BlockGrid::Box& box) -> Bytes {
        const std::vector<std::uint16_t> samples = stored_metrics(metrics, box);
        if (std::ranges::all_of(samples, [](std::uint16_t code) { return code == 0; })) {
            return std::vector<std::byte>{};
        }
        return encode_block<std::uint16_t>(samples, {box.columns, box.rows, 3}, std::nullopt);
    });
    if (!written) return written.error();
    state_->metrics = std::move(*written);
    return {};
}

Result<void> SceneWriter::write_undulations(const UndulationGrid& undulations) {
    const Raster<float>& nodes = undulations.nodes();
    if (nodes.columns() == 0) return {};  // heights above the ellipsoid
    const auto bytes = encode_block<float>(nodes.samples(), {nodes.columns(), nodes.rows()}, std::nullopt);
    if (!bytes) return bytes.error();
    Result<BlockInfo> written = state_->write(kUndulationFile, *bytes);
    if (!written) return written.error();
    state_->undulation = std::move(*written);
    return {};
}

Result<void> SceneWriter::commit(SceneInfo info) {
    info.height_type = state_->height_type;
    info.heights = std::move(state_->heights);
    info.metrics = std::move(state_->metrics);
    info.undulation = std::move(state_->undulation);

    const std::string text = scene_text(info);
    if (const auto readable = scene_info_from_text(text); !readable) {
        return Error{ErrorKind::internal,
                     fmt::format("the scene does not make sense: {}", readable.error().message)};
    }
    const Folder& folder = state_->folder();
    const std::string mosaic = mosaic_text(info);
    if (auto done = folder.write(kMosaicFile, std::as_bytes(std::span(mosaic))); !done) return done;
    if (auto done = folder.write(kSceneFile, std::as_bytes(std::span(text))); !done) return done;
    if (auto done = folder.sync_all(); !done) return done;
    return state_->place.take();
}

}  // namespace relevo::lod
