// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "particles/motion/motion_rows.hpp"
#include "particles/store/tile.hpp"

#include <cstdint>
#include <span>

namespace dust::particles {

/// One step of the leapfrog of `step` [s], kick and drift; docs/theory/grains.md, eq. (6) to (8).
/// Forces and torques are rows of eight numbers; what is taken leaves zeros.
///
/// All particles of a tile, `force` in the order of rows.
void integrate_tile(const MotionRows& rows, Tile tile, double* force, double step);
/// The particles named, `force` in the order of the rows of the tile.
void integrate_in_tile(const MotionRows& rows, Tile tile, std::span<const std::int32_t> particles,
                       double* force, double step);
/// The particles named, `force` in their order.
void integrate_in_order(const MotionRows& rows, std::span<const std::int32_t> particles,
                        double* force, double step);
/// The particles named, without forces.
void integrate_without_force(const MotionRows& rows, std::span<const std::int32_t> particles,
                             double step);

}  // namespace dust::particles
