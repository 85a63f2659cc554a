#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "geo/frame.hpp"
#include "geo/result.hpp"
#include "ingest/affine.hpp"
#include "ingest/sea/sea_polygons.hpp"
#include "ingest/sea/sea_raster.hpp"
#include "ingest/source/trust.hpp"
#include "lod/scene/raster.hpp"

namespace relevo::ingest {

/// A file that says where the sea is: polygons (posts inside are sea) in anything that OGR reads, or a raster
/// (posts whose nearest pixel is valid and not 0 are sea) in anything that GDAL reads, in any CRS.
class SeaMask {
  public:
    static Result<SeaMask> open(const std::string& file, const Trust& trust, const geo::GridFrame& frame);

    /// The file's name without its folder.
    const std::string& name() const { return name_; }

    /// 1 where a post of the window is sea, else 0; from any thread.
    Result<void> read(Window window, lod::Raster<std::uint8_t>& is_sea) const;

  private:
    using Shape = std::variant<SeaPolygons, SeaRaster>;
    SeaMask(std::string name, Shape shape);

    std::string name_;
    Shape shape_;
};

}  // namespace relevo::ingest
