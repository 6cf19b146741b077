// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contact/batch.hpp"

#include <cstddef>
#include <cstdint>

namespace dust::contact {

/// Doubles from one grain's velocity to the next: the velocity of the instant and that of the last
/// step's way stand in one line of the cache, because a contact wants both.
inline constexpr std::size_t k_motion_stride = 8;

/// Rows of all grains: of four doubles, and two such in turn.
struct RowView {
  const double* position = nullptr;  ///< x, y, z, radius
  /// Velocity of the instant, 1 / mass, velocity of the last step's way, half of its time.
  const double* motion = nullptr;
  const double* spin = nullptr;  ///< the same of the rotation; fourth and eighth radius
};

/// Minimum image along periodic directions; elsewhere half is infinite, so that nothing is shifted.
struct Images {
  double length[3] = {0, 0, 0};
  double half[3] = {0, 0, 0};
};

/// Pairs of grains with what belongs to a pair, row by row.
struct PairView {
  const std::int32_t* a = nullptr;  ///< rows of side i
  const std::int32_t* b = nullptr;  ///< rows of side j
  std::uint8_t* is_touching = nullptr;
  double* history = nullptr;
  std::size_t history_stride = 0;  ///< a multiple of 4
  std::size_t count = 0;
};

/// Pairs that are looked at, and closer than touch + `range` [m] taken.
struct GatherInput {
  const RowView& rows;
  const Images& images;
  const PairView& pairs;
  double range = 0.0;
};

/// Rows of a tile's force buffer where what a pair does to its two sides is gathered.
struct Places {
  std::int32_t a = 0;
  std::int32_t b = 0;
};

/// Rows up to the padded count repeat the last one, in the columns from `first` to `last`.
void repeat_last(BatchColumns& columns, std::size_t count, int first, int last);

/// Finds pairs from entry `next` up to `end` that are near enough until a batch is full, loads them
/// into the first columns and writes their numbers to `contacts` (k_batch of them); rows up to the
/// padded count repeat the last one. Moves `next` on and returns how many. A pair that parts loses
/// its history. Brings near, too, what load_history and the next batch want.
std::size_t gather_touching(const GatherInput& in, std::size_t& next, std::size_t end,
                            std::int32_t* contacts, BatchColumns& columns);

/// Overlap, normal, effective radius and mass, lever arms, the relative velocity of the contact
/// point and its displacement since the last look, or since the two began to touch in between, from
/// what gather_touching wrote. Returns the largest overlap / smaller radius [-].
double derive_pair_columns(BatchColumns& columns, std::size_t count);

/// Of contacts that have begun within the last step, takes off displacement and angle what lies
/// before the touch. Done by derive_pair_columns.
void cut_first_displacements(BatchColumns& columns, std::size_t count);

/// How fast the sides of each pair part, for the cohesion stage.
void derive_normal_velocity(BatchColumns& columns, std::size_t count);

/// Takes the attraction of the cohesion stage from the forces, along the normals.
void subtract_attraction(BatchColumns& columns, std::size_t count);

/// Torques about the centres: force at the lever arms plus the rolling couple.
void derive_torques(BatchColumns& columns, std::size_t count, bool has_couple);

/// History rows <-> columns; `groups` of four columns.
void load_history(const PairView& pairs, const std::int32_t* contacts, std::size_t count,
                  int groups, BatchColumns& columns);
void store_history(const PairView& pairs, const std::int32_t* contacts, std::size_t count,
                   int groups, BatchColumns& columns);

/// Adds forces and torques to rows of eight doubles; `places` stand in the order of the list.
void scatter_pairs(const Places* places, const std::int32_t* contacts, std::size_t count,
                   bool has_scales, BatchColumns& columns, double* force);
/// The same for contacts that stand in the order of `places`.
void scatter_pairs(const Places* places, std::size_t count, bool has_scales, BatchColumns& columns,
                   double* force);
/// The same for surfaces: only side i receives.
void scatter_single(const std::int32_t* local_rows, std::size_t count, BatchColumns& columns,
                    double* force);

}  // namespace dust::contact
