#include "output/post_box.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "lod/measure/height_sampler.hpp"

namespace relevo::output {
namespace {

using lod::BlockGrid;

/// Columns and rows, as far as they go outside the grid too.
struct Range {
    double west = std::numeric_limits<double>::infinity();
    double north = std::numeric_limits<double>::infinity();
    double east = -std::numeric_limits<double>::infinity();
    double south = -std::numeric_limits<double>::infinity();

    void add(geo::GridPosition place) {
        west = std::min(west, place.column);
        east = std::max(east, place.column);
        north = std::min(north, place.row);
        south = std::max(south, place.row);
    }
};

int snapped_down(double coordinate) {
    return static_cast<int>(std::floor(coordinate + lod::HeightSampler::kPostTolerance));
}
int snapped_up(double coordinate) {
    return static_cast<int>(std::ceil(coordinate - lod::HeightSampler::kPostTolerance));
}

/// The posts of a range, as far as there are any; at least two a side, so that there is a cell.
std::optional<BlockGrid::Box> box_of(const geo::GridFrame& frame, const Range& range) {
    const double limit = std::max(frame.columns, frame.rows);
    const auto bounded = [&](double coordinate) { return std::clamp(coordinate, -2.0, limit + 1); };
    const int west = std::max(snapped_down(bounded(range.west)), 0);
    const int north = std::max(snapped_down(bounded(range.north)), 0);
    const int east = std::min(snapped_up(bounded(range.east)), frame.columns - 1);
    const int south = std::min(snapped_up(bounded(range.south)), frame.rows - 1);
    if (east <= west || south <= north) return {};
    return BlockGrid::Box{west, north, east - west + 1, south - north + 1};
}

std::vector<BlockGrid::Box> geographic_boxes(const geo::GridFrame& frame, const Bounds& bounds,
                                             double width) {
    std::vector<BlockGrid::Box> boxes;
    for (const int turn : {-2, -1, 0, 1, 2}) {
        const double west = (bounds.west + 360 * turn - frame.west) / frame.step_x;
        const Range range{.west = west,
                          .north = (frame.north - bounds.north) / frame.step_y,
                          .east = west + width / frame.step_x,
                          .south = (frame.north - bounds.south) / frame.step_y};
        if (const auto box = box_of(frame, range)) boxes.push_back(*box);
    }
    return boxes;
}

/// Easting and northing are largest and smallest at corners of the area, or where a side along a parallel
/// crosses a meridian along which the grid runs.
std::vector<BlockGrid::Box> polar_boxes(const geo::GridFrame& frame, const Bounds& bounds, double width) {
    Range range;
    for (const double lat : {bounds.south, bounds.north}) {
        const auto add = [&](double lon) {
            range.add(frame.grid_position({geo::Degrees{lat}, geo::Degrees{lon}}));
        };
        add(bounds.west);
        add(bounds.west + width);
        for (double lon = 90 * std::ceil(bounds.west / 90); lon <= bounds.west + width; lon += 90) add(lon);
    }
    const auto box = box_of(frame, range);
    return box ? std::vector{*box} : std::vector<BlockGrid::Box>{};
}

}  // namespace

Result<BlockGrid::Box> posts_around(const geo::GridFrame& frame, const Bounds& bounds) {
    const auto refuse = [&](const std::string& why) {
        return Error{ErrorKind::usage, fmt::format("--bounds {},{},{},{}: {}", bounds.west, bounds.south,
                                                   bounds.east, bounds.north, why)};
    };
    const bool numbers = std::abs(bounds.west) <= 540 && std::abs(bounds.east) <= 540 &&
                         std::abs(bounds.south) <= 90 && std::abs(bounds.north) <= 90;
    if (!numbers || !(bounds.south < bounds.north) || bounds.west == bounds.east)
        return refuse("expected degrees west, south, east and north, south below north");
    double width = bounds.east - bounds.west;
    if (width < 0) width += 360;
    if (width < 0 || width > 360) return refuse("west and east are more than a turn apart");

    const auto boxes =
        frame.is_polar() ? polar_boxes(frame, bounds, width) : geographic_boxes(frame, bounds, width);
    if (boxes.empty()) return refuse("the scene has nothing there; `relevo info` says where it is");
    const auto whole =
        std::ranges::find_if(boxes, [&](const BlockGrid::Box& box) { return box.columns == frame.columns; });
    if (whole != boxes.end()) return *whole;
    if (boxes.size() > 1)
        return refuse("it lies on both sides of the scene's first column: export the two parts one by one");
    return boxes.front();
}

geo::GridFrame frame_of(const geo::GridFrame& frame, const BlockGrid::Box& box) {
    geo::GridFrame part = frame;
    part.west += box.column * frame.step_x;
    part.north -= box.row * frame.step_y;
    if (!frame.is_polar() && part.west >= 180) part.west -= 360;
    part.columns = box.columns;
    part.rows = box.rows;
    return part;
}

}  // namespace relevo::output
