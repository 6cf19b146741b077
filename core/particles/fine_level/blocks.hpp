// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/sensor.hpp"
#include "particles/fine_level/clusters.hpp"
#include "particles/fine_level/sub_cycled_particle.hpp"
#include "particles/forces/wall_sliding.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dust::particles {

/// A contact that may come about in a block.
struct CandidateContact {
  std::int32_t entry = 0;     ///< in the scene's contacts
  std::int32_t particle = 0;  ///< index in the block, as is the partner
  std::int32_t partner = -1;  ///< or -1: the surface
  std::int32_t surface = -1;
  std::int32_t law = 0;
};

/// What contacts with other particles have dissipated at a particle of a block in a coarse step;
/// see ContactWork.
struct BlockWork {
  double normal = 0.0, tangential = 0.0;  ///< [J]
  double acceleration = 0.0;              ///< [m/s2] largest
};

/// The same with a wall in a sub-step.
struct BlockWallWork {
  std::int32_t particle = 0;  ///< index in the block
  std::int32_t wall = 0;
  double normal = 0.0, tangential = 0.0;  ///< [J]
};

/// Clusters of one level that step together.
struct Block {
  std::vector<SubCycledParticle> particles;
  std::vector<CandidateContact> candidates;  ///< by law and surface
  int level = 0;
  std::int64_t fine_count = 0;  ///< of the particles
  double largest_overlap = 0.0;
  std::vector<double> wall_sums;  ///< WallLoads::k_sums per wall, if watched
  std::vector<sdk::WallImpact> wall_impacts;
  WallSlidings slidings;
  std::vector<BlockWork> work;  ///< by particle, if it is kept
  std::vector<BlockWallWork> wall_work;
};

/// The clusters of a step in blocks, with copies of their particles. Memory is kept from step to
/// step.
class Blocks {
 public:
  /// Before the fine particles move.
  void load(const FineScene& scene, const Clusters& clusters, const DeferredImpulses& deferred);

  [[nodiscard]] std::span<Block> all() { return {blocks_.data(), count_}; }

 private:
  /// The next block, empty; with the memory of a step before, if there was one.
  void open(int level);
  void load_partners(const FineScene& scene, std::span<const CoarsePartner> partners,
                     const DeferredImpulses& deferred, std::int32_t cluster);
  void list_candidates(const FineScene& scene, const Clusters& clusters);

  std::vector<Block> blocks_;
  std::size_t count_ = 0;  ///< of `blocks_` in use
  /// Where a sub-cycled particle is.
  struct Location {
    std::int32_t block = -1;
    std::int32_t index = -1;
  };
  std::vector<Location> fine_;               ///< by number among the fine ones
  std::vector<std::int32_t> partner_index_;  ///< of the clusters' coarse partners, in its block
};

}  // namespace dust::particles
