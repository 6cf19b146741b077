// SPDX-License-Identifier: Apache-2.0
#include "particles/store/particle_domain.hpp"

#include <cmath>
#include <limits>

namespace dust::particles {

ParticleDomain::ParticleDomain(const scenario::Setup& setup)
    : min_(setup.domain.min), max_(setup.domain.max) {
  for (std::size_t side = 0; side < sides_.size(); ++side) {
    sides_[side] = setup.domain.sides[side].grains;
  }
  for (int d = 0; d < 3; ++d) {
    images_.half[d] = std::numeric_limits<double>::infinity();
    if (sides_[static_cast<std::size_t>(2 * d)] == scenario::GrainSide::periodic) {
      is_periodic_ = true;
      images_.length[d] = max_[d] - min_[d];
      images_.half[d] = 0.5 * images_.length[d];
    }
  }
}

void ParticleDomain::wrap(ParticleStore& particles) const {
  if (!is_periodic_) return;
  for (std::size_t n = 0; n < particles.size(); ++n) {
    for (int d = 0; d < 3; ++d) {
      double& x = particles.position(n)[d];
      if (images_.length[d] > 0.0) {
        if (x < min_[d]) x += images_.length[d];
        if (x >= max_[d]) x -= images_.length[d];
      }
    }
  }
}

ParticleDomain::Place ParticleDomain::place_of(const double* p) const {
  Place found;
  for (int d = 0; d < 3; ++d) {
    const bool below = p[d] < min_[d];
    const bool above = p[d] > max_[d];
    if (!below && !above && std::isfinite(p[d])) continue;
    const auto side = static_cast<std::size_t>(2 * d + (above ? 1 : 0));
    if (sides_[side] == scenario::GrainSide::wall) {
      const double depth = above ? p[d] - max_[d] : min_[d] - p[d];
      if (!(depth <= p[3])) return {Where::lost, side};
    }
    if (sides_[side] == scenario::GrainSide::open) found = {Where::escaped, side};
  }
  return found;
}

}  // namespace dust::particles
