// SPDX-License-Identifier: Apache-2.0
// Rules of contact laws: symmetry of the two sides, no preferred direction, and single collisions
// integrated with a small step.
#include "contract/rule_runner.hpp"
#include "contract/rules/symmetry_rules.hpp"
#include "contract/scenes/contact_bench.hpp"
#include "dust/sdk/sphere.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace dust::contract {
namespace {

/// Of collision_time: a law that tells it ten times too short is not one whose grains stick.
constexpr int k_longest = 100;

using sdk::Vec3;

std::unique_ptr<sdk::ContactLaw> make_law(const Maker& make, const Units& units = {},
                                          bool is_swapped = false) {
  auto law = make_as<sdk::ContactLaw>(make, units);
  law->prepare(material(is_swapped, units), material(!is_swapped, units));
  require_history(law->history_size());
  return law;
}

/// A step [s] that resolves the stiffest of the standard contacts.
double small_step(const sdk::ContactLaw& law, const Units& units) {
  double step = std::numeric_limits<double>::infinity();
  for (const Touch& t : standard_contacts(0.0, 0)) {
    step = std::min(step, law.half_period(t.radius * units.length, t.mass * units.mass,
                                          t.overlap * units.length));
  }
  require(step > 0.0 && std::isfinite(step),
          "half_period is " + shown(step) + " s; expected: a finite time above 0");
  return step / units.time / 50.0;
}

Observations observe(const Maker& make, const TestVariant& variant) {
  const auto law = make_law(make, variant.units);
  const double step = small_step(*law, variant.units);
  ContactBench bench(standard_contacts(0.0, 0).size(), law->history_size());
  Observations observations;
  const auto add = [&](const std::string& name, double value, sdk::Dimension dimension,
                       bool has_dimension = true) {
    observations.push_back({name, value, dimension, has_dimension});
  };
  for (int look = 0; look < 3; ++look) {
    bench.show(standard_contacts(law->range() / variant.units.length, look), step, variant.units,
               false);
    bench.evaluate(
        [&](const sdk::ContactBatch& batch) { call_hot(variant, [&] { law->evaluate(batch); }); },
        variant.batch);
    for (std::size_t n = 0; n < bench.count(); ++n) {
      const std::string row = " of contact " + std::to_string(n);
      add("normal_force" + row, bench.output(ContactBench::normal_force, n), sdk::dimension::force);
      add("normal_stiffness" + row, bench.output(ContactBench::normal_stiffness, n),
          sdk::dimension::stiffness);
      add("tangential_stiffness" + row, bench.output(ContactBench::tangential_stiffness, n),
          sdk::dimension::stiffness);
      for (int d = 0; d < 3; ++d) {
        add(std::string("force_") + "xyz"[d] + row, bench.output(ContactBench::force + d, n),
            sdk::dimension::force);
      }
      for (int h = 0; h < law->history_size(); ++h) {
        add("history_" + std::to_string(h) + row, bench.history(h, n), {}, false);
      }
    }
  }
  for (const Touch& t : standard_contacts(0.0, 0)) {
    const double radius = t.radius * variant.units.length;
    const double mass = t.mass * variant.units.mass;
    add("half_period", law->half_period(radius, mass, t.overlap * variant.units.length),
        sdk::dimension::time);
    add("collision_time",
        law->collision_time(radius, mass, 0.5 * variant.units.of(sdk::dimension::velocity)),
        sdk::dimension::time);
  }
  return observations;
}

/// Forces of the standard contacts after a few looks, changed by `change`.
std::vector<Vec3> forces(const Maker& make, bool is_swapped,
                         const std::function<std::vector<Touch>(std::vector<Touch>)>& change) {
  const auto law = make_law(make, {}, is_swapped);
  ContactBench bench(standard_contacts(0.0, 0).size(), law->history_size());
  const double step = small_step(*law, {});
  for (int look = 0; look < 3; ++look) {
    bench.show(change(standard_contacts(law->range(), look)), step, {}, false);
    bench.evaluate([&](const sdk::ContactBatch& batch) { law->evaluate(batch); }, 0);
  }
  std::vector<Vec3> result;
  for (std::size_t n = 0; n < bench.count(); ++n) {
    result.push_back(bench.vector(ContactBench::force, n));
  }
  return result;
}

/// A sphere that meets a wall at x = 0.
struct Impact {
  double normal_speed = 0.0;             ///< [m/s] after, > 0 away from the wall
  double duration = 0.0;                 ///< [s]
  double energy_ratio = 0.0;             ///< after over before, rotation included
  double tangential_ratio = 0.0;         ///< of the energy along the wall, rotation included
  double patch_ratio = 0.0;              ///< speed of the contact point along the wall
  double largest_overlap = 0.0;          ///< [m]
  double largest_slip_over_limit = 0.0;  ///< max |F_t| / (mu max(F_n, 0)), if mu is given
  bool has_ended = false;
};

constexpr int k_small_steps = 4000;

/// Integrated as the core does, in steps of collision_time / `steps`: the leapfrog, forces from
/// velocities predicted for the time of the places, springs told the way of the last step, or of
/// the part of it in touch. The wall is first touched after the share `start` of a step.
Impact run_impact(const sdk::ContactLaw& law, double speed, double tangential, double friction,
                  int steps = k_small_steps, double start = 0.5) {
  constexpr double k_radius = 5e-4;
  const double mass = 2500.0 * sdk::sphere_volume(2.0 * k_radius);
  const double inertia = sdk::sphere_inertia(mass, k_radius);
  const double step = law.collision_time(k_radius, mass, speed) / steps;
  require(step > 0.0 && std::isfinite(step),
          "collision_time is " + shown(step * steps) + " s; expected: a finite time above 0");
  ContactBench bench(1, law.history_size());
  Vec3 velocity{-speed, tangential, 0.0};  // half a step behind the overlap
  double rotation = 0.0;                   // about z, as well
  Vec3 velocity_now = velocity;
  double rotation_now = rotation;
  const double before = 0.5 * mass * dot(velocity, velocity);
  double overlap = -start * step * speed;
  Impact result;
  int n = 0;
  for (; n < k_longest * steps; ++n) {
    overlap -= step * velocity.x;
    if (overlap < -law.range() && n > 0) break;
    result.largest_overlap = std::max(result.largest_overlap, overlap);
    Touch t;
    t.overlap = overlap;
    t.normal = {1.0, 0.0, 0.0};
    // The contact point lies at -R x: it moves with v + w x r.
    t.velocity = velocity_now + Vec3{0.0, -rotation_now * k_radius, 0.0};
    t.angular_velocity = {0.0, 0.0, rotation_now};
    const double touched =
        velocity.x < 0.0 ? std::clamp(overlap / (-step * velocity.x), 0.0, 1.0) : 1.0;
    t.displacement = touched * step * (velocity + Vec3{0.0, -rotation * k_radius, 0.0});
    t.angle = touched * step * Vec3{0.0, 0.0, rotation};
    t.radius = k_radius;
    t.mass = mass;
    bench.show({t}, step, {}, false);
    bench.evaluate([&](const sdk::ContactBatch& batch) { law.evaluate(batch); }, 0);
    const Vec3 force = bench.vector(ContactBench::force, 0);
    const double normal = bench.output(ContactBench::normal_force, 0);
    const double sliding = std::hypot(force.y, force.z);
    const double limit = friction * std::max(normal, 0.0);
    const double rounding = 1e-12 * std::abs(normal);
    if (friction >= 0.0 && sliding > rounding) {
      result.largest_slip_over_limit =
          std::max(result.largest_slip_over_limit, (sliding - rounding) / std::max(limit, 1e-300));
    }
    const Vec3 kick = step / mass * force;
    const double spin = step / inertia * -k_radius * force.y;
    velocity += kick;
    rotation += spin;
    velocity_now = velocity + 0.5 * kick;
    rotation_now = rotation + 0.5 * spin;
  }
  result.has_ended = n < k_longest * steps;
  result.normal_speed = velocity.x;
  result.duration = n * step;
  const double along = mass * velocity.y * velocity.y + inertia * rotation * rotation;
  result.tangential_ratio = along / (mass * tangential * tangential);
  result.patch_ratio = (velocity.y - k_radius * rotation) / tangential;
  result.energy_ratio = (0.5 * mass * velocity.x * velocity.x + 0.5 * along) / before;
  return result;
}

void check_restitution(const Maker& make, const ModelUnderTest& model_under_test) {
  // A four thousandth of the collision per step; laws whose damping is fitted rather than exact
  // are known to be off by up to a hundredth.
  constexpr double k_realised = 0.01;
  const double* declared = model_under_test.number("restitution");
  const auto law = make_law(make);
  for (const double speed : {0.1, 1.0}) {
    const Impact impact = run_impact(*law, speed, 0.0, -1.0);
    if (!impact.has_ended) throw Remark("the grains stick at " + shown(speed) + " m/s");
    const double realised = impact.normal_speed / speed;
    require(realised <= 1.0 + 1e-3, "a collision at " + shown(speed) + " m/s comes back " +
                                        shown(realised) + " times as fast");
    if (declared == nullptr) continue;
    require(std::abs(realised - *declared) <= k_realised,
            "restitution " + shown(*declared) + " is declared, " + shown(realised) +
                " realised at " + shown(speed) + " m/s");
  }
  if (declared == nullptr) throw Remark("it has no parameter 'restitution' to compare with");
}

/// What a fresh contact at rest gives.
struct Rest {
  double force = 0.0;             ///< [N] along the normal
  double normal_stiffness = 0.0;  ///< [N/m]
};
Rest at_rest(const sdk::ContactLaw& law, double radius, double mass, double overlap) {
  ContactBench bench(1, law.history_size());
  Touch t;
  t.overlap = overlap;
  t.normal = {1.0, 0.0, 0.0};
  t.radius = radius;
  t.mass = mass;
  bench.show({t}, 1e-12, {}, false);
  bench.evaluate([&](const sdk::ContactBatch& batch) { law.evaluate(batch); }, 0);
  return {bench.output(ContactBench::force, 0), bench.output(ContactBench::normal_stiffness, 0)};
}

/// Rolling laws and the core read the secant stiffness.
void check_stiffness(const Maker& make) {
  const auto law = make_law(make);
  for (const Touch& t : standard_contacts(0.0, 0)) {
    const Rest rest = at_rest(*law, t.radius, t.mass, t.overlap);
    // An elastic force at rest over its overlap; nothing is integrated.
    constexpr double k_rounding = 1e-6;
    const double secant = rest.force / t.overlap;
    require(std::abs(rest.normal_stiffness - secant) <= k_rounding * std::abs(secant),
            "normal_stiffness is " + shown(rest.normal_stiffness) + " N/m where the force is " +
                shown(secant) + " N/m times the overlap");
  }
}

/// The core makes so many steps in a collision_time.
constexpr int k_core_steps = 15;

/// The stiffness [N/m] of a contact at rest, about an overlap [m].
struct Slopes {
  double closing = 0.0;
  double opening = 0.0;  ///< after it has been as deep: stiffer, where plastic work is done
  [[nodiscard]] double steepest() const { return std::max(closing, opening); }
};
Slopes slopes_at(const sdk::ContactLaw& law, double radius, double mass, double overlap) {
  constexpr double k_change = 1e-3;
  const auto force_at = [&](double depth) { return at_rest(law, radius, mass, depth).force; };
  Slopes slopes;
  slopes.closing = (force_at((1.0 + k_change) * overlap) - force_at((1.0 - k_change) * overlap)) /
                   (2.0 * k_change * overlap);
  ContactBench bench(1, law.history_size());
  Touch t;
  t.normal = {1.0, 0.0, 0.0};
  t.radius = radius;
  t.mass = mass;
  double before = 0.0;
  for (const double depth : {overlap, (1.0 - k_change) * overlap}) {
    t.overlap = depth;
    bench.show({t}, 1e-12, {}, false);
    bench.evaluate([&](const sdk::ContactBatch& batch) { law.evaluate(batch); }, 0);
    const double force = bench.output(ContactBench::force, 0);
    slopes.opening = (before - force) / (k_change * overlap);
    before = force;
  }
  return slopes;
}

/// How the steps that collision_time sets suit the stiffest part of a collision.
struct Resolution {
  double step = 0.0;         ///< [s] a fifteenth of collision_time
  double half_period = 0.0;  ///< [s] by the steepest slope about the deepest overlap
  double stiffer = 1.0;      ///< opening over closing
  [[nodiscard]] double steps() const { return half_period / step; }
  /// "unloading is 25 times as stiff as loading: ..."
  [[nodiscard]] std::string text(double collision_time) const {
    return "unloading is " + shown(stiffer) +
           " times as stiff as loading: the core's step, a fifteenth of collision_time (" +
           shown(collision_time) + " s), fits only " + shown(steps()) +
           " times into its half period of " + shown(half_period) +
           " s; give a collision_time that covers unloading, at most " +
           shown(k_core_steps * half_period / k_wanted) + " s here";
  }
  /// A swing needs more than pi/2 steps in its half period, or it grows.
  static constexpr double k_needed = 2.0;
  /// Enough for the energy of a collision to within some hundredths.
  static constexpr double k_wanted = 5.0;
};
Resolution resolution_of(const sdk::ContactLaw& law, double radius, double mass, double speed,
                         double deepest) {
  const Slopes slopes = slopes_at(law, radius, mass, deepest);
  Resolution r;
  r.step = law.collision_time(radius, mass, speed) / k_core_steps;
  r.half_period = std::numbers::pi * std::sqrt(mass / std::max(slopes.steepest(), 1e-300));
  if (slopes.closing > 0.0) r.stiffer = slopes.opening / slopes.closing;
  return r;
}

void check_times(const Maker& make, const ModelUnderTest& model_under_test) {
  const auto law = make_law(make);
  constexpr double k_radius = 5e-4;
  constexpr double k_speed = 0.5;
  const double mass = 2500.0 * sdk::sphere_volume(2.0 * k_radius);
  const Impact impact = run_impact(*law, k_speed, 0.0, -1.0);
  if (!impact.has_ended) throw Remark("the grains stick");
  const double reported = law->collision_time(k_radius, mass, k_speed);
  const Resolution resolution =
      resolution_of(*law, k_radius, mass, k_speed, impact.largest_overlap);
  // Damping lengthens a collision; the elastic time is told. A law that is stiffer in unloading
  // tells a shorter one, down to that of its stiffest spring.
  const double* e = model_under_test.number("restitution");
  const double damped = e != nullptr ? 1.0 + 0.5 * std::abs(std::log(*e)) : 2.0;
  const double longest =
      std::max(1.1 * damped * reported, resolution.stiffer > 1.1 ? impact.duration : 0.0);
  require(
      impact.duration >= 0.9 * reported && impact.duration <= longest,
      "a collision lasts " + shown(impact.duration) + " s, collision_time says " + shown(reported));
  // Stiffness from contacts at rest, 1 % of the radius deep.
  const double depth = 0.01 * k_radius;
  const double slope = slopes_at(*law, k_radius, mass, depth).steepest();
  if (!(slope > 0.0)) throw Remark("a fresh contact has no stiffness to measure half_period by");
  const double measured = std::numbers::pi * std::sqrt(mass / slope);
  const double half = law->half_period(k_radius, mass, depth);
  require(half <= 1.5 * measured, "half_period says " + shown(half) + " s, the force's slope " +
                                      shown(measured) + " s: time steps would be too long");
  const bool is_stiffer = resolution.stiffer > 1.1;
  require(!is_stiffer || resolution.steps() >= Resolution::k_needed, resolution.text(reported));
  if (is_stiffer && resolution.steps() < Resolution::k_wanted) {
    throw Remark(resolution.text(reported));
  }
  if (half < 0.5 * measured) {
    throw Remark("half_period says " + shown(half) + " s, the force's slope " + shown(measured) +
                 " s: time steps are shorter than they need be");
  }
}

void check_energy(const Maker& make, const ModelUnderTest& model_under_test) {
  const double* friction = model_under_test.number("friction");
  const auto law = make_law(make);
  for (const double tangential : {0.1, 0.5, 2.0}) {
    const Impact impact = run_impact(*law, 0.5, tangential, friction != nullptr ? *friction : -1.0);
    if (!impact.has_ended) throw Remark("the grains stick");
    require(impact.energy_ratio <= 1.0 + 1e-3,
            "an oblique collision ends with " + shown(impact.energy_ratio) +
                " of its energy (tangential speed " + shown(tangential) + " m/s)");
    require(
        impact.largest_slip_over_limit <= 1.0 + 1e-9,
        "the tangential force reaches " + shown(impact.largest_slip_over_limit) + " times mu F_n");
  }
}

/// Throws where it is not the spring along the wall that the core's step is too long for.
void require_resolved(const sdk::ContactLaw& law, double speed) {
  constexpr double k_radius = 5e-4;
  const double mass = 2500.0 * sdk::sphere_volume(2.0 * k_radius);
  const Impact impact = run_impact(law, speed, 0.0, -1.0);
  const Resolution resolution = resolution_of(law, k_radius, mass, speed, impact.largest_overlap);
  require(resolution.stiffer <= 1.1 || resolution.steps() >= Resolution::k_wanted,
          resolution.text(law.collision_time(k_radius, mass, speed)));
}

/// What a step does to the spring along the wall. A law that moves its spring by velocity times
/// time step damps it, to first order: a tenth and more of the energy at the core's own step.
void check_step(const Maker& make) {
  // The core makes 15 steps per contact and more. The leapfrog and what begins or ends within a
  // step leave a fiftieth of the energy at that step in mean over the starts; below k_small the
  // order is not told from that scatter.
  constexpr double k_energy = 0.05;
  constexpr double k_small = 0.01;
  constexpr double k_order = 1.3;
  constexpr int k_starts = 16;
  // Slow along the wall, so that friction holds the contact for most of its time.
  constexpr double k_speed = 0.5;
  constexpr double k_tangential = 0.01;
  const auto law = make_law(make);
  const auto kept = [&](int steps) {
    double sum = 0.0;
    for (int n = 0; n < k_starts; ++n) {
      const Impact impact =
          run_impact(*law, k_speed, k_tangential, -1.0, steps, (n + 0.5) / k_starts);
      if (!impact.has_ended) throw Remark("the grains stick");
      sum += impact.tangential_ratio / k_starts;
    }
    return sum;
  };
  const double converged = kept(k_small_steps);
  const double coarse = kept(k_core_steps);
  const double error = std::abs(coarse - converged);
  if (error > k_energy) require_resolved(*law, k_speed);
  require(error <= k_energy,
          "in 15 steps a collision keeps " + shown(coarse) +
              " of the energy along the wall, in many steps " + shown(converged) +
              ": move springs by displacement and angle, not by velocity times time step");
  if (error < k_small) return;
  const double finer = std::abs(kept(3 * k_core_steps) - converged);
  const double order = std::log(error / finer) / std::log(3.0);
  require(order >= k_order, "with a third of the time step the energy along the wall is still " +
                                shown(finer) + " off, where it was " + shown(error) + ": order " +
                                shown(order) + " in place of 2");
}

void rules(const Maker& make, const ModelUnderTest& model_under_test, RuleRunner& runner) {
  check_symmetry(runner, "force", [&](bool is_swapped, const auto& change) {
    return forces(make, is_swapped, change);
  });
  runner.rule("declared restitution = realised restitution",
              [&] { check_restitution(make, model_under_test); });
  runner.rule("tells its times as they are", [&] { check_times(make, model_under_test); });
  runner.rule("tells its normal stiffness as it is", [&] { check_stiffness(make); });
  runner.rule("creates no energy in oblique collisions, keeps Coulomb's limit",
              [&] { check_energy(make, model_under_test); });
  runner.rule("keeps its tangential energy to second order in the step", [&] { check_step(make); });
}

}  // namespace

Kind contact_kind() {
  // The core pads batches to multiples of eight.
  return {.observe = observe,
          .batches = {8, 24},
          .other_units = {4.0, 2.0, 0.5},
          .is_hot = true,
          .rules = rules};
}

}  // namespace dust::contract
