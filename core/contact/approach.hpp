// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contact/batch_kernels.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace dust::contact {

/// Grains that fly straight, each to be found within its skin of that line.
struct Trajectories {
  const double* position = nullptr;  ///< rows: x, y, z, radius
  const double* velocity = nullptr;  ///< rows, k_motion_stride apart
  const double* skin = nullptr;      ///< [m] one per grain
};

/// What is looked for: who may come closer than touch + `range` [m] within `lifetime` [s], and who
/// has overlapped for longer than `behind` [s].
struct ContactPrediction {
  double range = 0.0;
  double lifetime = 0.0;
  double behind = 0.0;
};

/// What mark_approaching says of a pair.
enum Approach : std::uint8_t {
  k_keeps_away = 0,
  k_may_meet = 1,
  k_overlaps = 2,  ///< by more than they come nearer in the time `behind`
};

/// For the pairs of grains a[q] and b[q]: k_may_meet, with k_overlaps or without, or 0.
void mark_approaching(const Trajectories& trajectories, const Images& images,
                      const ContactPrediction& prediction, std::span<const std::int32_t> a,
                      std::span<const std::int32_t> b, std::uint8_t* approach);

}  // namespace dust::contact
