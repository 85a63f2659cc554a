#pragma once

#include <future>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "geo/units.hpp"
#include "lod/measure/height_sampler.hpp"
#include "lod/measure/profile.hpp"
#include "viewer/measure_tool.hpp"

namespace relevo::viewer {

/// Where a shape's outline is on the true ground.
struct OutlinePoint {
    geo::LatLon place;
    double distance_m = 0;  ///< from the first vertex, along the geodesics
    double N = 0;           ///< undulation, metres
    double H = 0;           ///< a void takes the height before it
};

/// What a shape comes to, from the full data.
struct ShapeResult {
    std::vector<std::string> lines;          ///< for people, with units and datum
    nlohmann::json json;                     ///< for files: SI, as `relevo measure --json`
    std::vector<OutlinePoint> outline;       ///< vertex after vertex, an area's closed
    std::vector<std::size_t> vertices;       ///< where they are in it
    std::vector<std::optional<double>> H_m;  ///< at the vertices
    std::optional<lod::Profile> profile;     ///< of a line, a path or a line of sight
    std::string label;                       ///< the one number that is drawn beside it
};

/// Measures a shape; whatever goes wrong is said in its lines. \pre is_measurable(shape)
ShapeResult measure_shape(lod::HeightSampler& sampler, const Shape& shape, geo::UnitSystem units);

/// The results of shapes as they change, worked out in the background one after the other.
class ShapeResults {
  public:
    /// The scene must outlive it.
    explicit ShapeResults(const lod::Scene& scene) : sampler_(scene) {}
    ~ShapeResults();

    /// Takes what is done and begins what is missing; results of shapes that are gone go.
    void update(const std::vector<Shape>& shapes, geo::UnitSystem units);
    bool busy() const { return running_.valid(); }

    /// Null where it is not there yet.
    const ShapeResult* find(const Shape& shape) const;

  private:
    struct Known {
        Shape shape;
        geo::UnitSystem units;
        ShapeResult result;
    };
    lod::HeightSampler sampler_;  // the running measurement's alone
    std::vector<Known> known_;
    std::future<Known> running_;
};

}  // namespace relevo::viewer
