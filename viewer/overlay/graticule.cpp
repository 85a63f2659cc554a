#include "viewer/overlay/graticule.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "viewer/overlay/ground_scale.hpp"

namespace relevo::viewer {

namespace {

constexpr double kApartPx = 160;
constexpr double kDegreeM = 111320;

/// The smallest step of degrees, minutes and seconds that is no less; below a second 0.5, 0.2, 0.1 ...
double round_degrees(double least) {
    const double seconds = least * 3600;
    if (seconds <= 0.5) return round_step(seconds) / 3600;
    for (const double step : {1, 2, 5, 10, 30, 60, 120, 300, 600, 1800, 3600, 7200, 18000, 36000}) {
        if (step >= seconds) return step / 3600;
    }
    return 30;
}

/// A step's decimals as far as they are not 0.
int decimals_of(double step) {
    return std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 9);
}

std::string degrees_text(double degrees, double step, char positive, char negative) {
    const double seconds_step = step * 3600;
    const int decimals = decimals_of(seconds_step);
    const double unit = std::pow(10.0, decimals);
    const double total = std::round(std::abs(degrees) * 3600 * unit) / unit;
    const double whole = std::floor(total / 3600 + 1e-9);
    const double minutes = std::floor((total - whole * 3600) / 60 + 1e-9);
    const double seconds = std::max(total - whole * 3600 - minutes * 60, 0.0);
    std::string text = fmt::format("{:.0f}\u00b0", whole);
    if (seconds_step < 3600) text += fmt::format("{:02.0f}'", minutes);
    if (seconds_step < 60)
        text += fmt::format("{:0{}.{}f}\"", seconds, decimals > 0 ? decimals + 3 : 2, decimals);
    if (total == 0) return text;
    return text + " " + (degrees < 0 ? negative : positive);
}

/// Coefficients of the polynomial through values at -1, -1/2, 0, 1/2, 1.
std::array<glm::dvec2, 5> polynomial(const std::array<glm::dvec2, 5>& f) {
    constexpr double s = 0.5;
    return {f[2], (f[0] - 8.0 * f[1] + 8.0 * f[3] - f[4]) / (12 * s),
            (-f[0] + 16.0 * f[1] - 30.0 * f[2] + 16.0 * f[3] - f[4]) / (24 * s * s),
            (-f[0] + 2.0 * f[1] - 2.0 * f[3] + f[4]) / (12 * s * s * s),
            (f[0] - 4.0 * f[1] + 6.0 * f[2] - 4.0 * f[3] + f[4]) / (24 * s * s * s * s)};
}

}  // namespace

glm::dvec2 Graticule::lines(geo::LatLon place) const {
    if (!is_utm) return glm::dvec2(place.lon.value, place.lat.value) / interval;
    const auto at = geo::utm_position(zone_at(place), place);
    return glm::dvec2(at.easting, at.northing) / interval;
}

std::string Graticule::text(int axis, double line, geo::UtmZone in) const {
    const double step = interval[axis];
    const double value = std::round(line) * step;
    if (is_utm) {
        const std::string zone_text = in.number == 0 ? std::string(in.north ? "UPS N" : "UPS S")
                                                     : fmt::format("{}{}", in.number, in.north ? 'N' : 'S');
        return fmt::format("{} {:.{}f} {}", zone_text, value, decimals_of(step), axis == 0 ? 'E' : 'N');
    }
    if (axis == 1) return degrees_text(value, step, 'N', 'S');
    const double lon = std::remainder(value, 360.0);
    return degrees_text(std::abs(lon) > 180 - 1e-9 ? 180 : lon, step, 'E', 'W');
}

Graticule suitable_graticule(bool utm, geo::LatLon eye, double pixel_m) {
    Graticule made{.is_utm = utm};
    if (utm) {
        made.every_zone = true;
        made.zone = geo::utm_zone(eye);
        made.interval = glm::dvec2(round_step(kApartPx * pixel_m));
        return made;
    }
    const double apart = kApartPx * pixel_m / kDegreeM;
    const double cosine = std::max(std::cos(eye.lat.radians()), 0.01);
    made.interval = {round_degrees(apart / cosine), round_degrees(apart)};
    return made;
}

namespace {

using Area = GraticuleTerms::Area;

/// Sets an area's terms from the exact values around its centre.
void fit(Area& area, const GraticuleTerms& made, const geo::GridFrame& grid, const Graticule& of_zone) {
    std::array<std::array<glm::dvec2, 5>, 5> rows;  // coefficients of u
    for (std::size_t k = 0; k < 5; ++k) {
        std::array<glm::dvec2, 5> values;
        for (std::size_t i = 0; i < 5; ++i) {
            const glm::dvec2 uv(0.5 * static_cast<double>(i) - 1, 0.5 * static_cast<double>(k) - 1);
            const glm::dvec2 place = made.anchor + (area.centre + uv * area.reach) * made.reach;
            values[i] = of_zone.lines(grid.lat_lon({place.x, place.y}));
        }
        rows[k] = polynomial(values);
    }
    for (std::size_t i = 0; i < 5; ++i) {
        const auto along_v = polynomial({rows[0][i], rows[1][i], rows[2][i], rows[3][i], rows[4][i]});
        for (std::size_t k = 0; k < 5; ++k) area.terms[i + 5 * k] = along_v[k];
    }
    area.terms[0] -= glm::dvec2(std::round(area.terms[0].x), std::round(area.terms[0].y));
}

/// The areas of UTM's zones in a geographic grid, as far as something is seen, the nearest first.
void add_zones(GraticuleTerms& made, const Graticule& graticule, const geo::GridFrame& grid, double reach_m,
               double seen_m) {
    const geo::LatLon eye = grid.lat_lon({made.anchor.x, made.anchor.y});
    const double lon = grid.west + made.anchor.x * grid.step_x;  // on the grid's own turn
    const double lat = eye.lat.value;
    const double up = std::min(seen_m / kDegreeM + 0.01, 60.0);
    const double poleward = std::min(std::abs(lat) + up, 89.0);
    const double along = std::min(up / std::cos(geo::Degrees{poleward}.radians()), 100.0);
    const glm::dvec2 per_degree(1 / (grid.step_x * made.reach.x), 1 / (grid.step_y * made.reach.y));
    struct Near {
        geo::UtmArea area;
        double far;
    };
    std::vector<Near> near;
    // Each area costs a polynomial a pixel: none that only the sea beyond the data would need.
    const double south = std::max({lat - up, -90.0, grid.north - (grid.rows - 1) * grid.step_y});
    const double north = std::min({lat + up, 90.0, grid.north});
    const double west = std::max(lon - along, grid.west);
    const double east = std::min(lon + along, grid.west + (grid.columns - 1) * grid.step_x);
    for (const geo::UtmArea& area : geo::utm_areas(west, south, std::max(east, west + 1e-9), north)) {
        if (area.west > east || area.north < south || area.south > north) continue;
        const double x = std::clamp(lon, area.west, area.east) - lon;
        const double y = std::clamp(lat, area.south, area.north) - lat;
        near.push_back({area, std::hypot(x * std::cos(eye.lat.radians()), y)});
    }
    std::stable_sort(near.begin(), near.end(), [](const Near& a, const Near& b) { return a.far < b.far; });
    if (near.size() > GraticuleTerms::kMostAreas) near.resize(GraticuleTerms::kMostAreas);
    for (const auto& [area, far] : near) {
        Area part;
        part.zone = area.zone;
        part.bounds = {(area.west - lon) * per_degree.x, (lat - area.north) * per_degree.y,
                       (area.east - lon) * per_degree.x, (lat - area.south) * per_degree.y};
        part.is_border = {area.west_is_border, area.north_is_border, area.east_is_border,
                          area.south_is_border};
        part.centre = {std::clamp(0.0, part.bounds[0], part.bounds[2]),
                       std::clamp(0.0, part.bounds[1], part.bounds[3])};
        // No farther than projections go, and not over a pole.
        const double centre_lat = std::clamp(lat, area.south, area.north);
        const double cosine = std::max(std::cos(geo::Degrees{centre_lat}.radians()), 0.01);
        const double reach_lat = std::min({reach_m / kDegreeM, 9.0, 0.9 * (90 - std::abs(centre_lat))});
        const double reach_lon = std::min(reach_m / kDegreeM / cosine, 12.0);
        part.reach = glm::dvec2(reach_lon, std::max(reach_lat, 1e-3)) * per_degree;
        Graticule of_zone = graticule;
        of_zone.every_zone = false;
        of_zone.zone = area.zone;
        fit(part, made, grid, of_zone);
        made.areas.push_back(part);
    }
}

}  // namespace

GraticuleTerms graticule_terms(const Graticule& graticule, const geo::GridFrame& grid, geo::LatLon around,
                               double reach_m, double seen_m) {
    const geo::GridPosition at = grid.grid_position(around);
    GraticuleTerms made;
    made.anchor = {std::round(std::clamp(at.column, 0.0, grid.columns - 1.0)),
                   std::round(std::clamp(at.row, 0.0, grid.rows - 1.0))};
    const auto spacing = grid.spacing({made.anchor.x, made.anchor.y});
    made.reach = {reach_m / std::max(spacing.column_m, 1e-6), reach_m / std::max(spacing.row_m, 1e-6)};
    if (graticule.every_zone && !grid.is_polar()) {
        add_zones(made, graticule, grid, reach_m, seen_m);
        return made;
    }
    Area all;
    all.zone = graticule.zone;
    if (graticule.is_utm || grid.is_polar()) {
        fit(all, made, grid, graticule);
    } else {
        // Here differences of rounded values would be all that there is of the higher terms.
        all.terms.fill(glm::dvec2(0));
        all.terms[0] = graticule.lines(grid.lat_lon({made.anchor.x, made.anchor.y}));
        all.terms[1].x = grid.step_x * made.reach.x / graticule.interval.x;
        all.terms[5].y = -grid.step_y * made.reach.y / graticule.interval.y;
        all.terms[0] -= glm::dvec2(std::round(all.terms[0].x), std::round(all.terms[0].y));
    }
    made.areas.push_back(all);
    return made;
}

std::optional<glm::dvec2> lines(const GraticuleTerms& terms, geo::GridPosition place) {
    const glm::dvec2 at = (glm::dvec2(place.column, place.row) - terms.anchor) / terms.reach;
    for (const Area& area : terms.areas) {
        const auto& [west, north, east, south] = area.bounds;
        if (at.x < west || at.x >= east || at.y < north || at.y >= south) continue;
        const glm::dvec2 uv = (at - area.centre) / area.reach;
        glm::dvec2 sum(0);
        for (int k = 4; k >= 0; --k) {
            glm::dvec2 row(0);
            for (int i = 4; i >= 0; --i) row = row * uv.x + area.terms[static_cast<std::size_t>(i + 5 * k)];
            sum = sum * uv.y + row;
        }
        return sum;
    }
    return std::nullopt;
}

}  // namespace relevo::viewer
