#pragma once

#include <memory>
#include <string>
#include <vector>

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include "geo/frame.hpp"
#include "geo/result.hpp"
#include "ingest/affine.hpp"
#include "ingest/source/open_dataset.hpp"
#include "lod/scene/raster.hpp"

namespace relevo::ingest {

/// Opens a file of polygons; nothing where OGR does not read it as one.
DatasetPtr open_polygons(const std::string& file);

/// Polygons over a scene's grid.
class SeaPolygons {
  public:
    /// Reads all polygons that touch the grid. Their edges are straight in their own CRS (a chord of 8 posts
    /// at most stands for that in another one), and longitudes may be in any turn.
    static Result<SeaPolygons> read(GDALDataset& dataset, const std::string& name,
                                    const geo::GridFrame& frame);

    /// 1 at posts inside of a polygon, else 0; GDAL's rule for posts on an edge.
    Result<void> read(Window window, lod::Raster<std::uint8_t>& inside) const;

    bool empty() const { return polygons_.empty(); }

  private:
    struct Polygon {
        std::unique_ptr<OGRGeometry> geometry;  // in columns and rows of the grid
        OGREnvelope box;
    };
    std::vector<Polygon> polygons_;
};

}  // namespace relevo::ingest
