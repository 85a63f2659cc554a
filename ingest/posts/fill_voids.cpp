#include "ingest/posts/fill_voids.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <gdal_alg.h>
#include <gdal_priv.h>

#include "ingest/source/gdal_messages.hpp"
#include "ingest/source/open_dataset.hpp"

namespace relevo::ingest {
namespace {

using Flags = lod::Raster<std::uint8_t>;
using Marks = lod::Raster<lod::PostMark>;

/// 1 where a square of `side` posts that are all void, or beyond the raster, lies over the post. The raster
/// is widened by one row and column all around, which stand for the outside.
///
/// An opening of the voids: erosion and dilation by the square, each of them by columns and by rows.
class WideVoids {
  public:
    WideVoids(const Marks& marks, int side) : side_(side), posts_(marks.columns() + 2, marks.rows() + 2, 1) {
        for (int r = 0; r < marks.rows(); ++r) {
            for (int c = 0; c < marks.columns(); ++c)
                posts_.at(c + 1, r + 1) = marks.at(c, r).is_void() ? 1 : 0;
        }
        open_rows();
    }

    bool at(int column, int row) const { return wide_.at(column + 1, row + 1) != 0; }

  private:
    /// Whether the square whose south-east post is here is void. Squares that reach over the raster's edge
    /// are void there.
    void open_rows() {
        // Runs of void posts that end here, to the west; beyond the edge they go on.
        const int columns = posts_.columns();
        const int rows = posts_.rows();
        lod::Raster<int> run(columns + side_ - 1, rows + side_ - 1);
        // How many rows up, from here, have a run of `side`.
        lod::Raster<int> stack(columns + side_ - 1, rows + side_ - 1);
        const auto is_void = [&](int c, int r) { return c >= columns || r >= rows || posts_.at(c, r) != 0; };
        for (int r = 0; r < run.rows(); ++r) {
            for (int c = 0; c < run.columns(); ++c) {
                run.at(c, r) = is_void(c, r) ? std::min((c > 0 ? run.at(c - 1, r) : side_) + 1, side_) : 0;
                const bool full = run.at(c, r) == side_;
                stack.at(c, r) = full ? std::min((r > 0 ? stack.at(c, r - 1) : side_) + 1, side_) : 0;
            }
        }
        // A post is under a square if one ends up to side - 1 posts to its east and south.
        wide_ = Flags(columns, rows);
        Flags across(columns, rows + side_ - 1);
        for (int r = 0; r < across.rows(); ++r) {
            int next = side_;  // columns to the nearest square's end, eastwards
            for (int c = run.columns() - 1; c >= 0; --c) {
                next = stack.at(c, r) == side_ ? 0 : std::min(next + 1, side_);
                if (c < columns) across.at(c, r) = next < side_ ? 1 : 0;
            }
        }
        for (int c = 0; c < columns; ++c) {
            int next = side_;
            for (int r = across.rows() - 1; r >= 0; --r) {
                next = across.at(c, r) != 0 ? 0 : std::min(next + 1, side_);
                if (r < rows) wide_.at(c, r) = next < side_ ? 1 : 0;
            }
        }
    }

    int side_;
    Flags posts_;
    Flags wide_;
};

/// 1 where a void post is narrow, by the rule of fill_voids.
Flags narrow_voids(const Marks& marks, int width) {
    const WideVoids wide{marks, width + 1};
    const int columns = marks.columns();
    const int rows = marks.rows();
    // Steps from a wide void, through voids; the outside is wide.
    constexpr int kUnreached = kWidestFill + 1;
    lod::Raster<int> steps(columns, rows, kUnreached);
    struct Post {
        int column;
        int row;
    };
    std::vector<Post> front;
    for (int r = 0; r < rows; ++r) {
        for (int c = 0; c < columns; ++c) {
            if (!marks.at(c, r).is_void()) continue;
            const bool at_edge = c == 0 || r == 0 || c + 1 == columns || r + 1 == rows;
            if (!wide.at(c, r) && !at_edge) continue;
            steps.at(c, r) = wide.at(c, r) ? 0 : 1;
            if (wide.at(c, r)) front.push_back({c, r});
        }
    }
    for (int step = 1; step <= width; ++step) {
        std::vector<Post> next;
        if (step == 2) {  // those one step from the outside
            for (int r = 0; r < rows; ++r) {
                for (int c = 0; c < columns; ++c) {
                    if (steps.at(c, r) == 1) front.push_back({c, r});
                }
            }
        }
        for (const Post post : front) {
            for (int r = std::max(post.row - 1, 0); r <= std::min(post.row + 1, rows - 1); ++r) {
                for (int c = std::max(post.column - 1, 0); c <= std::min(post.column + 1, columns - 1); ++c) {
                    if (!marks.at(c, r).is_void() || steps.at(c, r) <= step) continue;
                    steps.at(c, r) = step;
                    next.push_back({c, r});
                }
            }
        }
        front = std::move(next);
    }
    Flags narrow(columns, rows);
    for (int r = 0; r < rows; ++r) {
        for (int c = 0; c < columns; ++c)
            narrow.at(c, r) = marks.at(c, r).is_void() && steps.at(c, r) == kUnreached ? 1 : 0;
    }
    return narrow;
}

Error failed(const GdalMessages& messages) {
    return {ErrorKind::internal, "filling voids failed: " + messages.text()};
}

/// The raster with its voids interpolated as far as GDAL goes.
Result<lod::Raster<float>> interpolated(const lod::Raster<float>& heights, const Marks& marks, int reach) {
    GDALAllRegister();
    const GdalMessages messages;
    auto* memory = GetGDALDriverManager()->GetDriverByName("MEM");
    if (memory == nullptr) return Error{ErrorKind::internal, "GDAL has no MEM driver"};
    const int columns = heights.columns();
    const int rows = heights.rows();
    const DatasetPtr dataset{memory->Create("", columns, rows, 1, GDT_Float32, nullptr)};
    const DatasetPtr mask{memory->Create("", columns, rows, 1, GDT_Byte, nullptr)};
    if (!dataset || !mask) return failed(messages);
    lod::Raster<float> filled(columns, rows);
    Flags valid(columns, rows);
    for (std::size_t i = 0; i < filled.samples().size(); ++i) {
        const bool has_height = !marks.samples()[i].is_void();
        valid.samples()[i] = has_height ? 1 : 0;
        filled.samples()[i] = has_height ? heights.samples()[i] : 0;
    }
    GDALRasterBand* band = dataset->GetRasterBand(1);
    GDALRasterBand* valid_band = mask->GetRasterBand(1);
    const auto pass = [&](GDALRWFlag direction) {
        return band->RasterIO(direction, 0, 0, columns, rows, filled.samples().data(), columns, rows,
                              GDT_Float32, 0, 0, nullptr) == CE_None;
    };
    const char* options[] = {"TEMP_FILE_DRIVER=MEM", nullptr};
    const bool done = pass(GF_Write) &&
                      valid_band->RasterIO(GF_Write, 0, 0, columns, rows, valid.samples().data(), columns,
                                           rows, GDT_Byte, 0, 0, nullptr) == CE_None &&
                      GDALFillNodata(band, valid_band, reach, 0, 0, const_cast<char**>(options), nullptr,
                                     nullptr) == CE_None &&
                      pass(GF_Read);
    if (!done) return failed(messages);
    return filled;
}

}  // namespace

Result<std::uint64_t> fill_voids(lod::Raster<float>& heights, Marks& marks, Window inside, int width,
                                 bool whole_metres) {
    assert(width >= 1 && width <= kWidestFill);
    assert(heights.columns() == marks.columns() && heights.rows() == marks.rows());
    if (std::none_of(marks.samples().begin(), marks.samples().end(),
                     [](lod::PostMark mark) { return mark.is_void(); }))
        return std::uint64_t{0};
    const Flags narrow = narrow_voids(marks, width);
    std::uint64_t count = 0;
    for (int r = inside.row; r < inside.row + inside.rows; ++r) {
        const std::uint8_t* row = narrow.row(r) + inside.column;
        count += static_cast<std::uint64_t>(std::count(row, row + inside.columns, 1));
    }
    if (count == 0) return count;

    const auto filled = interpolated(heights, marks, 2 * width);
    if (!filled) return filled.error();
    for (int r = inside.row; r < inside.row + inside.rows; ++r) {
        for (int c = inside.column; c < inside.column + inside.columns; ++c) {
            if (narrow.at(c, r) == 0) continue;
            const float height = filled->at(c, r);
            heights.at(c, r) = whole_metres ? std::round(height) : height;
            marks.at(c, r).set_class(lod::PostClass::land);
            marks.at(c, r).set_filled();
        }
    }
    return count;
}

}  // namespace relevo::ingest
