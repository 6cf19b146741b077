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

/// A grain while it is sub-cycled: a fine one, or a coarse one that fine ones are near (a guest),
/// which has made its coarse step and is followed along it once more, with their impulses.
struct Member {
  std::int32_t row = 0;
  bool is_guest = false;
  double radius = 0.0, inverse_mass = 0.0, weight = 1.0, rate = 0.0;
  sdk::Vec3 position, velocity, rotation, half_velocity, half_rotation, target, gravity, received;
  double lag = 0.0;
  sdk::Vec3 displacement, angle;  ///< [m], [rad] of the last sub-step
  sdk::Vec3 impulse, twist;       ///< of the contacts in this sub-step
  double kick = -1.0, decay = 1.0, phi = 1.0;
  sdk::Vec3 force;

  // Of a guest.
  sdk::Vec3 course, course_rotation;  ///< [m/s], [rad/s] over the step without fine grains
  sdk::Vec3 slow_kick, slow_twist;    ///< what its own step has added to them
  sdk::Vec3 shift, turn;              ///< [m], [rad] what fine grains have added to the step
};

/// A contact candidate of a block.
struct Candidate {
  std::int32_t entry = 0;  ///< in the fine list
  std::int32_t member = 0;
  std::int32_t partner = -1;  ///< member, or -1
  std::int32_t surface = -1;
  std::int32_t law = 0;
};

/// Clusters of one level that step together.
struct Block {
  std::vector<Member> members;
  std::vector<Candidate> candidates;
  int level = 0;
  std::int64_t guests = 0;  ///< of the members
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
  std::int32_t seat = -1;        ///< in the block
  std::int32_t least_level = 0;  ///< that of a contact under way: it keeps its step
  double stable_step = 0.0;      ///< [s]
  double speed = 0.0;            ///< [m/s] largest relative speed to a near partner
};

/// A coarse grain that a cluster is near.
struct Guest {
  std::int32_t cluster = 0;
  std::int32_t row = 0;
  std::int32_t seat = -1;  ///< in the cluster's block
};

/// Working space of the fine pass, kept from step to step.
struct FineSpace {
  std::vector<FineState> state;      ///< by fine grain
  std::vector<Outlook> outlook;      ///< by watched entry
  std::vector<std::int32_t> active;  ///< fine grains with a near partner
  std::vector<Guest> guests;         ///< by cluster and row, each once
  /// By coarse row: a fine grain whose cluster it belongs to, with all else that is near it; or -1.
  std::vector<std::int32_t> host;
  std::vector<Block> blocks;
  std::size_t block_count = 0;  ///< of `blocks` in use
};

}  // namespace dust::particles
