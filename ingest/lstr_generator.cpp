#include "ingest/lstr_generator.hpp"

#include <utility>

#include "lod/lstr/chunk_file.hpp"

namespace relevo::ingest {

Result<LstrGenerator> LstrGenerator::load_height_map(const ImportOptions& options, const ImportPlace& place,
                                                     const Progress& progress) {
    if (auto imported = import_scene(options, place, progress); !imported) return imported.error();
    return open(place.scene);
}

Result<LstrGenerator> LstrGenerator::load_height_map(const std::filesystem::path& file,
                                                     const std::filesystem::path& scene) {
    ImportOptions options;
    SourceRequest source;
    source.input = file.string();
    options.mosaic.sources.push_back(std::move(source));
    return load_height_map(options, {.scene = scene, .overwrite = true});
}

Result<LstrGenerator> LstrGenerator::open(const std::filesystem::path& scene) {
    auto opened = lod::Scene::open(scene);
    if (!opened) return opened.error();
    return LstrGenerator(*std::move(opened));
}

Result<lod::PostSet> LstrGenerator::simplify(double percent, lod::RemovalTest test) const {
    const auto heights = scene_.read_all_heights();
    if (!heights) return heights.error();
    return lod::removable_posts(*heights, lod::margin_of_range(*heights, percent), test);
}

Result<void> LstrGenerator::generate(const Simplification& by, const lod::ChunkProgress& progress) const {
    const auto terrain = lod::Terrain::open(scene_, lod::ErrorMetric::bounded, {});
    if (!terrain) return terrain.error();
    lod::ChunkBuilding building{lod::chunk_errors(*terrain), by.test};
    if (by.margin_m) building.errors = {*by.margin_m};
    return lod::make_chunk_file(scene_, *terrain, building, progress);
}

Result<void> LstrGenerator::generate() const {
    if (lod::ChunkFile::is_there(scene_)) return {};
    return generate(Simplification{});
}

}  // namespace relevo::ingest
