#include "ingest/mosaic/layer_in_scene.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "ingest/mosaic/frame_plane.hpp"
#include "ingest/refusal.hpp"

namespace relevo::ingest {
namespace {

GridMap map_to(const Layer& layer, const geo::GridFrame& frame) {
    SourceMap map = layer.map();
    // All round the earth columns may begin anywhere: on without a jump where the scene is.
    if (layer.turn() > 0 && !frame.is_polar())
        map.set_columns_around(frame.west + 0.5 * frame.step_x * (frame.columns - 1));
    return {map, frame};
}

Window whole(const geo::GridFrame& frame) {
    return {0, 0, frame.columns, frame.rows};
}

/// The posts of the frame that a layer's members lie in, with room for what bulges between the places looked
/// at.
Window reach_of(const Layer& layer, const geo::GridFrame& frame) {
    if (frame.closes()) return whole(frame);
    double left = frame.columns;
    double top = frame.rows;
    double right = -1;
    double bottom = -1;
    for (const Layer::Member& member : layer.members()) {
        const SourceMap its = layer.map_of(member);
        if (holds_pole(its, 90) || holds_pole(its, -90)) return whole(frame);
        auto places = outline_of(its, 33);
        GridMap{its, frame}.to_scene(places);
        double its_left = frame.columns;
        double its_right = -1;
        for (const Place& p : places) {
            if (!std::isfinite(p.x) || !std::isfinite(p.y)) return whole(frame);
            its_left = std::min(its_left, p.x);
            its_right = std::max(its_right, p.x);
            top = std::min(top, p.y);
            bottom = std::max(bottom, p.y);
        }
        // Farther than half round the earth from edge to edge: it lies across the meridian opposite of the
        // frame.
        if (!frame.is_polar() && (its_right - its_left) * frame.step_x > 180) return whole(frame);
        left = std::min(left, its_left);
        right = std::max(right, its_right);
    }
    const double room_x = 64 + 0.05 * (right - left);
    const double room_y = 64 + 0.05 * (bottom - top);
    const auto clamped = [](double at, int most) {
        return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(most)));
    };
    const int first_column = clamped(left - room_x, frame.columns);
    const int first_row = clamped(top - room_y, frame.rows);
    return {first_column, first_row, clamped(right + room_x, frame.columns) - first_column,
            clamped(bottom + room_y, frame.rows) - first_row};
}

}  // namespace

double DatumShift::at(geo::LatLon place) const {
    double shift = 0;
    if (from) shift += from->covers(place) ? from->undulation(place).m : std::nan("");
    if (to) shift -= to->covers(place) ? to->undulation(place).m : std::nan("");
    return shift;
}

LayerInScene::LayerInScene(const Layer& layer, const geo::GridFrame& frame, const ChosenFrame::Use& use,
                           Resampling method, std::optional<DatumShift> shift)
    : layer_(&layer),
      frame_(frame),
      map_(map_to(layer, frame)),
      own_(use.own),
      warp_(layer, map_, method),
      shift_(std::move(shift)),
      reach_(reach_of(layer, frame)) {}

Result<LayerPosts> LayerInScene::read(Window window, const std::vector<bool>& wanted) const {
    auto posts = own_ ? read_own(window) : warp_.read(window, wanted);
    if (!posts || !shift_) return posts;
    if (auto done = shift_datum(window, *posts); !done) return done.error();
    return posts;
}

Result<LayerPosts> LayerInScene::read_own(Window window) const {
    LayerPosts posts{window.columns, window.rows};
    // A frame all round the earth has each meridian once, a layer may have it a turn away.
    const int turn =
        frame_.closes() && layer_->turn() == 0 ? static_cast<int>(std::round(360 / frame_.step_x)) : 0;
    for (const int shift : {0, -turn, turn}) {
        if (auto done = read_own_part(own_->of(window), shift, posts); !done) return done.error();
        if (turn == 0) break;
    }
    return posts;
}

Result<void> LayerInScene::read_own_part(Window window, int shift, LayerPosts& into) const {
    window.column += shift;
    if (!layer_->has_posts_in(window)) return {};
    const auto read = layer_->read(window);
    if (!read) return read.error();
    const lod::Raster<double>& from = read->posts.heights;
    for (int r = 0; r < window.rows; ++r) {
        const int from_row = own_->flip_rows ? window.rows - 1 - r : r;
        for (int c = 0; c < window.columns; ++c) {
            const int from_column = own_->flip_columns ? window.columns - 1 - c : c;
            const double height = from.at(from_column, from_row);
            if (std::isnan(height)) continue;
            into.heights.at(c, r) = static_cast<float>(height);
            into.sources.at(c, r) = static_cast<std::uint16_t>(
                read->source_at(window.column + from_column, window.row + from_row));
        }
    }
    return {};
}

Result<void> LayerInScene::shift_datum(Window window, LayerPosts& posts) const {
    for (int r = 0; r < window.rows; ++r)
        for (int c = 0; c < window.columns; ++c) {
            float& height = posts.heights.at(c, r);
            if (std::isnan(height)) continue;
            const geo::LatLon place =
                frame_.lat_lon({static_cast<double>(window.column + c), static_cast<double>(window.row + r)});
            const double shift = shift_->at(place);
            if (std::isnan(shift))
                return refusal(
                    layer_->name(),
                    fmt::format("its heights above {} cannot be brought to the scene's datum at {:.6f}, "
                                "{:.6f}: the geoid grid does not reach there",
                                layer_->vertical().name, place.lat.value, place.lon.value),
                    "Take a part with --crop, or give a grid that does with --geoid");
            height = static_cast<float>(static_cast<double>(height) + shift);
        }
    return {};
}

Window whole_tiles(Window window, const geo::GridFrame& frame) {
    const int left = window.column / kTransformTile * kTransformTile;
    const int top = window.row / kTransformTile * kTransformTile;
    const auto up = [](int at, int most) {
        return std::min((at + kTransformTile - 1) / kTransformTile * kTransformTile, most);
    };
    return {left, top, up(window.column + window.columns, frame.columns) - left,
            up(window.row + window.rows, frame.rows) - top};
}

}  // namespace relevo::ingest
