#pragma once

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>

#include "lod/ocean/wind_sea.hpp"

namespace relevo::lod {

/// One long-crested wave: amplitude cos(k . x - omega t + phase) metres above the still sea.
struct WaveComponent {
    glm::dvec2 k{0};  ///< rad/m in the chart (x east, y north), the way that the wave runs
    double amplitude_m = 0;
    double omega = 0;  ///< rad/s
    double phase = 0;  ///< rad

    double length_m() const;
};

/// The sea's height as a sum of waves, longest first.
class Waves {
  public:
    static constexpr int kComponents = 32;  ///< of a wind's waves, at most

    /// A still sea.
    Waves() = default;
    explicit Waves(std::vector<WaveComponent> components);

    /// A wind's waves from 2.5 times the peak's length down to 1 m, in logarithmic bands of length: a wave a
    /// band, of all the band's energy. A sea whose longest waves are shorter than 1 m is still.
    ///
    /// The same seed gives the same sea on every machine, to the last digits of its mathematical functions.
    /// \param depth_m  slows the waves (Airy's omega^2 = g k tanh(k depth)); their energy is that of deep
    /// water
    static Waves of_wind(const Wind& wind, std::uint64_t seed = 1,
                         double depth_m = std::numeric_limits<double>::infinity());

    /// Metres above the still sea at a place of the chart, right to 1e-8 m within 1000 km and 1000 hours.
    double height(const glm::dvec2& at, double time_s) const;
    /// The same over ground `depth_m` below the still sea, which takes of each wave its `depth_part`.
    double height(const glm::dvec2& at, double time_s, double depth_m) const;

    /// No wave rises or sinks more: the sum of the amplitudes.
    double crest_m() const;
    /// Four standard deviations of the height.
    double significant_height_m() const;
    /// Mean square of the slope (both axes together).
    double slope_variance() const;

    const std::vector<WaveComponent>& components() const& { return components_; }
    /// So that a loop over a temporary sea's waves has something to loop over.
    std::vector<WaveComponent> components() && { return std::move(components_); }

  private:
    std::vector<WaveComponent> components_;
};

/// What is left of a wave over ground: all of it where the water is deeper than half its length (there it
/// begins to feel the ground), nothing on dry land, smoothly between. A look, not a law of shoaling.
double depth_part(double depth_m, double length_m);

/// Mean square slope of a real sea, waves of all lengths: 0.003 + 0.00512 U +- 0.004, U the wind in m/s, 1 to
/// 14, at 12.5 m (Cox & Munk 1954, "Measurement of the roughness of the sea surface from photographs of the
/// Sun's glitter").
double cox_munk_slope_variance(double wind_m_s);

}  // namespace relevo::lod
