// SPDX-License-Identifier: Apache-2.0
#include "coupling/stencils/own_sides.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>

namespace dust::coupling {

particles::GrainRows OwnSides::take(const particles::GrainRows& rows) {
  constexpr std::size_t k_rows = 512;
  if (bodies_ == nullptr || bodies_->is_empty()) return rows;
  position_.resize(4 * rows.count);
  const tbb::blocked_range<std::size_t> all(0, rows.count, k_rows);
  tbb::parallel_for(all, [&](const tbb::blocked_range<std::size_t>& range) {
    for (std::size_t row = range.begin(); row < range.end(); ++row) {
      const double* from = rows.position_of(row);
      double* to = position_.data() + 4 * row;
      const sdk::Vec3 place = bodies_->on_own_side({from[0], from[1], from[2]});
      for (int d = 0; d < 3; ++d) to[d] = place[d];
      to[3] = from[3];
    }
  });
  particles::GrainRows sided = rows;
  sided.position = position_.data();
  return sided;
}

}  // namespace dust::coupling
