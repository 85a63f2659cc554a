#pragma once

#include <memory>
#include <optional>

#include "geo/position.hpp"
#include "lod/scene/scene_info.hpp"

namespace relevo::lod {

/// A place in the CRS of a source: easting and northing, or longitude and latitude, in the CRS's own units (x
/// first, whatever the CRS's axis order).
struct SourcePosition {
    double x = 0;
    double y = 0;
};

/// From WGS 84 to the CRS of a source, by the coordinate operation that it came in with. For one thread at a
/// time.
class SourceProjection {
  public:
    /// Nothing where PROJ has no such operation here.
    static std::optional<SourceProjection> create(const SourceInfo& source);
    SourceProjection(SourceProjection&&) noexcept;
    SourceProjection& operator=(SourceProjection&&) noexcept;
    ~SourceProjection();

    /// Nothing where the place is outside the CRS.
    std::optional<SourcePosition> position(geo::LatLon place) const;

  private:
    struct Proj;
    explicit SourceProjection(std::unique_ptr<Proj> proj);

    std::unique_ptr<Proj> proj_;
};

/// The same for one place; nothing where PROJ has no operation or the place is outside it.
std::optional<SourcePosition> source_position(const SourceInfo& source, geo::LatLon place);

}  // namespace relevo::lod
