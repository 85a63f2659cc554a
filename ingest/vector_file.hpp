#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "geo/frame.hpp"
#include "geo/result.hpp"
#include "ingest/image_file.hpp"

namespace relevo::ingest {

/// Is a file in a format that VectorFile reads, with a layer of geometries in it?
bool is_vector_file(const std::string& file);

/// Lines and points of a file, as they lie on a scene's grid, to be told texel by texel. Polygons are their
/// rings.
class VectorFile {
  public:
    /// Reads all layers of a file in a vector format of OGR (GPX, GeoJSON, Shapefile, GeoPackage, KML, ...),
    /// in any CRS; of GPX the tracks, routes and waypoints. Straight lines of the file's CRS stay straight in
    /// it. Fails with ErrorKind::input where the file cannot be read or has none in the grid.
    static Result<std::shared_ptr<const VectorFile>> open(const std::string& file,
                                                          const geo::GridFrame& frame);

    /// Where from each texel the nearest line and the nearest point are, so that whoever draws them can make
    /// them as wide as he likes. From any thread.
    ///
    /// First and second byte: the direction across the line, in 256ths of half a turn from the columns'
    /// towards the rows', and how far along it the line is, 128 + kLineSteps a texel; 0 where none is within
    /// kLineReach. Third and fourth: how many columns and rows on the point is, 128 + kPointSteps a texel; 0
    /// where none is within kPointReach.
    ImageTexels draw(const GridSquare& square) const;
    static constexpr double kLineSteps = 16;
    static constexpr double kLineReach = 7.9;
    static constexpr double kPointSteps = 8;
    static constexpr double kPointReach = 15.8;  ///< either way

    /// In posts.
    struct Segment {
        geo::GridPosition from;
        geo::GridPosition to;  ///< the same: a point
    };
    const std::vector<Segment>& segments() const { return segments_; }

  private:
    explicit VectorFile(const geo::GridFrame& frame);
    void add(const Segment& segment);
    /// Of the bins that a square of posts touches.
    std::vector<std::uint32_t> near(double west, double north, double east, double south) const;

    static constexpr int kBins = 64;  // a side
    geo::GridFrame frame_;
    std::vector<Segment> segments_;
    std::vector<std::vector<std::uint32_t>> bins_;
};

}  // namespace relevo::ingest
