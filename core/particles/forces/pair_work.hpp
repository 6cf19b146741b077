// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "particles/forces/contact_forces.hpp"
#include "particles/forces/pair_batch.hpp"

#include <cstddef>
#include <cstdint>

/// The energy account of contacts between particles.
namespace dust::particles {

/// Of a batch, after the laws; the histories stand in the columns.
void record_work(const ContactScene& scene, const PairBatch& batch, EnergySums& sums);
/// Of pairs that part in this step: the search for those that touch clears their histories.
void record_separated(const ContactScene& scene, const LawRange& range,
                      const contact::PairView& pairs, EnergySums& sums);

}  // namespace dust::particles
