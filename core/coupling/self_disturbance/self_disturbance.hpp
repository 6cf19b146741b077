// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "coupling/coupling_scene.hpp"
#include "coupling/fluid_state.hpp"
#include "coupling/self_disturbance/disturbance_formulas.hpp"
#include "coupling/stencils/face_stencils.hpp"
#include "coupling/stencils/smooth_kernel.hpp"
#include "dust/sdk/boundary_condition.hpp"
#include "setup/setup.hpp"

#include <array>
#include <span>

namespace dust::coupling {

/// Correction of the undisturbed fluid: what a lone particle does to the fluid by itself, flow and
/// solids, is taken off what it sees (docs/theory/own_disturbance.md). The state per particle is
/// that of ParticleStates.
class SelfDisturbance {
 public:
  /// All are kept by reference.
  SelfDisturbance(scenario::DisturbanceCorrection mode, const CouplingScene& scene);

  /// What the boundaries of the domain are to a particle's flow; null where periodic.
  void use_boundaries(const std::array<const sdk::BoundaryCondition*, 6>& boundaries);

  /// Before the void fraction of `grains` is found: keeps their flows from now on if one of them
  /// may need it.
  void prepare(const particles::GrainRows& grains);
  /// Spreads the solids of large lone particles by their kernels, in place of the voidage rule.
  void spread_solids(const particles::GrainRows& grains);
  /// Decides whether what a particle does by itself is taken off in this fluid step of `step` [s],
  /// and finds it. `eps` is the void fraction of its cell, and becomes that of the others around.
  bool begin_step(const particles::GrainRows& grains, std::size_t row, double slip, double step,
                  SmoothKernel& kernel, double& eps);
  /// What the particles with a SmoothKernel see of the fluid, in place of what their eight faces
  /// show. `v`: their velocities.
  void sample(const ParticleBatch& batch, const FluidState& fluid, bool needs_stress,
              const std::array<StencilBatch::Reals, 3>& v, SampledFlow& sampled,
              DragColumns& columns);
  /// The flows at the end of the fluid step: what is left of them, and what was added.
  void end_step(double step);

  /// Drag with the stress of the own drag; docs/theory/own_disturbance.md, eq. (8).
  [[nodiscard]] double stress_factor(std::size_t row) const {
    return states_.is_smooth(row) ? 1.0 + states_.self_flow(row).self_stress : 1.0;
  }

 private:
  /// Part of the slip from which on what a particle makes is taken off [-].
  [[nodiscard]] double worth() const {
    return mode_ == scenario::DisturbanceCorrection::taken_off ? 0.0 : self_disturbance::k_worth;
  }
  [[nodiscard]] bool has_candidates(const particles::GrainRows& grains) const;
  [[nodiscard]] bool is_candidate(const particles::GrainRows& grains, std::size_t row) const;
  [[nodiscard]] double own_part(const particles::GrainRows& grains, std::size_t row, double eps,
                                double slip) const;
  [[nodiscard]] double own_weight(const particles::GrainRows& grains, std::size_t row) const;
  [[nodiscard]] double crowding(const particles::GrainRows& grains, std::size_t row) const;
  void find_own_solids(const particles::GrainRows& grains, std::size_t row,
                       const SmoothKernel& kernel);
  void find_self_flow(const particles::GrainRows& grains, std::size_t row,
                      const SmoothKernel& kernel, double eps, double slip, double step);
  void look_at_kernel(const double* position, const SmoothKernel& kernel, const FluidState& fluid,
                      bool needs_stress, SelfFlow::Seen& seen) const;
  [[nodiscard]] double concentration_seen(const particles::GrainRows& grains, std::size_t row,
                                          const SelfFlow& own, const SmoothKernel& kernel) const;
  [[nodiscard]] double beside_walls(const particles::GrainRows& grains, std::size_t row,
                                    const NearWalls::Wall* wall, int d, double k) const;

  scenario::DisturbanceCorrection mode_;
  const Lattice& lattice_;
  const sdk::VoidageRule& voidage_;
  const DragModel& drag_;
  const FaceVoidFraction& face_void_;
  VoidFractionField& void_fraction_;
  ParticleStates& states_;
  /// What the boundaries of the domain are to a particle's own flow, where not periodic.
  std::array<self_disturbance::Side, 6> sides_;
  double least_spacing_;  ///< [m]
  double mean_spacing_;   ///< [m] edge of the cube of a cell's volume
};

}  // namespace dust::coupling
