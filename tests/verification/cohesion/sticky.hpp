// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contract/contact/laws.hpp"
#include "support/dem_rig.hpp"

#include <cmath>
#include <numbers>

namespace dust::test {

inline constexpr double k_pi = std::numbers::pi;

/// Sand of 0.6 mm on a wall of the same material.
struct Sticky {
  static constexpr double radius = 3e-4;
  static constexpr double density = 2650.0;
  static constexpr double young = 50e6 / (1.0 - 0.09) / 2.0;  ///< [Pa] E*
  static double mass() { return density * 4.0 / 3.0 * k_pi * radius * radius * radius; }

  DemRig rig;
  int sand = 0;
  Sticky(const DemRig::Choice& cohesion, double restitution, double friction) {
    sand = rig.material(density, 50e6, 0.3);
    rig.laws_of(sand, sand,
                {"hertz_mindlin", {{"restitution", restitution}, {"friction", friction}}}, {},
                cohesion);
    rig.diameters = {2 * radius};
  }
  void floor() {
    rig.setup.domain.min.z = 0.0;
    rig.wall(4, sand);
  }
};

inline double hertz(double overlap, double radius, double young) {
  return overlap > 0.0 ? 4.0 / 3.0 * young * std::sqrt(radius * overlap) * overlap : 0.0;
}

/// Force [N] of a pair that has touched, at rest, pushed together or pulled apart to `overlap`.
inline double force_at(const sdk::CohesionLaw& law, double radius, double young, double overlap) {
  LawBench bench({{.overlap = 0.0,
                   .radius = radius,
                   .mass = 1.0,
                   .normal = {0, 0, 1},
                   .velocity = {},
                   .rotation = {}}});
  bench.cohesion(law);
  bench.rows()[0].overlap = overlap;
  bench.cohesion(law);
  const Answer a = bench.answers()[0];
  return hertz(a.contact_overlap, radius, young) - a.attraction;
}

}  // namespace dust::test
