#include "viewer/measure/measuring.hpp"

#include <algorithm>
#include <utility>

#include <glm/geometric.hpp>

#include "geo/geodesic.hpp"

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

namespace {

constexpr double kGrabPx = 9;

/// Keeps the nearest to a pixel of what it is asked about.
class Nearest {
  public:
    Nearest(const lod::View& view, const glm::dvec2& pixel) : view_(view), pixel_(pixel) {}
    bool is(const geo::Ecef& position) {
        const glm::dvec3 offset = position - view_.eye();
        if (!view_.sees(offset)) return false;
        const double away = glm::distance(view_.pixel(offset), pixel_);
        if (away >= nearest_) return false;
        nearest_ = away;
        return true;
    }

  private:
    const lod::View& view_;
    glm::dvec2 pixel_;
    double nearest_ = kGrabPx;
};

}  // namespace

std::optional<MeasureTool::Vertex> Measuring::nearest_vertex(const lod::View& view, const glm::dvec2& pixel,
                                                             double exaggeration) const {
    std::optional<MeasureTool::Vertex> found;
    Nearest nearest(view, pixel);
    const std::vector<Shape>& shapes = tool_.shapes();
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        const std::vector<geo::LatLon>& vertices = shapes[i].measurement.vertices;
        for (std::size_t k = 0; k < vertices.size(); ++k) {
            if (nearest.is(position(vertices[k], exaggeration))) found = {i, k};
        }
    }
    return found;
}

std::vector<std::pair<std::size_t, geo::LatLon>> Measuring::middles() const {
    std::vector<std::pair<std::size_t, geo::LatLon>> found;
    if (!tool_.current()) return found;
    const Shape& shape = tool_.shapes()[*tool_.current()];
    const std::vector<geo::LatLon>& vertices = shape.measurement.vertices;
    const bool closed = shape.tool == Tool::area && vertices.size() > 2;
    if (shape.tool != Tool::path && shape.tool != Tool::area) return found;
    for (std::size_t i = 1; i < vertices.size() + (closed ? 1 : 0); ++i) {
        const geo::GeodesicPath side(vertices[i - 1], vertices[i % vertices.size()]);
        found.emplace_back(i, side.at(side.length_m() / 2));
    }
    return found;
}

bool Measuring::exists(const std::optional<MeasureTool::Vertex>& vertex) const {
    return vertex && vertex->shape < tool_.shapes().size() &&
           vertex->vertex < tool_.shapes()[vertex->shape].measurement.vertices.size();
}

void Measuring::take_mouse(Input& input, const lod::View& view, double exaggeration,
                           const PlaceAt& place_at) {
    hovered_.reset();
    if (input.cursor_inside) hovered_ = nearest_vertex(view, input.cursor, exaggeration);
    for (const glm::dvec2& click : input.right_clicks) {
        if (const auto vertex = nearest_vertex(view, click, exaggeration)) {
            tool_.delete_vertex(*vertex);
            hovered_.reset();
            chosen_.reset();
        }
    }
    if (input.left_pressed_at) {
        held_ = nearest_vertex(view, *input.left_pressed_at, exaggeration);
        chosen_ = held_;
        if (held_) {
            tool_.begin_move(*held_);
        } else {
            std::optional<std::pair<std::size_t, geo::LatLon>> side;
            Nearest nearest(view, *input.left_pressed_at);
            for (const auto& middle : middles()) {
                if (nearest.is(position(middle.second, exaggeration))) side = middle;
            }
            if (side) {
                held_ = {*tool_.current(), side->first};
                tool_.begin_insert(*held_, side->second);
            }
        }
    }
    if (!exists(held_)) held_.reset();  // undone in the middle of a drag
    if (!held_) return;
    if (input.drag_left != glm::dvec2(0)) {
        if (const auto place = place_at(input.cursor)) tool_.move(*held_, *place);
        input.drag_left = {0, 0};
    }
    if (!input.clicks.empty()) {  // of the vertex: it is chosen, and no side is divided
        const std::size_t shape = held_->shape;
        tool_.undo();
        tool_.select(shape);
        input.clicks.clear();
    }
    if (!input.left_down) held_.reset();
}

void Measuring::delete_vertex() {
    const auto vertex = exists(hovered_) ? hovered_ : chosen_;
    if (exists(vertex)) {
        tool_.delete_vertex(*vertex);
    } else {
        tool_.delete_vertex();
    }
    hovered_.reset();
    chosen_.reset();
}

Handles Measuring::handles(double exaggeration) const {
    Handles found;
    for (const auto& [after, place] : middles()) found.middles.push_back(position(place, exaggeration));
    const auto at = [&](const std::optional<MeasureTool::Vertex>& vertex) -> std::optional<geo::Ecef> {
        if (!exists(vertex)) return std::nullopt;
        return position(tool_.shapes()[vertex->shape].measurement.vertices[vertex->vertex], exaggeration);
    };
    found.hovered = at(hovered_);
    found.chosen = at(chosen_);
    return found;
}

std::shared_ptr<const lod::Viewshed> Measuring::viewshed() {
    bool still_there = false;
    for (std::size_t i = 0; i < tool_.shapes().size(); ++i) {
        const ShapeResult* result = results_.find(tool_.shapes()[i]);
        if (result == nullptr || !result->viewshed) continue;
        if (tool_.current() == i) return viewshed_ = result->viewshed;
        still_there = still_there || result->viewshed == viewshed_;
    }
    if (!still_there) viewshed_.reset();
    return viewshed_;
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
        if (const ShapeResult* result = results_.find(shapes[i]); result && !result->outline.empty()) {
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
