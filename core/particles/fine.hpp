// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/sensor.hpp"
#include "dust/sdk/vec3.hpp"

#include <cstdint>
#include <utility>
#include <vector>

namespace dust::particles {

/// The first three numbers of a row.
inline sdk::Vec3 vec(const double* p) { return {p[0], p[1], p[2]}; }

/// A fine grain while it is sub-cycled.
struct Member {
  std::int32_t row = 0;
  double radius = 0.0, inverse_mass = 0.0, weight = 1.0, rate = 0.0;
  sdk::Vec3 position, velocity, rotation, half_velocity, half_rotation, target, gravity, received;
  double lag = 0.0;
  sdk::Vec3 impulse, twist;  ///< of the contacts in this sub-step
  double kick = -1.0, decay = 1.0, phi = 1.0;
  sdk::Vec3 force;
};

/// A contact candidate of a block.
struct Candidate {
  std::int32_t entry = 0;  ///< in the fine list
  std::int32_t member = 0;
  std::int32_t partner = -1;  ///< member, or -1
  std::int32_t row = -1;      ///< coarse row, or -1
  std::int32_t surface = -1;
  std::int32_t law = 0;
  double reaction[6] = {0, 0, 0, 0, 0, 0};
  sdk::Vec3 wall_velocity;  ///< [m/s] of the surface, at the last look
};

/// Clusters of one level that step together.
struct Block {
  std::vector<Member> members;
  std::vector<Candidate> candidates;
  int level = 0;
  double largest_overlap = 0.0;
  std::vector<double> wall_sums;  ///< as of a chunk
  std::vector<sdk::WallImpact> wall_impacts;
};

/// What the look-out found about one entry of the fine list.
struct Outlook {
  bool is_near = false;
  double stable_step = 0.0;
  double speed = 0.0;
};

/// Fine grain's state of the current coarse step.
struct FineState {
  std::int32_t cluster = -1;  ///< -1: no partner in reach
  std::int32_t level = 0;     ///< of the cluster whose root this grain is
  std::int32_t block = -1;
  std::int32_t seat = -1;    ///< in the block
  double stable_step = 0.0;  ///< [s]
  double speed = 0.0;        ///< [m/s] largest relative speed to a near partner
};

/// Working space of the fine pass, kept from step to step.
struct FineSpace {
  std::vector<FineState> state;      ///< by fine grain
  std::vector<Outlook> outlook;      ///< by watched entry
  std::vector<std::int32_t> active;  ///< fine grains with a near partner
  std::vector<Block> blocks;
  std::size_t block_count = 0;  ///< of `blocks` in use
};

}  // namespace dust::particles
