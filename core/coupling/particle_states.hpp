// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "coupling/self_disturbance/disturbance_formulas.hpp"
#include "dust/sdk/archive.hpp"
#include "particles/grain_rows.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace dust::coupling {

using Triple = std::array<double, 3>;

/// What the coupling remembers of one grain.
struct ParticleState {
  // What a refresh needs stands together.
  Triple fluid_velocity{};  ///< [m/s] its own plus the slip, at the last refresh
  Triple velocity{};        ///< [m/s] its own, at the last refresh
  Triple stress_impulse{};  ///< [N s] of V_p (-grad p + div tau) so far in this fluid step
  double size_ratio = 1.0;  ///< diameter over the Sauter mean in its cell, at begin_step()
  bool has_velocity = false;
  std::array<bool, 3> is_paired{};  ///< the component's force found open faces at begin_step()
  std::int32_t stencil =
      -1;             ///< its number in the order of the cells, as last numbered; -1: was not there
  Triple given{};     ///< [N s] drag that the fluid was told to balance, weight included
  Triple place{};     ///< [m] at end_step()
  Triple deferred{};  ///< [N s] impulse the fluid has still to receive, weight included
};

/// What a grain does to the fluid by itself, while that is taken off.
struct SelfFlow {
  using Groups = std::array<double, self_disturbance::k_groups>;

  bool is_smooth =
      false;  ///< coupled through a SmoothKernel since begin_step(); else nothing is taken off
  bool is_beside = false;                                 ///< a side of the domain cuts its kernel
  std::array<Triple, self_disturbance::k_groups> flow{};  ///< [m/s] by the drag it has received
  Groups kept{};  ///< [-] share of the flow that is left after a fluid step
  /// [s/kg] flow that a fluid step adds along each axis, per force on the grain
  std::array<Triple, self_disturbance::k_groups> gained{};
  Triple released{};  ///< [N s] residual before begin_step(), which the fluid receives in this step
  double spread = 0.0;       ///< [-] of its solids, by the SmoothKernel and not by the voidage rule
  double excess = 0.0;       ///< [-] of its own solids and flow, over those of a lone grain
  Triple solids{};           ///< [-] its own at the faces of each component
  double self_stress = 0.0;  ///< [-] force by the stress of its own drag, over that drag

  /// What its faces showed when it was last looked at since begin_step(), and where that was: they
  /// are looked at again once it has gone on by part of a cell.
  struct Seen {
    bool is_valid = false;
    Triple place{};   ///< [m]
    Triple flux{};    ///< [m/s] void fraction times velocity
    Triple all{};     ///< [-] void fraction that goes with it
    Triple eps{};     ///< [-] void fraction of the open faces
    Triple stress{};  ///< [N/m3]
  };
  Seen seen;
};

/// Component d of what is taken off the fluid's velocity [m/s], to be added to the slip.
[[nodiscard]] inline double disturbance(const SelfFlow& own, std::size_t d) {
  double sum = 0.0;
  for (const Triple& part : own.flow) sum += part[d];
  return own.excess * sum;
}
/// Its own share of the solids at faces of the mean void fraction `eps`: no more than there are.
[[nodiscard]] inline double solids_at(const SelfFlow& own, std::size_t d, double eps) {
  return std::min(own.solids[d], 1.0 - eps);
}
/// Void fraction that turns the flux through those faces into the slip: that of the others, and
/// for what flows round its own solids (docs/theory/own_disturbance.md).
[[nodiscard]] inline double void_of_flux(const SelfFlow& own, std::size_t d, double eps) {
  return eps + own.excess * solids_at(own, d, eps) * (1.0 / 3.0);
}

/// Residual impulse for the fluid [N s] of a grain that is gone, at the place where it was last
/// [m].
struct EscapedParticle {
  Triple place{};
  Triple deferred{};
};

/// Remembers grains across calls by their id, however the rows are reordered in between.
class ParticleStates {
 public:
  /// Brings the memory into the order of `grains`; new grains start empty.
  void align(const particles::GrainRows& grains);

  /// Changes whenever the order of the rows has.
  [[nodiscard]] std::uint64_t order() const { return order_; }

  /// Numbers the particles of these rows, in the order of the cells.
  void number(std::span<const std::int32_t> rows);

  /// Where the particles `then`, numbered as order() was `order`, are now: by
  /// ParticleState::stencil, -1 for those that are gone. Empty if nothing has changed.
  [[nodiscard]] std::vector<std::int32_t> rows_now(std::uint64_t order,
                                                   std::span<const std::int32_t> then) const;

  /// Keeps what each grain does to the fluid by itself, from now on.
  void keep_self_flow() {
    has_self_flow_ = true;
    self_flow_.resize(rows_.size());
  }
  [[nodiscard]] bool has_self_flow() const { return has_self_flow_; }
  SelfFlow& self_flow(std::size_t row) { return self_flow_[row]; }
  [[nodiscard]] const SelfFlow& self_flow(std::size_t row) const { return self_flow_[row]; }
  /// Whether the grain is coupled through a SmoothKernel.
  [[nodiscard]] bool is_smooth(std::size_t row) const {
    return has_self_flow_ && self_flow_[row].is_smooth;
  }

  /// Keeps `width` further numbers per particle, zero for new ones; before the first align().
  void add_columns(std::size_t width) { width_ = width; }
  /// Those of a particle.
  double* columns(std::size_t row) { return columns_.data() + width_ * row; }

  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  ParticleState& operator[](std::size_t row) { return rows_[row]; }
  const ParticleState& operator[](std::size_t row) const { return rows_[row]; }
  /// Fetches what a refresh needs of it.
  void prefetch(std::size_t row) const {
    __builtin_prefetch(&rows_[row]);
    __builtin_prefetch(&rows_[row].is_paired);
  }
  [[nodiscard]] std::vector<EscapedParticle>& escaped() { return escaped_; }

  void save(sdk::ArchiveWriter& archive) const;
  void load(sdk::ArchiveReader& archive);

 private:
  void save_self_flow(sdk::ArchiveWriter& archive) const;
  void load_self_flow(sdk::ArchiveReader& archive);

  std::vector<std::int64_t> ids_;
  std::uint64_t order_ = 0;
  std::vector<ParticleState> rows_;
  std::vector<SelfFlow> self_flow_;  ///< empty until kept
  bool has_self_flow_ = false;
  std::vector<EscapedParticle> escaped_;
  std::size_t width_ = 0;
  std::vector<double> columns_;  ///< width_ per row
};

}  // namespace dust::coupling
