#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace relevo::lod {

/// A grid of samples in memory, row by row from the north-west.
template <class T>
class Raster {
  public:
    Raster() = default;
    Raster(int columns, int rows, T fill = {})
        : columns_(columns),
          rows_(rows),
          samples_(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), fill) {}

    int columns() const { return columns_; }
    int rows() const { return rows_; }

    T& at(int column, int row) { return samples_[index(column, row)]; }
    const T& at(int column, int row) const { return samples_[index(column, row)]; }

    T* row(int r) { return samples_.data() + index(0, r); }
    const T* row(int r) const { return samples_.data() + index(0, r); }

    std::vector<T>& samples() { return samples_; }
    const std::vector<T>& samples() const { return samples_; }

  private:
    std::size_t index(int column, int row) const {
        assert(column >= 0 && column < columns_ && row >= 0 && row < rows_);
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
               static_cast<std::size_t>(column);
    }

    int columns_ = 0;
    int rows_ = 0;
    std::vector<T> samples_;
};

/// The refinement metrics of a padded grid, as 16-bit codes (soar/metric_code.hpp).
struct MetricRasters {
    Raster<std::uint16_t> bounded;      ///< bounded object-space error
    Raster<std::uint16_t> incremental;  ///< the reference's error
    Raster<std::uint16_t> radius;       ///< of the nested sphere; 0: nothing valid below this vertex
};

}  // namespace relevo::lod
