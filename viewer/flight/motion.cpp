#include "viewer/flight/motion.hpp"

#include <utility>

namespace relevo::viewer {

void Motion::play(FlightPath flight) {
    flight_.emplace(std::move(flight));
    has_begun_ = false;
}

void Motion::fly_to(ViewState& view, const ViewState& there) {
    constexpr double kSeconds = 1.2;
    const FlightKey from = key_of(view, 0);
    const FlightKey to = key_of(there, kSeconds);
    if (joins(from, to)) {
        if (auto flight = FlightPath::create({from, to})) return play(*std::move(flight));
    }
    put(view, to);
}

void Motion::move(ViewState& view, const Window& window, const Input& input, double dt, int width,
                  int height) {
    if (flight_ && controls_.steered(window, input)) flight_.reset();
    if (!flight_) return controls_.steer(view, window, input, dt, width, height);
    const auto now = std::chrono::steady_clock::now();
    if (!std::exchange(has_begun_, true)) begin_ = now;
    const double flown_s = std::chrono::duration<double>(now - begin_).count();
    put(view, flight_->at(flight_->begin_s() + flown_s));
    if (flown_s >= flight_->duration_s()) flight_.reset();
}

}  // namespace relevo::viewer
