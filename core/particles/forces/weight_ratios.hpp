// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "particles/forces/pair_batch.hpp"
#include "particles/store/particle_store.hpp"

namespace dust::particles {

/// What statistical weights do to a batch of pairs (docs/theory/rare_grains.md): the share of the
/// force that each side feels, in scale_i and scale_j, and where the two differ the inverse masses
/// that the laws see. Returns whether the weights of any pair differ.
bool find_weight_ratios(const ParticleStore& particles, const PairBatch& batch);

}  // namespace dust::particles
