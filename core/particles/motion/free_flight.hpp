// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "particles/motion/motion_rows.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace dust::particles {

/// `count` steps of `step` [s] at once for those of particles [begin, end) whose `activity` is
/// zero: they have felt no contact. docs/theory/grains.md, eq. (14).
void advance_free_flight(const MotionRows& rows, std::span<const std::uint8_t> activity,
                         std::size_t begin, std::size_t end, double step, std::int64_t count);

}  // namespace dust::particles
