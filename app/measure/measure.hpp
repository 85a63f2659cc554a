#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "app/command.hpp"
#include "geo/units.hpp"
#include "lod/measure/height_sampler.hpp"
#include "lod/measure/measurement.hpp"
#include "lod/measure/sight.hpp"

namespace relevo::app {

/// What `relevo measure` was asked for.
struct MeasureFlags {
    Common common;
    std::string scene;
    std::string what;
    std::vector<std::string> places;
    std::string from;  ///< a file of places
    std::string save;  ///< a file for places and results
    std::string name;  ///< of what is saved
    std::string units = "metric";
    std::string format = "text";   ///< of a profile: text or csv
    std::string plane = "lowest";  ///< of an area's volumes
    lod::Looking looking;
    double radius_m = 0;
    std::string output;
    bool overwrite = false;

    geo::UnitSystem unit_system() const { return geo::unit_system(units).value_or(geo::UnitSystem::metric); }
};

/// The datum of the heights H, and whether the source said so.
std::string datum_text(const lod::VerticalReference& vertical);

/// "37.7397000, -105.5146000".
std::string place_text(geo::LatLon place);

// One file each: measure and print; what comes back is what JSON and files have.
using Places = std::vector<geo::LatLon>;
Result<nlohmann::json> measure_point(const MeasureFlags& flags, lod::HeightSampler& sampler,
                                     geo::LatLon place);
Result<nlohmann::json> measure_path(const MeasureFlags& flags, lod::HeightSampler& sampler,
                                    const Places& path);
Result<nlohmann::json> measure_profile(const MeasureFlags& flags, lod::HeightSampler& sampler,
                                       const Places& path);
Result<nlohmann::json> measure_area(const MeasureFlags& flags, lod::HeightSampler& sampler,
                                    const Places& polygon);
Result<nlohmann::json> measure_sight(const MeasureFlags& flags, lod::HeightSampler& sampler,
                                     const Places& ends);
Result<nlohmann::json> measure_viewshed(const MeasureFlags& flags, lod::HeightSampler& sampler,
                                        geo::LatLon eye);

}  // namespace relevo::app
