// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "coupling/stencils/face_kernels.hpp"
#include "fluid/grid.hpp"

#include <array>

namespace dust::coupling {

/// The fluid as particles are to see it.
struct FluidState {
  const fluid::FaceField& velocity;
  const fluid::FaceField& stress_divergence;
  /// With filled halo; null where pressure and viscous stress need not be told apart.
  const fluid::CellField* pressure = nullptr;
  double time = 0.0;  ///< [s] now, for walls that move
  double held = 0.0;  ///< [s] until the next refresh; 0 = Coupling::refresh_interval
};

/// What the faces around a batch of particles show of it, as columns.
struct SampledFlow {
  std::array<StencilBatch::Reals, 3> slip;    ///< [m/s] interstitial
  std::array<StencilBatch::Reals, 3> ratio;   ///< [-] of the drag on the particle to the law's
  std::array<StencilBatch::Reals, 3> stress;  ///< [N/m3]
};

}  // namespace dust::coupling
