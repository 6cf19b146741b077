// SPDX-License-Identifier: Apache-2.0
#include "liberation/energy/energy.hpp"
#include "liberation/force_ratio/force_ratio.hpp"
#include "liberation/given/given.hpp"
#include "liberation/moisture.hpp"
#include "liberation/shear/shear.hpp"
#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace energy = dust::model::energy;
namespace force_ratio = dust::model::force_ratio;
namespace given = dust::model::given;
namespace shear = dust::model::shear;
using dust::model::binding_by_moisture;
using dust::test::approx;

TEST_CASE("energy shall give E / e_b while that is little, all in the end, and add up") {
  // 1 mJ at 1 MJ/kg is 1 ug, beside 1 g.
  CHECK(energy::released(1e-3, 1e-3, 1e-3, 1e6) == approx(1e-9).epsilon(1e-5));
  CHECK(energy::released(1e-3, 1e-3, 1e9, 1e3) == approx(1e-3));
  CHECK(energy::released(1e-3, 1e-3, 1.0, 1e3) == approx(1e-3 * 0.632120558828558).epsilon(1e-12));
  const double first = energy::released(1e-3, 1e-3, 0.5, 1e3);
  const double second = energy::released(1e-3 - first, 1e-3, 0.5, 1e3);
  CHECK(first + second == approx(energy::released(1e-3, 1e-3, 1.0, 1e3)).epsilon(1e-12));
  CHECK(energy::released(0.0, 1e-3, 1.0, 1e3) == 0.0);
  // 8 times the diameter: 2^-5.
  CHECK(energy::binding_of(80e-6, 3e6, 10e-6, 5.0 / 3.0) == approx(3e6 / 32.0).epsilon(1e-12));
}

TEST_CASE("moisture shall bind by a decade per scale, or as AP-42 has it") {
  CHECK(binding_by_moisture(0.05, 0.02, 0.03) == approx(10.0).epsilon(1e-12));
  CHECK(binding_by_moisture(0.02, 0.01, 0.0) == approx(std::pow(2.0, 1.4)).epsilon(1e-12));
  // Below 0.25 % nothing was measured.
  CHECK(binding_by_moisture(0.0, 0.01, 0.0) == binding_by_moisture(0.0025, 0.01, 0.0));
}

TEST_CASE("given shall set free what the measured drop did") {
  // A tonne that drops 2 m as measured: 3.6 g, shared by the classes.
  const double drop = 9.81 * 2.0;
  CHECK(given::released(1.0, 0.25, 3.6e-6, 1000.0 * drop, drop) == approx(0.9e-3).epsilon(1e-12));
  CHECK(given::released(1e-6, 1.0, 3.6e-6, 1000.0 * drop, drop) == 1e-6);
}

TEST_CASE("a ratio of forces shall set free what is bound more weakly, once") {
  // 10 um of 2650 kg/m3: 1.3875 ng; at 1e4 m/s2 13.875 nN.
  CHECK(force_ratio::ratio(10e-6, 2650.0, 1e4, 13.8754e-9) == approx(1.0).epsilon(1e-4));
  CHECK(force_ratio::share_below(1.0, 3.0) == approx(0.5).epsilon(1e-15));
  CHECK(force_ratio::share_below(3.0, 3.0) == approx(0.841344746).epsilon(1e-8));
  CHECK(force_ratio::share_below(1.0 / 9.0, 3.0) == approx(0.022750132).epsilon(1e-7));
  CHECK(force_ratio::share_below(0.0, 3.0) == 0.0);
  const double first = force_ratio::released(2e-6, 2e-6, 0.5);
  CHECK(first == approx(1e-6));
  CHECK(force_ratio::released(2e-6 - first, 2e-6, 0.5) == 0.0);
  CHECK(force_ratio::released(2e-6 - first, 2e-6, 0.84) == approx(0.68e-6).epsilon(1e-9));
}

TEST_CASE("wind shall take dust off above the threshold of Shao and Lu") {
  // sqrt(0.0123 (2650/1.227 9.81 d + 3e-4/(1.227 d))).
  CHECK(shear::threshold(10e-6, 2650.0, 1.227, 3e-4, 9.81) ==
        approx(std::sqrt(0.0123 * (0.211871 + 24.44988))).epsilon(1e-5));
  // The smallest threshold is where the two terms are alike: 106 um for these.
  const auto of = [](double d) { return shear::threshold(d, 2650.0, 1.227, 3e-4, 9.81); };
  const double best = std::sqrt(3e-4 / (2650.0 * 9.81));
  CHECK(best == approx(107.4e-6).epsilon(1e-3));
  CHECK(of(best) < of(0.9 * best));
  CHECK(of(best) < of(1.1 * best));
  CHECK(shear::raised_by_moisture(0.004, 0.005) == 1.0);
  CHECK(shear::raised_by_moisture(0.015, 0.005) == approx(std::sqrt(2.21)).epsilon(1e-12));
  CHECK(shear::flux(0.3, 0.3, 1.2, 1e-5, 9.81) == 0.0);
  CHECK(shear::flux(0.6, 0.3, 1.2, 1e-5, 9.81) ==
        approx(1e-5 * 1.2 / 9.81 * 0.216 * 0.75).epsilon(1e-12));
  CHECK(shear::released(1e-6, 2e-6, 1e-12) == approx(0.5e-12).epsilon(1e-5));
  CHECK(shear::released(1e-6, 2e-6, 1.0) == approx(1e-6));
}
