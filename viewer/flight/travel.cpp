#include "viewer/flight/travel.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "geo/coordinate_text.hpp"
#include "viewer/camera.hpp"
#include "viewer/flight/flight_path.hpp"
#include "viewer/ui/hud.hpp"

namespace relevo::viewer {

void go_near(FlightState& flight, const lod::View& view, const glm::dvec2& pixel, const lod::Hit& there) {
    const geo::Geodetic target = geo::to_geodetic(view.eye() + there.distance_m * view.ray(pixel));
    ViewState to = flight.view;
    look_at(to, flight.heights, target, std::max(there.distance_m / 3, 50.0));
    flight.motion.fly_to(flight.view, to);
}

void go_to(FlightState& flight, const std::string& text) {
    if (text.empty()) return flight.panels.show_go_to();
    if (text.find('/') != std::string::npos) return go_to_view(flight, text);
    const auto place = geo::parse_lat_lon(text);
    if (!place) return flight.panels.complain_of_go_to(place.error().message);
    const double ground_m = ground_height(flight.terrain, *place, flight.view.exaggeration)
                                .value_or(geo::EllipsoidalHeight{flight.heights.undulation(*place).m})
                                .m;
    ViewState to = flight.view;
    look_at(to, flight.heights, {place->lat, place->lon, {ground_m}},
            std::clamp(flight.middle_distance_m.value_or(5000), 100.0, 1e6));
    flight.motion.fly_to(flight.view, to);
}

void go_to_view(FlightState& flight, const std::string& text) {
    ViewState& view = flight.view;
    const auto read = parse_view_state(text, view);
    if (!read) return flight.tell(fmt::format("this is no view: {}", read.error().message));
    ViewState to = *read;
    to.ocean.map = view.ocean.map;
    to.metric = view.metric;  // the terrain is open for it
    if (to.method == Method::lstr && flight.terrain.chunks() == nullptr) {
        to.method = view.method;
        flight.tell("nodes are drawn where the window is opened with --lod lstr");
    }
    std::swap(to, view);
    const ViewState there = view;
    put(view, key_of(to, 0));
    flight.motion.fly_to(view, there);
}

void add_bookmark(FlightState& flight) {
    std::vector<Bookmark>& marks = flight.desk.settings().bookmarks;
    marks.push_back({place_text(flight.view.place), flight.scene_name(), to_string(flight.view)});
    flight.desk.show_panel(true);
    flight.desk.save();
    flight.tell("bookmark added");
}

}  // namespace relevo::viewer
