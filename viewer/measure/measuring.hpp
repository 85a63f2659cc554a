#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "geo/result.hpp"
#include "lod/terrain.hpp"
#include "lod/view.hpp"
#include "viewer/eye_height.hpp"
#include "viewer/input.hpp"
#include "viewer/measure/measure_tool.hpp"
#include "viewer/measure/shape_result.hpp"
#include "viewer/ui/handle_marks.hpp"
#include "viewer/ui/hud.hpp"

namespace relevo::viewer {

/// Measurements as files, which the viewer itself does not know the formats of.
struct MeasurementFiles {
    std::function<bool(const std::filesystem::path&)> is_one;
    std::function<Result<std::vector<lod::Measurement>>(const std::filesystem::path&)> load;
    /// Measurements with their results, in the order of shapes.
    std::function<Result<void>(const std::vector<Shape>&, const std::vector<const ShapeResult*>&,
                               const std::filesystem::path&)>
        save;
    /// As a raster with colours.
    std::function<Result<void>(const lod::SceneInfo&, const lod::Viewshed&, const std::filesystem::path&)>
        save_viewshed;
};

/// Measuring in a picture: what clicks and drags mean for the shapes, and how these are drawn.
class Measuring {
  public:
    /// All must outlive it.
    Measuring(const lod::Scene& scene, const lod::Terrain& terrain, const EyeHeight& heights)
        : terrain_(terrain), heights_(heights), results_(scene) {}

    MeasureTool& tool() { return tool_; }
    const MeasureTool& tool() const { return tool_; }
    const ShapeResults& results() const { return results_; }

    /// Where the ground is under a pixel; nothing: nowhere.
    using PlaceAt = std::function<std::optional<geo::LatLon>(const glm::dvec2& pixel)>;

    /// Takes what the mouse does to vertices, so that the view does not have it: a drag moves one, or in the
    /// middle of a side of the current path or area makes a new one; a click chooses one, a click of the
    /// right button deletes it.
    void take_mouse(Input& input, const lod::View& view, double exaggeration, const PlaceAt& place_at);
    void click(geo::LatLon place);
    /// The click before was the first of two, which mean something else.
    void take_back_click();

    /// Deletes the vertex under the cursor, else the chosen one, else the last of the current shape.
    void delete_vertex();

    /// Once a frame: results that are there, and work for those that are not.
    void update(geo::UnitSystem units) { results_.update(tool_.shapes(), units); }
    bool busy() const { return results_.busy(); }
    /// Of the shape that was current last among those that have one; null: none.
    std::shared_ptr<const lod::Viewshed> viewshed();

    ShapeResults& results() { return results_; }

    std::vector<DrawnShape> drawn(double exaggeration) const;
    /// What can be taken hold of.
    Handles handles(double exaggeration) const;
    /// How far along the current shape's outline the place is that is nearest to a pixel, metres; nothing
    /// beyond `within_px`.
    std::optional<double> distance_at(const lod::View& view, const glm::dvec2& pixel, double within_px,
                                      double exaggeration) const;
    /// Where the current shape's outline is after a distance.
    std::optional<geo::Ecef> place_at(double distance_m, double exaggeration) const;

  private:
    const ShapeResult* current_result() const;
    geo::Ecef position(const OutlinePoint& point, double exaggeration) const;
    geo::Ecef position(geo::LatLon place, double exaggeration) const;

    const lod::Terrain& terrain_;
    const EyeHeight& heights_;
    MeasureTool tool_;
    ShapeResults results_;
    std::optional<MeasureTool::Vertex> nearest_vertex(const lod::View& view, const glm::dvec2& pixel,
                                                      double exaggeration) const;
    /// Of the current shape's sides: their middles, each with the vertex after it.
    std::vector<std::pair<std::size_t, geo::LatLon>> middles() const;
    bool exists(const std::optional<MeasureTool::Vertex>& vertex) const;

    std::optional<MeasureTool::Vertex> held_;
    std::optional<MeasureTool::Vertex> hovered_;
    std::optional<MeasureTool::Vertex> chosen_;
    std::shared_ptr<const lod::Viewshed> viewshed_;
    bool just_clicked_ = false;
};

}  // namespace relevo::viewer
