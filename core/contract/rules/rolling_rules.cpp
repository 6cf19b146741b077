// SPDX-License-Identifier: Apache-2.0
// Rules of rolling laws: a couple against relative rotation, the same from both sides.
#include "contract/rule_runner.hpp"
#include "contract/rules/symmetry_rules.hpp"
#include "contract/scenes/contact_bench.hpp"
#include "dust/sdk/sphere.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

namespace dust::contract {
namespace {

using sdk::Vec3;

/// Short against every time of the standard contacts.
constexpr double k_step = 1e-7;

std::unique_ptr<sdk::RollingLaw> make_law(const Maker& make, const Units& units = {},
                                          bool is_swapped = false) {
  auto law = make_as<sdk::RollingLaw>(make, units);
  law->prepare(material(is_swapped, units), material(!is_swapped, units));
  require_history(law->history_size());
  require(law->couple_column() + 3 <= law->history_size() || law->couple_column() < 0,
          "its couple would stand in columns " + std::to_string(law->couple_column()) +
              " and the next two of " + std::to_string(law->history_size()));
  return law;
}

Observations observe(const Maker& make, const TestVariant& variant) {
  const auto law = make_law(make, variant.units);
  ContactBench bench(standard_contacts(0.0, 0).size(), law->history_size());
  Observations observations;
  for (int look = 0; look < 3; ++look) {
    bench.show(standard_contacts(0.0, look), k_step, variant.units, true);
    bench.evaluate(
        [&](const sdk::ContactBatch& batch) { call_hot(variant, [&] { law->evaluate(batch); }); },
        variant.batch);
    for (std::size_t n = 0; n < bench.count(); ++n) {
      const std::string row = " of contact " + std::to_string(n);
      for (int d = 0; d < 3; ++d) {
        observations.push_back({std::string("torque_") + "xyz"[d] + row,
                                bench.output(ContactBench::torque + d, n), sdk::dimension::energy});
      }
      for (int h = 0; h < law->history_size(); ++h) {
        observations.push_back(
            {"history_" + std::to_string(h) + row, bench.history(h, n), {}, false});
      }
    }
  }
  return observations;
}

std::vector<Vec3> couples(const Maker& make, bool is_swapped,
                          const std::function<std::vector<Touch>(std::vector<Touch>)>& change) {
  const auto law = make_law(make, {}, is_swapped);
  ContactBench bench(standard_contacts(0.0, 0).size(), law->history_size());
  for (int look = 0; look < 3; ++look) {
    bench.show(change(standard_contacts(0.0, look)), k_step, {}, true);
    bench.evaluate([&](const sdk::ContactBatch& batch) { law->evaluate(batch); }, 0);
  }
  std::vector<Vec3> result;
  for (std::size_t n = 0; n < bench.count(); ++n) {
    result.push_back(bench.vector(ContactBench::torque, n));
  }
  return result;
}

void check_brakes(const Maker& make) {
  const auto law = make_law(make);
  const std::vector<Touch> contacts = standard_contacts(0.0, 0);
  ContactBench bench(contacts.size(), law->history_size());
  bench.show(contacts, k_step, {}, true);
  bench.evaluate([&](const sdk::ContactBatch& batch) { law->evaluate(batch); }, 0);
  for (std::size_t n = 0; n < contacts.size(); ++n) {
    const Vec3 torque = bench.vector(ContactBench::torque, n);
    require(dot(torque, contacts[n].angular_velocity) <=
                1e-12 * norm(torque) * norm(contacts[n].angular_velocity),
            "contact " + std::to_string(n) + " is driven when it begins, not braked: " +
                shown(dot(torque, contacts[n].angular_velocity)) +
                " W on its rotation; expected: 0 or below");
  }
}

void check_rest(const Maker& make) {
  const auto law = make_law(make);
  std::vector<Touch> contacts = standard_contacts(0.0, 0);
  for (Touch& t : contacts) {
    t.angular_velocity = {};
    t.share_i = 0.5;  // the force turns unequal sides unequally, which a law may reckon with
  }
  ContactBench bench(contacts.size(), law->history_size());
  for (int look = 0; look < 3; ++look) {
    bench.show(contacts, k_step, {}, true);
    bench.evaluate([&](const sdk::ContactBatch& batch) { law->evaluate(batch); }, 0);
  }
  for (std::size_t n = 0; n < contacts.size(); ++n) {
    const double couple = norm(bench.vector(ContactBench::torque, n));
    require(couple == 0.0, "contact " + std::to_string(n) + " feels a couple of " + shown(couple) +
                               " N m without any rotation; expected: 0");
  }
}

void check_energy(const Maker& make) {
  const auto law = make_law(make);
  constexpr double k_radius = 5e-4;
  const double mass = 2500.0 * sdk::sphere_volume(2.0 * k_radius);
  const double inertia = sdk::sphere_inertia(mass, k_radius);
  ContactBench bench(1, law->history_size());
  constexpr double k_start = 100.0;
  Vec3 rotation{0.0, k_start, 0.0};
  for (int n = 0; n < 20000; ++n) {
    Touch t;
    t.overlap = 1e-6;
    t.normal = {0.0, 0.0, 1.0};
    t.angular_velocity = rotation;
    t.radius = k_radius;
    t.mass = mass;
    t.normal_force = 10.0 * mass * 9.81;
    t.stiffness = 100.0;
    bench.show({t}, k_step, {}, true);
    bench.evaluate([&](const sdk::ContactBatch& batch) { law->evaluate(batch); }, 0);
    rotation += k_step / inertia * bench.vector(ContactBench::torque, 0);
    require(norm(rotation) <= k_start * (1.0 + 1e-3),
            "a rolling grain gets faster: " + shown(norm(rotation) / k_start) + " of its start");
  }
}

/// A grain on a pressed contact that rocks on the law's spring about it, stepped as the core does.
class Rocking {
 public:
  explicit Rocking(const Maker& make) : law_(make_law(make)), bench_(1, law_->history_size()) {}

  /// Couple [N m] after another step of `angle` [rad] at `rotation` [rad/s].
  double couple(double angle, double rotation, double step) {
    Touch t;
    t.overlap = 1e-6;
    t.normal = {0.0, 0.0, 1.0};
    t.angular_velocity = {0.0, rotation, 0.0};
    t.angle = Vec3{0.0, angle, 0.0};
    t.radius = k_radius;
    t.mass = mass();
    t.normal_force = 10.0 * mass() * 9.81;
    t.stiffness = 100.0;
    bench_.show({t}, step, {}, true);
    bench_.evaluate([&](const sdk::ContactBatch& batch) { law_->evaluate(batch); }, 0);
    return bench_.vector(ContactBench::torque, 0).y;
  }
  /// Energy of the rotation after a swing there and back, as a share, in `steps` steps.
  double swing(double duration, int steps) {
    const double step = duration / steps;
    double rotation = k_slow;  // half a step behind
    double now = rotation;
    for (int n = 0; n < steps; ++n) {
      const double kick = step / inertia() * couple(step * rotation, now, step);
      rotation += kick;
      now = rotation + 0.5 * kick;
    }
    return now * now / (k_slow * k_slow);
  }
  static double mass() { return 2500.0 * sdk::sphere_volume(2.0 * k_radius); }
  static double inertia() { return sdk::sphere_inertia(mass(), k_radius); }

 private:
  static constexpr double k_radius = 5e-4;
  static constexpr double k_slow = 1e-3;  ///< [rad/s] far from any limit of the couple
  std::unique_ptr<sdk::RollingLaw> law_;
  ContactBench bench_;
};

/// A spring that moves by angular velocity times time step is damped by the step, to first order.
void check_step(const Maker& make) {
  // What is left of a turn when it is over.
  constexpr double k_turning = 1e-3;
  Rocking probe(make);
  probe.couple(k_step * k_turning, k_turning, k_step);
  const double stiffness = -probe.couple(0.0, 0.0, k_step) / (k_step * k_turning);
  if (!(stiffness > 0.0)) return;  // no spring
  const double period = 2.0 * std::numbers::pi * std::sqrt(Rocking::inertia() / stiffness);
  // 15 steps for half a swing, as the core makes at least; the leapfrog's own error is a fortieth.
  constexpr double k_energy = 0.05;
  const double coarse = Rocking(make).swing(period, 30);
  const double fine = Rocking(make).swing(period, 3000);
  require(std::abs(coarse - fine) <= k_energy,
          "a grain that rocks keeps " + shown(coarse) + " of its energy in 30 steps, " +
              shown(fine) +
              " in many: move springs by angle, not by angular velocity times time step");
}

void rules(const Maker& make, const ModelUnderTest&, RuleRunner& runner) {
  check_symmetry(runner, "couple", [&](bool is_swapped, const auto& change) {
    return couples(make, is_swapped, change);
  });
  runner.rule("brakes a rotation that begins", [&] { check_brakes(make); });
  runner.rule("leaves what does not rotate alone", [&] { check_rest(make); });
  runner.rule("creates no energy", [&] { check_energy(make); });
  runner.rule("keeps what its spring holds, to second order in the step",
              [&] { check_step(make); });
}

}  // namespace

Kind rolling_kind() {
  return {.observe = observe,
          .batches = {8, 24},
          .other_units = {4.0, 2.0, 0.5},
          .is_hot = true,
          .rules = rules};
}

}  // namespace dust::contract
