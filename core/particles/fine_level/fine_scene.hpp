// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contact/batch_kernels.hpp"
#include "dust/sdk/vec3.hpp"
#include "particles/forces/wall_loads.hpp"
#include "particles/openings/opening_marks.hpp"
#include "particles/pair_law_table.hpp"
#include "particles/store/particle_store.hpp"
#include "particles/surfaces.hpp"
#include "particles/time_steps.hpp"
#include "particles/work/contact_work.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace dust::particles {

/// What the fine level works on in one coarse step: views of what others own.
struct FineScene {
  const PairLawTable& laws;
  std::span<const Surface> surfaces;
  const TimeSteps& steps;
  const contact::Images& images;
  std::span<const double> gravity;  ///< four per material, reduced by buoyancy

  /// Coarse particles first, [0, coarse_count). They have made their step.
  ParticleStore& particles;
  std::size_t coarse_count = 0;
  std::span<const std::int32_t> active;  ///< fine particles that make this step
  /// Contacts of fine particles (side a) with particles (b >= 0) and surfaces (-1 - b). What
  /// `is_touching` holds is 1 + the level of a contact under way.
  contact::PairView contacts;
  double time = 0.0;  ///< [s] at the beginning of the step
  WallLoads& wall_loads;
  OpeningMarks opening_marks = {};
  ContactWork* work = nullptr;      ///< null: not kept
  std::span<double> contact_force;  ///< [N] four per coarse particle, or empty: not kept

  [[nodiscard]] std::size_t fine_count() const { return particles.size() - coarse_count; }
  [[nodiscard]] bool is_fine(std::int32_t particle) const {
    return particle >= static_cast<std::int32_t>(coarse_count);
  }
  [[nodiscard]] bool is_coarse(std::int32_t particle) const {
    return particle >= 0 && !is_fine(particle);
  }
  /// Its number among the fine ones.
  [[nodiscard]] std::size_t fine_index(std::int32_t particle) const {
    return static_cast<std::size_t>(particle) - coarse_count;
  }
  [[nodiscard]] const Surface& surface(std::int32_t number) const {
    return surfaces[static_cast<std::size_t>(number)];
  }
  [[nodiscard]] const PairLaws& law(std::int32_t number) const {
    return laws[static_cast<std::size_t>(number)];
  }
};

}  // namespace dust::particles
