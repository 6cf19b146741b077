// SPDX-License-Identifier: Apache-2.0
#include "particles/neighbours/active_set.hpp"

#include "particles/neighbours/reference_trajectories.hpp"

#include <algorithm>
#include <cmath>

namespace dust::particles {

void ActiveSet::clear() {
  rows_.clear();
  reference_.clear();
  unshared_ = 0;
}

void ActiveSet::add(const ParticleStore& particles, std::size_t row, double skin) {
  rows_.push_back(static_cast<std::int32_t>(row));
  const double* p = particles.position(row);
  const double* v = particles.velocity(row);
  reference_.push_back(
      {{p[0], p[1], p[2]},
       {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])},
       static_cast<float>(skin)});
}

ActiveSet::Check ActiveSet::check(const ParticleStore& particles, double t, double ahead) const {
  Check found;
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const auto n = static_cast<std::size_t>(rows_[k]);
    const double* p = particles.position(n);
    const double* v = particles.velocity(n);
    const Reference& reference = reference_[k];
    double off2 = 0.0;
    double next2 = 0.0;
    for (int d = 0; d < 3; ++d) {
      const double off = p[d] - reference.position[d] - t * reference.velocity[d];
      const double next = off + ahead * (v[d] - reference.velocity[d]);
      off2 += off * off;
      next2 += next * next;
    }
    const double skin2 = static_cast<double>(reference.skin) * reference.skin;
    found.is_skin_used_up =
        found.is_skin_used_up ||
        std::max(off2, next2) > Deviation::k_trigger * Deviation::k_trigger * skin2;
    if (!std::isfinite(off2)) {
      found.not_a_number = rows_[k];
      return found;
    }
  }
  return found;
}

}  // namespace dust::particles
