#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "geo/position.hpp"
#include "geo/result.hpp"
#include "viewer/view_state.hpp"

namespace relevo::viewer {

/// Where the camera is at a time: one line of a flight file.
struct FlightKey {
    double time_s = 0;
    geo::LatLon place;
    geo::OrthometricHeight H;  ///< of the eye, above the scene's vertical datum
    geo::Degrees heading, pitch, roll;
    geo::Degrees fov{60};
};

/// The key that a view is at a time.
FlightKey key_of(const ViewState& view, double time_s);

/// Moves a view to a key; how it is drawn stays.
void put(ViewState& view, const FlightKey& key);

/// May one key follow another: are they at most 90 degrees of the earth apart, so that the way is clear?
bool joins(const FlightKey& a, const FlightKey& b);

/// A camera's path through time, kept as a text file (docs/bench.md):
///
///     relevo-flight 1
///     # time_s lat_deg lon_deg H_m heading_deg pitch_deg roll_deg fov_deg
///     0   37.45 -105.75 3200   55 -3 0 60
///     2.5 37.46 -105.74 3150   57 -3 0 60
///
/// Between keys it runs smoothly (continuous speeds) and beyond none of the values of the two keys: a camera
/// that rests between equal keys rests. Places go over the earth's curve, also across the antimeridian and
/// over the poles; angles go the shorter way. Near a pole (75 degrees, as in grids) headings are interpolated
/// against the pole's grid, where they do not turn with the meridians.
class FlightPath {
  public:
    /// Fails with ErrorKind::usage where the keys are none, are not in the order of time, leave a view's
    /// ranges, or two that follow each other are more than 90 degrees of the earth apart; the message names
    /// the key, counted from 1.
    static Result<FlightPath> create(std::vector<FlightKey> keys);

    /// Reads a flight file. ErrorKind::input, with file and line.
    static Result<FlightPath> load(const std::filesystem::path& file);

    /// \param name  for messages
    static Result<FlightPath> parse(std::string_view text, std::string_view name);

    /// As parse() reads it, to the last bit.
    std::string to_text() const;

    const std::vector<FlightKey>& keys() const { return keys_; }
    double begin_s() const { return keys_.front().time_s; }
    double duration_s() const { return keys_.back().time_s - keys_.front().time_s; }

    /// The camera at a time; before the first key at the first, after the last at the last. At a key's time
    /// it is the key, but for whole turns of its longitude and heading.
    FlightKey at(double time_s) const;

  private:
    FlightPath() = default;

    /// What is interpolated, so that a plain cubic does.
    struct Knot {
        glm::dvec3 up;                        // the ellipsoid's normal at the place
        double H, heading, pitch, roll, fov;  // degrees without jumps; the heading as pole_ says
        glm::dvec3 up_speed;                  // a second
        double H_speed, heading_speed, pitch_speed, roll_speed, fov_speed;
    };
    void choose_pole();
    void make_knots();
    double turned_heading(const FlightKey& key) const;

    std::vector<FlightKey> keys_;
    std::vector<Knot> knots_;
    int pole_ = 0;  // headings count from the grid of: +1 the north pole, -1 the south pole; 0: from north
};

/// Writes a flight; the file appears when it is whole.
Result<void> write_flight(const FlightPath& flight, const std::filesystem::path& file);

}  // namespace relevo::viewer
