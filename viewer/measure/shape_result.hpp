#pragma once

#include <atomic>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "geo/units.hpp"
#include "lod/measure/height_sampler.hpp"
#include "lod/measure/profile.hpp"
#include "lod/measure/viewshed.hpp"
#include "viewer/measure/measure_tool.hpp"

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
    std::vector<std::string> lines;                 ///< for people, with units and datum
    nlohmann::json json;                            ///< for files: SI, as `relevo measure --json`
    std::vector<OutlinePoint> outline;              ///< vertex after vertex, an area's closed
    std::vector<std::size_t> vertices;              ///< where they are in it
    std::vector<std::optional<double>> H_m;         ///< at the vertices
    std::optional<lod::Profile> profile;            ///< of a line, a path or a line of sight
    std::shared_ptr<const lod::Viewshed> viewshed;  ///< of a viewshed
    std::string label;                              ///< the one number that is drawn beside it
    bool stopped = false;                           ///< its user did not want to wait
};

/// Measures a shape; whatever goes wrong is said in its lines. \pre is_measurable(shape)
/// \param progress  told the part done, 0 to 1, from any thread; where it says false there is no result
ShapeResult measure_shape(lod::HeightSampler& sampler, const Shape& shape, geo::UnitSystem units,
                          const std::function<bool(double)>& progress = {});

/// The results of shapes as they change, worked out in the background one after the other. What is no longer
/// wanted is stopped, not waited for.
class ShapeResults {
  public:
    /// The scene must outlive it.
    explicit ShapeResults(const lod::Scene& scene) : sampler_(scene) {}
    ~ShapeResults();

    /// Takes what is done and begins what is missing; results of shapes that are gone go.
    void update(const std::vector<Shape>& shapes, geo::UnitSystem units);
    bool busy() const { return running_ != nullptr; }

    /// Null where it is not there yet.
    const ShapeResult* find(const Shape& shape) const;
    /// Of the one that is being measured, 0 to 1.
    std::optional<double> progress(const Shape& shape) const;

    /// Stops what is being measured; its result says so.
    void cancel();
    /// Measures a shape anew.
    void forget(const Shape& shape);

  private:
    struct Known {
        Shape shape;
        geo::UnitSystem units;
        ShapeResult result;
    };
    struct Running {
        Shape shape;
        geo::UnitSystem units;
        std::atomic<double> progress = 0;
        std::atomic<bool> stop = false;
        bool cancelled = false;  // by its user
        std::future<ShapeResult> result;
    };
    lod::HeightSampler sampler_;  // the running measurement's alone
    std::vector<Known> known_;
    std::unique_ptr<Running> running_;
};

}  // namespace relevo::viewer
