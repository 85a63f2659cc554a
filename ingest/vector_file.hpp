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

/// Lines and points of a file, as they lie on a scene's grid, to be drawn into texels. Polygons are their
/// rings.
class VectorFile {
  public:
    /// Reads all layers of a file in a vector format of OGR (GPX, GeoJSON, Shapefile, GeoPackage, KML, ...),
    /// in any CRS; of GPX the tracks, routes and waypoints. Straight lines of the file's CRS stay straight in
    /// it. Fails with ErrorKind::input where the file cannot be read or has none in the grid.
    static Result<std::shared_ptr<const VectorFile>> open(const std::string& file,
                                                          const geo::GridFrame& frame,
                                                          std::array<std::uint8_t, 3> colour);

    /// Lines kLineTexels wide with a white rim, points as discs, whatever the texels' size. From any thread.
    ImageTexels draw(const GridSquare& square) const;
    static constexpr double kLineTexels = 5.0;
    static constexpr double kPointTexels = 7.0;  ///< radius
    static constexpr double kRimTexels = 1.4;

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
    std::array<std::uint8_t, 3> colour_{};
    std::vector<Segment> segments_;
    std::vector<std::vector<std::uint32_t>> bins_;
};

}  // namespace relevo::ingest
