// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contact/aligned.hpp"
#include "dust/sdk/archive.hpp"
#include "particles/fine_level/blocks.hpp"
#include "particles/fine_level/clusters.hpp"
#include "particles/fine_level/deferred_impulse.hpp"
#include "particles/fine_level/fine_scene.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace dust::particles {

/// Particles below the border of the coarse level, stepped as fine as their contacts need
/// (docs/theory/grains.md, "Several rates"). One coarse step is: form_clusters(); the owner moves
/// all active fine particles as if alone; sub_cycle(), which moves those of clusters instead.
class FineLevel {
 public:
  void form_clusters(const FineScene& scene);
  void sub_cycle(const FineScene& scene);

  /// What coarse particles have been given and what acts in their next step. In it, the owner lets
  /// each act once, before the particle's kick; the next sub_cycle() makes them new.
  [[nodiscard]] const DeferredImpulses& deferred() const { return deferred_; }
  /// No fine particles are left that could make them new.
  void clear_deferred() { deferred_.clear(); }
  /// Particle n is new_index[n] from now on, or gone where that is negative.
  void renumber(std::span<const std::int32_t> new_index) { deferred_.renumber(new_index); }

  /// [N] mean contact force of the last sub-step, four per fine particle.
  [[nodiscard]] std::span<const double> force() const { return force_; }
  /// So many fine particles, as yet without a force.
  void clear_force(std::size_t fine_count) { force_.assign(4 * fine_count, 0.0); }

  [[nodiscard]] std::int64_t sub_steps() const { return sub_steps_; }  ///< summed over particles
  [[nodiscard]] double largest_overlap() const { return largest_overlap_; }  ///< [-] so far

  /// Another solver's particles have come, with what acts in their next step.
  void transfer_from(const FineLevel& other) { deferred_ = other.deferred_; }

  void save(sdk::ArchiveWriter& archive) const;
  /// The number of sub-steps stands among others of the solver.
  void load(sdk::ArchiveReader& archive, std::int64_t sub_steps);

 private:
  void count(const FineScene& scene);
  static void give_work(const FineScene& scene, const Block& block);
  void return_to_coarse(const FineScene& scene);

  Clusters clusters_;
  Blocks blocks_;
  DeferredImpulses deferred_;
  contact::AlignedVector<double> force_;
  std::int64_t sub_steps_ = 0;
  double largest_overlap_ = 0.0;
};

}  // namespace dust::particles
