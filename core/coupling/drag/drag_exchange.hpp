// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "coupling/drag/drag_linearisation.hpp"
#include "coupling/particle_states.hpp"
#include "coupling/stencils/face_stencils.hpp"
#include "coupling/stencils/face_void_fraction.hpp"
#include "coupling/stencils/lattice.hpp"
#include "coupling/stencils/multi_cell_kernel.hpp"
#include "coupling/stencils/smooth_kernel.hpp"
#include "fluid/momentum_set.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace dust::coupling {

class StressBalance;

/// Coefficient and source of each face from the grains around it. A grain with drag coefficient K,
/// velocity v and weight W adds, at face f of component d with trilinear weight w_f,
///   coefficient += W w_f K eps_f / (a eps_c^2 V)
///   source      += W w_f K eps_f v / (a eps_c^2 V) + w_f residual / (e V step)
/// and for the tangent of the drag K (1 + b) in place of K, and source += W w_f K b s_0 / (a eps_c
/// V). a = sum(w open), e = sum(w open eps) over its eight faces, eps_c the void fraction of its
/// cell, V the cell volume. Grains larger than a cell act through all faces of the cells they are
/// spread over, those whose own disturbance is taken off through the faces of a SmoothKernel.
/// Derivation and what this conserves: docs/theory/coupling.md, eq. (5), (14), (16).
class DragExchange {
 public:
  /// In set III the fluid receives a density of force on the whole control volume, a_f V, in place
  /// of eps_f a_f V.
  DragExchange(const Lattice& lattice, const FaceVoidFraction& face_void,
               const sdk::VoidageRule& rule, fluid::MomentumSet set);

  /// Makes room for as many batches.
  void resize(std::size_t batches);
  /// What each particle of the batch of this `number` gives its faces, from the sums over these.
  /// Residuals reach the fluid thereby.
  void assemble(const ParticleBatch& particles, std::size_t number, const LinearisedDrag& drag,
                ParticleStates& states, const fluid::CellField& eps, double step);
  /// Adds up at the faces what the batches give, the residuals of the particles that are gone, and
  /// part of those of cells (null: there are none). Returns the number of force components without
  /// an open face.
  std::int64_t scatter(const FaceStencils& stencils, ParticleStates& states,
                       const fluid::CellField& eps, double step, StressBalance* stress);
  /// Writes the impulse that each particle's drag took from a fluid of this velocity
  /// (ParticleState::given), and compares the sum over the particles with that over the faces:
  /// returns |difference| / scale. `stencils` as assembled; `rows` of these particles by now, -1
  /// for those that are gone.
  double evaluate(const FaceStencils& stencils, std::span<const std::int32_t> rows,
                  ParticleStates& states, const fluid::CellField& eps,
                  const fluid::FaceField& velocity, double step);

  [[nodiscard]] const fluid::Exchange& exchange() const { return exchange_; }
  /// Force on the fluid per cell volume [N/m3], as evaluated.
  void per_cell(std::vector<float>& values) const;

 private:
  struct ActiveFace {
    std::ptrdiff_t face;
    double volume;  ///< [m3] of the face's control volume that the force's density acts on
    double force;   ///< [N] on the fluid, once evaluated
  };
  /// One particle's of the FaceContributions; zero if it finds no open face.
  struct Contribution {
    double drag = 0.0, push = 0.0, extra = 0.0;
  };
  /// What a batch gives, and sums over it that are added up in the order of the batches.
  struct BatchContributions {
    std::array<FaceContributions, 3> component;
    std::array<char, StencilBatch::k_size> is_smooth;  ///< as LinearisedDrag
    std::int64_t unpaired = 0;
    bool has_multi_cell = false;  ///< particles larger than a cell
    bool has_smooth = false;      ///< particles with a SmoothKernel
    Triple released{};
    Triple given{};  ///< [N s] weight included
    Triple size{};   ///< [N s] sum of the magnitudes
  };
  using Impulses = std::array<StencilBatch::Reals, 3>;
  /// What the contributions of a batch are made of.
  struct BatchInputs {
    StencilBatch::Reals coefficient;  ///< of all components
    std::array<ContributionInputs, 3> component;
  };
  /// What took up the drag of a step.
  struct FluidAfter {
    const fluid::CellField& eps;
    const fluid::FaceField& velocity;
    double impulse = 0.0;  ///< [m3 s] step times the volume of a cell
  };

  void begin_batch(const ParticleBatch& particles, const LinearisedDrag& drag,
                   const ParticleStates& states, double step, BatchInputs& inputs,
                   BatchContributions& batch) const;
  void sum_multi_cell(const StencilBatch& stencils, int d, const fluid::CellField& eps,
                      ContributionInputs& input) const;
  void assemble_smooth(const ParticleBatch& particles, const LinearisedDrag& drag,
                       const ParticleStates& states, std::array<ContributionInputs, 3>& inputs,
                       BatchContributions& batch) const;
  void release(std::span<const std::int32_t> rows, const std::array<ContributionInputs, 3>& inputs,
               ParticleStates& states, BatchContributions& batch) const;
  void scatter_component(int d, const FaceStencils& stencils, const fluid::CellField& eps);
  void scatter_smooth(int d, const SmoothKernel& kernel, const Contribution& c);
  void scatter_groups(int d, const StencilBatch& stencils, const FaceContributions& contributions);
  template <class Faces>
  void scatter_one(int d, const Faces& faces, const Contribution& c);
  std::int64_t release_escaped(int d, ParticleStates& states, double step);
  void release_cells(int d, std::vector<double>& deferred, double step);
  void evaluate_batch(const StencilBatch& here, const FluidAfter& fluid, BatchContributions& batch,
                      Impulses& given) const;
  void evaluate_multi_cell(const StencilBatch& here, int d, const FluidAfter& after,
                           const BatchContributions& batch, Impulses& given) const;
  [[nodiscard]] double drag_through(int d, const SmoothKernel& kernel, const std::vector<double>& u,
                                    double velocity, double flux_difference) const;
  [[nodiscard]] double imbalance(const fluid::FaceField& velocity, double step);
  /// Adds to one face of this open share and void fraction what is weighted already.
  void add(int d, std::ptrdiff_t face, double open, double eps, const Contribution& weighted);
  void clear(int d);

  const Lattice& lattice_;
  const FaceVoidFraction& face_void_;
  const sdk::VoidageRule& rule_;
  fluid::MomentumSet set_;
  fluid::Exchange exchange_;
  std::array<std::vector<ActiveFace>, 3> active_;
  std::vector<BatchContributions> batches_;
  Triple released_{};  ///< [N s] residuals in the source
};

}  // namespace dust::coupling
