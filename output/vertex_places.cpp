#include "output/vertex_places.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace relevo::output {
namespace {

bool knows_undulation(const lod::VerticalReference& vertical) {
    return vertical.datum != lod::VerticalDatum::other || vertical.geoid_known;
}

bool is_in_space(Coordinates coordinates) {
    return coordinates == Coordinates::ecef || coordinates == Coordinates::enu;
}

}  // namespace

const char* to_string(Coordinates coordinates) {
    switch (coordinates) {
        case Coordinates::geodetic:
            return "geodetic";
        case Coordinates::ecef:
            return "ecef";
        case Coordinates::source:
            return "source";
        case Coordinates::enu:
            break;
    }
    return "enu";
}

VertexPlaces::VertexPlaces(const lod::Scene& scene, const lod::BlockGrid::Box& box, Coordinates coordinates,
                           Heights heights)
    : scene_(&scene), box_(box), coordinates_(coordinates), vertical_datum_(scene.info().vertical.name) {
    const geo::GridFrame& frame = scene.info().frame;
    const bool above_ellipsoid = is_in_space(coordinates) || heights == Heights::ellipsoid;
    if (above_ellipsoid) {
        undulations_ = scene.undulations();
        vertical_datum_ = "WGS 84 ellipsoid";
    }
    if (is_in_space(coordinates)) positions_ = std::make_unique<geo::PostPositions>(frame);
    enu_origin_ = frame.lat_lon({box.column + 0.5 * (box.columns - 1), box.row + 0.5 * (box.rows - 1)});
    const char* const height = above_ellipsoid ? "h_m" : "H_m";
    switch (coordinates) {
        case Coordinates::geodetic:
            axes_ = {"longitude_deg", "latitude_deg", height};
            crs_ = "EPSG:4326";
            break;
        case Coordinates::ecef:
            axes_ = {"x_m", "y_m", "z_m"};
            crs_ = "EPSG:4978";
            break;
        case Coordinates::source:
            axes_ = {"x", "y", height};
            break;
        case Coordinates::enu:
            axes_ = {"east_m", "north_m", "up_m"};
            enu_ = std::make_unique<geo::EnuFrame>(
                geo::Geodetic{enu_origin_.lat, enu_origin_.lon, geo::EllipsoidalHeight{0}});
            break;
    }
}

Result<VertexPlaces> VertexPlaces::create(const lod::Scene& scene, const lod::BlockGrid::Box& box,
                                          Coordinates coordinates, Heights heights) {
    const lod::SceneInfo& info = scene.info();
    const std::string name = scene.path().string();
    if ((is_in_space(coordinates) || heights == Heights::ellipsoid) && !knows_undulation(info.vertical)) {
        return Error{
            ErrorKind::input,
            fmt::format("{}: its heights are above {}, and how far that is from the ellipsoid is not "
                        "known here: import it with --geoid FILE, or export it with --coordinates "
                        "geodetic or source and --heights datum",
                        name, info.vertical.name)};
    }
    VertexPlaces places(scene, box, coordinates, heights);
    if (coordinates == Coordinates::source) {
        if (info.sources.empty() || !lod::SourceProjection::create(info.sources.front())) {
            return Error{
                ErrorKind::input,
                fmt::format("{}: there is no way to the CRS of its first source here: export it with "
                            "--coordinates geodetic",
                            name)};
        }
        places.crs_ = info.sources.front().crs;
        places.projections_ = std::make_unique<Projections>(
            [source = info.sources.front()] { return lod::SourceProjection::create(source); });
    }
    if (coordinates == Coordinates::enu) return places;
    const auto middle = places.at((box.columns - 1) / 2, (box.rows - 1) / 2, 0);
    if (!middle) return middle.error();
    const bool in_degrees =
        coordinates == Coordinates::geodetic ||
        (coordinates == Coordinates::source && info.sources.front().step_unit == "degree");
    const double unit = in_degrees ? 1000 : 1;
    for (int i = 0; i < 3; ++i) places.origin_[i] = std::round((*middle)[i] * unit) / unit;
    if (coordinates != Coordinates::ecef) places.origin_.z = 0;
    return places;
}

double VertexPlaces::height(int column, int row, float H) const {
    return static_cast<double>(H) + undulations_.at(box_.column + column, box_.row + row);
}

Result<glm::dvec3> VertexPlaces::at(int column, int row, float H) const {
    const double h = height(column, row, H);
    if (positions_) {
        const glm::dvec3 ecef = positions_->at(box_.column + column, box_.row + row, h);
        return enu_ ? enu_->from_ecef({ecef}).m : ecef;
    }
    const geo::LatLon place = scene_->info().frame.lat_lon(
        {static_cast<double>(box_.column + column), static_cast<double>(box_.row + row)});
    if (coordinates_ == Coordinates::geodetic) return glm::dvec3{place.lon.value, place.lat.value, h};
    const std::optional<lod::SourceProjection>& projection = projections_->local();
    const auto there = projection ? projection->position(place) : std::nullopt;
    if (!there) {
        return Error{
            ErrorKind::input,
            fmt::format("{}: {:.6f},{:.6f} has no coordinates in {}: export a smaller box with --bounds, "
                        "or --coordinates geodetic",
                        scene_->path().string(), place.lat.value, place.lon.value, crs_)};
    }
    return glm::dvec3{there->x, there->y, h};
}

}  // namespace relevo::output
