#include "geo/post_positions.hpp"

#include <cmath>

#include <GeographicLib/Math.hpp>

#include "geo/ellipsoid.hpp"

namespace relevo::geo {

PostPositions::PostPositions(const GridFrame& frame) {
    if (frame.is_polar()) {
        polar_.emplace(frame);
        return;
    }
    const int side = frame.padded_side();
    rows_.reserve(static_cast<std::size_t>(side));
    columns_.reserve(static_cast<std::size_t>(side));
    for (int i = 0; i < side; ++i) {
        const LatLon place = frame.lat_lon({static_cast<double>(i), static_cast<double>(i)});

        Row row{};
        GeographicLib::Math::sincosd(place.lat.value, row.sin_lat, row.cos_lat);
        const double across =
            wgs84::kSemiMajor / std::sqrt(1 - wgs84::kEccentricity2 * row.sin_lat * row.sin_lat);
        row.from_axis = across * row.cos_lat;
        row.z = (1 - wgs84::kEccentricity2) * across * row.sin_lat;
        rows_.push_back(row);

        Column column{};
        GeographicLib::Math::sincosd(place.lon.value, column.sin_lon, column.cos_lon);
        columns_.push_back(column);
    }
}

}  // namespace relevo::geo
