#pragma once

#include <memory>
#include <optional>

#include "geo/geoid.hpp"
#include "ingest/mosaic/frame_choice.hpp"
#include "ingest/resample/warp.hpp"

namespace relevo::ingest {

/// What brings heights above one datum to another: H + N of theirs - N of the scene's. Nothing in place of
/// the ellipsoid's zero.
struct DatumShift {
    std::shared_ptr<const geo::Geoid> from;
    std::shared_ptr<const geo::Geoid> to;

    /// Metres to add; NaN where a geoid does not cover the place.
    double at(geo::LatLon place) const;
};

/// A layer as the scene sees it: its own posts or resampled ones, above the scene's datum.
class LayerInScene {
  public:
    /// \pre the layer outlives this
    LayerInScene(const Layer& layer, const geo::GridFrame& frame, const ChosenFrame::Use& use,
                 Resampling method, std::optional<DatumShift> shift);

    const Layer& layer() const { return *layer_; }
    const GridMap& map() const { return map_; }
    bool own() const { return own_.has_value(); }
    Resampling method() const { return warp_.method(); }
    const std::optional<DatumShift>& shift() const { return shift_; }

    /// Posts of the frame that may have a height here, and perhaps some more.
    Window reach() const { return reach_; }

    /// The posts of a window of the frame; those of tiles that are not wanted may stay void. As Warp::read.
    Result<LayerPosts> read(Window window, const std::vector<bool>& wanted) const;

  private:
    Result<LayerPosts> read_own(Window window) const;
    Result<void> read_own_part(Window window, int shift, LayerPosts& into) const;
    Result<void> shift_datum(Window window, LayerPosts& posts) const;

    const Layer* layer_;
    geo::GridFrame frame_;
    GridMap map_;
    std::optional<OwnPosts> own_;
    Warp warp_;
    std::optional<DatumShift> shift_;
    Window reach_;
};

/// A window with all tiles that it touches: what Warp::read takes. \pre it lies in the frame
Window whole_tiles(Window window, const geo::GridFrame& frame);

/// Tiles of a window of whole tiles.
struct TileCount {
    int across = 0;
    int down = 0;
    explicit TileCount(Window window)
        : across((window.columns + kTransformTile - 1) / kTransformTile),
          down((window.rows + kTransformTile - 1) / kTransformTile) {}
    std::size_t all() const { return static_cast<std::size_t>(across) * static_cast<std::size_t>(down); }
};

}  // namespace relevo::ingest
