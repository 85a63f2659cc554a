#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geo/position.hpp"
#include "geo/result.hpp"

namespace relevo::lod {

enum class MeasurementKind { point, path, polygon };

/// What a user measures: a named place, a path over two or more vertices (a line is a path of two), or a
/// polygon. Sides are geodesics; a polygon is closed by itself, its first vertex is not repeated.
struct Measurement {
    std::string name;  ///< UTF-8; may be empty, need not be unique
    MeasurementKind kind = MeasurementKind::point;
    std::vector<geo::LatLon> vertices;
};

/// "point", "path", "polygon": as in files and JSON.
const char* to_string(MeasurementKind kind);
std::optional<MeasurementKind> measurement_kind(std::string_view text);

/// Can it be measured: one vertex of a point, two of a path, three of a polygon, each a place on earth?
/// Whether a polygon's sides cross is measure_area's to say. The error names the measurement.
Result<void> check(const Measurement& measurement);

}  // namespace relevo::lod
