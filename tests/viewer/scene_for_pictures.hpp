#pragma once

#include <string>

#include "tests/lod/scratch_scene.hpp"
#include "tests/lod/synthetic_terrain.hpp"

namespace relevo::test {

/// Writes a small scene of mountains, heights above the ellipsoid.
inline void write_mountains(const std::string& path) {
    SceneParts parts;
    const auto frame = geographic_frame(129, 129);
    parts.heights = make_heights(frame, mountains);
    parts.metrics = lod::build_metrics(frame, {}, parts.heights);
    parts.info.frame = frame;
    parts.info.vertical = {lod::VerticalDatum::ellipsoid, "WGS 84 ellipsoid", false};
    parts.info.height_min_m = parts.info.height_max_m = static_cast<double>(parts.heights.at(0, 0));
    for (const float H : parts.heights.samples()) {
        parts.info.height_min_m = std::min(parts.info.height_min_m, static_cast<double>(H));
        parts.info.height_max_m = std::max(parts.info.height_max_m, static_cast<double>(H));
    }
    parts.info.valid_posts = parts.heights.samples().size();
    parts.info.resampling_method = "none";
    const auto written = write_scene(parts, path);
    ASSERT_TRUE(written) << written.error().message;
}

}  // namespace relevo::test
