#pragma once

#include <span>

#include "geo/frame.hpp"
#include "ingest/affine.hpp"
#include "ingest/reference/crs.hpp"
#include "ingest/reference/operation.hpp"

namespace relevo::ingest {

/// Between posts of a source and (longitude, latitude), exactly: PROJ at every place. Longitudes go on
/// without a jump around a middle meridian, and so do the columns of a source that is itself in longitudes.
class SourceMap {
  public:
    /// \pre posts has an inverse; the operation outlives the map
    SourceMap(const Operation& operation, const Crs& crs, const Affine& posts, int columns, int rows);

    /// Source (column, row) to (lon, lat) in degrees, in place; NaN where there is none.
    void to_lon_lat(std::span<Place> places) const;
    void from_lon_lat(std::span<Place> places) const;

    /// The meridian around which longitudes are continuous: [-180, 180] to both sides of it.
    double middle_lon() const { return middle_lon_; }
    void set_middle_lon(double lon) { middle_lon_ = lon; }

    /// Moves a geographic source's columns by whole turns to around a meridian, for sources all round the
    /// earth.
    void set_columns_around(double lon) {
        if (full_turn_ > 0) middle_x_ = lon * (full_turn_ / 360);
    }

    const Affine& posts() const { return posts_; }
    int columns() const { return columns_; }
    int rows() const { return rows_; }

  private:
    const Operation& operation_;
    Affine posts_;
    Affine inverse_;
    int columns_;
    int rows_;
    double middle_lon_ = 0;
    double middle_x_ = 0;   // of a geographic source, in its unit
    double full_turn_ = 0;  // likewise; 0 for a projected one
};

/// Between posts of a source and posts of a scene's grid.
class GridMap {
  public:
    GridMap(const SourceMap& source, const geo::GridFrame& frame) : source_(source), frame_(frame) {}

    void to_source(std::span<Place> scene_posts) const;
    void to_scene(std::span<Place> source_posts) const;

  private:
    SourceMap source_;
    geo::GridFrame frame_;
};

}  // namespace relevo::ingest
