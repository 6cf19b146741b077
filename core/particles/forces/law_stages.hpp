// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contact/batch.hpp"
#include "particles/pair_law_table.hpp"

#include <cstddef>
#include <cstdint>

namespace dust::particles {

/// All stages of a pair's laws on one batch, from the overlaps to the torques. The columns of
/// history stand in the order contact, rolling, cohesion.
void evaluate_laws(const PairLaws& law, contact::BatchColumns& columns, std::size_t count,
                   double time_step);

/// Pairs of a batch that touch; the others are within the range of cohesion.
std::int64_t in_touch(contact::BatchColumns& columns, std::size_t count);

/// Batch scratch of the calling thread.
contact::BatchColumns& thread_columns();

}  // namespace dust::particles
