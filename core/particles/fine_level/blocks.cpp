// SPDX-License-Identifier: Apache-2.0
#include "particles/fine_level/blocks.hpp"

#include <algorithm>
#include <tuple>

namespace dust::particles {
namespace {

/// Particles of one block, if clusters allow.
constexpr std::size_t k_block_particles = 64;

using Partners = std::span<const CoarsePartner>;

/// Number of the first partner of a cluster from `particle` on.
std::size_t first_partner(Partners partners, std::int32_t cluster, std::int32_t particle) {
  const CoarsePartner wanted{cluster, particle};
  const auto found = std::lower_bound(
      partners.begin(), partners.end(), wanted, [](const CoarsePartner& a, const CoarsePartner& b) {
        return std::tie(a.cluster, a.particle) < std::tie(b.cluster, b.particle);
      });
  return static_cast<std::size_t>(found - partners.begin());
}

}  // namespace

void Blocks::open(int level) {
  if (count_++ == blocks_.size()) blocks_.emplace_back();
  Block& block = blocks_[count_ - 1];
  block.particles.clear();
  block.candidates.clear();
  block.level = level;
  block.fine_count = 0;
  block.largest_overlap = 0.0;
}

void Blocks::load(const FineScene& scene, const Clusters& clusters,
                  const DeferredImpulses& deferred) {
  fine_.resize(scene.fine_count());
  partner_index_.resize(clusters.coarse_partners().size());
  count_ = 0;
  std::int32_t last_cluster = -1;
  for (const std::int32_t n : clusters.sub_cycled()) {
    const std::int32_t cluster = clusters.cluster_of(n);
    const int level = clusters.level_of(cluster);
    if (count_ == 0 || blocks_[count_ - 1].level != level ||
        (cluster != last_cluster && blocks_[count_ - 1].particles.size() >= k_block_particles)) {
      open(level);
    }
    if (cluster != last_cluster) {
      load_partners(scene, clusters.coarse_partners(), deferred, cluster);
    }
    last_cluster = cluster;
    Block& block = blocks_[count_ - 1];
    fine_[static_cast<std::size_t>(n)] = {static_cast<std::int32_t>(count_ - 1),
                                          static_cast<std::int32_t>(block.particles.size())};
    const auto particle = static_cast<std::int32_t>(scene.coarse_count) + n;
    block.particles.push_back(load_fine(scene, particle));
    ++block.fine_count;
  }
  list_candidates(scene, clusters);
}

/// The coarse particles near a cluster join its block.
void Blocks::load_partners(const FineScene& scene, Partners partners,
                           const DeferredImpulses& deferred, std::int32_t cluster) {
  Block& block = blocks_[count_ - 1];
  const double sub_step = scene.steps.coarse_step / static_cast<double>(1 << block.level);
  for (std::size_t p = first_partner(partners, cluster, -1);
       p < partners.size() && partners[p].cluster == cluster; ++p) {
    partner_index_[p] = static_cast<std::int32_t>(block.particles.size());
    block.particles.push_back(load_coarse(scene, deferred, partners[p].particle, sub_step));
  }
}

void Blocks::list_candidates(const FineScene& scene, const Clusters& clusters) {
  const contact::PairView& contacts = scene.contacts;
  const auto material = [&](std::int32_t particle) {
    return scene.particles.material(static_cast<std::size_t>(particle));
  };
  const Partners partners = clusters.coarse_partners();
  for (std::size_t e = 0; e < contacts.count; ++e) {
    if (!clusters.is_near(e)) continue;
    const std::int32_t b = contacts.b[e];
    const std::size_t n = scene.fine_index(contacts.a[e]);
    CandidateContact c{.entry = static_cast<std::int32_t>(e), .particle = fine_[n].index};
    const int own_material = material(contacts.a[e]);
    if (b < 0) {
      c.surface = -1 - b;
      c.law = scene.laws.index(own_material, scene.surface(c.surface).material);
    } else {
      c.law = scene.laws.index(own_material, material(b));
      const auto cluster = clusters.cluster_of(static_cast<std::int32_t>(n));
      c.partner = scene.is_fine(b) ? fine_[scene.fine_index(b)].index
                                   : partner_index_[first_partner(partners, cluster, b)];
    }
    blocks_[static_cast<std::size_t>(fine_[n].block)].candidates.push_back(c);
  }
}

}  // namespace dust::particles
