// SPDX-License-Identifier: Apache-2.0
#include "particles/time_steps.hpp"

#include "dust/sdk/error.hpp"
#include "dust/sdk/sphere.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace dust::particles {
namespace {

/// Fluid steps are whole numbers of coarse steps; this forgives the rounding of their quotient.
constexpr double k_whole_slack = 1e-9;

double approach_speed(const scenario::Setup& setup, const bodies::BodySet& bodies,
                      double release_speed) {
  if (setup.time.expected_speed > 0.0) return setup.time.expected_speed;
  double speed = std::max(k_default_speed, release_speed);
  for (const auto& body : bodies) speed = std::max(speed, body.largest_speed());
  return speed;
}

/// What grains of one size meet, and how fast.
struct Encounters {
  const scenario::Setup& setup;
  std::span<const PairLaws> laws;
  std::set<int> materials;  ///< that grains have
  double largest;           ///< [m] diameter
  double speed;             ///< [m/s]
};

/// Notes the collision of a grain of material `m` with a partner of material `other`: R* [m] and
/// m* [kg]. Grains that stick swing about their overlap at rest.
void collide(const PairLaws& law, int m, int other, double radius, double mass, double speed,
             ClassStep& c) {
  const auto shorten = [&](double time) {
    if (!(time < c.hertz_time)) return;
    c.hertz_time = time;
    c.material = m;
    c.partner = other;
  };
  shorten(law.contact->collision_time(radius, mass, speed));
  if (!law.cohesion) return;
  shorten(law.contact->half_period(radius, mass, law.cohesion->resting_overlap(radius)));
}

ClassStep class_step(double diameter, const Encounters& e) {
  ClassStep c{.diameter = diameter};
  c.rayleigh_time = c.hertz_time = std::numeric_limits<double>::infinity();
  const double radius = 0.5 * diameter;
  for (const int m : e.materials) {
    const auto& properties = e.setup.materials[static_cast<std::size_t>(m)].properties;
    c.rayleigh_time = std::min(c.rayleigh_time, rayleigh_time(properties, radius));
    const double mass = properties.density * sdk::sphere_volume(diameter);
    for (const PairLaws& law : e.laws) {
      if (law.material_i != m && law.material_j != m) continue;
      const int other = law.material_i == m ? law.material_j : law.material_i;
      if (e.materials.count(other) > 0) {
        const double density =
            e.setup.materials[static_cast<std::size_t>(other)].properties.density;
        for (const double partner : {diameter, e.largest}) {
          const double partner_mass = density * sdk::sphere_volume(partner);
          collide(law, m, other, 0.5 * diameter * partner / (diameter + partner),
                  mass * partner_mass / (mass + partner_mass), e.speed, c);
        }
      }
      // A wall, or a body, of the other material.
      collide(law, m, other, radius, mass, e.speed, c);
    }
  }
  c.stable_step =
      std::min(k_rayleigh_share * c.rayleigh_time, c.hertz_time / k_steps_per_collision);
  return c;
}

const ClassStep* smallest(std::span<const ClassStep> classes, double from_diameter) {
  const ClassStep* found = nullptr;
  for (const ClassStep& c : classes) {
    if (c.diameter < from_diameter) continue;
    if (found == nullptr || c.stable_step < found->stable_step) found = &c;
  }
  return found;
}

/// Sub-steps are halvings of the coarse step.
int level_of(double coarse_step, double stable_step) {
  return std::max(0, static_cast<int>(std::ceil(std::log2(coarse_step / stable_step))));
}

}  // namespace

std::set<int> grain_materials(const scenario::Setup& setup) {
  std::set<int> materials;
  for (const auto& e : setup.emitters) {
    materials.insert(e.material);
    materials.insert(e.more_materials.begin(), e.more_materials.end());
  }
  if (materials.empty()) {
    for (std::size_t m = 0; m < setup.materials.size(); ++m) materials.insert(static_cast<int>(m));
  }
  return materials;
}

double rayleigh_time(const sdk::MaterialProperties& material, double radius) {
  const double shear = material.young_modulus / (2.0 * (1.0 + material.poisson_ratio));
  return std::numbers::pi * radius * std::sqrt(material.density / shear) /
         (0.1631 * material.poisson_ratio + 0.8766);  // docs/theory/grains.md, eq. (9)
}

double TimeSteps::step_of(const ClassStep& c) const { return std::ldexp(coarse_step, -c.level); }

double TimeSteps::finest_step() const {
  double step = coarse_step;
  for (const ClassStep& c : classes) step = std::min(step, step_of(c));
  return step;
}

const ClassStep* TimeSteps::deciding() const { return smallest(classes, 0.0); }
const ClassStep* TimeSteps::coarse_deciding() const { return smallest(classes, coarse_limit); }

TimeSteps time_steps(const scenario::Setup& setup, const bodies::BodySet& bodies,
                     std::span<const PairLaws> laws, std::span<const double> diameters,
                     double release_speed) {
  if (diameters.empty()) throw sdk::ParameterError("no grain diameters: the time step is unknown");
  TimeSteps out;
  out.expected_speed = approach_speed(setup, bodies, release_speed);
  const double largest = diameters.back();
  out.coarse_limit = setup.time.rates_single ? 0.0 : k_coarse_share * largest * (1.0 - 1e-12);
  const Encounters encounters{setup, laws, grain_materials(setup), largest, out.expected_speed};
  for (const double diameter : diameters) out.classes.push_back(class_step(diameter, encounters));
  // One rate for all is that of the class that needs the smallest: the limit is 0 then.
  double step = out.coarse_deciding()->stable_step;
  if (setup.time.dem_step > 0.0) step = setup.time.dem_step;
  const double interval = setup.time.fluid_step;
  out.coarse_step =
      interval > 0.0 ? interval / std::max(1.0, std::ceil(interval / step - k_whole_slack)) : step;
  for (ClassStep& c : out.classes) {
    c.level = out.is_coarse(c) ? 0 : level_of(out.coarse_step, c.stable_step);
  }
  return out;
}

}  // namespace dust::particles
