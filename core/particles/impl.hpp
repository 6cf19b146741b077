// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "particles/balance_book.hpp"
#include "particles/dem.hpp"
#include "particles/fine_level/fine_level.hpp"
#include "particles/forces/contact_forces.hpp"
#include "particles/forces/deferred_forces.hpp"
#include "particles/forces/force_buffer.hpp"
#include "particles/forces/ghost_exchange.hpp"
#include "particles/forces/wall_loads.hpp"
#include "particles/grain_store.hpp"
#include "particles/motion/motion_rows.hpp"
#include "particles/neighbours/inner_list.hpp"
#include "particles/neighbours/list_tuner.hpp"
#include "particles/neighbours/outer_list.hpp"
#include "particles/phase_times.hpp"
#include "particles/surfaces.hpp"
#include "particles/tile.hpp"
#include "particles/time_steps.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace dust::particles {

struct Dem::Impl {
  Impl(const scenario::Setup& setup, const bodies::BodySet& bodies, std::vector<PairLaws> laws,
       std::vector<double> diameters, double fluid_density);

  // dem.cpp
  void insert(std::span<const NewGrain> grains);
  void remove_leavers();
  void refresh_decay();
  void look_at_weights();

  // pair_lists.cpp
  void neighbours();
  void land();
  void rebuild();
  void reorder_if_due(ContactCarrier& contacts);
  void wrap_periodic();
  void prune();
  void look_at_outer_list(std::size_t begin, std::size_t end, OuterList::Due& due) const;
  [[nodiscard]] bool is_far_out(std::size_t row) const;

  // tile_step.cpp
  void step_tiles(double now, bool keeps_force);
  void contact(double now, bool keeps_force);
  void force();
  void integrate();
  void begin_contacts(double now, bool keeps_force);
  void evaluate(Tile tile, ForceBuffer& force);
  void keep_force(Tile tile, const double* force);
  void add_contributions(Tile tile, ForceBuffer& force);
  void add_to_deferred(Tile tile);
  void note_contribution(std::int32_t row, const double* given);
  void move_all(Tile tile, ForceBuffer& force);
  void move_unshared(Tile tile, ForceBuffer& force);
  void move_deferred(Tile tile);
  void check(Tile tile);
  void end_tiles();
  template <class Work>
  void each_tile(Work&& work) {
    oneapi::tbb::parallel_for(std::size_t{0}, inner.tiles(),
                              [&](std::size_t t) { work(tiling.tile(t)); });
  }
  /// Tiles of whose particles some have not moved: often none.
  template <class Work>
  void each_deferred(Work&& work) {
    if (!deferred.has_any()) return;
    each_tile([&](Tile tile) {
      if (deferred.has(tile.index)) work(tile);
    });
  }
  [[nodiscard]] MotionRows motion_rows() { return MotionRows::of(store, gravity, has_fluid); }

  void gather_wall_loads();

  // dem_fine_level.cpp
  [[nodiscard]] FineScene fine_scene();
  void advance_fine();
  /// Which particles of a tile are about to move: all, those that other tiles look at, the others.
  enum class Movers { all, shared, unshared };
  void apply_deferred_impulses(Tile tile, Movers movers);

  // health.cpp
  [[noreturn]] void fail_as_not_a_number(std::size_t row) const;
  [[noreturn]] void fail(std::size_t row, const std::string& what, const std::string& cause) const;

  void fill_last_force() const;
  void save(sdk::ArchiveWriter& archive) const;
  void load(sdk::ArchiveReader& archive);
  void load_tiles(sdk::ArchiveReader& archive, const OuterList::State& list);

  [[nodiscard]] ListScene list_scene() const {
    return {.particles = store,
            .tiling = tiling,
            .laws = laws,
            .surfaces = surfaces,
            .images = images,
            .gravity = gravity,
            .origin = domain_min,
            .step = steps.coarse_step,
            .largest_diameter = steps.classes.back().diameter};
  }
  [[nodiscard]] ContactScene contact_scene() const {
    return {.particles = store,
            .laws = laws,
            .surfaces = surfaces,
            .images = images,
            .step = steps.coarse_step,
            .time = time,
            .has_weights = has_weights};
  }

  // Fixed after construction.
  PairLawTable laws;
  std::vector<sdk::MaterialProperties> materials;
  std::vector<Surface> surfaces;
  std::array<scenario::GrainSide, 6> sides{};
  sdk::Vec3 domain_min, domain_max;
  contact::Images images;
  TimeSteps steps;
  contact::AlignedVector<double> gravity;  ///< four per material, reduced by buoyancy
  bool is_periodic = false;

  // The particles.
  GrainStore store;
  BalanceBook book;
  Tiling tiling;
  std::int64_t next_id = 0;
  double time = 0.0;
  bool has_fluid = false;    ///< drag acts
  bool has_weights = false;  ///< coarse particles of different weights
  bool all_step = false;     ///< none flies without steps

  // The parts of a step.
  ListTuner tuner;
  OuterList outer;
  InnerList inner{laws.history_stride()};
  ContactForces contact_forces;
  GhostExchange ghosts;
  DeferredForces deferred;
  FineLevel fine_level;
  WallLoads wall_loads;  ///< empty between fluid steps, so that nothing of it is saved
  PhaseTimes phase_times;
  mutable DemReport counters;
  mutable contact::AlignedVector<double> last_force;
  /// Of the contacts of coarse particles at the last step that kept it, four each; else empty.
  contact::AlignedVector<double> contact_force;
};

}  // namespace dust::particles
