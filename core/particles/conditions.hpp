// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/body_set.hpp"
#include "contact/aligned.hpp"
#include "particles/openings/opening.hpp"
#include "particles/pair_law_table.hpp"
#include "particles/store/particle_domain.hpp"
#include "particles/surfaces.hpp"
#include "particles/time_steps.hpp"
#include "setup/setup.hpp"

#include <vector>

namespace dust::particles {

/// What particles meet. Fixed before the first step, but for the time and where moving surfaces
/// stand at it.
struct Conditions {
  /// `keeps_work`: the work of contacts is kept (ContactWork).
  Conditions(const scenario::Setup& setup, const bodies::BodySet& bodies,
             std::vector<PairLaws> laws, const std::vector<double>& diameters,
             const DemOptions& options, bool keeps_work);

  PairLawTable laws;
  std::vector<sdk::MaterialProperties> materials;
  std::vector<Surface> surfaces;
  std::vector<Opening> openings;  ///< named by number in their surfaces
  double opening_rounding = 0.0;  ///< [m]
  ParticleDomain domain;
  TimeSteps steps;
  contact::AlignedVector<double> gravity;  ///< four per material, reduced by buoyancy
  double time = 0.0;                       ///< [s]

  [[nodiscard]] double step() const { return steps.coarse_step; }
  [[nodiscard]] double largest_diameter() const { return steps.classes.back().diameter; }
};

}  // namespace dust::particles
