// SPDX-License-Identifier: Apache-2.0
#include "airborne/impaction.hpp"

#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

using dust::test::approx;
using namespace dust::airborne;

namespace {

/// Place and velocity along and across the stream.
using State = std::array<double, 4>;

/// Of a point of response time `tau` in potential flow of speed 1 round a sphere of radius 1.
State rate(const State& s, double tau) {
  const double r2 = s[0] * s[0] + s[1] * s[1];
  const double r5 = r2 * r2 * std::sqrt(r2);
  const double along = 1.0 - 0.5 * (2.0 * s[0] * s[0] - s[1] * s[1]) / r5;
  const double across = -1.5 * s[0] * s[1] / r5;
  return {s[2], s[3], (along - s[2]) / tau, (across - s[3]) / tau};
}

State moved(const State& s, const State& by, double share) {
  State to = s;
  for (std::size_t n = 0; n < to.size(); ++n) to[n] += share * by[n];
  return to;
}

/// Does a point that starts far upstream, `off` the axis, hit the sphere? Runge and Kutta's fourth
/// order.
bool hits(double off, double tau) {
  constexpr double k_step = 0.004;
  State s{-8.0, off, 0.0, 0.0};
  const State gas = rate(s, 1.0);
  s[2] = gas[2];
  s[3] = gas[3];
  while (s[0] < 0.0) {
    const State a = rate(s, tau), b = rate(moved(s, a, 0.5 * k_step), tau);
    const State c = rate(moved(s, b, 0.5 * k_step), tau), d = rate(moved(s, c, k_step), tau);
    for (std::size_t n = 0; n < s.size(); ++n) {
      s[n] += k_step / 6.0 * (a[n] + 2.0 * b[n] + 2.0 * c[n] + d[n]);
    }
    if (s[0] * s[0] + s[1] * s[1] < 1.0) return true;
  }
  return false;
}

double share_that_hits(double stokes) {
  const double tau = 2.0 * stokes;  // St counts in diameters
  double low = 0.0, high = 1.05;
  for (int n = 0; n < 14; ++n) {
    const double middle = 0.5 * (low + high);
    (hits(middle, tau) ? low : high) = middle;
  }
  return low * low;
}

}  // namespace

TEST_CASE("as much shall hit a sphere as paths in potential flow end on it") {
  for (const double stokes : {0.25, 0.5, 1.0, 2.5, 5.0}) {
    CAPTURE(stokes);
    CHECK(std::abs(impaction_efficiency(stokes) - share_that_hits(stokes)) < 0.02);
  }
  // With twice the Stokes number, as of radii, it would be wrong by 0.1 and more.
  CHECK(std::abs(impaction_efficiency(2.0 * 0.5) - share_that_hits(0.5)) > 0.1);
  CHECK(impaction_efficiency(1.0 / 25.0) == 0.0);
  CHECK(share_that_hits(1.0 / 25.0) < 1e-4);
}

TEST_CASE("a sphere shall clear the gas in its way of the share that hits it") {
  const DustClass sand = make_class(40e-6, 2650, {0, 0, -9.81}, {1.2, 1.8e-5});
  // tau = 2650 (40 um)^2 1.004 / (18 * 18 uPa s) = 13.14 ms; St = 26.3 at 4 m/s and 2 mm.
  CHECK(sand.response_time == approx(13.14e-3).epsilon(1e-3));
  CHECK(cleared_flow(sand, 2e-3, 4.0) ==
        approx(4.0 * std::numbers::pi / 4.0 * 4e-6 * std::pow(26.28 / 26.53, 2)).epsilon(1e-3));
  CHECK(cleared_flow(sand, 2e-3, 0.0) == 0.0);
}
