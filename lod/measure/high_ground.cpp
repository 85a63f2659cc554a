#include "lod/measure/high_ground.hpp"

#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace relevo::lod {
namespace {

template <class Work>
void for_each_row(int rows, const Work& work) {
    tbb::parallel_for(tbb::blocked_range<int>(0, rows), [&](const tbb::blocked_range<int>& range) {
        for (int row = range.begin(); row < range.end(); ++row) work(row);
    });
}

}  // namespace

HighGround::HighGround(const Scene& scene, const BlockGrid::Box& box, const Raster<float>& H)
    : h_(box.columns, box.rows) {
    const geo::GridFrame& frame = scene.info().frame;
    for_each_row(box.rows, [&](int row) {
        for (int column = 0; column < box.columns; ++column) {
            double h = static_cast<double>(H.at(column, row));
            if (scene.geoid() != nullptr && !std::isnan(h)) {
                const geo::GridPosition at{box.column + column + 0.0, box.row + row + 0.0};
                h += scene.geoid()->undulation(frame.lat_lon(at)).m;
            }
            h_.at(column, row) = h;
        }
    });
    Raster<float> cells(std::max(box.columns - 1, 1), std::max(box.rows - 1, 1));
    for_each_row(cells.rows(), [&](int row) {
        for (int column = 0; column < cells.columns(); ++column) {
            const Cell c = cell(column, row);
            const double highest = std::max({c.nw, c.ne, c.sw, c.se});
            const bool is_void = std::isnan(c.nw + c.ne + c.sw + c.se);
            cells.at(column, row) =
                is_void ? std::numeric_limits<float>::infinity()
                        : std::nextafter(static_cast<float>(highest), std::numeric_limits<float>::infinity());
        }
    });
    levels_.push_back(std::move(cells));
    while (levels_.back().columns() > 1 || levels_.back().rows() > 1) {
        const Raster<float>& fine = levels_.back();
        Raster<float> coarse((fine.columns() + 1) / 2, (fine.rows() + 1) / 2,
                             -std::numeric_limits<float>::infinity());
        for (int row = 0; row < fine.rows(); ++row) {
            for (int column = 0; column < fine.columns(); ++column) {
                float& highest = coarse.at(column / 2, row / 2);
                highest = std::max(highest, fine.at(column, row));
            }
        }
        levels_.push_back(std::move(coarse));
    }
}

}  // namespace relevo::lod
