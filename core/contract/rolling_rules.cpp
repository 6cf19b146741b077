// SPDX-License-Identifier: Apache-2.0
// Rules of rolling laws: a couple against relative rotation, the same from both sides.
#include "contract/contact_bench.hpp"
#include "contract/judge.hpp"
#include "contract/symmetry_rules.hpp"
#include "dust/sdk/sphere.hpp"

#include <algorithm>
#include <cmath>

namespace dust::contract {
namespace {

using sdk::Vec3;

/// Short against every time of the standard contacts.
constexpr double k_step = 1e-7;

std::unique_ptr<sdk::RollingLaw> make_law(const Maker& make, const Units& units = {},
                                          bool is_swapped = false) {
  auto law = make_as<sdk::RollingLaw>(make, units);
  law->prepare(material(is_swapped, units), material(!is_swapped, units));
  require(law->history_size() >= 0 && law->history_size() <= 12,
          "it asks for " + std::to_string(law->history_size()) + " history columns");
  return law;
}

Readings observe(const Maker& make, const Trial& trial) {
  const auto law = make_law(make, trial.units);
  ContactBench bench(standard_touches(0.0, 0).size(), law->history_size());
  Readings readings;
  for (int look = 0; look < 3; ++look) {
    bench.show(standard_touches(0.0, look), k_step, trial.units, true);
    bench.evaluate(
        [&](const sdk::ContactBatch& batch) { call_hot(trial, [&] { law->evaluate(batch); }); },
        trial.batch);
    for (std::size_t n = 0; n < bench.count(); ++n) {
      const std::string row = " of contact " + std::to_string(n);
      for (int d = 0; d < 3; ++d) {
        readings.push_back({std::string("torque_") + "xyz"[d] + row,
                            bench.output(ContactBench::torque + d, n), sdk::dimension::energy});
      }
      for (int h = 0; h < law->history_size(); ++h) {
        readings.push_back({"history_" + std::to_string(h) + row, bench.history(h, n), {}, false});
      }
    }
  }
  return readings;
}

std::vector<Vec3> couples(const Maker& make, bool is_swapped,
                          const std::function<std::vector<Touch>(std::vector<Touch>)>& change) {
  const auto law = make_law(make, {}, is_swapped);
  ContactBench bench(standard_touches(0.0, 0).size(), law->history_size());
  for (int look = 0; look < 3; ++look) {
    bench.show(change(standard_touches(0.0, look)), k_step, {}, true);
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
  const std::vector<Touch> touches = standard_touches(0.0, 0);
  ContactBench bench(touches.size(), law->history_size());
  bench.show(touches, k_step, {}, true);
  bench.evaluate([&](const sdk::ContactBatch& batch) { law->evaluate(batch); }, 0);
  for (std::size_t n = 0; n < touches.size(); ++n) {
    const Vec3 torque = bench.vector(ContactBench::torque, n);
    require(dot(torque, touches[n].rotation) <= 1e-12 * norm(torque) * norm(touches[n].rotation),
            "a contact that begins is driven, not braked");
  }
}

void check_rest(const Maker& make) {
  const auto law = make_law(make);
  std::vector<Touch> touches = standard_touches(0.0, 0);
  for (Touch& t : touches) t.rotation = {};
  ContactBench bench(touches.size(), law->history_size());
  for (int look = 0; look < 3; ++look) {
    bench.show(touches, k_step, {}, true);
    bench.evaluate([&](const sdk::ContactBatch& batch) { law->evaluate(batch); }, 0);
  }
  for (std::size_t n = 0; n < touches.size(); ++n) {
    require(norm(bench.vector(ContactBench::torque, n)) == 0.0,
            "contact " + std::to_string(n) + " feels a couple without any rotation");
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
    t.rotation = rotation;
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

void rules(const Maker& make, const Subject&, Judge& judge) {
  judge_symmetry(judge, "couple", [&](bool is_swapped, const auto& change) {
    return couples(make, is_swapped, change);
  });
  judge.rule("brakes a rotation that begins", [&] { check_brakes(make); });
  judge.rule("leaves what does not rotate alone", [&] { check_rest(make); });
  judge.rule("creates no energy", [&] { check_energy(make); });
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
