#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "geo/frame.hpp"
#include "geo/result.hpp"
#include "ingest/affine.hpp"
#include "ingest/reference/crs.hpp"
#include "ingest/reference/operation.hpp"
#include "ingest/source/open_dataset.hpp"
#include "ingest/source/trust.hpp"
#include "lod/scene/raster.hpp"

namespace relevo::ingest {

/// A raster that is not 0 where the sea is.
class SeaRaster {
  public:
    static Result<SeaRaster> open(const std::string& file, const Trust& trust, const geo::GridFrame& frame);

    /// 1 at posts whose nearest pixel is valid and not 0, else 0 (also beyond the raster); from any thread.
    Result<void> read(Window window, lod::Raster<std::uint8_t>& is_sea) const;

  private:
    SeaRaster(OpenDataset opened, Crs crs, Operation operation, const Affine& to_pixel,
              const geo::GridFrame& frame);

    OpenDataset opened_;
    Crs crs_;
    Operation operation_;
    Affine to_pixel_;  // from its CRS to column and row; pixel centres are whole
    geo::GridFrame frame_;
    std::unique_ptr<std::mutex> reading_ = std::make_unique<std::mutex>();  // GDAL and PROJ: one at a time
};

}  // namespace relevo::ingest
