#pragma once

#include "geo/angle.hpp"

namespace relevo::lod {

inline constexpr double kGravity = 9.80665;  ///< m/s^2, standard

struct Wind {
    double speed_m_s = 0;    ///< 10 m above the sea
    geo::Degrees from;       ///< azimuth that the wind comes from
    double fetch_m = 500e3;  ///< of open water upwind
};

/// The waves that a steady wind raises on deep water, as a spectrum: JONSWAP (Hasselmann et al. 1973,
/// "Measurements of wind-wave growth and swell decay during the Joint North Sea Wave Project"), which ends
/// in that of a fully developed sea (Pierson & Moskowitz 1964) where the fetch is long enough.
///
/// Significant heights of measured seas scatter by some 15 % about such laws. No wind, no fetch: no waves.
class WindSea {
  public:
    explicit WindSea(const Wind& wind);

    /// Angular frequency of the highest waves, rad/s; 0 without waves.
    double peak_rad_s() const { return peak_; }
    /// Their length in deep water; 0 without waves.
    double peak_length_m() const;

    /// Variance of the sea's height per frequency, m^2 s: S(omega).
    double density(double rad_s) const;
    /// Variance of the sea's height from waves between two frequencies, m^2. Right to 1e-4 of that.
    double variance(double from_rad_s, double to_rad_s) const;
    /// Four standard deviations of the height.
    double significant_height_m() const;

    /// How far from the wind's direction waves of a frequency run, radians in (-pi, pi): the angle below
    /// which a share `quantile` in [0, 1] of their energy lies. Donelan, Hamilton & Hui 1985, "Directional
    /// spectra of wind-generated waves": sech^2(beta angle), beta held beyond 1.6 times the peak's frequency.
    /// (The fits of cos^2s (angle / 2), Mitsuyasu 1975 and Hasselmann 1980, lose all direction there, against
    /// what is seen.)
    double spread_rad(double rad_s, double quantile) const;

  private:
    double peak_ = 0;
    double alpha_ = 0;  ///< Phillips's constant
    double gamma_ = 1;  ///< what the peak rises above Pierson and Moskowitz's
};

/// Angular frequency of waves of a length in deep water, rad/s. \pre length_m > 0
double deep_water_rad_s(double length_m);

}  // namespace relevo::lod
