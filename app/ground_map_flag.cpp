#include "app/ground_map_flag.hpp"

#include <utility>

#include "ingest/ground_map_file.hpp"

namespace relevo::app {

Result<std::shared_ptr<const viewer::GroundMap>> read_ground_map(const std::optional<std::string>& file,
                                                                 const geo::GridFrame& frame) {
    std::shared_ptr<const viewer::GroundMap> made;
    if (!file) return made;
    auto texels = ingest::read_ground_map(*file, frame);
    if (!texels) return Error{texels.error().kind, "--ground-map: " + texels.error().message};
    made = std::make_shared<viewer::GroundMap>(
        viewer::GroundMap{texels->columns, texels->rows, std::move(texels->shares)});
    return made;
}

}  // namespace relevo::app
