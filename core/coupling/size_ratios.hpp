// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "coupling/coarse_graining.hpp"
#include "coupling/particle_states.hpp"
#include "coupling/stencils/lattice.hpp"
#include "particles/grain_rows.hpp"

#include <array>
#include <vector>

namespace dust::coupling {

/// Diameter of each particle over the Sauter mean of those in its cell, for laws that ask.
class SizeRatios {
 public:
  explicit SizeRatios(const Lattice& lattice) : lattice_(lattice) {}

  /// Writes them to the states; summed in the order of the particles.
  void find(const particles::GrainRows& grains, const CoarseGraining& graining,
            ParticleStates& states);

 private:
  [[nodiscard]] std::size_t cell_of(const double* position) const;

  const Lattice& lattice_;
  std::vector<std::array<double, 2>> sums_;  ///< per cell W D^3 and W D^2
};

}  // namespace dust::coupling
