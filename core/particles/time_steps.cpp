// SPDX-License-Identifier: Apache-2.0
#include "particles/time_steps.hpp"

#include "dust/sdk/error.hpp"
#include "dust/sdk/sphere.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

namespace dust::particles {
namespace {

/// Fluid steps are whole numbers of coarse steps; this forgives the rounding of their quotient.
constexpr double k_whole_slack = 1e-9;

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

}  // namespace

double rayleigh_time(const sdk::MaterialProperties& material, double radius) {
  const double shear = material.young_modulus / (2.0 * (1.0 + material.poisson_ratio));
  return std::numbers::pi * radius * std::sqrt(material.density / shear) /
         (0.1631 * material.poisson_ratio + 0.8766);
}

TimeSteps time_steps(const scenario::Setup& setup, const bodies::BodySet& bodies,
                     std::span<const PairLaws> laws, std::span<const double> diameters) {
  TimeSteps out;
  if (diameters.empty()) throw sdk::ParameterError("no grain diameters: the time step is unknown");
  out.expected_speed = setup.time.expected_speed;
  if (!(out.expected_speed > 0.0)) {
    out.expected_speed = k_default_speed;
    for (const auto& body : bodies) {
      out.expected_speed = std::max(out.expected_speed, body.largest_speed());
    }
  }
  const double largest = diameters.back();
  out.coarse_limit = setup.time.rates_single ? 0.0 : k_coarse_share * largest * (1.0 - 1e-12);
  const auto materials = grain_materials(setup);

  double smallest = std::numeric_limits<double>::infinity();
  double coarse = smallest;
  for (const double diameter : diameters) {
    ClassStep c{.diameter = diameter};
    c.rayleigh_time = c.hertz_time = std::numeric_limits<double>::infinity();
    const double radius = 0.5 * diameter;
    for (const int m : materials) {
      const auto& properties = setup.materials[static_cast<std::size_t>(m)].properties;
      c.rayleigh_time = std::min(c.rayleigh_time, rayleigh_time(properties, radius));
      const double mass = properties.density * sdk::sphere_volume(diameter);
      for (const PairLaws& law : laws) {
        if (law.material_i != m && law.material_j != m) continue;
        const auto shortest = [&](double r, double mm) {
          c.hertz_time =
              std::min(c.hertz_time, law.contact->collision_time(r, mm, out.expected_speed));
          if (law.cohesion) {
            const double overlap = law.cohesion->resting_overlap(r);
            c.hertz_time = std::min(c.hertz_time, law.contact->half_period(r, mm, overlap));
          }
        };
        const int other = law.material_i == m ? law.material_j : law.material_i;
        if (materials.count(other) > 0) {
          const double density =
              setup.materials[static_cast<std::size_t>(other)].properties.density;
          for (const double partner : {diameter, largest}) {
            const double partner_mass = density * sdk::sphere_volume(partner);
            shortest(0.5 * diameter * partner / (diameter + partner),
                     mass * partner_mass / (mass + partner_mass));
          }
        }
        shortest(radius, mass);
      }
    }
    c.stable_step = std::min(0.3 * c.rayleigh_time, c.hertz_time / 15.0);
    smallest = std::min(smallest, c.stable_step);
    if (diameter >= out.coarse_limit) coarse = std::min(coarse, c.stable_step);
    out.classes.push_back(c);
  }

  double step = setup.time.rates_single ? smallest : coarse;
  if (setup.time.dem_step > 0.0) step = setup.time.dem_step;
  const double interval = setup.time.fluid_step;
  out.coarse_step =
      interval > 0.0 ? interval / std::max(1.0, std::ceil(interval / step - k_whole_slack)) : step;
  for (ClassStep& c : out.classes) {
    const bool is_coarse = c.diameter >= out.coarse_limit;
    c.level =
        is_coarse
            ? 0
            : std::max(0, static_cast<int>(std::ceil(std::log2(out.coarse_step / c.stable_step))));
  }
  return out;
}

}  // namespace dust::particles
