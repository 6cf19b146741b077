// SPDX-License-Identifier: Apache-2.0
// Rules of forces of the fluid besides drag: nothing from nothing, the same in a mirror and in a
// turned frame, and a reaction that fits what is taken over.
#include "contract/as_kind.hpp"
#include "contract/rule_runner.hpp"
#include "dust/sdk/fluid_force.hpp"
#include "dust/sdk/random.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <limits>

namespace dust::contract {
namespace {

namespace dim = sdk::dimension;
using sdk::Vec3;

constexpr std::size_t k_grains = 24;
constexpr int k_calls = 40;  ///< intervals in a row, for models with a history
constexpr double k_interval = 1e-3;

struct Vectors {
  std::vector<double> x, y, z;
  void set(std::size_t n, Vec3 v) {
    x[n] = v.x;
    y[n] = v.y;
    z[n] = v.z;
  }
  [[nodiscard]] sdk::VectorColumns view(std::size_t first) const {
    return {x.data() + first, y.data() + first, z.data() + first};
  }
};
Vectors vectors() {
  const std::vector<double> zeros(k_grains, 0.0);
  return {zeros, zeros, zeros};
}

/// One instant of the standard scene: sand-like grains in a liquid, near walls and away from them.
struct Scene {
  std::vector<double> diameter, mass, density, viscosity, void_fraction, gap;
  Vectors angular_velocity, slip, vorticity, acceleration, pressure_gradient, viscous_stress,
      normal, wall;
  Vec3 gravity;
  double interval = 0.0;
};

/// A change of the frame for true vectors and for axial ones (vorticity, angular velocity).
struct Frame {
  std::function<Vec3(Vec3)> turn = [](Vec3 v) { return v; };
  std::function<Vec3(Vec3)> turn_axial = [](Vec3 v) { return v; };
};

Scene scene_at(int call, const Units& u, const Frame& frame, bool is_calm) {
  const sdk::Random random(3, sdk::stream_of("fluid_force"));
  Scene s;
  s.interval = k_interval * u.time;
  s.gravity = (is_calm ? 0.0 : u.of(dim::acceleration)) * frame.turn({1.0, -2.0, -9.81});
  for (Vectors* v : {&s.angular_velocity, &s.slip, &s.vorticity, &s.acceleration,
                     &s.pressure_gradient, &s.viscous_stress, &s.normal, &s.wall}) {
    *v = vectors();
  }
  for (std::uint32_t g = 0; g < k_grains; ++g) {
    std::uint32_t draw = 0;
    const auto number = [&] { return random.uniform(g, 0, draw++); };
    const auto vector = [&](double size) {
      const Vec3 v{number() - 0.5, number() - 0.5, number() - 0.5};
      // Everything swings with time, so that histories have something to remember.
      return (is_calm ? 0.0 : size * (1.0 + 0.3 * std::sin(0.4 * call + g))) * v;
    };
    const double size = 1e-4 * (1.0 + 9.0 * number()) * u.length;
    s.diameter.push_back(size);
    s.density.push_back((g % 2 == 0 ? 1000.0 : 1.2) * u.of(dim::density));
    s.viscosity.push_back((g % 2 == 0 ? 1e-3 : 1.8e-5) * u.of(dim::dynamic_viscosity));
    s.mass.push_back(2500.0 * u.of(dim::density) * size * size * size * 0.5235987755982988);
    s.void_fraction.push_back(0.4 + 0.6 * number());
    const bool is_near = g % 3 == 0;
    // Down to a film of a thousandth of the grain.
    const double share = number();
    s.gap.push_back(is_near ? size * 0.3 * share * share * share
                            : std::numeric_limits<double>::infinity());
    const Vec3 towards{number() - 0.5, number() - 0.5, number() + 0.1};
    s.slip.set(g, frame.turn(u.of(dim::velocity) * vector(0.4)));
    s.angular_velocity.set(g, frame.turn_axial((1.0 / u.time) * vector(600.0)));
    s.vorticity.set(g, frame.turn_axial((1.0 / u.time) * vector(200.0)));
    s.acceleration.set(g, frame.turn(u.of(dim::acceleration) * vector(5.0)));
    s.pressure_gradient.set(g, frame.turn(u.of(dim::pressure / dim::length) * vector(900.0)));
    s.viscous_stress.set(g, frame.turn(u.of(dim::pressure / dim::length) * vector(50.0)));
    if (is_near) s.normal.set(g, frame.turn(towards / norm(towards)));
    if (is_near) s.wall.set(g, frame.turn(u.of(dim::velocity) * vector(0.5)));
  }
  return s;
}

struct Result {
  Vectors force;
  std::vector<double> added_mass, resistance;
};

/// What the model gives at the last of some calls.
Result evaluate(const sdk::FluidForce& model, const TestVariant& variant, const Frame& frame = {},
                bool is_calm = false) {
  const int size = model.history_size();
  require(size >= 0, "it keeps " + std::to_string(size) + " numbers per grain");
  const sdk::FluidForceNeeds needs = model.needs();
  constexpr double k_guard = -7.25e77;
  std::vector<double> history(k_grains * static_cast<std::size_t>(size) + 1, 0.0);
  history.back() = k_guard;
  Result r;
  for (int call = 0; call < k_calls; ++call) {
    const Scene s = scene_at(call, variant.units, frame, is_calm);
    const std::vector<double> zeros(k_grains + 1, 0.0);
    r = {{zeros, zeros, zeros}, zeros, zeros};
    for (auto* c : {&r.force.x, &r.force.y, &r.force.z, &r.added_mass, &r.resistance}) {
      c->back() = k_guard;
    }
    const std::size_t most = variant.batch == 0 ? k_grains : variant.batch;
    for (std::size_t first = 0; first < k_grains; first += most) {
      sdk::FluidForceBatch b;
      b.count = std::min(most, k_grains - first);
      b.interval = s.interval;
      b.gravity = s.gravity;
      b.diameter = s.diameter.data() + first;
      b.mass = s.mass.data() + first;
      b.density = s.density.data() + first;
      b.viscosity = s.viscosity.data() + first;
      b.void_fraction = s.void_fraction.data() + first;
      b.angular_velocity = s.angular_velocity.view(first);
      b.slip = s.slip.view(first);
      if (needs.vorticity) b.vorticity = s.vorticity.view(first);
      if (needs.acceleration) b.acceleration = s.acceleration.view(first);
      if (needs.stresses) {
        b.pressure_gradient = s.pressure_gradient.view(first);
        b.viscous_stress = s.viscous_stress.view(first);
      }
      if (needs.wall_reach > 0.0) {
        b.gap = s.gap.data() + first;
        b.wall_normal = s.normal.view(first);
        b.wall_velocity = s.wall.view(first);
      }
      b.force = {r.force.x.data() + first, r.force.y.data() + first, r.force.z.data() + first};
      b.added_mass = r.added_mass.data() + first;
      b.resistance = r.resistance.data() + first;
      b.history = size > 0 ? history.data() + first * static_cast<std::size_t>(size) : nullptr;
      call_hot(variant, [&] { model.evaluate(b); });
    }
    for (auto* c : {&r.force.x, &r.force.y, &r.force.z, &r.added_mass, &r.resistance}) {
      require(c->back() == k_guard, "it writes beyond the end of the batch");
      c->pop_back();
    }
    require(history.back() == k_guard, "it writes beyond the end of its history");
  }
  return r;
}

Vec3 force_on(const Result& r, std::size_t g) { return {r.force.x[g], r.force.y[g], r.force.z[g]}; }

Observations observe(const Maker& make, const TestVariant& variant) {
  const auto model = make_as<sdk::FluidForce>(make, variant.units);
  const Result r = evaluate(*model, variant);
  const sdk::Dimension rate = dim::mass / dim::time;
  Observations observations;
  for (std::size_t g = 0; g < k_grains; ++g) {
    const std::string grain = " on grain " + std::to_string(g);
    observations.push_back({"force" + grain, r.force.x[g], dim::force});
    observations.push_back({"force" + grain, r.force.y[g], dim::force});
    observations.push_back({"force" + grain, r.force.z[g], dim::force});
    observations.push_back({"added_mass" + grain, r.added_mass[g], dim::mass});
    observations.push_back({"resistance" + grain, r.resistance[g], rate});
  }
  return observations;
}

std::string shown_vector(const Vec3& v) {
  return "(" + shown(v.x) + ", " + shown(v.y) + ", " + shown(v.z) + ")";
}

void check_frame(const sdk::FluidForce& model, const Frame& frame, const std::string& what) {
  // Sums in another order: a few roundings of the largest component.
  constexpr double k_rounding = 1e-12;
  const Result here = evaluate(model, {});
  const Result there = evaluate(model, {}, frame);
  for (std::size_t g = 0; g < k_grains; ++g) {
    const Vec3 expected = frame.turn(force_on(here, g));
    require(norm(force_on(there, g) - expected) <= k_rounding * norm(expected),
            "the force on grain " + std::to_string(g) + " differs " + what + ": " +
                shown_vector(force_on(there, g)) + " N, expected: " + shown_vector(expected) +
                " N");
    require(there.added_mass[g] == here.added_mass[g] && there.resistance[g] == here.resistance[g],
            "added mass or resistance of grain " + std::to_string(g) + " differs " + what + ": " +
                shown(there.added_mass[g]) + " kg and " + shown(there.resistance[g]) +
                " kg/s, expected: " + shown(here.added_mass[g]) + " kg and " +
                shown(here.resistance[g]) + " kg/s; expected: from 0 on");
  }
}

void rules(const Maker& make, const ModelUnderTest&, RuleRunner& runner) {
  runner.rule("gives no force in a uniform stream that carries the grain, without gravity", [&] {
    const Result r = evaluate(*make_as<sdk::FluidForce>(make), {}, {}, true);
    for (std::size_t g = 0; g < k_grains; ++g) {
      require(norm(force_on(r, g)) == 0.0,
              shown(norm(force_on(r, g))) + " N on grain " + std::to_string(g) + "; expected: 0");
    }
  });
  runner.rule("turns with the frame and mirrors with it", [&] {
    const auto model = make_as<sdk::FluidForce>(make);
    const auto cycle = [](Vec3 v) { return Vec3{v.y, v.z, v.x}; };
    check_frame(*model, {cycle, cycle}, "when the axes are exchanged");
    check_frame(*model,
                {[](Vec3 v) {
                   return Vec3{-v.x, v.y, v.z};
                 },
                 [](Vec3 v) {
                   return Vec3{v.x, -v.y, -v.z};
                 }},
                "in a mirror: vorticity and spin are axial");
  });
  runner.rule("gives no negative added mass or resistance, resistance only near a wall", [&] {
    const auto model = make_as<sdk::FluidForce>(make);
    const Result r = evaluate(*model, {});
    for (std::size_t g = 0; g < k_grains; ++g) {
      require(r.added_mass[g] >= 0.0,
              "added mass " + shown(r.added_mass[g]) + " kg; expected: from 0 on");
      require(r.resistance[g] >= 0.0, "resistance " + shown(r.resistance[g]) + " kg/s");
      require(r.resistance[g] == 0.0 || g % 3 == 0,
              "resistance " + shown(r.resistance[g]) + " kg/s where no wall is near; expected: 0");
    }
  });
  runner.rule("what it takes over is contained in the momentum set", [&] {
    const auto model = make_as<sdk::FluidForce>(make);
    const sdk::FluidForceParts parts = model->takes_over();
    const bool takes = parts.pressure_gradient || parts.viscous_stress || parts.buoyancy;
    const bool is_contained = model->reaction() == sdk::FluidForceReaction::momentum_set;
    require(takes == is_contained,
            takes ? "takes_over() names a part and reaction() is not momentum_set: the "
                    "fluid would get it a second time"
                  : "reaction() is momentum_set and takes_over() names no "
                    "part: no part of the fluid's equation holds it");
  });
}

}  // namespace

Kind fluid_force_kind() {
  return {.observe = observe,
          .batches = {1, 5, 8},
          .other_units = {4.0, 2.0, 0.5},
          .is_hot = true,
          .rules = rules};
}

}  // namespace dust::contract
