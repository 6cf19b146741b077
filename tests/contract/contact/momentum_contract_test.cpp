// SPDX-License-Identifier: Apache-2.0
// Two grains that meet obliquely under any of the laws keep their momentum, linear and angular.
#include "contract/contact/laws.hpp"
#include "support/dem_rig.hpp"

namespace {

using namespace dust;
using particles::NewGrain;
using sdk::Vec3;
using test::DemRig;
using test::GrainState;

std::vector<NewGrain> pair() {
  return {{.position = {-2.1e-4, 3e-5, 1e-5},
           .velocity = {0.5, 0.1, -0.2},
           .rotation = {30, -400, 90},
           .diameter = 400e-6},
          {.position = {3.1e-4, -9e-5, 2e-5},
           .velocity = {-0.6, 0.0, 0.1},
           .rotation = {-50, 10, 700},
           .diameter = 600e-6}};
}

struct Momentum {
  Vec3 linear, angular;
  double linear_scale = 0.0, angular_scale = 0.0;
};
Momentum momentum(const std::vector<GrainState>& grains) {
  Momentum m;
  for (const GrainState& g : grains) {
    const double inertia = 0.4 * g.mass * g.radius * g.radius;
    m.linear += g.mass * g.velocity;
    m.angular += g.mass * cross(g.position, g.velocity) + inertia * g.rotation;
    m.linear_scale += g.mass * norm(g.velocity);
    m.angular_scale += g.mass * norm(g.position) * norm(g.velocity) + inertia * norm(g.rotation);
  }
  return m;
}

void check_pair(const DemRig::Choice& contact, const DemRig::Choice& rolling,
                const DemRig::Choice& cohesion) {
  constexpr double k_rounding = 1e-12;
  DemRig rig;
  const int sand = rig.material(2650, 50e6, 0.3);
  rig.laws_of(sand, sand, contact, rolling, cohesion);
  rig.diameters = {600e-6};
  rig.setup.time.dem_step = 5e-7;
  auto dem = rig.make();
  dem->insert(pair());
  test::Stepper stepper(*dem);
  const auto now = [&] { return std::vector{test::grain(*dem, 0), test::grain(*dem, 1)}; };
  const Momentum before = momentum(now());
  const Vec3 first = now()[0].velocity;
  stepper.step(800);
  REQUIRE(dem->report().largest_overlap > 1e-4);
  CHECK(norm(now()[0].velocity - first) > 0.1);
  // In a contact that lasts, velocities are those predicted to the positions' instant: both grains'
  // predictions are of the same force, so that the sum still holds.
  const Momentum after = momentum(now());
  CHECK(norm(after.linear - before.linear) < k_rounding * before.linear_scale);
  if (dem->report().contacts == 0) {
    CHECK(norm(after.angular - before.angular) < k_rounding * before.angular_scale);
  }
}

DemRig::Choice choice(const test::Law& law) { return {law.offer.info.name, law.values}; }

TEST_CASE("every law of a contact shall keep the momentum of two grains that meet") {
  const DemRig::Choice hertz{"hertz_mindlin", {{"restitution", 0.7}, {"friction", 0.4}}};
  for (const auto& law : test::all_laws("contact")) {
    CAPTURE(law.offer.info.name);
    check_pair(choice(law), {}, {});
  }
  for (const auto& law : test::all_laws("rolling")) {
    CAPTURE(law.offer.info.name);
    check_pair(hertz, choice(law), {});
  }
  for (const auto& law : test::all_laws("cohesion")) {
    CAPTURE(law.offer.info.name);
    check_pair(hertz, {"epsd2", {{"friction", 0.2}}}, choice(law));
  }
}

}  // namespace
