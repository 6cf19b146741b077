// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contact/batch_kernels.hpp"
#include "contact/nearest_image.hpp"
#include "particles/balance_book.hpp"
#include "particles/dem.hpp"
#include "particles/fine_level/fine_level.hpp"
#include "particles/forces/deferred_forces.hpp"
#include "particles/forces/force_buffer.hpp"
#include "particles/forces/ghost_exchange.hpp"
#include "particles/grain_store.hpp"
#include "particles/law_stages.hpp"
#include "particles/neighbours/list_tuner.hpp"
#include "particles/neighbours/pair_lists.hpp"
#include "particles/neighbours/reference_trajectories.hpp"
#include "particles/search.hpp"
#include "particles/surfaces.hpp"
#include "particles/tile.hpp"
#include "particles/time_steps.hpp"
#include "particles/wall_loads.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace dust::particles {

/// Grains per task where nothing but their rows is touched.
inline constexpr std::size_t k_block = 512;
/// Coarse grains per chunk: enough to keep a chunk's data in the second-level cache and most pairs
/// inside one chunk, and some 16 chunks for the threads to share. A function of the number of
/// grains alone, for it fixes the order of sums.
inline std::size_t chunk_rows(std::size_t coarse_grains) {
  return std::clamp(std::bit_ceil(coarse_grains / 16 + 1), std::size_t{512}, std::size_t{2048});
}
/// Coarse steps between two checks of how far coarse grains are off the course a watch supposes:
/// seldom where watches last long, because nobody moves much there.
constexpr std::int64_t check_every(std::int64_t watch_length) {
  return std::clamp<std::int64_t>(watch_length / 8, 4, 16);
}

/// Grains that make every step of a watch.
struct Awake {
  std::vector<std::int32_t> rows;
  /// So many at the front stand in no list of another chunk: nobody else looks at them.
  std::size_t own = 0;
  /// The course a watch supposes. Single precision does for what is checked against it.
  struct Start {
    double position[3];
    float velocity[3];
    float allowance;
  };
  std::vector<Start> start;
};

/// Time [s] that a tile has spent in each of its phases, in steps whose times were taken.
struct TileTimes {
  double contact = 0.0, force = 0.0, integration = 0.0;

  void add(const TileTimes& other) {
    contact += other.contact, force += other.force, integration += other.integration;
  }
};

/// Coarse grains [begin, end) with everything only their owner writes.
struct Chunk {
  std::int32_t index = 0;
  std::int32_t begin = 0;
  std::int32_t end = 0;
  [[nodiscard]] Tile tile() const { return {index, begin, end}; }
  OuterList near_pairs;
  OuterList near_surfaces;
  ContactList pairs;
  ContactList surfaces;
  /// Per entry of `surfaces`, see bodies::Touches: forgotten when a watch begins, so that a
  /// run that goes on from a checkpoint finds what an unbroken one finds.
  std::vector<std::int32_t> hints;
  Awake awake;
  std::vector<contact::Places> places;  ///< per entry of `pairs`: rows of a ForceBuffer
  double largest_overlap = 0.0;
  std::int64_t contacts = 0;
  std::int64_t seen_late = 0;                 ///< contacts, when the watch began
  std::vector<double> wall_sums;              ///< WallLoads::k_sums per wall, if watched
  std::vector<sdk::WallImpact> wall_impacts;  ///< in the order of the contacts
  bool wants_watch = false;
  TileTimes times;
};

struct AwakeRows;
class ContactCarrier;

struct Dem::Impl {
  Impl(const scenario::Setup& setup, const bodies::BodySet& bodies, std::vector<PairLaws> laws,
       std::vector<double> diameters, double fluid_density);

  // dem.cpp
  void insert(std::span<const NewGrain> grains);
  void remove_leavers();
  void refresh_decay();
  void look_at_weights();
  [[nodiscard]] std::int32_t law_of(int material_i, int material_j) const {
    return laws.index(material_i, material_j);
  }

  // rebuild.cpp
  void neighbours();
  void rebuild();
  [[nodiscard]] ContactCarrier take_contacts();
  void reorder_if_due(ContactCarrier& contacts);
  void restart_trajectories();
  [[nodiscard]] std::vector<std::vector<RowPair>> share_pairs(
      ListTuner::OuterStatistics& statistics);
  void make_tile(std::size_t number, std::vector<RowPair> pairs, const ContactCarrier& contacts);
  void make_fine_list(const ContactCarrier& contacts);
  void wrap_periodic();
  void group_by_law(OuterList& list, bool is_surface);
  [[nodiscard]] bool near_surface(std::size_t row, const Surface& surface,
                                  double horizon_time) const;
  /// Side i of a pair is the fine grain where there is one, else the lower id, so that a history
  /// keeps its sign through all sorts.
  [[nodiscard]] RowPair in_order(std::int32_t i, std::int32_t j) const;

  // mend.cpp
  [[nodiscard]] bool mend();
  [[nodiscard]] std::vector<std::int32_t> find_strays() const;
  void add_pairs_of(std::span<const std::int32_t> strays);
  void add_surfaces_of(std::span<const std::int32_t> strays);

  // watch.cpp
  void record_inner_list();
  [[nodiscard]] double fastest() const;
  [[nodiscard]] double typical_speed() const;
  [[nodiscard]] double speed2(std::size_t row) const {
    const double* v = store.velocity(row);
    return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  }
  void choose_watch_allowances();
  [[nodiscard]] bool may_meet_surface(std::size_t i, const Surface& surface) const;
  [[nodiscard]] bool flies_straight(std::size_t row) const;
  /// Not one that has just come, perhaps into an overlap.
  [[nodiscard]] bool has_made_steps(std::int32_t row) const {
    return store.half_velocity(static_cast<std::size_t>(row))[3] == 0.5 * steps.coarse_step;
  }
  void begin_watch();
  void wake_ghosts();
  void land();

  // choose.cpp
  std::int64_t choose_contacts(const OuterList& list, ContactList& contacts,
                               const std::vector<std::uint8_t>& meets, bool may_stand) const;
  void stand(ContactList& contacts) const;
  void fall_in(ContactList& contacts) const;

  // contacts.cpp
  [[nodiscard]] bool find_scales(const contact::PairView& pairs, const std::int32_t* contacts,
                                 std::size_t first, std::size_t count,
                                 contact::BatchColumns& columns) const;
  void standing_pairs(const Segment& segment, Chunk& chunk, double* force);
  void open_pairs(const Segment& segment, Chunk& chunk, double* force);
  void chunk_pairs(Chunk& chunk, double* force);
  void chunk_surfaces(Chunk& chunk, double* force);
  void note_wall_loads(Chunk& chunk, const Surface& surface, const std::int32_t* contacts,
                       const bool* is_new, std::size_t count, contact::BatchColumns& columns);

  // tile_step.cpp
  void step_tiles(double now, bool keeps_force);
  void contact(double now, bool keeps_force);
  void force();
  void integrate();
  void begin_contacts(double now, bool keeps_force);
  void evaluate(Chunk& chunk, ForceBuffer& force);
  void keep_force(const Chunk& chunk, const double* force);
  void add_contributions(const Chunk& chunk, ForceBuffer& force);
  void add_to_deferred(Chunk& chunk);
  void note_contribution(std::int32_t row, const double* given);
  void move_all(Chunk& chunk, ForceBuffer& force);
  void move_unshared(Chunk& chunk, ForceBuffer& force);
  void move_deferred(Chunk& chunk);
  void end_tiles();
  /// Tiles of whose particles some have not moved: often none.
  template <class Work>
  void each_deferred(Work&& work) {
    if (!deferred.has_any()) return;
    oneapi::tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t c) {
      if (deferred.has(static_cast<std::int32_t>(c))) work(chunks[c]);
    });
  }
  enum class ForceOrder { by_row, by_place };

  // wall_loads.cpp
  void gather_wall_loads();

  // integrate.cpp
  [[nodiscard]] bool is_check_due() const;
  void check(Chunk& chunk, std::int64_t done) const;
  void integrate_all(std::size_t first, std::size_t count, double* force);
  [[nodiscard]] AwakeRows awake_rows();
  void integrate_awake(std::span<const std::int32_t> rows, std::size_t first, double* force,
                       ForceOrder order);

  // dem_fine_level.cpp
  [[nodiscard]] FineScene fine_scene();
  void advance_fine();
  /// Who is about to move: all of a chunk, those that other chunks look at, or the others.
  enum class Movers { all, shared, unshared };
  void resume_course(const Chunk& chunk, Movers movers);

  // health.cpp
  [[noreturn]] void fail_as_not_a_number(std::size_t row) const;
  [[noreturn]] void fail(std::size_t row, const std::string& what, const std::string& cause) const;
  [[nodiscard]] Deviation deviation(std::size_t n) const {
    return trajectories.deviation(n, store.position.data() + 4 * n, store.velocity(n),
                                  list_time(since_rebuild), list_time(tuner.inner_lifetime()));
  }
  /// [s] of so many coarse steps.
  [[nodiscard]] double list_time(std::int64_t count) const {
    return static_cast<double>(count) * steps.coarse_step;
  }
  [[nodiscard]] bool is_off_course(std::size_t row) const;
  void check_course(std::size_t begin, std::size_t end, bool& wants_mending,
                    bool& wants_rebuild) const;
  void check_awake(const Awake& awake, std::int64_t done, std::int64_t ahead,
                   bool& wants_watch) const;
  void look_for_wraps(std::size_t begin, std::size_t end, bool& wants_rebuild) const;

  void fill_last_force() const;
  void save(sdk::ArchiveWriter& archive) const;
  void load(sdk::ArchiveReader& archive);

  [[nodiscard]] contact::RowView row_view() const {
    return {store.position.data(), store.motion.data(), store.spin.data()};
  }
  [[nodiscard]] sdk::Vec3 separation(const double* from, const double* to) const {
    return contact::nearest_image(images, from, to);
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
  std::size_t history_stride = laws.history_stride();
  double largest_range = laws.largest_range();
  bool is_periodic = false;
  bool has_fluid = false;
  bool has_weights = false;  ///< coarse grains of different weights

  // State.
  GrainStore store;
  BalanceBook book;
  std::size_t coarse_count = 0;
  std::vector<Chunk> chunks;
  OuterList near_fine;
  ContactList fine;  ///< partner >= 0: row; < 0: surface -1 - b
  FineLevel fine_level;
  std::int64_t next_id = 0;
  WallLoads wall_loads;  ///< empty between fluid steps, so that nothing of it is saved
  double time = 0.0;
  ReferenceTrajectories trajectories;
  ListTuner tuner;
  std::int64_t since_rebuild = 0;  ///< coarse steps
  std::int64_t since_watch = 0;    ///< coarse steps
  std::int64_t flying = 0;         ///< grains asleep in the present watch
  GhostExchange ghosts;
  DeferredForces deferred;
  TileTimes times_before;  ///< of the tiles before the last rebuild
  bool all_step = false;   ///< nobody flies without steps
  bool is_watching = false;
  bool must_watch = false;
  bool must_mend = false;   ///< grains are off the course the lists suppose
  std::int64_t mended = 0;  ///< grains set on a new course since the last rebuild
  bool must_rebuild = true;
  bool must_sort = true;
  mutable DemReport counters;
  mutable contact::AlignedVector<double> last_force;
  /// Of the contacts of coarse grains at the last step that kept it, four per grain; else empty.
  contact::AlignedVector<double> contact_force;

  double farthest_reach = 0.0;  ///< [m] of a grain until the lists' end, at most; 0 = not known
  // Working space of a watch.
  std::vector<double> watch_allowance;  ///< [m] how far a grain may be off its course
  std::vector<std::uint8_t> is_awake;   ///< 2: awake, and in a list of another chunk
  Awake fine_awake;
  std::vector<std::uint8_t> wants;
};

}  // namespace dust::particles
