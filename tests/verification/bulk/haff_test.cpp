// SPDX-License-Identifier: Apache-2.0
#include "support/approx.hpp"
#include "verification/bulk/bulk_run.hpp"

#include <numbers>

using dust::test::approx;

// Haff, J. Fluid Mech. 134 (1983) 401; rate of cooling with the contact value of Carnahan and
// Starling for spheres. Clustering begins later than this run ends.
TEST_CASE("a gas of grains shall cool as Haff says") {
  const dust::test::BulkRun run("haff");
  const auto time = run.column("time [s]");
  const auto temperature = run.column("energy/granular_temperature [m2/s2]");
  const double d = 1e-3;
  const double e = 0.9;
  const double n = run.summary["particles"]["emitted"].get<double>() / std::pow(27.8e-3, 3);
  const double phi = n * std::numbers::pi / 6 * d * d * d;
  CHECK(phi == approx(0.1).epsilon(0.01));
  const double g0 = (1 - phi / 2) / std::pow(1 - phi, 3);
  // From the second sample on: the first was taken before the first step.
  double sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0, count = 0;
  const double t0 = time[1];
  const double first = temperature[1];
  REQUIRE(first > 0.0);
  for (std::size_t k = 1; k < time.size(); ++k) {
    const double x = time[k] - t0;
    const double y = std::sqrt(first / temperature[k]);
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
    syy += y * y;
    count += 1;
  }
  const double covariance = sxy - sx * sy / count;
  const double slope = covariance / (sxx - sx * sx / count);
  const double r2 = slope * covariance / (syy - sy * sy / count);
  const double expected =
      (1 - e * e) * 2 * std::sqrt(std::numbers::pi) / 3 * n * d * d * g0 * std::sqrt(first);
  CAPTURE(slope);
  CAPTURE(expected);
  CHECK(temperature.back() < 0.2 * first);  // it has cooled indeed
  CHECK(r2 > 0.999);
  // 10 %: the theory is for a Maxwellian gas of many more grains than 4096.
  CHECK(slope == approx(expected).epsilon(0.1));
}
