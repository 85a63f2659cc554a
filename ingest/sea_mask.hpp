#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "geo/frame.hpp"
#include "geo/result.hpp"
#include "ingest/affine.hpp"
#include "lod/scene/raster.hpp"

namespace relevo::ingest {

/// A file that says where the sea is: polygons (posts inside are sea) in anything that OGR reads, or a raster
/// (posts whose nearest pixel is valid and not 0 are sea) in anything that GDAL reads.
class SeaMask {
  public:
    static Result<SeaMask> open(const std::string& file, const geo::GridFrame& frame);

    SeaMask(SeaMask&&) noexcept;
    SeaMask& operator=(SeaMask&&) noexcept;
    ~SeaMask();

    /// The file's name without its folder.
    const std::string& name() const { return name_; }

    /// 1 where a post of the window is sea, else 0; from any thread.
    Result<void> read(Window window, lod::Raster<std::uint8_t>& is_sea) const;

    /// What can be read; one implementation for polygons, one for rasters.
    class Shape;

  private:
    SeaMask(std::string name, std::unique_ptr<Shape> shape);

    std::string name_;
    std::unique_ptr<Shape> shape_;
};

}  // namespace relevo::ingest
