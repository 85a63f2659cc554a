#include "geo/polar_positions.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

#include <GeographicLib/Constants.hpp>
#include <GeographicLib/Math.hpp>

namespace relevo::geo {
namespace {

const long double kEccentricity = std::sqrt(static_cast<long double>(wgs84::kEccentricity2));

/// Easting and northing from the pole for t = 1, metres: the point of the projection whose conformal latitude
/// is 0.
double unit_of_plane() {
    const double c = (1 - wgs84::kFlattening) *
                     std::exp(GeographicLib::Math::eatanhe(1.0, static_cast<double>(kEccentricity)));
    return 2 * GeographicLib::Constants::UPS_k0() * wgs84::kSemiMajor / c;
}

/// What the polynomials stand for, from the conformal latitude.
struct Exact {
    long double cosine;
    long double sine;
    long double radius;
};

/// \param v  2 sin^2 chi - 1, inside (-1, 1)
Exact exact(long double v) {
    const long double tan_chi = std::sqrt((1 + v) / (1 - v));
    const long double tan_lat = GeographicLib::Math::tauf(tan_chi, kEccentricity);
    const long double cosine = std::sqrt((1 + tan_chi * tan_chi) / (1 + tan_lat * tan_lat));
    const long double sin2_lat = tan_lat * tan_lat / (1 + tan_lat * tan_lat);
    return {cosine, cosine * tan_lat / tan_chi,
            wgs84::kSemiMajor / std::sqrt(1 - kEccentricity * kEccentricity * sin2_lat)};
}

}  // namespace

PolarPositions::PolarPositions(const GridFrame& frame) {
    assert(frame.is_polar());
    const double unit = unit_of_plane();
    // Around the north pole northing grows from longitude 0 to 180, around the south pole the other way.
    pole_ = frame.kind == FrameKind::ups_north ? 1 : -1;
    y_ = (frame.west - kUpsFalseOrigin) / unit;
    y_column_ = frame.step_x / unit;
    x_ = -pole_ * (frame.north - kUpsFalseOrigin) / unit;
    x_row_ = pole_ * frame.step_y / unit;

    // Interpolation at Chebyshev's points, and from Chebyshev's polynomials to powers: with terms that fall
    // by e^2 each nothing is lost in that.
    std::array<std::array<long double, kTerms>, kTerms> chebyshev{};  // powers of T_k
    chebyshev[0][0] = 1;
    chebyshev[1][1] = 1;
    for (std::size_t k = 2; k < kTerms; ++k) {
        for (std::size_t i = 0; i < kTerms; ++i)
            chebyshev[k][i] = (i > 0 ? 2 * chebyshev[k - 1][i - 1] : 0) - chebyshev[k - 2][i];
    }
    std::array<long double, kTerms> cosine{};
    std::array<long double, kTerms> sine{};
    std::array<long double, kTerms> radius{};
    for (std::size_t j = 0; j < kTerms; ++j) {
        const long double angle =
            std::numbers::pi_v<long double> * (static_cast<long double>(j) + 0.5L) / kTerms;
        const Exact value = exact(std::cos(angle));
        for (std::size_t k = 0; k < kTerms; ++k) {
            const long double weight =
                (k == 0 ? 1 : 2) * std::cos(static_cast<long double>(k) * angle) / kTerms;
            for (std::size_t i = 0; i < kTerms; ++i) {
                cosine[i] += weight * value.cosine * chebyshev[k][i];
                sine[i] += weight * value.sine * chebyshev[k][i];
                radius[i] += weight * value.radius * chebyshev[k][i];
            }
        }
    }
    for (std::size_t i = 0; i < kTerms; ++i) {
        cosine_.c[i] = static_cast<double>(cosine[i]);
        sine_.c[i] = static_cast<double>(sine[i]);
        radius_.c[i] = static_cast<double>(radius[i]);
    }
}

}  // namespace relevo::geo
