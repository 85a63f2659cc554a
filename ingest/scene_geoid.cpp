#include "ingest/scene_geoid.hpp"

#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "ingest/reference/vertical_datum.hpp"

namespace relevo::ingest {
namespace {

/// The geoid under the meshes: of the scene's datum, or EGM96 where that has none here, which is then said.
Result<std::optional<geo::Geoid>> geoid_under(const Mosaic& mosaic, const ImportOptions& options,
                                              lod::VerticalReference& vertical,
                                              std::vector<std::string>& notes) {
    if (mosaic.vertical().datum == lod::VerticalDatum::other) {
        auto own = geoid_of(mosaic.vertical(), options.mosaic.geoid);
        vertical.geoid_known = own && own->has_value();
        if (vertical.geoid_known) return own;
        notes.push_back(fmt::format("pictures put {} on EGM96; h and N stay unknown ({})", vertical.name,
                                    own ? "it has no geoid" : own.error().message));
    }
    if (mosaic.vertical().datum == lod::VerticalDatum::ellipsoid) return std::optional<geo::Geoid>{};
    auto egm96 = geo::Geoid::egm96();
    if (!egm96) return egm96.error();
    return std::optional(*std::move(egm96));
}

/// What the scene keeps of it: nodes around the padded grid.
geo::GeoidNodes nodes_under(const geo::Geoid& geoid, const geo::GridFrame& frame) {
    geo::GridFrame padded = frame;
    padded.columns = padded.rows = frame.padded_side();
    return geoid.nodes_around(padded.extent());
}

}  // namespace

Result<lod::UndulationGrid> write_geoid(const Mosaic& mosaic, const ImportOptions& options,
                                        lod::SceneWriter& writer, lod::VerticalReference& vertical,
                                        std::vector<std::string>& notes) {
    const auto geoid = geoid_under(mosaic, options, vertical, notes);
    if (!geoid) return geoid.error();
    if (!geoid->has_value()) return lod::UndulationGrid{};
    const geo::GeoidNodes nodes = nodes_under(**geoid, mosaic.frame());
    auto kept = geo::Geoid::from_nodes(nodes, "the scene's geoid");
    if (!kept) return kept.error();
    if (auto done = writer.write_geoid(nodes); !done) return done.error();
    return lod::UndulationGrid{std::make_shared<const geo::Geoid>(*std::move(kept)), mosaic.frame()};
}

}  // namespace relevo::ingest
