#pragma once

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "ingest/import.hpp"
#include "lod/scene/scene.hpp"
#include "tests/ingest/synthetic_raster.hpp"

namespace relevo::test {

/// A scene as it came back from disk.
struct ImportedScene {
    lod::SceneInfo info;
    lod::Raster<float> heights;
    std::vector<std::string> notes;

    /// Bilinear height at a place, for comparisons; NaN where a corner is void or outside.
    double height(double lat, double lon) const {
        const auto p = info.frame.grid_position({geo::Degrees{lat}, geo::Degrees{lon}});
        const double c = std::floor(p.column);
        const double r = std::floor(p.row);
        if (c < 0 || r < 0 || c + 1 >= heights.columns() || r + 1 >= heights.rows()) return std::nan("");
        const int i = static_cast<int>(c);
        const int j = static_cast<int>(r);
        const double u = p.column - c;
        const double v = p.row - r;
        return (1 - v) * ((1 - u) * static_cast<double>(heights.at(i, j)) +
                          u * static_cast<double>(heights.at(i + 1, j))) +
               v * ((1 - u) * static_cast<double>(heights.at(i, j + 1)) +
                    u * static_cast<double>(heights.at(i + 1, j + 1)));
    }
};

inline ingest::ImportOptions options_for(const std::filesystem::path& input) {
    ingest::ImportOptions options;
    options.mosaic.sources.emplace_back().input = input.string();
    return options;
}

/// Imports into the folder and reads the scene back; a failure fails the test and gives an empty scene.
inline ImportedScene imported(const SceneFolder& folder, const ingest::ImportOptions& options) {
    const auto place = folder / "scene.relevo";
    auto done = ingest::import_scene(options, {.scene = place, .overwrite = true});
    if (!done) {
        ADD_FAILURE() << done.error().message;
        return {};
    }
    const auto scene = lod::Scene::open(place);
    EXPECT_TRUE(scene) << (scene ? "" : scene.error().message);
    if (!scene) return {};
    auto heights = scene->read_all_heights();
    EXPECT_TRUE(heights);
    return {scene->info(), heights ? std::move(*heights) : lod::Raster<float>{}, std::move(done->notes)};
}

/// The message of an import that must be refused as an input, with nothing left behind.
inline std::string refused(const SceneFolder& folder, const ingest::ImportOptions& options) {
    const auto place = folder / "refused.relevo";
    const auto done = ingest::import_scene(options, {.scene = place});
    EXPECT_FALSE(done);
    EXPECT_FALSE(std::filesystem::exists(place));
    if (done) return "imported";
    EXPECT_EQ(done.error().kind, ErrorKind::input) << done.error().message;
    return done.error().message;
}

/// Does a message say all that it should?
inline testing::AssertionResult says(const std::string& message, std::initializer_list<const char*> parts) {
    for (const char* part : parts)
        if (message.find(part) == std::string::npos)
            return testing::AssertionFailure() << "'" << part << "' is not in: " << message;
    return testing::AssertionSuccess();
}

}  // namespace relevo::test
