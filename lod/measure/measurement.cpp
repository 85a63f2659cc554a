#include "lod/measure/measurement.hpp"

#include <cmath>

#include <fmt/format.h>

namespace relevo::lod {

const char* to_string(MeasurementKind kind) {
    switch (kind) {
        case MeasurementKind::point:
            return "point";
        case MeasurementKind::path:
            return "path";
        case MeasurementKind::polygon:
            break;
    }
    return "polygon";
}

std::optional<MeasurementKind> measurement_kind(std::string_view text) {
    for (const auto kind : {MeasurementKind::point, MeasurementKind::path, MeasurementKind::polygon}) {
        if (text == to_string(kind)) return kind;
    }
    return {};
}

Result<void> check(const Measurement& measurement) {
    const auto& [name, kind, vertices] = measurement;
    const std::string who = name.empty() ? fmt::format("a {} without a name", to_string(kind))
                                         : fmt::format("the {} \"{}\"", to_string(kind), name);
    const std::size_t least = kind == MeasurementKind::polygon ? 3 : kind == MeasurementKind::path ? 2 : 1;
    if (vertices.size() < least || (kind == MeasurementKind::point && vertices.size() != 1)) {
        return Error{ErrorKind::input, fmt::format("{} has {} vertices, and needs {}{}", who, vertices.size(),
                                                   least, kind == MeasurementKind::point ? "" : " or more")};
    }
    for (const geo::LatLon& place : vertices) {
        if (!(std::abs(place.lat.value) <= 90) || !std::isfinite(place.lon.value)) {
            return Error{ErrorKind::input,
                         fmt::format("{} has a vertex at latitude {}, longitude {}: no place on earth", who,
                                     place.lat.value, place.lon.value)};
        }
    }
    return {};
}

}  // namespace relevo::lod
