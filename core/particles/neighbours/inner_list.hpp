// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/digest.hpp"
#include "contact/approach.hpp"
#include "particles/fine_level/deferred_impulse.hpp"
#include "particles/forces/ghost_exchange.hpp"
#include "particles/neighbours/active_set.hpp"
#include "particles/neighbours/contact_carrier.hpp"
#include "particles/neighbours/contact_list.hpp"
#include "particles/neighbours/inner_list_life.hpp"
#include "particles/neighbours/list_archive.hpp"
#include "particles/neighbours/list_scene.hpp"
#include "particles/neighbours/list_tuner.hpp"
#include "particles/neighbours/outer_list.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dust::particles {

/// What a tile's contacts are evaluated from.
struct TileContacts {
  ContactList pairs;
  ContactList walls;
  /// Per entry of `walls`: the closest-triangle cache, see bodies::ClosestPoints. Forgotten when
  /// the list is pruned, so that a run that goes on from a checkpoint finds what an unbroken one
  /// finds.
  std::vector<std::int32_t> nearest_triangles;
  std::vector<contact::Places> slots;  ///< per entry of `pairs`: rows of a ForceBuffer
};

/// The inner one of the dual pair list: pruned from the outer list again and again, it holds the
/// pairs that may touch within its short life (InnerListLife), with the histories of contacts.
/// Particles in it are active and make every step. The others are in free flight: they feel no
/// contact until its end (docs/decisions/0006_inner_pair_list.md).
///
/// Tiles may be worked through at once: what is kept of one tile is its task's alone.
class InnerList {
 public:
  explicit InnerList(std::size_t history_stride)
      : stride_(history_stride), fine_(PartnerKind::both, history_stride) {}

  [[nodiscard]] const InnerListLife& life() const { return life_; }

  struct PruneInput {
    const ListScene& scene;
    const OuterList& outer;
    std::int64_t lifetime = 0;                  ///< coarse steps
    std::span<const DeferredImpulse> impulses;  ///< whose particles step to receive them
  };
  /// A new list; contacts keep their histories. Finds the ghosts that its pairs make, too. Returns
  /// how many contacts between particles had begun unseen by the list before.
  std::int64_t prune(const PruneInput& in, GhostExchange& ghosts);
  /// From the next list on all particles are active: none flies freely.
  void let_all_step() { all_active_ = true; }
  /// All histories into rows, as everyone but the laws knows them.
  void return_histories();
  /// No step more of this list.
  void end() { life_.end(); }

  // --- During its life.
  [[nodiscard]] std::size_t tiles() const { return tiles_.size(); }
  [[nodiscard]] TileContacts& contacts(std::size_t tile) { return tiles_[tile].contacts; }
  [[nodiscard]] const TileContacts& contacts(std::size_t tile) const {
    return tiles_[tile].contacts;
  }
  [[nodiscard]] ContactList& fine() { return fine_; }
  [[nodiscard]] const ContactList& fine() const { return fine_; }
  [[nodiscard]] const ActiveSet& active(std::size_t tile) const { return tiles_[tile].active; }
  [[nodiscard]] const ActiveSet& fine_active() const { return fine_active_; }
  /// Per particle: 0 in free flight, else active.
  [[nodiscard]] std::span<const std::uint8_t> activity() const { return activity_; }
  [[nodiscard]] bool is_shared(std::int32_t row) const {
    return activity_[static_cast<std::size_t>(row)] == k_shared;
  }
  [[nodiscard]] std::int64_t ballistic_count() const { return ballistic_count_; }
  /// Pairs and walls of all tiles.
  [[nodiscard]] std::int64_t entries() const;

  /// After the step in hand: whether the tile's active particles keep to their skins. Returns one
  /// whose position is not a number, or -1.
  [[nodiscard]] std::int32_t check(std::size_t tile, const ListScene& scene);
  /// The coarse step is done.
  void end_step();
  /// The fine level, after end_step().
  [[nodiscard]] std::int32_t check_fine(const ListScene& scene);

  // --- Between two lists: particles come and go, the outer list is rebuilt.
  /// Gives away all contacts in touch; the list is empty then.
  [[nodiscard]] ContactCarrier release(std::size_t particles);
  /// Those of them that a new outer list names.
  void adopt(const OuterList& outer, const ContactCarrier& contacts);
  void renumber(std::span<const std::int32_t> new_row);
  /// Contacts in touch that another solver's lists held, until a new outer list names them.
  void receive(ContactList pairs, ContactList walls, ContactList fine);

  void add_entries_to(base::Digest& digest) const;
  void add_histories_to(base::Digest& digest) const;
  void save(sdk::ArchiveWriter& archive) const;
  void load(sdk::ArchiveReader& archive, std::size_t tiles);

 private:
  static constexpr std::uint8_t k_ballistic = 0;
  static constexpr std::uint8_t k_active = 1;
  static constexpr std::uint8_t k_shared = 2;  ///< active, and in a list of another tile

  struct OfTile {
    explicit OfTile(std::size_t stride)
        : contacts{{PartnerKind::particles, stride}, {PartnerKind::surfaces, stride}, {}, {}} {}
    TileContacts contacts;
    ActiveSet active;
    std::int64_t missed_onsets = 0;
    bool is_skin_used_up = false;
  };
  /// What pairs are pruned by.
  struct Pruning {
    const PruneInput& in;
    contact::Trajectories trajectories;
    contact::ContactPrediction look_ahead;
    double duration = 0.0;  ///< [s]
  };

  void set_tiles(std::size_t count);
  void choose_skins(const PruneInput& in);
  [[nodiscard]] bool may_meet(const Pruning& p, std::int32_t row, std::int32_t surface) const;
  void prune_tile(const Pruning& p, OfTile& tile, Tile range, GhostExchange& ghosts);
  [[nodiscard]] std::int64_t prune_fine(const Pruning& p);
  void activate(std::int32_t row);
  void collect_active(const Pruning& p, std::size_t begin, std::size_t end, ActiveSet& active);
  [[nodiscard]] bool flies_straight(const Pruning& p, std::size_t row) const;

  std::size_t stride_;
  InnerListLife life_;
  std::vector<OfTile> tiles_;
  ContactList fine_;
  ActiveSet fine_active_;
  std::vector<double> skin_;            ///< [m] by particle
  std::vector<std::uint8_t> activity_;  ///< by particle
  std::int64_t ballistic_count_ = 0;
  bool all_active_ = false;
};

}  // namespace dust::particles
