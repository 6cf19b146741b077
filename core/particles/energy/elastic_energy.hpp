// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contact/batch.hpp"
#include "particles/pair_law_table.hpp"

#include <cstddef>

namespace dust::particles {

/// Energy [J] that the springs of each contact of a batch hold; zeros where it does not touch.
struct ElasticEnergy {
  double normal[contact::k_batch];
  double friction[contact::k_batch];
};

/// From force, overlap and stiffness of a batch whose laws have been evaluated;
/// docs/theory/energy.md, eq. (5).
void find_elastic_energy(const PairLaws& law, contact::BatchColumns& columns, std::size_t count,
                         ElasticEnergy& out);

}  // namespace dust::particles
