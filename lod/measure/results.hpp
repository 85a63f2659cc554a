#pragma once

#include <nlohmann/json.hpp>

#include "lod/measure/area.hpp"
#include "lod/measure/measurement.hpp"
#include "lod/measure/path.hpp"
#include "lod/measure/point.hpp"
#include "lod/measure/profile.hpp"
#include "lod/measure/sight.hpp"
#include "lod/measure/source_position.hpp"
#include "lod/measure/viewshed.hpp"

// What was measured as JSON: the one place that names the results, for the command line, files and the
// viewer. Metres and degrees, units in the names, null for unknown.
namespace relevo::lod {

/// The source of a place's nearest post (of the first source where there is none), and the place in its CRS.
struct PointSource {
    const SourceInfo* info = nullptr;  ///< null: the scene names none
    std::optional<SourcePosition> position;
};
PointSource source_of(const SceneInfo& info, const PointMeasurement& point);

/// "land", "sea", "void", "outside".
const char* to_string(PointClass kind);

nlohmann::json results_of(const PointMeasurement& point, const PointSource& source, const SceneInfo& info);
nlohmann::json results_of(const LineMeasurement& line);
nlohmann::json results_of(const PathMeasurement& path);
nlohmann::json results_of(const Profile& profile);  ///< with all samples
nlohmann::json results_of(const AreaMeasurement& area, const SceneInfo& info);
nlohmann::json results_of(const SightMeasurement& sight, const Looking& looking);
nlohmann::json results_of(const Viewshed& shed, const ViewshedRequest& request);

/// Measures by kind: a point, a path, a polygon, with `kind` in the results; and H at each vertex.
struct MeasuredItem {
    nlohmann::json results;
    std::vector<std::optional<double>> H_m;
};
/// Fails as check(), measure_area and the rest do.
Result<MeasuredItem> measure_item(HeightSampler& sampler, const Measurement& measurement,
                                  const AreaRequest& request = {});

}  // namespace relevo::lod
