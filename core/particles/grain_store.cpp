// SPDX-License-Identifier: Apache-2.0
#include "particles/grain_store.hpp"

#include "particles/reorder_rows.hpp"

namespace dust::particles {
void GrainStore::resize(std::size_t count) {
  position.resize(4 * count, 0.0);
  for (auto* rows : {&motion, &spin}) rows->resize(k_motion_stride * count, 0.0);
  if (has_fluid) {
    action.resize(4 * count, 0.0);
    impulse.resize(4 * count, 0.0);
    decay.resize(2 * count, 1.0);
  }
  id.resize(count);
  material.resize(count);
  population.resize(count);
  weight.resize(count, 1.0);
}

void GrainStore::reorder(std::span<const std::int32_t> order) {
  reorder_rows(position, order, 4);
  for (auto* rows : {&motion, &spin}) reorder_rows(*rows, order, k_motion_stride);
  if (has_fluid) {
    reorder_rows(action, order, 4);
    reorder_rows(impulse, order, 4);
    reorder_rows(decay, order, 2);
  }
  reorder_rows(id, order, 1);
  reorder_rows(material, order, 1);
  reorder_rows(population, order, 1);
  reorder_rows(weight, order, 1);
}

}  // namespace dust::particles
