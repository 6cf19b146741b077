// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/digest.hpp"
#include "dust/sdk/archive.hpp"
#include "particles/neighbours/list_scene.hpp"
#include "particles/neighbours/list_tuner.hpp"
#include "particles/neighbours/pair_list.hpp"
#include "particles/neighbours/reference_trajectories.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dust::particles {

/// The outer one of the dual pair list: who may meet whom until its lifetime ends, tile by tile and
/// for the fine level, while every particle goes on along its reference trajectory, give or take
/// its skin. A particle that leaves its skin is given a new trajectory and its new pairs are added
/// (update(), docs/decisions/0018_lists_are_updated.md); where that does not pay, all is built
/// anew.
class OuterList {
 public:
  /// What is due before the next step, the more the later; a rebuild settles all.
  enum class Due : std::uint8_t {
    nothing,
    update,   ///< particles leave their skins
    rebuild,  ///< positions want to be wrapped, or surfaces have changed
    reorder,  ///< particles have come or gone: the list names other rows
  };
  void require(Due due) { due_ = std::max(due_, due); }
  [[nodiscard]] bool is_update_due() const { return due_ == Due::update && age_ < lifetime_; }
  [[nodiscard]] bool is_rebuild_due() const { return due_ >= Due::rebuild || age_ >= lifetime_; }
  [[nodiscard]] bool is_reorder_due() const { return due_ == Due::reorder; }
  /// A coarse step has been made.
  void count_step() { ++age_; }

  /// A new list, of rows as they are now. The tuner learns how the old one ended and what the new
  /// one is like.
  void build(const ListScene& scene, ListTuner& tuner);
  /// Adds the pairs of particles that have left their skins. False where a rebuild is cheaper: for
  /// many such particles, or because the list is short and will hold longer with wider skins.
  [[nodiscard]] bool update(const ListScene& scene, const ListTuner& tuner);

  [[nodiscard]] std::size_t tiles() const { return tiles_.size(); }
  [[nodiscard]] const PairList& pairs(std::size_t tile) const { return tiles_[tile].pairs; }
  [[nodiscard]] const PairList& walls(std::size_t tile) const { return tiles_[tile].walls; }
  /// Side a is a fine particle; b a particle, or -1 - surface.
  [[nodiscard]] const PairList& fine() const { return fine_; }

  [[nodiscard]] const ReferenceTrajectories& trajectories() const { return trajectories_; }
  /// Now, when the next look comes after `ahead` coarse steps.
  [[nodiscard]] Deviation deviation(const ListScene& scene, std::size_t row,
                                    std::int64_t ahead) const {
    return trajectories_.deviation(row, scene.position(row), scene.particles.velocity(row),
                                   scene.time_of(age_), scene.time_of(ahead));
  }

  /// Particles have come, at the end of the rows.
  void resize(std::size_t particles) { trajectories_.resize(particles); }
  /// Row n becomes what row order[n] was. The pairs name the old rows until the next build().
  void reorder(std::span<const std::int32_t> order) { trajectories_.reorder(order); }

  void add_to(base::Digest& digest) const;
  /// Numbers of the solver's state in a checkpoint.
  struct State {
    std::int64_t age = 0;
    std::int64_t updated = 0;
    std::int64_t lifetime = 0;
    Due due = Due::reorder;
  };
  [[nodiscard]] State state() const { return {age_, updated_, lifetime_, due_}; }
  void save(sdk::ArchiveWriter& archive) const;
  void load(sdk::ArchiveReader& archive, std::size_t tiles, State state);

 private:
  struct OfTile {
    PairList pairs{PartnerKind::particles};
    PairList walls{PartnerKind::surfaces};
  };
  using Shares = std::vector<std::vector<RowPair>>;

  // outer_list.cpp
  void restart_trajectories(const ListScene& scene, double skin_in_diameters);
  [[nodiscard]] Shares share_pairs(const ListScene& scene, ListTuner::OuterStatistics& statistics);
  void build_tile(const ListScene& scene, std::size_t tile, std::vector<RowPair> pairs);
  void build_fine(const ListScene& scene);
  [[nodiscard]] std::span<const std::int32_t> surfaces_near(const ListScene& scene, std::size_t row,
                                                            double duration,
                                                            SurfaceSearch& search) const;
  static void group_by_law(const ListScene& scene, PairList& list);

  // outer_list_update.cpp
  /// Particles that have left their skins.
  struct Displaced {
    std::span<const std::int32_t> rows;          ///< ascending
    std::span<const std::uint8_t> is_displaced;  ///< by particle
    [[nodiscard]] bool has(std::int32_t row) const {
      return is_displaced[static_cast<std::size_t>(row)] != 0;
    }
  };
  [[nodiscard]] std::vector<std::int32_t> find_displaced(const ListScene& scene,
                                                         std::int64_t ahead) const;
  [[nodiscard]] double remaining(const ListScene& scene) const {
    return scene.time_of(lifetime_ - age_);
  }
  [[nodiscard]] Ball swept_ball(const ListScene& scene, std::size_t row) const;
  void find_farthest_reach(const ListScene& scene);
  [[nodiscard]] bool come_near(const ListScene& scene, std::size_t i, std::size_t j) const;
  [[nodiscard]] Shares pairs_of(const ListScene& scene, const Displaced& displaced);
  void add_pairs(const ListScene& scene, const Displaced& displaced);
  static void add_new(PairList& list, std::vector<RowPair>& pairs, const Displaced& displaced);
  void add_walls(const ListScene& scene, std::span<const std::int32_t> displaced);

  ReferenceTrajectories trajectories_;
  std::vector<OfTile> tiles_;
  PairList fine_{PartnerKind::both};
  std::int64_t lifetime_ = 0;  ///< coarse steps
  std::int64_t age_ = 0;       ///< coarse steps
  std::int64_t updated_ = 0;   ///< particles set on new trajectories so far
  Due due_ = Due::reorder;
  double farthest_reach_ = 0.0;  ///< [m] of a particle until the end, at most; 0 = not known
};

}  // namespace dust::particles
