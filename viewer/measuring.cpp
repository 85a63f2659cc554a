#include "viewer/measuring.hpp"

#include <algorithm>
#include <utility>

#include <glm/geometric.hpp>

namespace relevo::viewer {

geo::Ecef Measuring::position(const OutlinePoint& point, double exaggeration) const {
    return geo::to_ecef({point.place.lat, point.place.lon, {point.N + exaggeration * point.H}});
}

geo::Ecef Measuring::position(geo::LatLon place, double exaggeration) const {
    const auto ground = ground_height(terrain_, place, exaggeration);
    return geo::to_ecef(
        {place.lat, place.lon, ground.value_or(geo::EllipsoidalHeight{heights_.undulation(place).m})});
}

const ShapeResult* Measuring::current_result() const {
    if (!tool_.current()) return nullptr;
    return results_.find(tool_.shapes()[*tool_.current()]);
}

void Measuring::take_drag(Input& input, const lod::View& view, double exaggeration, const PlaceAt& place_at) {
    constexpr double kGrabPx = 9;
    if (input.left_pressed_at) {
        held_.reset();
        double nearest = kGrabPx;
        const std::vector<Shape>& shapes = tool_.shapes();
        for (std::size_t i = 0; i < shapes.size(); ++i) {
            const std::vector<geo::LatLon>& vertices = shapes[i].measurement.vertices;
            for (std::size_t k = 0; k < vertices.size(); ++k) {
                const glm::dvec3 offset = position(vertices[k], exaggeration) - view.eye();
                if (!view.sees(offset)) continue;
                const double away = glm::distance(view.pixel(offset), *input.left_pressed_at);
                if (away >= nearest) continue;
                nearest = away;
                held_ = {i, k};
            }
        }
        if (held_) tool_.begin_move(*held_);
    }
    if (!held_) return;
    if (input.drag_left != glm::dvec2(0)) {
        if (const auto place = place_at(input.cursor)) tool_.move(*held_, *place);
        input.drag_left = {0, 0};
    }
    if (!input.clicks.empty()) {  // of the vertex: it is chosen
        tool_.undo();
        tool_.select(held_->shape);
        input.clicks.clear();
    }
    if (!input.left_down) held_.reset();
}

void Measuring::click(geo::LatLon place) {
    tool_.add(place);
    just_clicked_ = true;
}

void Measuring::take_back_click() {
    if (std::exchange(just_clicked_, false)) tool_.undo();
}

std::vector<DrawnShape> Measuring::drawn(double exaggeration) const {
    std::vector<DrawnShape> drawn;
    const std::vector<Shape>& shapes = tool_.shapes();
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        DrawnShape shape;
        shape.current = tool_.current() == i;
        if (const ShapeResult* result = results_.find(shapes[i])) {
            for (const OutlinePoint& point : result->outline)
                shape.line.push_back(position(point, exaggeration));
            shape.vertices = result->vertices;
            shape.label = result->label;
        } else {
            for (const geo::LatLon& place : shapes[i].measurement.vertices) {
                shape.vertices.push_back(shape.line.size());
                shape.line.push_back(position(place, exaggeration));
            }
            if (shapes[i].tool == Tool::area && shape.line.size() > 2)
                shape.line.push_back(shape.line.front());
        }
        drawn.push_back(std::move(shape));
    }
    return drawn;
}

std::optional<double> Measuring::distance_at(const lod::View& view, const glm::dvec2& pixel, double within_px,
                                             double exaggeration) const {
    const ShapeResult* result = current_result();
    std::optional<double> distance_m;
    if (result == nullptr || result->outline.size() < 2) return distance_m;
    for (const OutlinePoint& point : result->outline) {
        const glm::dvec3 offset = position(point, exaggeration) - view.eye();
        if (!view.sees(offset)) continue;
        const double away = glm::distance(view.pixel(offset), pixel);
        if (away >= within_px) continue;
        within_px = away;
        distance_m = point.distance_m;
    }
    return distance_m;
}

std::optional<geo::Ecef> Measuring::place_at(double distance_m, double exaggeration) const {
    const ShapeResult* result = current_result();
    if (result == nullptr || result->outline.empty()) return std::nullopt;
    const auto after = std::lower_bound(
        result->outline.begin(), result->outline.end(), distance_m,
        [](const OutlinePoint& point, double distance) { return point.distance_m < distance; });
    if (after == result->outline.begin()) return position(result->outline.front(), exaggeration);
    if (after == result->outline.end()) return position(result->outline.back(), exaggeration);
    const OutlinePoint& before = *(after - 1);
    const double part = (distance_m - before.distance_m) / (after->distance_m - before.distance_m);
    const geo::Ecef a = position(before, exaggeration);
    return a + part * (position(*after, exaggeration) - a);
}

}  // namespace relevo::viewer
