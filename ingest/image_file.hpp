#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "geo/frame.hpp"
#include "geo/result.hpp"
#include "ingest/source/open_dataset.hpp"

namespace relevo::ingest {

/// Texels of a square of a grid: red, green, blue and alpha, colours times alpha, row by row from the
/// north-west.
using ImageTexels = std::vector<std::array<std::uint8_t, 4>>;

/// A square of a grid: `side` texels a side, `step` posts apart; a texel's middle is at its place.
struct GridSquare {
    double column = 0;  ///< of the first texel, in posts of the grid
    double row = 0;
    double step = 1;
    int side = 0;
};

/// A picture of a part of the earth, in any CRS and format that GDAL reads: colours, shades of grey or a
/// palette, of bytes; nodata and alpha are transparent. Read piece by piece as it would lie on a scene's
/// grid.
class ImageFile {
  public:
    /// Fails with ErrorKind::input where the file is not such a picture, has no georeference, or nothing of
    /// it is in the grid.
    static Result<std::shared_ptr<const ImageFile>> open(const std::string& file,
                                                         const geo::GridFrame& frame);

    /// Of the grid's step, how long a pixel is: 0.1 where ten lie between two posts.
    double pixel_posts() const { return pixel_posts_; }

    /// Bilinear between pixels, the mean of them where texels are larger. By GDAL, with positions exact to
    /// 0.02 texels. From any thread.
    Result<ImageTexels> read(const GridSquare& square) const;

  private:
    /// The file, and how its bands are taken; used by one thread at a time.
    struct Handle {
        DatasetPtr file;
        DatasetPtr colours;  // refers to the file
    };
    ImageFile() = default;
    Result<Handle> take() const;
    Result<Handle> open_handle() const;

    std::string file_;
    std::string name_;
    geo::GridFrame frame_;
    double pixel_posts_ = 1;
    bool beyond_180_ = false;  // its longitudes go on beyond
    mutable std::mutex mutex_;
    mutable std::vector<Handle> free_;
};

}  // namespace relevo::ingest
