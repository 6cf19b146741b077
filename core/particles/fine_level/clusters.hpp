// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "particles/fine_level/fine_scene.hpp"
#include "particles/fine_level/prediction.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dust::particles {

/// A coarse particle that a cluster is near.
struct CoarsePartner {
  std::int32_t cluster = 0;
  std::int32_t particle = 0;
};

/// Who steps with whom in the coarse step at hand: fine particles in reach of somebody form
/// clusters with the fine particles they are in reach of. A cluster is named by the least of its
/// fine particles, by number among the fine ones, as are these here.
class Clusters {
 public:
  void find(const FineScene& scene);

  /// Whether the two of a contact may touch within the step.
  [[nodiscard]] bool is_near(std::size_t entry) const { return prediction_[entry].is_near; }
  /// Fine particles of clusters: of the finest level first, cluster by cluster.
  [[nodiscard]] std::span<const std::int32_t> sub_cycled() const { return sub_cycled_; }
  [[nodiscard]] std::int32_t cluster_of(std::int32_t fine) const { return at(fine).cluster; }
  /// The cluster makes 2^level sub-steps; docs/theory/grains.md, eq. (11).
  [[nodiscard]] int level_of(std::int32_t cluster) const { return at(cluster).level; }
  /// By cluster and particle, each once.
  [[nodiscard]] std::span<const CoarsePartner> coarse_partners() const { return partners_; }

 private:
  /// A fine particle in the present step.
  struct Fine {
    std::int32_t cluster = -1;     ///< a particle nearer to the root, or the root; -1: none
    std::int32_t level = 0;        ///< of the cluster whose root this particle is
    std::int32_t least_level = 0;  ///< that of a contact under way: it keeps its step
    double stable_step = 0.0;      ///< [s]
    double speed = 0.0;            ///< [m/s] largest relative speed to a near partner
  };

  void predict_others(const FineScene& scene);
  void join_near_others(const FineScene& scene);
  void join_knocked(const FineScene& scene);
  void note_host(const FineScene& scene, std::size_t entry);
  void unite_by_light_partners(const FineScene& scene);
  void unite_fine_pairs(const FineScene& scene);
  void list_coarse_partners(const FineScene& scene);
  void choose_levels(const FineScene& scene);
  void join(std::int32_t fine, const ContactPrediction& prediction, std::uint8_t touching);
  void unite(std::int32_t a, std::int32_t b);
  std::int32_t root(std::int32_t n);
  [[nodiscard]] Fine& at(std::int32_t n) { return fine_[static_cast<std::size_t>(n)]; }
  [[nodiscard]] const Fine& at(std::int32_t n) const { return fine_[static_cast<std::size_t>(n)]; }

  std::vector<Fine> fine_;                     ///< of those that do not step, left as they were
  std::vector<ContactPrediction> prediction_;  ///< by contact
  std::vector<std::int32_t> sub_cycled_;
  std::vector<CoarsePartner> partners_;
  /// By light coarse particle: a fine one whose cluster it belongs to, with all else that is near
  /// it; -1 between two calls of find().
  std::vector<std::int32_t> host_;
};

}  // namespace dust::particles
