// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "coupling/coupling_scene.hpp"
#include "coupling/self_disturbance/self_disturbance.hpp"
#include "coupling/stencils/face_stencils.hpp"

#include <array>

namespace dust::coupling {

/// Drag of a batch of particles as the fluid is given it, K [(1 + b) s - b s_0] for the slip s to
/// come and that of before, s_0: the tangent to a drag that grows as s^(1+b), so that the fluid is
/// not too late with it where drag is stiff; docs/theory/coupling.md, eq. (15).
struct LinearisedDrag {
  StencilBatch::Reals coefficient;    ///< [kg/s] K at s_0
  StencilBatch::Reals slope;          ///< [-] b = d ln K / d ln s, 0..1
  StencilBatch::Reals void_fraction;  ///< [-] around each: of its cell, or the mean over its cells
  std::array<char, StencilBatch::k_size> is_smooth;  ///< coupled through a SmoothKernel
};

/// Finds it from the slip of each particle with the fluid last seen at it.
class DragLinearisation {
 public:
  /// How the particles' cycle and the fluid's step follow each other decides which part of the
  /// coefficient is stable.
  enum class Order { fluid_first, overlapped };

  /// All are kept by reference. `initial_velocity` [m/s]: of the fluid, for new particles.
  DragLinearisation(const CouplingScene& scene, SelfDisturbance& self,
                    const Triple& initial_velocity, Order order);

  /// Of a batch, which is that of this `number`, for a fluid step of `step` [s].
  void evaluate(const ParticleBatch& batch, std::size_t number, double step, LinearisedDrag& drag);

 private:
  void find_slips(const ParticleBatch& batch, std::size_t number, double step, LinearisedDrag& drag,
                  DragColumns& columns);
  [[nodiscard]] double implicit_factor(double relaxations) const;

  const Lattice& lattice_;
  const sdk::VoidageRule& voidage_;
  const DragModel& drag_;
  const VoidFractionField& void_fraction_;
  SelfDisturbance& self_;
  ParticleStates& states_;
  Triple initial_velocity_;
  Order order_;
};

}  // namespace dust::coupling
