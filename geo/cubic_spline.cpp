#include "geo/cubic_spline.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace relevo::geo {

void to_periodic_spline_coefficients(std::span<double> samples) {
    assert(!samples.empty());
    // One recursive filter forward, one back, both begun with the sum over the whole period.
    const double pole = std::sqrt(3.0) - 2;
    const std::size_t n = samples.size();
    // |pole|^40 < 1e-22: more terms add nothing.
    const std::size_t terms = std::min<std::size_t>(n, 40);
    const double period = 1 / (1 - std::pow(pole, static_cast<double>(n)));

    double sum = 0;
    double power = 1;
    for (std::size_t k = 0; k < terms; ++k, power *= pole) sum += power * samples[(n - k) % n];
    samples[0] = sum * period;
    for (std::size_t k = 1; k < n; ++k) samples[k] += pole * samples[k - 1];

    sum = 0;
    power = 1;
    for (std::size_t k = 0; k < terms; ++k, power *= pole) sum += power * samples[(n - 1 + k) % n];
    samples[n - 1] = -pole * sum * period;
    for (std::size_t k = n - 1; k-- > 0;) samples[k] = pole * (samples[k + 1] - samples[k]);

    for (double& c : samples) c *= 6;
}

std::vector<double> line_spline_coefficients(std::span<const double> s) {
    const std::size_t n = s.size();
    assert(n >= 4);
    // With M_k = c_(k-1) - 2 c_k + c_(k+1), interpolation is s_k = c_k + M_k / 6. "Not a knot" at sample 1 is
    // M_0 - 2 M_1 + M_2 = 0, and taking second differences of s around it gives M_1 = s_0 - 2 s_1 + s_2: c_1
    // is known at once, and so is its counterpart at the other end.
    std::vector<double> c(n + 2);  // c[k + 1] is c_k
    c[2] = s[1] - (s[0] - 2 * s[1] + s[2]) / 6;
    c[n - 1] = s[n - 2] - (s[n - 3] - 2 * s[n - 2] + s[n - 1]) / 6;
    // Between them c_(k-1) + 4 c_k + c_(k+1) = 6 s_k: Thomas's elimination, whose pivots stay above 3.
    std::vector<double> upper(n + 2);
    for (std::size_t k = 3; k + 1 < n; ++k) {
        const double pivot = 4 - upper[k - 1];
        upper[k] = 1 / pivot;
        const double last = k + 2 == n ? c[n - 1] : 0;
        c[k] = (6 * s[k - 1] - c[k - 1] - last) / pivot;
    }
    for (std::size_t k = n - 2; k-- > 3;) c[k] -= upper[k] * c[k + 1];
    c[1] = 6 * s[1] - 4 * c[2] - c[3];
    c[0] = 6 * s[0] - 4 * c[1] - c[2];
    c[n] = 6 * s[n - 2] - 4 * c[n - 1] - c[n - 2];
    c[n + 1] = 6 * s[n - 1] - 4 * c[n] - c[n - 1];
    return c;
}

std::array<double, 4> spline_weights(double t) {
    const double s = 1 - t;
    return {s * s * s / 6, 2.0 / 3 - 0.5 * t * t * (2 - t), 2.0 / 3 - 0.5 * s * s * (2 - s), t * t * t / 6};
}

}  // namespace relevo::geo
