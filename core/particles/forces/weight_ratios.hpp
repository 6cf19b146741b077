// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contact/batch.hpp"
#include "contact/batch_kernels.hpp"
#include "particles/store/particle_store.hpp"

#include <cstddef>
#include <cstdint>

namespace dust::particles {

/// What statistical weights do to a batch of pairs (docs/theory/rare_grains.md): the share of the
/// force that each side feels, in scale_i and scale_j, and where the two differ the inverse masses
/// that the laws see. `contacts`: entries of `pairs` in the batch; null: those from `first` on.
/// Returns whether the weights of any pair differ.
bool find_weight_ratios(const ParticleStore& particles, const contact::PairView& pairs,
                        const std::int32_t* contacts, std::size_t first, std::size_t count,
                        contact::BatchColumns& columns);

}  // namespace dust::particles
