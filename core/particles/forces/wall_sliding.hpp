// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/sensor.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dust::particles {

/// A contact with a wall in one step, as it slides.
struct SlidingContact {
  std::int32_t particle = 0;  ///< row; one that slides on a wall in many steps is one entry
  std::int32_t wall = 0;
  sdk::Vec3 point;             ///< [m]
  sdk::Vec3 normal;            ///< of the wall
  sdk::Vec3 force;             ///< [N] on the particle
  sdk::Vec3 velocity;          ///< [m/s] of its surface relative to the wall's
  double weighted_time = 0.0;  ///< [s]
};

/// The slidings of some particles at walls, added up from step to step. They come in nearly the
/// same order in every step, so that each is looked for where the one before was found.
class WallSlidings {
 public:
  void begin_step() { next_ = 0; }
  void add(const SlidingContact& contact);
  /// Appends all to `out`, and is empty.
  void take(std::vector<sdk::WallSliding>& out);

 private:
  sdk::WallSliding& entry(std::int32_t particle, std::int32_t wall);

  std::vector<std::int32_t> particles_;    ///< of the entries
  std::vector<sdk::WallSliding> entries_;  ///< places still times the impulse
  std::size_t next_ = 0;
};

}  // namespace dust::particles
