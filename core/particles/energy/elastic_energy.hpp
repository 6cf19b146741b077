// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contact/batch.hpp"
#include "particles/pair_law_table.hpp"

#include <cstddef>

namespace dust::particles {

/// Energy [J] that the springs of a contact hold.
struct ElasticEnergy {
  double normal, friction;
};
/// Of contact q of a batch whose laws have been evaluated, from its force, overlap and stiffness;
/// docs/theory/energy.md, eq. (5). Zeros where it does not touch.
ElasticEnergy elastic_energy(const PairLaws& law, contact::BatchColumns& columns, std::size_t q);

}  // namespace dust::particles
