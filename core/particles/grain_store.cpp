// SPDX-License-Identifier: Apache-2.0
#include "particles/grain_store.hpp"

#include <cstring>

namespace dust::particles {
namespace {

template <class Vector>
void reorder_rows(Vector& rows, std::span<const std::int32_t> order, std::size_t width) {
  Vector sorted(order.size() * width);
  for (std::size_t n = 0; n < order.size(); ++n) {
    std::memcpy(sorted.data() + n * width, rows.data() + static_cast<std::size_t>(order[n]) * width,
                width * sizeof(sorted[0]));
  }
  rows.swap(sorted);
}

}  // namespace

void GrainStore::resize(std::size_t count) {
  for (auto* rows : {&position, &start}) rows->resize(4 * count, 0.0);
  for (auto* rows : {&motion, &spin}) rows->resize(k_motion_stride * count, 0.0);
  start_velocity.resize(4 * count, 0.0F);
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
  for (auto* rows : {&position, &start}) reorder_rows(*rows, order, 4);
  for (auto* rows : {&motion, &spin}) reorder_rows(*rows, order, k_motion_stride);
  reorder_rows(start_velocity, order, 4);
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
