// SPDX-License-Identifier: Apache-2.0
#include "run/body_removal.hpp"

#include "base/log.hpp"
#include "scenario/text/units.hpp"

#include <limits>
#include <string>

namespace dust::run {
namespace {

/// Why a body goes now; empty if it stays.
std::string cause_of_removal(const scenario::RemovalSpec& removal, double now,
                             const particles::GrainRows& rows) {
  if (now >= removal.at) return "its time has come";
  if (!(removal.kinetic_energy_per_grain > 0.0) || now < removal.after) return {};
  const double energy = kinetic_energy_per_grain(rows);
  if (!(energy < removal.kinetic_energy_per_grain)) return {};
  return "the mean kinetic energy per grain is " + scenario::number_text(energy) + " J";
}

}  // namespace

double kinetic_energy_per_grain(const particles::GrainRows& rows) {
  double sum = 0.0;
  double grains = 0.0;
  for (std::size_t n = 0; n < rows.count; ++n) {
    const double* v = rows.velocity_of(n);
    const double* w = rows.rotation_of(n);
    const double r = rows.radius(n);
    const double inertia = 0.4 * r * r / rows.inverse_mass(n);
    const double energy = 0.5 / rows.inverse_mass(n) * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) +
                          0.5 * inertia * (w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
    sum += rows.weight[n] * energy;
    grains += rows.weight[n];
  }
  return rows.count > 0 ? sum / grains : std::numeric_limits<double>::infinity();
}

bool remove_bodies(const scenario::Setup& setup, double time, const particles::GrainRows& rows,
                   bodies::BodySet& bodies) {
  // Times in decimal meet the steps to a few roundings.
  const double now = time + 1e-9 * setup.time.fluid_step;
  bool has_changed = false;
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    const auto& removal = setup.bodies[b].removal;
    bodies::Body& body = bodies[b];
    if (!removal || body.is_removed()) continue;
    const std::string cause = cause_of_removal(*removal, now, rows);
    if (cause.empty()) continue;
    body.removed_at = time;
    has_changed = true;
    base::log_info("the body " + body.name + " is taken away at " + scenario::number_text(time) +
                   " s: " + cause);
  }
  return has_changed;
}

}  // namespace dust::run
