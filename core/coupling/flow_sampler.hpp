// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "coupling/coupling_scene.hpp"
#include "coupling/fluid_state.hpp"
#include "coupling/self_disturbance/self_disturbance.hpp"
#include "coupling/stencils/face_stencils.hpp"

namespace dust::coupling {

/// Interpolates the fluid to the particles: slip, what the drag on a particle is of the law's,
/// stress.
class FlowSampler {
 public:
  /// All are kept by reference.
  FlowSampler(const CouplingScene& scene, SelfDisturbance& self);

  /// Models of forces need the stress in every momentum set.
  void sample_stress() { needs_stress_ = true; }

  /// A batch at its stencils, by the velocities now; sets the void fractions of `columns`.
  void sample(const ParticleBatch& batch, const FluidState& fluid, SampledFlow& flow,
              DragColumns& columns) const;

 private:
  bool sample_cells(const StencilBatch& here, std::size_t count, const FluidState& fluid,
                    SampledFlow& flow, DragColumns& columns) const;
  /// By particle, of one component: sums over its faces, their flux and the stress.
  struct ComponentColumns {
    FaceSumColumns sums;
    double* flux = nullptr;
    double* stress = nullptr;
  };
  void sample_multi_cell(const StencilBatch& here, int d, const FluidState& fluid, const double* v,
                         const ComponentColumns& out) const;

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
