#pragma once

#include <optional>

#include <gdal_priv.h>

#include "lod/scene/block_grid.hpp"
#include "lod/scene/scene.hpp"

namespace relevo::output {

/// A box of a scene's posts as GDAL reads them: one band, blocks made from the scene's when asked for.
class SceneDataset : public GDALDataset {
  public:
    /// The scene must outlive this.
    SceneDataset(const lod::Scene& scene, const lod::BlockGrid::Box& box);

    CPLErr GetGeoTransform(double* transform) override;
    const OGRSpatialReference* GetSpatialRef() const override { return &crs_; }

    /// The first failure to read a block, for a better message than GDAL's.
    const std::optional<Error>& failure() const { return failure_; }

  private:
    friend class SceneBand;

    CPLErr read(int block_column, int block_row, void* samples);

    const lod::Scene& scene_;
    lod::BlockGrid::Box box_;
    OGRSpatialReference crs_;
    std::optional<Error> failure_;
};

}  // namespace relevo::output
