// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "coupling/drag/drag_model.hpp"
#include "coupling/fluid_state.hpp"
#include "coupling/particle_states.hpp"
#include "coupling/stencils/lattice.hpp"
#include "dust/sdk/archive.hpp"
#include "dust/sdk/fluid_force.hpp"
#include "fluid/momentum_set.hpp"
#include "fluid/properties.hpp"
#include "particles/grain_rows.hpp"
#include "particles/surfaces.hpp"

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace dust::coupling {

/// The models of the forces besides drag, and what they need to know.
class ForceModels {
 public:
  static constexpr std::size_t k_batch = 256;  ///< grains per call

  /// Sums over the models for a batch of grains.
  struct Sums {
    std::array<Triple, k_batch> contained;  ///< [N] balanced by the momentum set, or by a wall
    std::array<Triple, k_batch> returned;   ///< [N] the fluid receives the opposite
    std::array<Triple, k_batch> kept;       ///< [N/m3] of the stress, not taken over by a model
    std::array<Triple, k_batch> contact;    ///< [m/s2] mean acceleration by contacts, last interval
    std::array<Triple, k_batch> normal;     ///< [-] of the nearest wall
    std::array<double, k_batch> wall_speed;  ///< [m/s] along the normal
    std::array<double, k_batch> added_mass;  ///< [kg]
    std::array<double, k_batch> resistance;  ///< [kg/s] along the normal
  };
  /// What the coupling has found already.
  struct Batch {
    std::span<const std::int32_t> rows;
    const double* void_fraction = nullptr;
    sdk::VectorColumns slip{};    ///< [m/s]
    sdk::VectorColumns stress{};  ///< [N/m3] -grad p + div tau, in every set
  };

  /// `lattice` and `drag` are kept by reference.
  ForceModels(std::span<const std::unique_ptr<sdk::FluidForce>> models,
              std::vector<particles::Surface> surfaces, const Lattice& lattice,
              const DragModel& drag, sdk::Vec3 gravity);

  /// Forces that the models give in place of the core.
  [[nodiscard]] const sdk::FluidForceParts& taken() const { return taken_; }
  /// Numbers per grain that ParticleStates holds.
  [[nodiscard]] std::size_t state_columns() const { return width_; }

  /// Before the batches of a refresh: puts moving walls in place.
  void begin(const FluidState& fluid, double step, bool is_first);
  /// May run at the same time for other batches.
  void evaluate(const particles::GrainRows& grains, const Batch& batch, const FluidState& fluid,
                double held, ParticleStates& memory, Sums& sums) const;
  /// After them: the fluid of this refresh is the last one seen.
  void end(const FluidState& fluid);
  /// The coupling has set the impulse of `row` from `received` to zero.
  void impulse_was_read(ParticleStates& memory, std::size_t row, const double* received) const;
  /// Weight of a grain in the fluid as the DEM has it [m/s2], by buoyancy of the own fluid.
  [[nodiscard]] double weight_share(double mass, double volume) const;

  void save(sdk::ArchiveWriter& archive) const;
  void load(sdk::ArchiveReader& archive);

 private:
  struct Columns;
  void gather(const particles::GrainRows& grains, const Batch& batch, const FluidState& fluid,
              ParticleStates& memory, Columns& c) const;
  void begin_sums(const particles::GrainRows& grains, const Batch& batch, double held,
                  const Columns& c, ParticleStates& states, Sums& sums) const;
  [[nodiscard]] sdk::FluidForceBatch batch_for(const sdk::FluidForce& model, const Batch& batch,
                                               double held, Columns& c) const;
  void add_to_sums(const sdk::FluidForce& model, const particles::GrainRows& grains,
                   const Batch& batch, const Columns& c, Sums& sums) const;
  void find_wall(sdk::Vec3 centre, double radius, double time, std::size_t n, Columns& c) const;
  void note_contact(const particles::GrainRows& grains, std::size_t row, double held,
                    double* numbers, Triple& acceleration) const;
  [[nodiscard]] sdk::Vec3 velocity_at(sdk::Vec3 place, const fluid::FaceField& u) const;
  /// Columns of the velocity gradient: derivative along x, y, z.
  [[nodiscard]] std::array<sdk::Vec3, 3> gradient_at(sdk::Vec3 place,
                                                     const fluid::FaceField& u) const;

  std::vector<const sdk::FluidForce*> models_;
  std::vector<particles::Surface> surfaces_;
  const Lattice& lattice_;
  const fluid::Properties& properties_;
  sdk::Vec3 gravity_;
  fluid::MomentumSet set_;
  const CoarseGraining& graining_;
  sdk::FluidForceNeeds needs_;
  sdk::FluidForceParts taken_;
  std::size_t width_ = 0;
  double step_ = 0.0;               ///< [s] of the fluid
  bool is_first_ = false;           ///< refresh of this fluid step
  fluid::FaceField last_velocity_;  ///< of the fluid step before; empty: none yet
};

}  // namespace dust::coupling
