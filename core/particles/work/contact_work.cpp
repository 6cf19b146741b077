// SPDX-License-Identifier: Apache-2.0
#include "particles/work/contact_work.hpp"

#include "particles/store/reorder_rows.hpp"

namespace dust::particles {

void ContactWork::begin(std::size_t walls, std::size_t particles) {
  walls_ = walls;
  width_ = k_first_wall + 2 * walls;
  numbers_.assign(width_ * particles, 0.0);
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

void ContactWork::clear() { std::fill(numbers_.begin(), numbers_.end(), 0.0); }

void ContactWork::reorder(std::span<const std::int32_t> order) {
  if (is_on()) reorder_rows(numbers_, order, width_);
}

}  // namespace dust::particles
