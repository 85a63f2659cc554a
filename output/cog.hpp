#pragma once

#include <functional>
#include <string>

#include "output/partial_file.hpp"

#include "lod/scene/block_grid.hpp"
#include "lod/scene/scene.hpp"

namespace relevo::output {

struct CogRequest {
    std::string compression = "DEFLATE";  ///< or "ZSTD": smaller and faster, and not read by every program
    std::uint64_t cache_bytes = std::uint64_t{256} << 20;  ///< GDAL's, for blocks on their way
    std::function<bool(double)> progress;                  ///< told the part done, 0 to 1; false stops it
};

/// Heights of a box of posts as a cloud-optimised GeoTIFF, bit for bit: pixel-is-point, void as nodata, the
/// vertical datum in the CRS where PROJ knows it and in the metadata (VERTICAL_DATUM) in any case. Overviews
/// hold posts of the data, no averages. Reads the scene block by block, each against its checksum. One at a
/// time in a process. Fails with ErrorKind::damaged where a block is, ErrorKind::internal where the file
/// cannot be written.
Result<void> write_cog(const lod::Scene& scene, const lod::BlockGrid::Box& box, const CogRequest& request,
                       PartialFile& file);

}  // namespace relevo::output
