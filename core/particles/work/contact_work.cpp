// SPDX-License-Identifier: Apache-2.0
#include "particles/work/contact_work.hpp"

#include "particles/store/reorder_rows.hpp"

namespace dust::particles {

void ContactWork::begin(std::size_t walls, std::size_t particles) {
  is_on_ = true;
  walls_ = walls;
  of_rows_.assign(particles, {});
  of_walls_.assign(walls * particles, {});
}

ContactWork::Energy ContactWork::sum(std::size_t row) const {
  Energy sum = with_particles(row);
  for (std::size_t wall = 0; wall < walls_; ++wall) {
    const Energy e = with_wall(row, wall);
    sum.normal += e.normal;
    sum.tangential += e.tangential;
  }
  return sum;
}

void ContactWork::clear() {
  std::fill(of_rows_.begin(), of_rows_.end(), OfRow{});
  std::fill(of_walls_.begin(), of_walls_.end(), Energy{});
}

void ContactWork::resize(std::size_t particles) {
  if (!is_on_) return;
  of_rows_.resize(particles);
  of_walls_.resize(walls_ * particles);
}

void ContactWork::reorder(std::span<const std::int32_t> order) {
  if (!is_on_) return;
  reorder_rows(of_rows_, order, 1);
  reorder_rows(of_walls_, order, walls_);
}

}  // namespace dust::particles
