// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contact/batch.hpp"
#include "contact/batch_kernels.hpp"
#include "particles/forces/pair_batch.hpp"
#include "particles/pair_law_table.hpp"

#include <cstddef>
#include <span>

namespace dust::particles {

/// What each contact of a batch dissipates in a step [J].
struct Dissipation {
  double normal[contact::k_batch];
  double tangential[contact::k_batch];
};

/// From a batch whose laws have been evaluated: the work that the contact does on its sides, less
/// what is stored in it (find_elastic_energy), D = -int F.v dt - U: dissipated is what the contact
/// cannot give back. What D has grown by is handed out, so that a whole collision hands out the
/// kinetic energy that it has cost. Work that is not handed out yet stands in the history of the
/// contact, in columns `first` and the next. docs/theory/dust.md, eq. (6), (7).
void find_dissipation(const PairLaws& law, contact::BatchColumns& columns, std::size_t count,
                      double step, std::size_t first, Dissipation& out);

/// Adds half of it to each side, as k_normal_work and k_tangential_work of the rows of forces;
/// where statistical weights differ (`has_scales`), the share of its half that goes with the share
/// of the force that the side feels: the work per real grain. `slots` by entry of the batch's list.
void scatter_dissipation(const Dissipation& out, const PairBatch& batch,
                         std::span<const contact::Places> slots, bool has_scales, double* force);

}  // namespace dust::particles
