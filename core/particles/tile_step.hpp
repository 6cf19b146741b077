// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/archive.hpp"
#include "dust/sdk/vec3.hpp"
#include "particles/fine_level/deferred_impulse.hpp"
#include "particles/forces/contact_forces.hpp"
#include "particles/forces/deferred_forces.hpp"
#include "particles/forces/force_buffer.hpp"
#include "particles/forces/ghost_exchange.hpp"
#include "particles/motion/motion_rows.hpp"
#include "particles/neighbours/inner_list.hpp"
#include "particles/phase_times.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

namespace dust::particles {

/// What a step of the coarse particles works on: views of what others own.
struct StepScene {
  ParticleStore& particles;
  InnerList& lists;
  const DeferredImpulses& impulses;  ///< that act before the next kick of their particles
  ListScene list_scene;
  ContactScene contacts;
  MotionRows motion;

  [[nodiscard]] double step() const { return contacts.step; }  ///< [s]
};

/// The step of the coarse particles, tile by tile: contacts, forces, integration. A tile whose
/// forces are complete goes through all three in one task, while its rows are in the cache
/// (docs/decisions/0012_forces_stay_in_the_cache.md); phase by phase, for whoever wants to look or
/// add something in between, the bits are the same.
class TileStep {
 public:
  /// A new outer list: so many tiles, and the walls whose loads are kept.
  void restart(std::size_t tiles, const WallLoads& loads);
  /// A new inner list, which has planned ghosts().
  void begin_list(std::size_t tiles) { deferred_.restart(tiles); }
  [[nodiscard]] GhostExchange& ghosts() { return ghosts_; }

  /// Before each step: whether contact_force() is asked for after it.
  void begin(std::size_t coarse_count, bool keeps_force);
  void contact(const StepScene& scene);
  void force(const StepScene& scene);
  void integrate(const StepScene& scene);
  /// The three at once: a tile goes through as many of them as it can.
  void run(const StepScene& scene, bool is_timed);
  /// Between force() and integrate(): adds `force`(row) [N] to each particle that is about to move.
  void add_force(const StepScene& scene, const std::function<sdk::Vec3(std::size_t)>& force);

  [[nodiscard]] ContactForces& contact_forces() { return contact_forces_; }
  [[nodiscard]] const ContactForces& contact_forces() const { return contact_forces_; }
  /// [N] of the contacts of coarse particles at the last step that kept it, four each; else empty.
  [[nodiscard]] std::span<double> contact_force() { return contact_force_; }
  [[nodiscard]] std::span<const double> contact_force() const { return contact_force_; }
  [[nodiscard]] PhaseTimes::Seconds phase_shares() const { return phase_times_.shares(); }
  [[nodiscard]] std::uint64_t ghost_digest() const { return ghosts_.digest(); }
  [[nodiscard]] std::uint64_t deferred_digest() const { return deferred_.digest(); }

  void save(sdk::ArchiveWriter& archive, const Tiling& tiling) const;
  /// Returns the number of tiles.
  std::size_t load(sdk::ArchiveReader& archive, const WallLoads& loads);

 private:
  /// Which active particles of a tile: all, those that other tiles look at, the others.
  enum class Selection { all, shared, unshared };

  void evaluate(const StepScene& scene, Tile tile, ForceBuffer& force);
  void keep_force(const ActiveSet& active, Tile tile, const double* force);
  void note_contribution(std::int32_t row, const double* given);
  void add_contributions(Tile tile, ForceBuffer& force);
  void add_to_deferred(const StepScene& scene, Tile tile);
  static void apply_impulses(const StepScene& scene, Tile tile, Selection selection);
  void move_all(const StepScene& scene, Tile tile, ForceBuffer& force);
  void move_unshared(const StepScene& scene, Tile tile, ForceBuffer& force);
  void move_deferred(const StepScene& scene, Tile tile);
  template <class PlaceOf>
  static void take_work(const StepScene& scene, std::span<const std::int32_t> particles,
                        double* force, const PlaceOf& place_of);
  template <class Move>
  static void with_energy(const StepScene& scene, Tile tile, std::span<const std::int32_t> rows,
                          Move&& move);
  static void check(const StepScene& scene, Tile tile);
  static const ActiveSet& active_of(const StepScene& scene, Tile tile) {
    return scene.lists.active(static_cast<std::size_t>(tile.index));
  }
  template <class Work>
  static void each_tile(const StepScene& scene, Work&& work) {
    const Tiling& tiling = scene.list_scene.tiling;
    oneapi::tbb::parallel_for(std::size_t{0}, scene.lists.tiles(),
                              [&](std::size_t t) { work(tiling.tile(t)); });
  }
  /// Tiles of whose particles some have not moved: often none.
  template <class Work>
  void each_deferred(const StepScene& scene, Work&& work) {
    if (!deferred_.has_any()) return;
    each_tile(scene, [&](Tile tile) {
      if (deferred_.has(tile.index)) work(tile);
    });
  }

  ContactForces contact_forces_;
  GhostExchange ghosts_;
  DeferredForces deferred_;
  PhaseTimes phase_times_;
  contact::AlignedVector<double> contact_force_;
};

}  // namespace dust::particles
