// SPDX-License-Identifier: Apache-2.0
#include "coupling/refresh_schedule.hpp"

#include <algorithm>
#include <cmath>

namespace dust::coupling {

RefreshSchedule::RefreshSchedule(double fluid_step, double least_spacing)
    : step_(fluid_step),
      least_spacing_(least_spacing),
      refreshes_(refreshes_for(fluid_step, 0.0)) {}

double RefreshSchedule::refreshes_for(double fluid_step, double fastest) const {
  constexpr double k_steps_per_relaxation = 4.0;
  constexpr double k_crossing_speed = 2.0;  // [m/s]
  constexpr double k_refreshes_per_cell = 8.0;
  constexpr double k_max_refreshes = 64.0;
  const double relaxing = k_steps_per_relaxation * fluid_step * fastest;
  const double crossing = k_refreshes_per_cell * k_crossing_speed * fluid_step / least_spacing_;
  // The allowance keeps rounding of a whole number from costing one more refresh.
  constexpr double k_rounding = 1e-9;
  const double wanted = std::ceil(std::max(relaxing, crossing) * (1.0 - k_rounding));
  return std::clamp(wanted, 1.0, k_max_refreshes);
}

void RefreshSchedule::begin_step(double fluid_step, double fastest) {
  step_ = fluid_step;
  refreshes_ = refreshes_for(fluid_step, fastest);
  done_ = 0;
}

void RefreshSchedule::note(double held) {
  ++done_;
  last_held_ = held;
}

void RefreshSchedule::save(sdk::ArchiveWriter& archive) const {
  archive.number("refreshes", refreshes_);
  archive.number("step", step_);
  archive.number("last_held", last_held_);
}

void RefreshSchedule::load(sdk::ArchiveReader& archive) {
  refreshes_ = archive.number("refreshes");
  step_ = archive.number("step");
  last_held_ = archive.number("last_held");
}

}  // namespace dust::coupling
