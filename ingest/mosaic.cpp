#include "ingest/mosaic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <utility>

#include "ingest/read_heights.hpp"
#include "ingest/refusal.hpp"
#include "ingest/resampling_error.hpp"

namespace relevo::ingest {

struct Mosaic::State {
    Source source;
    Operation operation;
    Target target;
    Resampling method;
    double middle_lon;
    bool cropped;
    mutable std::mutex reading;

    SourceMap source_map() const {
        SourceMap map{operation, source.crs(), source.posts(), source.columns(), source.rows()};
        map.set_middle_lon(middle_lon);
        return map;
    }
};

namespace {

/// Places of the source in its CRS: a lattice with its corners.
std::vector<Place> places_of(const Source& source) {
    constexpr int kCount = 8;
    std::vector<Place> places;
    for (int j = 0; j <= kCount; ++j)
        for (int i = 0; i <= kCount; ++i)
            places.push_back(source.posts().at(
                {(source.columns() - 1) * i / double{kCount}, (source.rows() - 1) * j / double{kCount}}));
    return places;
}

}  // namespace

Mosaic::Mosaic(std::unique_ptr<State> state) : state_(std::move(state)) {}
Mosaic::Mosaic(Mosaic&&) noexcept = default;
Mosaic& Mosaic::operator=(Mosaic&&) noexcept = default;
Mosaic::~Mosaic() = default;

Result<Mosaic> Mosaic::open(const MosaicRequest& request) {
    if (request.sources.empty()) return Error{ErrorKind::usage, "there is no INPUT"};
    if (request.sources.size() > 1)
        return Error{ErrorKind::internal, "several inputs cannot be joined yet: give one"};
    auto source = Source::open(request.sources[0]);
    if (!source) return source.error();
    auto operation = Operation::to_wgs84(source->crs(), places_of(*source));
    if (!operation)
        return operation.error().kind == ErrorKind::input
                   ? refusal(source->name(), operation.error().message, "")
                   : operation.error();
    SourceMap map{*operation, source->crs(), source->posts(), source->columns(), source->rows()};
    auto target = choose_target(source->name(), source->crs(), source->posts(), map, request.target);
    if (!target) return target.error();
    const Resampling automatic = target->downsamples ? Resampling::average : Resampling::cubic;
    return Mosaic{std::unique_ptr<State>{new State{std::move(*source),
                                                   std::move(*operation),
                                                   std::move(*target),
                                                   request.resampling.value_or(automatic),
                                                   map.middle_lon(),
                                                   request.target.crop.has_value(),
                                                   {}}}};
}

const geo::GridFrame& Mosaic::frame() const {
    return state_->target.frame;
}

const lod::VerticalReference& Mosaic::vertical() const {
    return state_->source.heights().reference;
}

std::vector<lod::SourceInfo> Mosaic::sources() const {
    const Source& source = state_->source;
    lod::SourceInfo info;
    info.name = source.name();
    info.crs = source.crs().name();
    info.crs_wkt = source.crs().wkt();
    info.columns = source.columns();
    info.rows = source.rows();
    info.step_x = std::hypot(source.posts().x_column, source.posts().y_column);
    info.step_y = std::hypot(source.posts().x_row, source.posts().y_row);
    info.step_unit = source.crs().unit();
    info.operation = state_->operation.name();
    info.operation_accuracy_m = state_->operation.accuracy_m();
    info.operation_note = state_->operation.note();
    return {info};
}

std::vector<std::filesystem::path> Mosaic::files() const {
    return {state_->source.file()};
}

std::string Mosaic::resampling_method() const {
    return state_->target.own ? "none" : to_string(state_->method);
}

bool Mosaic::fits_int16() const {
    const std::string type = state_->source.value_type();
    return state_->target.own && state_->source.whole_metres() && (type == "Int16" || type == "Byte");
}

std::vector<std::string> Mosaic::notes() const {
    std::vector<std::string> notes = state_->source.notes();
    notes.insert(notes.end(), state_->target.notes.begin(), state_->target.notes.end());
    if (state_->source.value_type() == "Float64")
        notes.emplace_back("float64 heights are rounded to float32");
    return notes;
}

Result<MosaicPosts> Mosaic::read(Window window) const {
    const std::scoped_lock one_at_a_time{state_->reading};
    MosaicPosts posts;
    if (state_->target.own) {
        OwnPosts own = *state_->target.own;
        own.window.column +=
            own.flip_columns ? own.window.columns - window.column - window.columns : window.column;
        own.window.row += own.flip_rows ? own.window.rows - window.row - window.rows : window.row;
        own.window.columns = window.columns;
        own.window.rows = window.rows;
        const Progress none;
        auto read = read_own_heights(state_->source, own, Stage{none, 0, 1});
        if (!read) return read.error();
        posts.heights = std::move(read->heights);
    } else {
        auto read = warp_block(state_->source, GridMap{state_->source_map(), frame()}, frame(),
                               state_->method, window);
        if (!read) return read.error();
        posts.heights = std::move(*read);
    }
    posts.marks = lod::Raster<lod::PostMark>{window.columns, window.rows};
    for (std::size_t i = 0; i < posts.marks.samples().size(); ++i)
        posts.marks.samples()[i] =
            std::isnan(posts.heights.samples()[i]) ? lod::PostMark{} : lod::PostMark{lod::PostClass::land, 0};
    return posts;
}

std::uint64_t Mosaic::memory_bytes() const {
    constexpr std::uint64_t kMemoryOfPart = std::uint64_t{160} << 20;
    return kMemoryOfPart;
}

Result<lod::ResamplingError> Mosaic::resampling_error(const SceneHeights& scene, const Stage& stage) const {
    const std::scoped_lock one_at_a_time{state_->reading};
    const auto heights = scene({0, 0, frame().columns, frame().rows});
    if (!heights) return heights.error();
    return ingest::resampling_error(state_->source, GridMap{state_->source_map(), frame()}, frame(), *heights,
                                    state_->cropped, stage);
}

}  // namespace relevo::ingest
