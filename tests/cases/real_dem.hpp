#pragma once

#include <ostream>

#include "ingest/import.hpp"
#include "tests/lod/scratch_scene.hpp"
#include "tests/shared_data.hpp"

namespace relevo::test {

/// A file of the developers' data folder.
struct RealDem {
    const char* name;
    const char* file;
    const char* crs;  // where the file does not say
};

inline void PrintTo(const RealDem& dem, std::ostream* out) {
    *out << dem.file;
}

/// Imports it into the folder as a user would, but for the options given.
inline Result<lod::Scene> import_real(const RealDem& dem, const SceneFolder& folder,
                                      ingest::ImportOptions options = {}) {
    ingest::SourceRequest& source = options.mosaic.sources.emplace_back();
    source.input = shared_data(dem.file).string();
    if (*dem.crs != '\0') source.crs = dem.crs;
    const auto place = folder / "real.relevo";
    if (auto done = ingest::import_scene(options, {place}); !done) return done.error();
    return lod::Scene::open(place);
}

}  // namespace relevo::test
