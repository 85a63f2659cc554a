#include "viewer/measure/shape_result.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "geo/coordinate_text.hpp"
#include "lod/measure/path.hpp"
#include "lod/measure/plane.hpp"
#include "lod/measure/point.hpp"
#include "lod/measure/results.hpp"
#include "lod/measure/sight.hpp"
#include "viewer/ui/hud.hpp"

namespace relevo::viewer {

namespace {

constexpr int kPointsALeg = 160;

/// Appends the ground under the geodesic from one vertex to the next, without its end.
Result<void> add_leg(lod::HeightSampler& sampler, geo::LatLon from, geo::LatLon to, int points,
                     double& distance_m, std::vector<OutlinePoint>& outline) {
    const geo::GridFrame& frame = sampler.scene().info().frame;
    const geo::Geoid* geoid = sampler.scene().geoid();
    const geo::GeodesicPath path(from, to);
    const double before_m = distance_m;
    distance_m += path.length_m();
    for (int i = 0; i < points; ++i) {
        OutlinePoint point;
        point.place = i == 0 ? from : path.at(path.length_m() * i / points);
        point.distance_m = before_m + path.length_m() * i / points;
        const auto H = sampler.height(frame.grid_position(point.place));
        if (!H) return H.error();
        point.H = H->value_or(outline.empty() ? 0 : outline.back().H);
        if (geoid != nullptr && geoid->covers(point.place)) point.N = geoid->undulation(point.place).m;
        outline.push_back(point);
    }
    return {};
}

Result<void> add_outline(lod::HeightSampler& sampler, const Shape& shape, ShapeResult& result) {
    const std::vector<geo::LatLon>& vertices = shape.measurement.vertices;
    const bool closed = shape.tool == Tool::area;
    double distance_m = 0;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        result.vertices.push_back(result.outline.size());
        const bool last = i + 1 == vertices.size();
        const int points = last && !closed ? 1 : kPointsALeg;
        if (auto done = add_leg(sampler, vertices[i],
                                vertices[last && closed ? 0 : std::min(i + 1, vertices.size() - 1)], points,
                                distance_m, result.outline);
            !done)
            return done;
    }
    if (closed) {
        result.outline.push_back(result.outline.front());
        result.outline.back().distance_m = distance_m;
    }
    return {};
}

/// Fills in what is said of a shape; the sampler is at hand, and units are the user's.
class Report {
  public:
    Report(lod::HeightSampler& sampler, geo::UnitSystem units, const std::function<bool(double)>& progress,
           ShapeResult& result)
        : sampler_(sampler),
          vertical_(sampler.scene().info().vertical),
          units_(units),
          progress_(progress),
          result_(result) {}

    Result<void> of(const Shape& shape) {
        const std::vector<geo::LatLon>& places = shape.measurement.vertices;
        for (const geo::LatLon& place : places) {
            const auto H = sampler_.height(sampler_.scene().info().frame.grid_position(place));
            if (!H) return H.error();
            result_.H_m.push_back(*H);
        }
        switch (shape.tool) {
            case Tool::point:
                return point(places.front());
            case Tool::line:
            case Tool::path:
                return path(places);
            case Tool::area:
                return area(places, shape.choices.plane);
            case Tool::sight:
                return sight(places[0], places[1], shape.choices.looking);
            case Tool::viewshed:
                return viewshed(places.front(), shape.choices);
        }
        return {};
    }

  private:
    template <class... Values>
    void say(fmt::format_string<Values...> text, Values&&... values) {
        result_.lines.push_back(fmt::format(text, std::forward<Values>(values)...));
    }
    std::string length(double m) const { return geo::length_text(m, units_); }
    std::string height(double m) const { return geo::height_text(m, units_, 2); }
    void say_datum() {
        say("H above {}{}", vertical_.name, vertical_.assumed ? " (assumed: the source does not say)" : "");
    }

    Result<void> point(geo::LatLon place) {
        const auto measured = lod::measure_point(sampler_, place);
        if (!measured) return measured.error();
        const lod::SceneInfo& info = sampler_.scene().info();
        result_.json = lod::results_of(*measured, lod::source_of(info, *measured), info);
        say("{}", geo::to_decimal_degrees(place));
        say("{}", geo::to_dms(place));
        say("UTM {}", geo::to_utm(place));
        say("MGRS {}", geo::to_mgrs(place));
        say("{}", heights_text(*measured, vertical_));
        if (measured->filled) say("interpolated over a void");
        if (measured->modelled) say("made-up sea bed");
        if (measured->kind == lod::PointClass::sea) say("sea");
        if (measured->kind != lod::PointClass::outside) say("a post every {:.1f} m", measured->resolution_m);
        result_.label = measured->H ? height(measured->H->m) : "no height";
        return {};
    }

    Result<void> path(const std::vector<geo::LatLon>& places) {
        const auto measured = lod::measure_path(sampler_, places);
        if (!measured) return measured.error();
        auto profile = lod::measure_profile(sampler_, places);
        if (!profile) return profile.error();
        result_.json = lod::results_of(*measured);
        say("geodesic {}", length(measured->length_m));
        result_.label = length(measured->length_m);
        if (places.size() == 2) say("azimuth {:.4f}\u00b0", measured->legs[0].geodesic.azimuth1.value);
        if (measured->surface_m) {
            say("over the ground {}", length(*measured->surface_m));
            say("climb {}, descent {}", height(*measured->climb_m), height(*measured->descent_m));
        }
        if (places.size() > 2) {
            for (std::size_t i = 0; i < measured->legs.size(); ++i) {
                say("{} to {}: {}, azimuth {:.3f}\u00b0{}", i + 1, i + 2,
                    length(measured->legs[i].geodesic.length_m), measured->legs[i].geodesic.azimuth1.value,
                    i == 0 ? "" : fmt::format(", turn {:+.2f}\u00b0", measured->turns[i - 1].value));
            }
        }
        say_profile(*profile);
        result_.profile = *std::move(profile);
        return {};
    }

    void say_profile(const lod::Profile& profile) {
        if (profile.lowest && profile.highest && profile.mean_H_m)
            say("H {} to {}, mean {}", height(profile.lowest->value), height(profile.highest->value),
                height(*profile.mean_H_m));
        const auto degrees = [](double slope) { return geo::Degrees::from_radians(std::atan(slope)).value; };
        if (profile.mean_slope) say("mean slope {:.1f}\u00b0", degrees(*profile.mean_slope));
        if (profile.steepest_up) say("steepest up {:.1f}\u00b0", degrees(profile.steepest_up->value));
        if (profile.steepest_down) say("steepest down {:.1f}\u00b0", degrees(profile.steepest_down->value));
        for (const lod::ProfileGap& gap : profile.gaps)
            say("{} from {} to {}", gap.outside ? "outside the data" : "void", length(gap.from_m),
                length(gap.to_m));
        say_datum();
    }

    Result<void> area(const std::vector<geo::LatLon>& places, const lod::Plane& plane) {
        const auto measured = lod::measure_area(sampler_, places, plane, progress_);
        if (!measured) return measured.error();
        result_.json = lod::results_of(*measured, sampler_.scene().info());
        const auto text = [&](double m2) { return geo::area_text(m2, units_); };
        say("geodesic area {}", text(measured->geodesic.area_m2));
        result_.label = text(measured->geodesic.area_m2);
        say("perimeter {}", length(measured->geodesic.perimeter_m));
        if (measured->surface_m2) say("surface {}", text(*measured->surface_m2));
        if (measured->lowest && measured->highest && measured->mean_H_m)
            say("H {} to {}, mean {}", height(measured->lowest->value), height(measured->highest->value),
                height(*measured->mean_H_m));
        if (measured->mean_slope_deg && measured->steepest_deg)
            say("slope mean {:.1f}\u00b0, steepest {:.1f}\u00b0", *measured->mean_slope_deg,
                measured->steepest_deg->value);
        if (measured->plane_H_m && measured->volume_above_m3 && measured->volume_below_m3)
            say("volume above H {}: {}, below it: {}", height(*measured->plane_H_m),
                geo::volume_text(*measured->volume_above_m3, units_),
                geo::volume_text(*measured->volume_below_m3, units_));
        if (measured->void_m2 > 0) say("voids {}: not in it", text(measured->void_m2));
        if (measured->outside_m2 > 0) say("outside the data {}: not in it", text(measured->outside_m2));
        say_datum();
        return {};
    }

    Result<void> sight(geo::LatLon eye, geo::LatLon target, const lod::Looking& looking) {
        const auto measured = lod::measure_sight(sampler_, eye, target, looking);
        if (!measured) return measured.error();
        result_.json = lod::results_of(*measured, looking);
        result_.label = !measured->visible ? "unknown" : *measured->visible ? "visible" : "hidden";
        say("{}, {} away", result_.label, length(measured->geodesic.length_m));
        if (measured->first_blocked)
            say("first blocked after {}", length(measured->first_blocked->distance_m));
        if (measured->worst)
            say("at most {} in the ground, after {}", height(-measured->worst->clearance_m),
                length(measured->worst->distance_m));
        if (measured->least_clearance)
            say("least clearance {} after {}", height(measured->least_clearance->clearance_m),
                length(measured->least_clearance->distance_m));
        if (measured->unknown_m > 0) say("over voids or outside: {}", length(measured->unknown_m));
        auto profile = lod::measure_profile(sampler_, std::vector{eye, target});
        if (!profile) return profile.error();
        result_.profile = *std::move(profile);
        return {};
    }

    Result<void> viewshed(geo::LatLon eye, const MeasureChoices& choices) {
        const lod::ViewshedRequest request{choices.looking, choices.radius_m, progress_};
        auto measured = lod::measure_viewshed(sampler_, eye, request);
        if (!measured) return measured.error();
        result_.json = lod::results_of(*measured, request);
        const auto text = [&](double m2) { return geo::area_text(m2, units_); };
        say("eye at H {}", height(measured->eye_H_m));
        say("visible {}, {} posts", text(measured->visible_m2), measured->visible_posts);
        say("hidden {}, {} posts", text(measured->hidden_m2), measured->hidden_posts);
        if (measured->unknown_posts > 0)
            say("unknown {}, {} posts: over voids or outside", text(measured->unknown_m2),
                measured->unknown_posts);
        say_datum();
        result_.label = "visible " + text(measured->visible_m2);
        result_.viewshed = std::make_shared<const lod::Viewshed>(*std::move(measured));
        return {};
    }

    lod::HeightSampler& sampler_;
    const lod::VerticalReference& vertical_;
    geo::UnitSystem units_;
    const std::function<bool(double)>& progress_;
    ShapeResult& result_;
};

}  // namespace

ShapeResult measure_shape(lod::HeightSampler& sampler, const Shape& shape, geo::UnitSystem units,
                          const std::function<bool(double)>& progress) {
    ShapeResult result;
    std::atomic<bool> stopped = false;
    const std::function<bool(double)> go_on = [&](double done) {
        if (progress && !progress(done)) stopped = true;
        return !stopped;
    };
    auto done = add_outline(sampler, shape, result);
    if (done && go_on(0)) done = Report(sampler, units, go_on, result).of(shape);
    if (stopped) {
        result = ShapeResult();
        result.stopped = true;
    } else if (!done) {
        result.lines.push_back(done.error().message);
    }
    return result;
}

}  // namespace relevo::viewer
