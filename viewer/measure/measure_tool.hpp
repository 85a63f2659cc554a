#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "lod/measure/measurement.hpp"
#include "lod/measure/plane.hpp"
#include "lod/measure/sight.hpp"

namespace relevo::viewer {

/// What a click on the ground is for.
enum class Tool { point, line, path, area, sight, viewshed };

/// What a measurement depends on besides its places.
struct MeasureChoices {
    lod::Plane plane;        ///< of an area's volumes
    lod::Looking looking;    ///< of a line of sight and a viewshed
    double radius_m = 5000;  ///< of a viewshed
    friend bool operator==(const MeasureChoices&, const MeasureChoices&) = default;
};

/// A measurement in the making or made, and with which tool.
struct Shape {
    Tool tool = Tool::line;
    lod::Measurement measurement;
    bool open = true;  ///< the next click adds a vertex
    MeasureChoices choices = {};
};

/// Has a shape of a tool enough vertices to be measured?
bool is_measurable(const Shape& shape);

/// The places that a user sets, moves and deletes, with all steps undone and done again. Knows nothing of
/// pictures: who draws says what was hit.
class MeasureTool {
  public:
    struct Vertex {
        std::size_t shape = 0;
        std::size_t vertex = 0;
        friend bool operator==(const Vertex&, const Vertex&) = default;
    };

    Tool tool() const { return tool_; }
    /// What was begun with another one is finished, or dropped where it is not enough.
    void take(Tool tool);

    const std::vector<Shape>& shapes() const { return shapes_; }
    /// The one that clicks add to, or that was touched last.
    const std::optional<std::size_t>& current() const { return current_; }
    void select(std::size_t shape) { current_ = shape; }

    /// A click on the ground: the next vertex of the open shape, else the first of a new one, with the
    /// choices that were made last. Points, lines, lines of sight and viewsheds are finished by their last
    /// vertex.
    void add(geo::LatLon place);
    /// Ends an open path or area; one that is not enough goes.
    void finish();

    /// Moves a vertex; all moves from begin_move on are one step for undo.
    void begin_move(const Vertex& vertex);
    void move(const Vertex& vertex, geo::LatLon place);
    /// A new vertex before which the one of this number was (or the first, of an area), to be moved on in the
    /// same step.
    void begin_insert(const Vertex& vertex, geo::LatLon place);

    void insert_shapes(const std::vector<lod::Measurement>& measurements);
    void rename(std::size_t shape, std::string name);
    void choose(std::size_t shape, const MeasureChoices& choices);
    /// Any vertex; what is not enough any more is open again, and a shape that has no other goes.
    void delete_vertex(const Vertex& vertex);
    /// The last vertex of the current shape, and with it a shape that has no other.
    void delete_vertex();
    void delete_shape(std::size_t shape);
    void clear();

    bool undo();
    bool redo();

    /// Grows with every change: what was worked out from the shapes at another one is old.
    std::size_t version() const { return version_; }

  private:
    struct State {
        std::vector<Shape> shapes;
        std::optional<std::size_t> current;
    };
    void keep();
    void restore(std::vector<State>& from, std::vector<State>& to);

    Tool tool_ = Tool::line;
    MeasureChoices choices_;  // of the next shape
    std::vector<Shape> shapes_;
    std::optional<std::size_t> current_;
    std::vector<State> undone_;  // oldest first: what redo() goes back to
    std::vector<State> done_;
    std::size_t version_ = 0;
};

}  // namespace relevo::viewer
