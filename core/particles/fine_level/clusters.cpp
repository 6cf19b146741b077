// SPDX-License-Identifier: Apache-2.0
#include "particles/fine_level/clusters.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace dust::particles {
namespace {

/// Contacts per task.
constexpr std::size_t k_contacts = 256;
/// A coarse particle is heavy beside a fine one from so many times its mass on. Clusters near a
/// heavy one feel each other through it only from the next coarse step on: a share of 1/k_heavy of
/// their forces comes that late. Near a light one all are one cluster.
constexpr double k_heavy = 64.0;

/// Whether a coarse particle is heavy beside a fine one; docs/theory/grains.md, eq. (13).
bool is_heavy(const ParticleStore& s, std::int32_t coarse, std::int32_t fine) {
  const auto c = static_cast<std::size_t>(coarse);
  const auto f = static_cast<std::size_t>(fine);
  return felt_share(s.weight(c), s.weight(f)) * s.inverse_mass(c) * k_heavy <=
         felt_share(s.weight(f), s.weight(c)) * s.inverse_mass(f);
}

/// The finest level that a fine particle's size may need.
int finest_level(const TimeSteps& steps, double diameter) {
  const auto size =
      std::lower_bound(steps.classes.begin(), steps.classes.end(), diameter * (1.0 - 1e-9),
                       [](const ClassStep& c, double d) { return c.diameter < d; });
  return size == steps.classes.end() ? 0 : size->level;
}

}  // namespace

void Clusters::find(const FineScene& scene) {
  fine_.resize(scene.fine_count());
  for (const std::int32_t particle : scene.active) fine_[scene.fine_index(particle)] = {};
  predict_others(scene);
  join_near_others(scene);
  join_knocked(scene);
  unite_by_light_partners(scene);
  unite_fine_pairs(scene);
  list_coarse_partners(scene);
  choose_levels(scene);
  // Cluster by cluster, those of the finest level first: a block of particles has one level.
  std::sort(sub_cycled_.begin(), sub_cycled_.end(), [&](std::int32_t a, std::int32_t b) {
    const std::int32_t ca = at(a).cluster;
    const std::int32_t cb = at(b).cluster;
    const std::int32_t la = at(ca).level;
    const std::int32_t lb = at(cb).level;
    return std::tie(lb, ca, a) < std::tie(la, cb, b);
  });
}

/// Contacts with surfaces and coarse particles.
void Clusters::predict_others(const FineScene& scene) {
  const std::size_t count = scene.contacts.count;
  prediction_.assign(count, {});
  oneapi::tbb::parallel_for(std::size_t{0}, (count + k_contacts - 1) / k_contacts,
                            [&](std::size_t block) {
                              const std::size_t end = std::min(count, (block + 1) * k_contacts);
                              for (std::size_t e = block * k_contacts; e < end; ++e) {
                                if (!scene.is_fine(scene.contacts.b[e]))
                                  prediction_[e] = predict_contact(scene, e, 0.0);
                              }
                            });
}

void Clusters::join(std::int32_t n, const ContactPrediction& prediction, std::uint8_t touching) {
  Fine& fine = at(n);
  if (fine.cluster < 0) {
    fine.cluster = n;
    fine.stable_step = prediction.stable_step;
  }
  fine.stable_step = std::min(fine.stable_step, prediction.stable_step);
  // A contact under way keeps its step, or a shorter one: a step that grew and shrank with the
  // speed and the overlap would not be the same on the way in and on the way out.
  fine.least_level = std::max(fine.least_level, static_cast<std::int32_t>(touching) - 1);
}

void Clusters::join_near_others(const FineScene& scene) {
  const contact::PairView& contacts = scene.contacts;
  host_.resize(scene.coarse_count, -1);
  for (std::size_t e = 0; e < contacts.count; ++e) {
    const std::int32_t b = contacts.b[e];
    if (scene.is_fine(b) || !is_near(e)) continue;
    const auto n = static_cast<std::int32_t>(scene.fine_index(contacts.a[e]));
    join(n, prediction_[e], contacts.is_touching[e]);
    at(n).speed = std::max(at(n).speed, prediction_[e].speed);
    note_host(scene, e);
  }
}

/// A light coarse partner has a cluster of its own.
void Clusters::note_host(const FineScene& scene, std::size_t entry) {
  const std::int32_t a = scene.contacts.a[entry];
  const std::int32_t b = scene.contacts.b[entry];
  if (!scene.is_coarse(b) || is_heavy(scene.particles, b, a)) return;
  host_[static_cast<std::size_t>(b)] = static_cast<std::int32_t>(scene.fine_index(a));
}

/// One that meets a partner within this step may be knocked to another: it leaves the first with up
/// to twice the speed that they meet with.
void Clusters::join_knocked(const FineScene& scene) {
  const contact::PairView& contacts = scene.contacts;
  for (std::size_t e = 0; e < contacts.count; ++e) {
    if (scene.is_fine(contacts.b[e]) || is_near(e)) continue;
    const auto n = static_cast<std::int32_t>(scene.fine_index(contacts.a[e]));
    if (at(n).cluster < 0) continue;
    prediction_[e] = predict_contact(scene, e, 2.0 * at(n).speed);
    if (!is_near(e)) continue;
    join(n, prediction_[e], contacts.is_touching[e]);
    note_host(scene, e);
  }
}

void Clusters::unite_by_light_partners(const FineScene& scene) {
  const contact::PairView& contacts = scene.contacts;
  for (std::size_t e = 0; e < contacts.count; ++e) {
    if (!scene.is_coarse(contacts.b[e]) || !is_near(e)) continue;
    const std::int32_t host = host_[static_cast<std::size_t>(contacts.b[e])];
    if (host >= 0) unite(host, fine_[scene.fine_index(contacts.a[e])].cluster);
  }
}

void Clusters::unite_fine_pairs(const FineScene& scene) {
  const contact::PairView& contacts = scene.contacts;
  for (std::size_t e = 0; e < contacts.count; ++e) {
    if (!scene.is_fine(contacts.b[e])) continue;
    const auto i = static_cast<std::int32_t>(scene.fine_index(contacts.a[e]));
    const auto j = static_cast<std::int32_t>(scene.fine_index(contacts.b[e]));
    // A particle that bounces within this step may turn its relative velocity round.
    prediction_[e] = predict_contact(scene, e, 2.0 * (at(i).speed + at(j).speed));
    if (!is_near(e)) continue;
    join(i, prediction_[e], contacts.is_touching[e]);
    join(j, prediction_[e], contacts.is_touching[e]);
    unite(at(i).cluster, at(j).cluster);
  }
}

void Clusters::list_coarse_partners(const FineScene& scene) {
  const contact::PairView& contacts = scene.contacts;
  partners_.clear();
  for (std::size_t e = 0; e < contacts.count; ++e) {
    const std::int32_t b = contacts.b[e];
    if (!scene.is_coarse(b)) continue;
    host_[static_cast<std::size_t>(b)] = -1;
    if (!is_near(e)) continue;
    partners_.push_back({root(fine_[scene.fine_index(contacts.a[e])].cluster), b});
  }
  const auto key = [](const CoarsePartner& p) { return std::tie(p.cluster, p.particle); };
  std::sort(partners_.begin(), partners_.end(),
            [&](const CoarsePartner& a, const CoarsePartner& b) { return key(a) < key(b); });
  const auto is_same = [&](const CoarsePartner& a, const CoarsePartner& b) {
    return key(a) == key(b);
  };
  partners_.erase(std::unique(partners_.begin(), partners_.end(), is_same), partners_.end());
}

/// A cluster steps at the level of its most demanding particle, no finer than that particle's size
/// needs.
void Clusters::choose_levels(const FineScene& scene) {
  sub_cycled_.clear();
  for (const std::int32_t particle : scene.active) {
    const auto n = static_cast<std::int32_t>(scene.fine_index(particle));
    Fine& fine = at(n);
    if (fine.cluster < 0) continue;
    fine.cluster = root(n);
    const double diameter = 2.0 * scene.particles.radius(static_cast<std::size_t>(particle));
    const int wanted = static_cast<int>(
        std::ceil(std::log2(scene.steps.coarse_step / std::max(fine.stable_step, 1e-30))));
    std::int32_t& level = at(fine.cluster).level;
    level = std::max(
        {level, std::clamp(wanted, 0, finest_level(scene.steps, diameter)), fine.least_level});
    sub_cycled_.push_back(n);
  }
}

void Clusters::unite(std::int32_t a, std::int32_t b) {
  const std::int32_t i = root(a);
  const std::int32_t j = root(b);
  at(std::max(i, j)).cluster = std::min(i, j);
}

/// With path halving.
std::int32_t Clusters::root(std::int32_t n) {
  while (at(n).cluster != n) {
    at(n).cluster = at(at(n).cluster).cluster;
    n = at(n).cluster;
  }
  return n;
}

}  // namespace dust::particles
