#include "viewer/graticule.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "viewer/ground_scale.hpp"

namespace relevo::viewer {

namespace {

constexpr double kApartPx = 160;
constexpr double kDegreeM = 111320;
constexpr double kReachM = 50e3;

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
    const auto at = geo::utm_position(zone, place);
    return glm::dvec2(at.easting, at.northing) / interval;
}

std::string Graticule::text(int axis, double line) const {
    const double step = interval[axis];
    const double value = std::round(line) * step;
    if (is_utm) return fmt::format("{:.{}f} {}", value, decimals_of(step), axis == 0 ? 'E' : 'N');
    if (axis == 1) return degrees_text(value, step, 'N', 'S');
    const double lon = std::remainder(value, 360.0);
    return degrees_text(std::abs(lon) > 180 - 1e-9 ? 180 : lon, step, 'E', 'W');
}

Graticule suitable_graticule(bool utm, geo::LatLon eye, double pixel_m) {
    Graticule made{.is_utm = utm};
    if (utm) {
        made.zone = geo::utm_zone(eye);
        made.interval = glm::dvec2(round_step(kApartPx * pixel_m));
        return made;
    }
    const double apart = kApartPx * pixel_m / kDegreeM;
    const double cosine = std::max(std::cos(eye.lat.radians()), 0.01);
    made.interval = {round_degrees(apart / cosine), round_degrees(apart)};
    return made;
}

GraticuleTerms graticule_terms(const Graticule& graticule, const geo::GridFrame& grid, geo::LatLon around) {
    const geo::GridPosition at = grid.grid_position(around);
    GraticuleTerms made;
    made.anchor = {std::round(std::clamp(at.column, 0.0, grid.columns - 1.0)),
                   std::round(std::clamp(at.row, 0.0, grid.rows - 1.0))};
    const auto spacing = grid.spacing({made.anchor.x, made.anchor.y});
    made.reach = {kReachM / std::max(spacing.column_m, 1e-6), kReachM / std::max(spacing.row_m, 1e-6)};
    if (!graticule.is_utm && !grid.is_polar()) {
        // Here differences of rounded values would be all that there is of the higher terms.
        made.terms.fill(glm::dvec2(0));
        made.terms[0] = graticule.lines(grid.lat_lon({made.anchor.x, made.anchor.y}));
        made.terms[1].x = grid.step_x * made.reach.x / graticule.interval.x;
        made.terms[5].y = -grid.step_y * made.reach.y / graticule.interval.y;
        made.terms[0] -= glm::dvec2(std::round(made.terms[0].x), std::round(made.terms[0].y));
        return made;
    }
    std::array<std::array<glm::dvec2, 5>, 5> rows;  // coefficients of u
    for (std::size_t k = 0; k < 5; ++k) {
        std::array<glm::dvec2, 5> values;
        for (std::size_t i = 0; i < 5; ++i) {
            const glm::dvec2 uv(0.5 * static_cast<double>(i) - 1, 0.5 * static_cast<double>(k) - 1);
            const glm::dvec2 place = made.anchor + uv * made.reach;
            values[i] = graticule.lines(grid.lat_lon({place.x, place.y}));
        }
        rows[k] = polynomial(values);
    }
    for (std::size_t i = 0; i < 5; ++i) {
        const auto along_v = polynomial({rows[0][i], rows[1][i], rows[2][i], rows[3][i], rows[4][i]});
        for (std::size_t k = 0; k < 5; ++k) made.terms[i + 5 * k] = along_v[k];
    }
    made.terms[0] -= glm::dvec2(std::round(made.terms[0].x), std::round(made.terms[0].y));
    return made;
}

glm::dvec2 lines(const GraticuleTerms& terms, geo::GridPosition place) {
    const double u = (place.column - terms.anchor.x) / terms.reach.x;
    const double v = (place.row - terms.anchor.y) / terms.reach.y;
    glm::dvec2 sum(0);
    for (int k = 4; k >= 0; --k) {
        glm::dvec2 row(0);
        for (int i = 4; i >= 0; --i) row = row * u + terms.terms[static_cast<std::size_t>(i + 5 * k)];
        sum = sum * v + row;
    }
    return sum;
}

}  // namespace relevo::viewer
