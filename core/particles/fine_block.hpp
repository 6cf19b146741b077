// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "particles/impl.hpp"

#include <vector>

namespace dust::particles {

/// A fine grain out of its rows, and back; its mean force [N] over the last sub-step to `force`.
Member load_member(const GrainStore& s, const contact::AlignedVector<double>& gravity,
                   std::size_t row);
/// A coarse grain that has made its step, for a block whose sub-steps last `sub_step` [s].
Member load_guest(const Dem::Impl& dem, std::int32_t row, double sub_step);
void store_member(GrainStore& s, const Member& m, double* force);

/// Takes the members of a block through the coarse step that begins at `now` [s], in the sub-steps
/// of its level.
void run_block(Dem::Impl& dem, Block& block, double now);

}  // namespace dust::particles
