// SPDX-License-Identifier: Apache-2.0
#include "particles/fine_level/fine_level.hpp"

#include "particles/fine_level/sub_cycle.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <tuple>

namespace dust::particles {

void FineLevel::form_clusters(const FineScene& scene) {
  for (const std::int32_t particle : scene.active) {
    std::fill_n(force_.begin() + 4 * static_cast<std::ptrdiff_t>(scene.fine_index(particle)), 4,
                0.0);
  }
  clusters_.find(scene);
  blocks_.load(scene, clusters_, deferred_);
}

void FineLevel::sub_cycle(const FineScene& scene) {
  const std::span<Block> blocks = blocks_.all();
  oneapi::tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t b) {
    Block& block = blocks[b];
    std::stable_sort(block.candidates.begin(), block.candidates.end(),
                     [](const CandidateContact& x, const CandidateContact& y) {
                       return std::tie(x.law, x.surface) < std::tie(y.law, y.surface);
                     });
    block.wall_sums.assign(WallLoads::k_sums * scene.wall_loads.walls(), 0.0);
    block.work.assign(scene.work != nullptr ? block.particles.size() : 0, {});
    block.wall_work.clear();
    particles::sub_cycle(scene, block);
    for (const SubCycledParticle& p : block.particles) {
      if (p.is_coarse) continue;
      store_fine(p, scene.particles, force_.data() + 4 * scene.fine_index(p.particle));
    }
  });
  count(scene);
  return_to_coarse(scene);
}

void FineLevel::count(const FineScene& scene) {
  // Those alone make one step.
  sub_steps_ += static_cast<std::int64_t>(scene.fine_count()) -
                static_cast<std::int64_t>(clusters_.sub_cycled().size());
  for (Block& block : blocks_.all()) {
    if (scene.wall_loads.is_on()) {
      scene.wall_loads.take(block.wall_sums, block.wall_impacts, block.slidings);
    }
    if (scene.work != nullptr) give_work(scene, block);
    sub_steps_ += block.fine_count << block.level;
    largest_overlap_ = std::max(largest_overlap_, block.largest_overlap);
  }
}

/// Block by block: a coarse particle may be in several.
void FineLevel::give_work(const FineScene& scene, const Block& block) {
  const auto row = [&](std::size_t n) {
    return static_cast<std::size_t>(block.particles[n].particle);
  };
  for (std::size_t n = 0; n < block.work.size(); ++n) {
    scene.work->add_with_particles(row(n), block.work[n].normal, block.work[n].tangential);
    scene.work->note_acceleration(row(n), block.work[n].acceleration);
  }
  for (const BlockWallWork& w : block.wall_work) {
    scene.work->add_with_wall(row(static_cast<std::size_t>(w.particle)),
                              static_cast<std::size_t>(w.wall), w.normal, w.tangential);
  }
}

void FineLevel::return_to_coarse(const FineScene& scene) {
  deferred_.clear();
  for (const Block& block : blocks_.all()) {
    for (const SubCycledParticle& p : block.particles) {
      DeferredImpulse impulse;
      if (p.is_coarse && store_coarse(p, scene, impulse)) deferred_.add(impulse);
    }
  }
  deferred_.merge();
}

void FineLevel::save(sdk::ArchiveWriter& archive) const {
  archive.numbers("fine_force", force_);
  deferred_.save(archive);
  archive.number("largest_fine_overlap", largest_overlap_);
}

void FineLevel::load(sdk::ArchiveReader& archive, std::int64_t sub_steps) {
  const auto force = archive.numbers("fine_force");
  force_.assign(force.begin(), force.end());
  deferred_.load(archive);
  largest_overlap_ = archive.number("largest_fine_overlap");
  sub_steps_ = sub_steps;
}

}  // namespace dust::particles
