// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "particles/conditions.hpp"
#include "particles/dem.hpp"
#include "particles/energy/energy_account.hpp"
#include "particles/fine_level/fine_level.hpp"
#include "particles/forces/wall_loads.hpp"
#include "particles/neighbours/inner_list.hpp"
#include "particles/neighbours/list_tuner.hpp"
#include "particles/neighbours/outer_list.hpp"
#include "particles/store/balance_ledger.hpp"
#include "particles/store/particle_store.hpp"
#include "particles/store/tile.hpp"
#include "particles/tile_step.hpp"
#include "particles/work/contact_work.hpp"
#include "particles/work/dust_loads.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace dust::particles {

/// The parts of the solver, one per noun of the algorithm, and how a step calls them.
class Dem::Impl {
 public:
  Impl(const scenario::Setup& setup, const bodies::BodySet& bodies, std::vector<PairLaws> laws,
       const std::vector<double>& diameters, DemOptions options);

  // dem_step.cpp
  void update_pair_lists();
  void synchronise();
  /// Before the phases of the coarse particles, and after them.
  void begin_step(double now, bool keeps_force);
  void end_step();
  void advance_fine();

 private:
  friend class Dem;

  // impl.cpp
  void set_openings(std::vector<Opening> openings);
  void insert(std::span<const NewGrain> grains);
  void remove_escaped();
  /// Whether a particle has left the domain or was drawn out; if so it is counted.
  [[nodiscard]] bool leaves(std::size_t row);
  /// All that follows the rows does so; the contacts of a list that stays, too. See
  /// ParticleStore::reorder.
  void reorder_rows(std::span<const std::int32_t> order);
  void rows_added();
  TransferReport transfer_from(const Impl& other, std::span<const LawTransfer> laws,
                               bool keeps_dust);
  void move_to(double time);
  void fill_last_force();
  /// What is saved or handed on has no inner list.
  void require_synchronised() const;
  /// Sides and bodies that are surfaces.
  [[nodiscard]] std::size_t wall_count() const;
  void gather_wall_loads();
  void save(sdk::ArchiveWriter& archive) const;
  void load(sdk::ArchiveReader& archive);

  // dem_step.cpp
  void rebuild();
  void reorder_if_due(ContactCarrier& contacts);
  void prune();
  [[nodiscard]] OuterList::Due look_at_outer_list(std::size_t begin, std::size_t end) const;

  [[nodiscard]] MotionRows motion_rows() { return MotionRows::of(store, conditions.gravity); }
  [[nodiscard]] ListScene list_scene() const;
  [[nodiscard]] ContactScene contact_scene() const;
  /// The contacts between steps: the last one left surfaces where they stood at its beginning.
  [[nodiscard]] ContactScene contact_scene_at(double time, std::span<const Surface> surfaces) const;
  [[nodiscard]] OpeningMarks opening_marks();
  [[nodiscard]] StepScene step_scene();
  [[nodiscard]] FineScene fine_scene();

  /// What contacts and motion give and take, where a run keeps account of it.
  struct Accounts {
    EnergyAccount energy;
    ContactWork work;  ///< where particles carry dust
  };

  Conditions conditions;
  ParticleStore store;
  BalanceLedger ledger;
  Tiling tiling;
  bool has_weights = false;  ///< coarse particles of different statistical weights
  ListTuner tuner;
  OuterList outer;
  InnerList inner;
  TileStep tile_step;
  FineLevel fine_level;
  Accounts accounts;
  WallLoads wall_loads;  ///< empty between fluid steps, so that nothing of it is saved
  DustLoads loads;       ///< empty where none carries dust
  DemReport counters;
  contact::AlignedVector<double> last_force;
};

}  // namespace dust::particles
