// SPDX-License-Identifier: Apache-2.0
// What of the declared restitution an impact realises at the default step, wherever in a step it
// begins.
#include "support/dem_rig.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

using dust::particles::NewGrain;
using namespace dust::test;

namespace {

constexpr double k_radius = 1e-3;  // [m]
constexpr double k_speed = 0.5;    // [m/s] of each of two equal grains, half of what is expected
constexpr int k_phases = 40;       // of a step, at which touch begins

/// Head-on impact of two grains that are `gap` x speed x step from where they touch.
double realised(const DemRig::Choice& law, double gap) {
  DemRig rig;
  const int m = rig.material(2650, 50e6, 0.3);
  rig.laws_of(m, m, law);
  rig.diameters = {2 * k_radius};
  rig.setup.time.expected_speed = 2 * k_speed;
  const auto dem = rig.make();
  const double place = k_radius + gap * k_speed * dem->coarse_step();
  dem->insert(std::vector<NewGrain>{
      {.position = {place, 0, 0}, .velocity = {-k_speed, 0, 0}, .diameter = 2 * k_radius},
      {.position = {-place, 0, 0}, .velocity = {k_speed, 0, 0}, .diameter = 2 * k_radius}});
  Stepper stepper(*dem);
  stepper.step(60);
  return grain(*dem, 0).velocity.x / k_speed;
}

/// Of the declared one, over all phases.
struct Error {
  double mean = 0.0;
  double worst = 0.0;
};
Error error_of(const std::string& law, std::map<std::string, dust::sdk::Value> values, double e) {
  values["restitution"] = e;
  values["friction"] = 0.0;
  Error out;
  for (int n = 0; n < k_phases; ++n) {
    const double error = realised({law, values}, 1.0 + n / double{k_phases}) - e;
    out.mean += error / k_phases;
    out.worst = std::max(out.worst, std::abs(error));
  }
  return out;
}

}  // namespace

TEST_CASE("impacts shall realise the declared restitution at the default step") {
  // The dampers begin and end with a jump somewhere in a step: a look of fifteen counts for more
  // or less than it should. The bounds are those of docs/theory/grains.md, "The time step".
  for (const double e : {0.1, 0.2, 0.3, 0.5, 0.7, 0.9}) {
    CAPTURE(e);
    const Error hertz = error_of("hertz_mindlin", {}, e);
    CHECK(std::abs(hertz.mean) < 0.01);
    CHECK(hertz.worst < 0.02);
    const Error hooke = error_of("hooke", {{"normal_stiffness", 2e4}}, e);
    CHECK(std::abs(hooke.mean) < 0.012);
    CHECK(hooke.worst < 0.035);
  }
  // Without dampers a second-order scheme is left.
  CHECK(error_of("hertz_mindlin", {}, 1.0).worst < 0.001);
  CHECK(error_of("hooke", {{"normal_stiffness", 2e4}}, 1.0).worst < 0.001);
}
