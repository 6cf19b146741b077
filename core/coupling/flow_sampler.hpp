// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "coupling/drag/drag_model.hpp"
#include "coupling/fluid_state.hpp"
#include "coupling/particle_states.hpp"
#include "coupling/self_disturbance/self_disturbance.hpp"
#include "coupling/stencils/face_void_fraction.hpp"
#include "coupling/stencils/lattice.hpp"
#include "coupling/void_fraction_field.hpp"

#include <span>

namespace dust::coupling {

/// Interpolates the fluid to the particles: slip, what the drag on a particle is of the law's,
/// stress.
class FlowSampler {
 public:
  /// All are kept by reference.
  FlowSampler(const Lattice& lattice, const sdk::VoidageRule& voidage, fluid::MomentumSet set,
              const VoidFractionField& void_fraction, const FaceVoidFraction& face_void,
              SelfDisturbance& self, const ParticleStates& states);

  /// Models of forces need the stress in every momentum set.
  void sample_stress() { needs_stress_ = true; }

  /// A batch at its stencils `here`, by the velocities now; sets the void fractions of `columns`.
  void sample(const particles::GrainRows& grains, std::span<const std::int32_t> rows,
              const StencilBatch& here, const FluidState& fluid, SampledFlow& flow,
              DragColumns& columns) const;

 private:
  bool sample_cells(const StencilBatch& here, std::size_t count, const FluidState& fluid,
                    SampledFlow& flow, DragColumns& columns) const;
  void sample_wide(const StencilBatch& here, int d, const FluidState& fluid, const double* v,
                   const FaceSumColumns& sums, double* flux, double* stress) const;

  const Lattice& lattice_;
  const sdk::VoidageRule& voidage_;
  fluid::MomentumSet set_;
  const VoidFractionField& void_fraction_;
  const FaceVoidFraction& face_void_;
  SelfDisturbance& self_;
  const ParticleStates& states_;
  bool needs_stress_;
};

}  // namespace dust::coupling
