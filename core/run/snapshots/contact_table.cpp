// SPDX-License-Identifier: Apache-2.0
#include "run/snapshots/contact_table.hpp"

namespace dust::run {

void ContactTable::publish(const std::vector<particles::ContactRecord>& records,
                           std::span<const std::size_t> order) {
  place_.resize(order.size());
  for (std::size_t n = 0; n < order.size(); ++n) place_[order[n]] = static_cast<std::int32_t>(n);
  const std::size_t count = records.size();
  grain_i_.resize(count);
  grain_j_.resize(count);
  overlap_.resize(count);
  for (int d = 0; d < 3; ++d) {
    force_[d].resize(count);
    branch_[d].resize(count);
    wall_velocity_[d].resize(count);
  }
  for (std::size_t n = 0; n < count; ++n) {
    const particles::ContactRecord& r = records[n];
    grain_i_[n] = place_[static_cast<std::size_t>(r.row_i)];
    grain_j_[n] = r.row_j < 0 ? -1 : place_[static_cast<std::size_t>(r.row_j)];
    overlap_[n] = r.overlap;
    for (int d = 0; d < 3; ++d) {
      force_[d][n] = r.force[d];
      branch_[d][n] = r.branch[d];
      wall_velocity_[d][n] = r.wall_velocity[d];
    }
  }
}

sdk::ContactColumns ContactTable::columns() const {
  sdk::ContactColumns c;
  c.grain_i = grain_i_;
  c.grain_j = grain_j_;
  c.force_x = force_[0];
  c.force_y = force_[1];
  c.force_z = force_[2];
  c.branch_x = branch_[0];
  c.branch_y = branch_[1];
  c.branch_z = branch_[2];
  c.overlap = overlap_;
  c.wall_velocity_x = wall_velocity_[0];
  c.wall_velocity_y = wall_velocity_[1];
  c.wall_velocity_z = wall_velocity_[2];
  return c;
}

}  // namespace dust::run
