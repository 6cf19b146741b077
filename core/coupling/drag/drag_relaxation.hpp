// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "coupling/drag/drag_look_ahead.hpp"
#include "coupling/drag/drag_model.hpp"
#include "coupling/fluid_state.hpp"
#include "coupling/force_models.hpp"
#include "coupling/particle_states.hpp"
#include "coupling/self_disturbance/self_disturbance.hpp"

#include <span>

namespace dust::coupling {

/// The action of the fluid on the particles: target velocity and rate of their relaxation,
/// dv/dt = rate (target - v) + g' + contacts / m; docs/theory/coupling.md, eq. (11).
class DragRelaxation {
 public:
  /// All are kept by reference.
  DragRelaxation(const DragModel& drag, const SelfDisturbance& self, ParticleStates& states,
                 sdk::Vec3 gravity);

  [[nodiscard]] sdk::Vec3 gravity() const { return gravity_; }
  /// Forces besides drag, kept by reference.
  void use(const ForceModels& forces) { forces_ = &forces; }

  /// Rows in the order of the cells lie anywhere: those of a batch are fetched at a time, while its
  /// faces are looked at.
  void fetch(const particles::GrainRows& grains, std::span<const std::int32_t> rows) const;

  /// For how long an action holds [s], and for how long the last one did; 0: there was none.
  struct Interval {
    double held = 0.0;
    double last_held = 0.0;
  };
  /// Writes the action on a batch. `columns` holds the void fractions, and is overwritten.
  void update(const ParticleBatch& batch, const FluidState& fluid, const SampledFlow& flow,
              const Interval& interval, DragColumns& columns);

 private:
  using Rows = std::span<const std::int32_t>;
  void begin(const ParticleBatch& batch, const SampledFlow& flow, DragColumns& columns) const;
  void look_ahead(const ParticleBatch& batch, const Interval& interval, const SampledFlow& flow,
                  DragColumns& columns, DragLookAhead& ahead);
  void relax_by_drag(const ParticleBatch& batch, const SampledFlow& flow, double held,
                     const DragLookAhead& ahead, const DragColumns& columns);
  void relax_by_forces(const ParticleBatch& batch, const FluidState& fluid, const SampledFlow& flow,
                       double held, const DragLookAhead& ahead, const DragColumns& columns);
  void act(const ParticleBatch& batch, std::size_t q, double drag_coefficient,
           const Triple& relative, double held, const ForceModels::Sums& sums);
  /// Part of the weight that the DEM's gravity is.
  [[nodiscard]] double weight_factor(double inverse_mass, double volume) const {
    return forces_ != nullptr ? forces_->weight_share(1.0 / inverse_mass, volume)
                              : 1.0 - drag_.properties().own().density * volume * inverse_mass;
  }
  /// K [kg/s] of the drag on particle q of the batch.
  [[nodiscard]] double drag_coefficient(const particles::GrainRows& grains, std::size_t row,
                                        const DragColumns& columns, std::size_t q) const {
    return drag_.coefficient(grains, row, columns.factor[q]) *
           drag_.factor_of_set(columns.void_fraction[q]) / self_.stress_factor(row);
  }

  const DragModel& drag_;
  const SelfDisturbance& self_;
  ParticleStates& states_;
  sdk::Vec3 gravity_;
  const ForceModels* forces_ = nullptr;
};

}  // namespace dust::coupling
