// SPDX-License-Identifier: Apache-2.0
#include "preflight/cost.hpp"

#include "dust/sdk/sphere.hpp"

#include <algorithm>
#include <cmath>

namespace dust::preflight {
namespace {

// What things cost on one core of an idle virtual machine of 2026, by `tools/validation/run
// estimates` and long runs. What this machine does differently is learnt: LearntCosts.
constexpr double k_bytes_base = 3.5e7;
constexpr double k_bytes_per_grain = 1500.0;  // with lists, and copies on their way to disk
constexpr double k_bytes_per_cell = 900.0;
constexpr double k_disk_base = 4e5;               // report, series, scenario, summary
constexpr double k_frame_bytes_per_grain = 48.0;  // packed
constexpr double k_frame_bytes_per_cell = 11.0;
constexpr double k_checkpoint_bytes_per_grain = 480.0;
constexpr double k_checkpoint_bytes_per_cell = 120.0;
// Steps of grains per second: those at rest in a bed have six contacts each, those of a stream meet
// now and then, those of a gas fly from one collision to the next.
constexpr double k_bed_steps_per_second = 1.1e7;
constexpr double k_stream_steps_per_second = 1.6e7;
constexpr double k_gas_steps_per_second = 7e7;
constexpr double k_cell_steps_per_second = 2.2e6;
constexpr double k_start_seconds = 0.3;
constexpr double k_seconds_per_fluid_step = 7e-4;  // however few the cells
constexpr double k_seconds_per_frame = 0.03;
// Solid share above which grains without gravity press on each other.
constexpr double k_dense = 0.2;

using scenario::DomainSpec;
using scenario::Setup;

double extent_along(const DomainSpec& domain, sdk::Vec3 direction) {
  const sdk::Vec3 size = domain.max - domain.min;
  return std::abs(size.x * direction.x) + std::abs(size.y * direction.y) +
         std::abs(size.z * direction.z);
}

/// [s] that grains filled in loosely fall before they lie on each other: the top of the filling
/// sinks by half its height. Nothing where they are few.
double settling_time(const Setup& setup, double volume) {
  constexpr double k_loose = 0.3;
  const double g = norm(setup.gravity);
  const double height = extent_along(setup.domain, setup.gravity / g);
  const sdk::Vec3 size = setup.domain.max - setup.domain.min;
  const double filled = volume / (k_loose * size.x * size.y * size.z) * height;
  return std::sqrt(std::min(filled, height) / g);
}

/// Seconds for `grains` that are there at once: with gravity they fall, then lie.
double seconds_at_once(const Setup& setup, double grains, double volume, const Derived& derived) {
  const double end = setup.time.end;
  const double steps = grains * end / derived.steps.coarse_step;
  if (derived.steps.classes.empty()) return steps / k_bed_steps_per_second;
  if (norm(setup.gravity) > 0.0) {
    const double share = std::min(1.0, settling_time(setup, volume) / end);
    return steps * (share / k_gas_steps_per_second + (1.0 - share) / k_bed_steps_per_second);
  }
  const sdk::Vec3 size = setup.domain.max - setup.domain.min;
  const double most = grains * sdk::sphere_volume(derived.steps.classes.back().diameter);
  const double solids = volume > 0.0 ? volume : most;
  return steps / (solids > k_dense * size.x * size.y * size.z ? k_bed_steps_per_second
                                                              : k_gas_steps_per_second);
}

}  // namespace

double fall_height(const scenario::Setup& setup) {
  const double g = norm(setup.gravity);
  return g > 0.0 ? extent_along(setup.domain, setup.gravity / g) : 0.0;
}

void estimate_cost(const scenario::Setup& setup, double body_speed, Derived& derived) {
  const double g = norm(setup.gravity);
  const sdk::Vec3 size = setup.domain.max - setup.domain.min;
  const double speed = body_speed > 0.0 ? body_speed : derived.expected_speed;
  if (g > 0.0) derived.residence_time += std::sqrt(2.0 * fall_height(setup) / g);
  if (speed > 0.0) derived.residence_time += std::max({size.x, size.y, size.z}) / speed;
  derived.residence_time = std::min(derived.residence_time, setup.time.end);
  double at_once = 0.0;
  double volume_at_once = 0.0;
  double flowing = 0.0;
  for (const EmissionNumbers& e : derived.emissions) {
    at_once += e.at_once;
    volume_at_once += e.volume_at_once;
    flowing += e.computed_per_second * derived.residence_time;
  }
  derived.grains_in_domain = at_once + flowing;
  // The domain fills during one residence time.
  const double mean_flowing = flowing * (1.0 - 0.5 * derived.residence_time / setup.time.end);
  double cells = 0.0;
  if (setup.fluid) {
    const auto& n = setup.fluid->cells;
    cells = static_cast<double>(n[0]) * n[1] * n[2];
  }
  derived.memory_bytes =
      k_bytes_base + k_bytes_per_grain * derived.grains_in_domain + k_bytes_per_cell * cells;
  const double frames = std::floor(setup.time.end / setup.time.output_every + 1e-9) + 1.0;
  derived.disk_bytes =
      k_disk_base +
      frames *
          (k_frame_bytes_per_grain * (at_once + mean_flowing) + k_frame_bytes_per_cell * cells) +
      k_checkpoint_bytes_per_grain * derived.grains_in_domain + k_checkpoint_bytes_per_cell * cells;
  const double fluid_steps =
      setup.time.end / setup.time.fluid_step * std::max(1.0, std::ceil(derived.courant_number));
  derived.core_seconds = k_start_seconds + cells * fluid_steps / k_cell_steps_per_second +
                         frames * k_seconds_per_frame;
  if (cells > 0.0) derived.core_seconds += fluid_steps * k_seconds_per_fluid_step;
  if (derived.steps.coarse_step > 0.0) {
    derived.core_seconds +=
        seconds_at_once(setup, at_once, volume_at_once, derived) +
        setup.time.end / derived.steps.coarse_step * mean_flowing / k_stream_steps_per_second;
  }
}

}  // namespace dust::preflight
