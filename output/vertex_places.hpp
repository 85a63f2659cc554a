#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>
#include <tbb/enumerable_thread_specific.h>

#include "geo/post_positions.hpp"
#include "lod/measure/source_position.hpp"
#include "lod/scene/block_grid.hpp"
#include "lod/scene/scene.hpp"
#include "lod/undulation_grid.hpp"

namespace relevo::output {

/// What the coordinates of a mesh's vertices are.
enum class Coordinates {
    geodetic,  ///< longitude and latitude (WGS 84, degrees), height
    ecef,      ///< earth-centred, earth-fixed (WGS 84), metres
    source,    ///< x and y in the CRS of the scene's first source, height
    enu,       ///< metres east, north and up of the middle of the box on the ellipsoid
};

/// Which height stands beside a longitude and latitude, or an x and y.
enum class Heights {
    datum,      ///< H, above the scene's vertical datum
    ellipsoid,  ///< h, above the WGS 84 ellipsoid
};

/// "geodetic", ...: the names on the command line.
const char* to_string(Coordinates coordinates);

/// Where the posts of a box are, in the coordinates of an output. Positions in space agree with GeographicLib
/// to 10 nm and take N from UndulationGrid, 0.1 mm from the geoid. Any threads may ask at once.
class VertexPlaces {
  public:
    /// Fails with ErrorKind::input where a height above the ellipsoid is wanted and N is not known, or PROJ
    /// does not know the way to the source's CRS. The scene must outlive this.
    static Result<VertexPlaces> create(const lod::Scene& scene, const lod::BlockGrid::Box& box,
                                       Coordinates coordinates, Heights heights);

    /// Of a post of the box with height H. Fails with ErrorKind::input where it has no place in the source's
    /// CRS.
    Result<glm::dvec3> at(int column, int row, float H) const;

    /// A whole number near the middle of the box in x and y (in all three for ECEF, where it is rounded to
    /// metres; degrees to 1e-3): what float positions are relative to. Heights are not shifted but in ECEF.
    glm::dvec3 origin() const { return origin_; }

    Coordinates coordinates() const { return coordinates_; }
    /// "longitude_deg", "latitude_deg", "H_m" and so on.
    const std::array<std::string, 3>& axes() const { return axes_; }
    /// "EPSG:4326", ..., the source's; "" for ENU, which the origin defines.
    const std::string& crs() const { return crs_; }
    /// What the third coordinate is above, or positions in space contain.
    const std::string& vertical_datum() const { return vertical_datum_; }
    /// Where ENU counts from: a place on the ellipsoid.
    geo::LatLon enu_origin() const { return enu_origin_; }
    /// N of the scene's posts; none where no height above the ellipsoid is wanted.
    const lod::UndulationGrid& undulations() const { return undulations_; }

  private:
    VertexPlaces(const lod::Scene& scene, const lod::BlockGrid::Box& box, Coordinates coordinates,
                 Heights heights);

    double height(int column, int row, float H) const;

    const lod::Scene* scene_;
    lod::BlockGrid::Box box_;
    Coordinates coordinates_;
    std::array<std::string, 3> axes_;
    std::string crs_;
    std::string vertical_datum_;
    glm::dvec3 origin_{0};
    geo::LatLon enu_origin_;
    lod::UndulationGrid undulations_;
    std::unique_ptr<geo::PostPositions> positions_;  // ECEF and ENU
    std::unique_ptr<geo::EnuFrame> enu_;
    using Projections = tbb::enumerable_thread_specific<std::optional<lod::SourceProjection>>;
    std::unique_ptr<Projections> projections_;
};

}  // namespace relevo::output
