#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "geo/frame.hpp"
#include "geo/result.hpp"
#include "viewer/ground/drape.hpp"

namespace relevo::viewer {

/// What a file can be to a window.
enum class FileUse { elevation, imagery, vectors, measurements };

/// Files as layers, which the viewer itself does not know the formats of.
struct LayerFiles {
    /// What a file may be, the likelier first; one at least. Asked of files that exist.
    std::function<std::vector<FileUse>(const std::filesystem::path&)> uses_of;
    /// Opens imagery or vectors for a scene's grid; of the vectors, which of their colours they have. From
    /// any thread.
    std::function<Result<std::shared_ptr<const Drape>>(const std::filesystem::path&, FileUse,
                                                       const geo::GridFrame&, std::size_t colour)>
        open;
};

}  // namespace relevo::viewer
