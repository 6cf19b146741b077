// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "particles/fine_level/fine_scene.hpp"

#include <cstddef>

namespace dust::particles {

/// What is to be expected of a contact of the fine level in the coarse step at hand.
struct ContactPrediction {
  bool is_near = false;      ///< the two may touch
  double stable_step = 0.0;  ///< [s] that their contact would need
  double speed = 0.0;        ///< [m/s] of one relative to the other, at most
};

/// Predicts contact `entry` of the scene, where both may be faster by `extra_speed` [m/s] than they
/// are.
ContactPrediction predict_contact(const FineScene& scene, std::size_t entry, double extra_speed);

}  // namespace dust::particles
