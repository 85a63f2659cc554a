#include "lod/measure/area.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "geo/ellipsoid.hpp"
#include "lod/measure/cell_sums.hpp"
#include "lod/scene/parallel_blocks.hpp"
#include "lod/scene/read_box.hpp"

namespace relevo::lod {
namespace {

/// A rectangle of cells: those between posts [west, east] and [north, south].
struct Cells {
    int west = 0;
    int north = 0;
    int east = 0;
    int south = 0;

    int across() const { return east - west; }
    int down() const { return south - north; }
};

/// Calls `visit(half, ring's part in it)` for both halves of cells that a ring may be in.
template <class Visit>
void halve(const Cells& cells, const GridRing& ring, const Visit& visit) {
    Cells low = cells;
    Cells high = cells;
    const auto middle = [](int from, int to) {
        // Whole blocks as long as there are several, so that each is read by few.
        constexpr int kSide = SceneInfo::kBlockSide;
        const int half = from + (to - from) / 2;
        const int block = (half + kSide / 2) / kSide * kSide;
        return block > from && block < to ? block : half;
    };
    if (cells.across() >= cells.down()) {
        low.east = high.west = middle(cells.west, cells.east);
        visit(low, clip_columns(ring, low.east, Side::low));
        visit(high, clip_columns(ring, low.east, Side::high));
    } else {
        low.south = high.north = middle(cells.north, cells.south);
        visit(low, clip_rows(ring, low.south, Side::low));
        visit(high, clip_rows(ring, low.south, Side::high));
    }
}

enum class Cover { none, part, whole };

/// How much of the cells is in a ring that was clipped to them.
Cover cover_of(const Cells& cells, const GridRing& ring) {
    if (ring.size() < 3) return Cover::none;
    for (const geo::GridPosition& p : ring) {
        if (p.column != cells.west && p.column != cells.east && p.row != cells.north && p.row != cells.south)
            return Cover::part;
    }
    const double whole = static_cast<double>(cells.across()) * cells.down();
    const double area = signed_area(ring);
    if (std::abs(area) < 1e-12 * whole) return Cover::none;
    return std::abs(area - whole) < 1e-12 * whole ? Cover::whole : Cover::part;
}

struct Tile {
    Cells cells;
    GridRing ring;
};

void collect_tiles(const Cells& cells, const GridRing& ring, std::vector<Tile>& tiles) {
    constexpr int kSide = 2 * SceneInfo::kBlockSide;
    if (cover_of(cells, ring) == Cover::none) return;
    if (cells.across() <= kSide && cells.down() <= kSide) {
        tiles.push_back({cells, ring});
        return;
    }
    halve(cells, ring, [&](const Cells& half, const GridRing& part) { collect_tiles(half, part, tiles); });
}

/// One tile's cells, summed.
class TileSums {
  public:
    TileSums(const geo::GridFrame& frame, const Cells& cells, const Raster<float>& heights,
             const UndulationGrid& undulations, std::optional<double> plane)
        : frame_(frame), cells_(cells), heights_(heights), plane_(plane) {
        undulation_.resize(heights.samples().size());
        for (int row = 0; row < heights.rows(); ++row)
            undulations.add_row(cells.west, cells.north + row, heights.columns(),
                                undulation_.data() + static_cast<std::ptrdiff_t>(row) * heights.columns());
        if (frame.is_polar()) return;
        for (int row = cells.north; row < cells.south; ++row) rows_.push_back(metric({0.0, row + 0.0}, 1));
    }

    void add(const Cells& cells, const GridRing& ring) {
        switch (cover_of(cells, ring)) {
            case Cover::none:
                return;
            case Cover::whole:
                for (int row = cells.north; row < cells.south; ++row) {
                    for (int column = cells.west; column < cells.east; ++column) add_whole(column, row);
                }
                return;
            case Cover::part:
                break;
        }
        if (cells.across() == 1 && cells.down() == 1) {
            add_part(cells.west, cells.north, ring);
            return;
        }
        halve(cells, ring, [&](const Cells& half, const GridRing& part) { add(half, part); });
    }

    CellSums sums;

  private:
    struct Metric {
        std::array<double, 3> column_m{};
        std::array<double, 3> row_m{};
        double curvature = 0;
    };

    /// At a place and half a row and a row (times `rows`) below it.
    Metric metric(geo::GridPosition at, double rows) const {
        Metric m;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto spacing = frame_.spacing({at.column, at.row + 0.5 * rows * static_cast<double>(i)});
            m.column_m[i] = spacing.column_m;
            m.row_m[i] = spacing.row_m;
        }
        const double sin_lat = std::sin(frame_.lat_lon({at.column, at.row + 0.5 * rows}).lat.radians());
        const double w2 = 1 - geo::wgs84::kEccentricity2 * sin_lat * sin_lat;
        m.curvature = w2 / (geo::wgs84::kSemiMajor * std::sqrt(1 - geo::wgs84::kEccentricity2));
        return m;
    }

    GroundCell cell(int column, int row) const {
        const int x = column - cells_.west;
        const int y = row - cells_.north;
        const auto at = [&](int dx, int dy) { return static_cast<double>(heights_.at(x + dx, y + dy)); };
        const auto n = [&](int dx, int dy) {
            return undulation_[static_cast<std::size_t>(y + dy) *
                                   static_cast<std::size_t>(heights_.columns()) +
                               static_cast<std::size_t>(x + dx)];
        };
        GroundCell cell;
        cell.H = {column, row, at(0, 0), at(1, 0), at(0, 1), at(1, 1)};
        cell.h = {
            column, row, cell.H.nw + n(0, 0), cell.H.ne + n(1, 0), cell.H.sw + n(0, 1), cell.H.se + n(1, 1)};
        // In a polar grid the scale is as good as even within a cell (4e-8 in one of 5 km).
        const Metric here = frame_.is_polar() ? metric({column + 0.5, row + 0.5}, 0)
                                              : rows_[static_cast<std::size_t>(row - cells_.north)];
        cell.column_m = here.column_m;
        cell.row_m = here.row_m;
        cell.curvature = here.curvature;
        return cell;
    }

    static bool is_void(const GroundCell& cell) {
        return std::isnan(cell.H.nw + cell.H.ne + cell.H.sw + cell.H.se);
    }

    void add_whole(int column, int row) {
        const GroundCell ground = cell(column, row);
        if (is_void(ground)) {
            sums.void_m2 += cell_area(ground, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
        } else {
            add_whole_cell(ground, plane_, sums);
        }
    }

    void add_part(int column, int row, GridRing ring) {
        for (geo::GridPosition& p : ring) {
            p.column -= column;
            p.row -= row;
        }
        const GroundCell ground = cell(column, row);
        if (is_void(ground)) {
            sums.void_m2 += cell_area(ground, ring);
        } else {
            add_cell(ground, ring, plane_, sums);
        }
    }

    const geo::GridFrame& frame_;
    Cells cells_;
    const Raster<float>& heights_;
    std::optional<double> plane_;
    std::vector<double> undulation_;
    std::vector<Metric> rows_;
};

AreaMeasurement figures(const geo::GridFrame& frame, std::span<const geo::LatLon> polygon, CellSums sums,
                        std::optional<double> plane) {
    AreaMeasurement area;
    area.geodesic = geo::geodesic_area(polygon);
    area.measured_m2 = sums.area_m2;
    area.void_m2 = sums.void_m2;
    const double outside = area.geodesic.area_m2 - sums.area_m2 - sums.void_m2;
    constexpr double kRounding = 1e-6;
    if (outside > kRounding * area.geodesic.area_m2) area.outside_m2 = outside;
    if (!sums.lowest || !(sums.area_m2 > 0)) return area;
    const auto extreme = [&](const CellSums::Extreme& e) {
        return AreaMeasurement::Extreme{e.value, frame.lat_lon(e.place)};
    };
    area.surface_m2 = sums.surface_m2;
    area.lowest = extreme(*sums.lowest);
    area.highest = extreme(*sums.highest);
    area.mean_H_m = sums.H_m3 / sums.area_m2;
    area.mean_slope_deg = sums.slope_degrees_m2 / sums.area_m2;
    if (sums.steepest) {
        area.steepest_deg = extreme(*sums.steepest);
        area.steepest_deg->value = geo::Degrees::from_radians(std::atan(sums.steepest->value)).value;
    }
    area.plane_H_m = plane ? *plane : sums.lowest->value;
    const double net = sums.H_m3 - sums.area_m2 * *area.plane_H_m;
    area.volume_above_m3 = plane ? sums.above_m3 : net;
    area.volume_below_m3 = plane ? std::max(0.0, sums.above_m3 - net) : 0;
    return area;
}

}  // namespace

Result<AreaMeasurement> measure_area(const Scene& scene, std::span<const geo::LatLon> polygon,
                                     const AreaRequest& request) {
    const geo::GridFrame& frame = scene.info().frame;
    const auto rings = grid_rings(frame, polygon);
    if (!rings) return rings.error();

    std::vector<Tile> tiles;
    const Cells data{0, 0, frame.columns - 1, frame.rows - 1};
    for (GridRing ring : *rings) {
        if (data.across() < 1 || data.down() < 1) break;
        ring = clip_columns(ring, 0, Side::high);
        // A grid that closes may overlap itself by a part of a column.
        const double last = frame.is_polar() ? data.east : std::min<double>(data.east, 360 / frame.step_x);
        ring = clip_columns(ring, last, Side::low);
        ring = clip_rows(clip_rows(ring, 0, Side::high), data.south, Side::low);
        collect_tiles(data, ring, tiles);
    }

    const UndulationGrid undulations = tiles.empty() ? UndulationGrid{} : scene.undulations();
    std::vector<CellSums> sums(tiles.size());
    std::atomic<std::size_t> done = 0;
    std::atomic<bool> stopped = false;
    const auto summed = for_each_block(static_cast<int>(tiles.size()), [&](int i) -> Result<void> {
        if (stopped) return {};
        const auto& [cells, ring] = tiles[static_cast<std::size_t>(i)];
        const auto heights = read_box(scene, {cells.west, cells.north, cells.across() + 1, cells.down() + 1});
        if (!heights) return heights.error();
        TileSums tile(frame, cells, *heights, undulations, request.plane_H_m);
        tile.add(cells, ring);
        sums[static_cast<std::size_t>(i)] = tile.sums;
        if (request.progress &&
            !request.progress(static_cast<double>(++done) / static_cast<double>(tiles.size())))
            stopped = true;
        return {};
    });
    if (!summed) return summed.error();
    if (stopped) return Error{ErrorKind::internal, "stopped: the polygon was not measured"};
    CellSums whole;
    for (const CellSums& part : sums) whole.add(part);
    return figures(frame, polygon, whole, request.plane_H_m);
}

}  // namespace relevo::lod
