#include "viewer/measure/measure_tool.hpp"

#include <utility>

#include <fmt/format.h>

namespace relevo::viewer {

namespace {

constexpr std::size_t kMostSteps = 200;

/// Vertices with which a shape is whole by itself; 0: its user says when.
std::size_t whole_with(Tool tool) {
    switch (tool) {
        case Tool::point:
        case Tool::viewshed:
            return 1;
        case Tool::line:
        case Tool::sight:
            return 2;
        case Tool::path:
        case Tool::area:
            break;
    }
    return 0;
}

lod::MeasurementKind kind_of(Tool tool) {
    if (whole_with(tool) == 1) return lod::MeasurementKind::point;
    return tool == Tool::area ? lod::MeasurementKind::polygon : lod::MeasurementKind::path;
}

Tool tool_of(const lod::Measurement& measurement) {
    if (measurement.kind == lod::MeasurementKind::point) return Tool::point;
    if (measurement.kind == lod::MeasurementKind::polygon) return Tool::area;
    return measurement.vertices.size() == 2 ? Tool::line : Tool::path;
}

const char* name_of(Tool tool) {
    switch (tool) {
        case Tool::point:
            return "point";
        case Tool::line:
            return "line";
        case Tool::path:
            return "path";
        case Tool::area:
            return "area";
        case Tool::sight:
            return "sight";
        case Tool::viewshed:
            return "viewshed";
    }
    return "";
}

}  // namespace

bool is_measurable(const Shape& shape) {
    const std::size_t least = shape.tool == Tool::area ? 3 : whole_with(shape.tool) == 1 ? 1 : 2;
    return shape.measurement.vertices.size() >= least;
}

void MeasureTool::keep() {
    done_.push_back({shapes_, current_});
    if (done_.size() > kMostSteps) done_.erase(done_.begin());
    undone_.clear();
    ++version_;
}

void MeasureTool::restore(std::vector<State>& from, std::vector<State>& to) {
    to.push_back({std::move(shapes_), current_});
    shapes_ = std::move(from.back().shapes);
    current_ = from.back().current;
    from.pop_back();
    ++version_;
}

void MeasureTool::take(Tool tool) {
    if (tool != tool_) finish();
    tool_ = tool;
}

void MeasureTool::add(geo::LatLon place) {
    keep();
    if (!current_ || !shapes_[*current_].open || shapes_[*current_].tool != tool_) {
        current_ = shapes_.size();
        shapes_.push_back(
            {.tool = tool_,
             .measurement = {fmt::format("{} {}", name_of(tool_), shapes_.size() + 1), kind_of(tool_), {}},
             .choices = choices_});
    }
    Shape& shape = shapes_[*current_];
    shape.measurement.vertices.push_back(place);
    shape.open = shape.measurement.vertices.size() != whole_with(tool_);
}

void MeasureTool::finish() {
    if (!current_ || !shapes_[*current_].open) return;
    if (!is_measurable(shapes_[*current_])) return delete_shape(*current_);
    keep();
    shapes_[*current_].open = false;
}

void MeasureTool::begin_move(const Vertex& vertex) {
    keep();
    current_ = vertex.shape;
}

void MeasureTool::move(const Vertex& vertex, geo::LatLon place) {
    shapes_[vertex.shape].measurement.vertices[vertex.vertex] = place;
    ++version_;
}

void MeasureTool::begin_insert(const Vertex& vertex, geo::LatLon place) {
    keep();
    current_ = vertex.shape;
    std::vector<geo::LatLon>& places = shapes_[vertex.shape].measurement.vertices;
    places.insert(places.begin() + static_cast<std::ptrdiff_t>(vertex.vertex), place);
}

void MeasureTool::insert_shapes(const std::vector<lod::Measurement>& measurements) {
    if (measurements.empty()) return;
    finish();
    keep();
    for (const lod::Measurement& measurement : measurements)
        shapes_.push_back({.tool = tool_of(measurement), .measurement = measurement, .open = false});
    current_ = shapes_.size() - 1;
}

void MeasureTool::rename(std::size_t shape, std::string name) {
    keep();
    shapes_[shape].measurement.name = std::move(name);
}

void MeasureTool::choose(std::size_t shape, const MeasureChoices& choices) {
    keep();
    shapes_[shape].choices = choices_ = choices;
}

void MeasureTool::delete_vertex(const Vertex& vertex) {
    if (shapes_[vertex.shape].measurement.vertices.size() <= 1) return delete_shape(vertex.shape);
    keep();
    current_ = vertex.shape;
    Shape& shape = shapes_[vertex.shape];
    std::vector<geo::LatLon>& places = shape.measurement.vertices;
    places.erase(places.begin() + static_cast<std::ptrdiff_t>(vertex.vertex));
    if (is_measurable(shape)) return;
    shape.open = true;
    tool_ = shape.tool;
}

void MeasureTool::delete_vertex() {
    if (!current_) return;
    if (shapes_[*current_].measurement.vertices.size() <= 1) return delete_shape(*current_);
    keep();
    Shape& shape = shapes_[*current_];
    shape.measurement.vertices.pop_back();
    shape.open = true;
    tool_ = shape.tool;
}

void MeasureTool::delete_shape(std::size_t shape) {
    keep();
    shapes_.erase(shapes_.begin() + static_cast<std::ptrdiff_t>(shape));
    current_.reset();
    if (!shapes_.empty()) current_ = shapes_.size() - 1;
}

void MeasureTool::clear() {
    if (shapes_.empty()) return;
    keep();
    shapes_.clear();
    current_.reset();
}

bool MeasureTool::undo() {
    if (done_.empty()) return false;
    restore(done_, undone_);
    return true;
}

bool MeasureTool::redo() {
    if (undone_.empty()) return false;
    restore(undone_, done_);
    return true;
}

}  // namespace relevo::viewer
