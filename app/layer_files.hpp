#pragma once

#include <memory>
#include <string>

#include "geo/frame.hpp"
#include "geo/result.hpp"
#include "viewer/flight/layer_files.hpp"

namespace relevo::app {

/// Opens a file for a scene's grid. Fails as ingest::ImageFile and VectorFile do.
/// \param colour  which one lines have
Result<std::shared_ptr<const viewer::Drape>> open_image(const std::string& file, const geo::GridFrame& frame);
Result<std::shared_ptr<const viewer::Drape>> open_lines(const std::string& file, const geo::GridFrame& frame,
                                                        std::size_t colour);

/// What the window can make of files: by content (ingest::contents_of), and measurements where an ending says
/// that it may be some and they can be read.
viewer::LayerFiles layer_files();

}  // namespace relevo::app
