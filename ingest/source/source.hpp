#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geo/result.hpp"
#include "ingest/affine.hpp"
#include "ingest/reference/crs.hpp"
#include "ingest/reference/vertical.hpp"
#include "ingest/source/height_encoding.hpp"
#include "ingest/source/open_dataset.hpp"
#include "lod/scene/raster.hpp"

namespace relevo::ingest {

/// An elevation file and what the user says about it.
struct SourceRequest {
    std::string input;
    std::optional<std::string> crs;  ///< in place of the file's own
    std::optional<Bounds>
        bounds;  ///< outer edges of the pixels in the CRS, in place of the file's georeference
    std::optional<double> nodata;  ///< in place of the band's own
    std::optional<double> height_scale;
    double height_offset = 0;
    std::optional<lod::VerticalDatum> vertical;

    std::optional<int> band;                 ///< from 1; else the only one that could be heights
    std::optional<std::string> variable;     ///< of a container (NetCDF, HDF); else its only one
    std::optional<RawLayout> raw;            ///< the file has no header, but this layout
    std::optional<HeightEncoding> encoding;  ///< heights are packed into colours
    Trust trust;
};

/// An open elevation raster that has passed all checks which need no heights to be read.
class Source {
  public:
    static Result<Source> open(const SourceRequest& request);

    const std::string& name() const { return opened_.name; }
    const std::filesystem::path& file() const { return opened_.file; }
    /// All that GDAL reads it from: also a VRT's sources, world files, ...
    std::vector<std::filesystem::path> all_files() const;
    int columns() const { return columns_; }
    int rows() const { return rows_; }
    const Crs& crs() const { return *crs_; }
    const Affine& posts() const { return posts_; }
    const HeightRule& heights() const { return rule_; }
    /// Are values whole numbers, and heights the values as they are?
    bool whole_metres() const;
    /// The type of the values: "Int16", "Float32", ...
    std::string value_type() const;
    const std::vector<std::string>& notes() const { return notes_; }

    /// Heights of a window at full resolution, metres, void = NaN. Posts outside the raster are void.
    Result<lod::Raster<double>> read(Window window) const;

  private:
    Source() = default;

    Result<void> choose_band(const std::optional<int>& wanted);
    Result<void> choose_colours();
    Result<void> read_values(Window window, lod::Raster<double>& into, int column, int row) const;
    Result<void> read_band(Window window, double* into, GSpacing line, const GdalMessages& messages) const;
    Result<void> read_colours(Window window, double* into, std::ptrdiff_t columns,
                              const GdalMessages& messages) const;
    bool is_void(double value) const;

    OpenDataset opened_;
    GDALRasterBand* band_ = nullptr;  // red where heights are packed into colours
    std::optional<HeightEncoding> encoding_;
    int columns_ = 0;
    int rows_ = 0;
    std::optional<Crs> crs_;
    Affine posts_;
    std::optional<double> nodata_;
    bool masked_ = false;
    HeightRule rule_;
    std::vector<std::string> notes_;
};

}  // namespace relevo::ingest
