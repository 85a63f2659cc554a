#include "lod/measure/lookout.hpp"

#include <algorithm>
#include <cmath>

#include "lod/measure/sight_line.hpp"

namespace relevo::lod {

Lookout::Lookout(const geo::GridFrame& frame, const BlockGrid::Box& box, const HighGround& ground,
                 geo::LatLon eye, double eye_h, const Looking& looking)
    : frame_(frame),
      box_(box),
      ground_(ground),
      looking_(looking),
      eye_(frame.grid_position(eye)),
      eye_h_(eye_h) {
    eye_place_ = {eye.lat, frame.is_polar() ? eye.lon : frame.lat_lon(eye_).lon};
}

Viewshed::Seen Lookout::look(int column, int row, double radius, double& hint) const {
    const double ground = ground_.post(column, row);
    if (std::isnan(ground)) return Viewshed::none;
    const geo::GeodesicPath path(eye_place_, place(column, row));
    const double length = path.length_m();
    if (length > radius) return Viewshed::none;
    if (length == 0) return Viewshed::visible;
    const auto [columns, rows] = cubics(path, column, row);
    const double target_h = ground + looking_.target_height_m;
    const SightLine sight(length, mean_curvature(path), looking_.refraction, eye_h_, target_h);
    const double steepest =
        std::abs(target_h - eye_h_) / length + length * std::abs(sight.effective_curvature());
    LineOverGround line(ground_, columns, rows, sight, steepest);
    if (hint > 0 && hint < length) {
        // Neighbours are mostly hidden by the same ridge.
        const double reach = 3 / std::max(1.0, std::hypot(column - eye_.column, row - eye_.row));
        const double middle = hint / length;
        if (line.is_blocked(std::max(0.0, middle - reach), std::min(1.0, middle + reach))) {
            hint = line.blocked_at;
            return Viewshed::hidden;
        }
    }
    line.unknown = false;
    if (line.is_blocked(0, 1)) {
        hint = line.blocked_at;
        return Viewshed::hidden;
    }
    return line.unknown ? Viewshed::unknown : Viewshed::visible;
}

double Lookout::bend_error(int column, int row) const {
    const geo::GeodesicPath path(eye_place_, place(column, row));
    if (path.length_m() == 0) return 0;
    const auto [columns, rows] = cubics(path, column, row);
    double worst = 0;
    for (const double t : {1.0 / 6, 0.5, 5.0 / 6}) {
        const auto at = position(path, t);
        worst = std::max({worst, std::abs(columns.at(t) - at.column), std::abs(rows.at(t) - at.row)});
    }
    return worst;
}

geo::LatLon Lookout::place(int column, int row) const {
    return frame_.lat_lon({box_.column + column + 0.0, box_.row + row + 0.0});
}

geo::GridPosition Lookout::position(const geo::GeodesicPath& path, double part) const {
    const geo::LatLon at = path.at(part * path.length_m());
    geo::GridPosition grid;
    if (frame_.is_polar()) {
        grid = frame_.grid_position(at);
    } else {
        grid = {(at.lon.value - frame_.west) / frame_.step_x, (frame_.north - at.lat.value) / frame_.step_y};
    }
    return {grid.column - box_.column, grid.row - box_.row};
}

std::pair<Cubic, Cubic> Lookout::cubics(const geo::GeodesicPath& path, int column, int row) const {
    const auto first = position(path, 1.0 / 3);
    const auto second = position(path, 2.0 / 3);
    return {Cubic::through(eye_.column - box_.column, first.column, second.column, column),
            Cubic::through(eye_.row - box_.row, first.row, second.row, row)};
}

}  // namespace relevo::lod
