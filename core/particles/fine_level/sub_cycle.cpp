// SPDX-License-Identifier: Apache-2.0
#include "particles/fine_level/sub_cycle.hpp"

#include "contact/nearest_image.hpp"
#include "particles/forces/handover.hpp"
#include "particles/forces/law_stages.hpp"
#include "particles/forces/wall_contacts.hpp"
#include "particles/work/dissipation.hpp"

#include <algorithm>
#include <ranges>

namespace dust::particles {
namespace {

using contact::BatchColumns;
using contact::k_batch;
using sdk::Vec3;
using B = BatchColumns;

/// Fills the columns of one batch and applies what the laws say.
class SubCycle {
 public:
  SubCycle(const FineScene& scene, Block& block) : scene_(scene), block_(block) {}

  void run() {
    const int count = 1 << block_.level;
    sub_step_ = scene_.steps.coarse_step / count;
    for (int m = 0; m < count; ++m) {
      block_.slidings.begin_step();
      time_ = scene_.time + m * sub_step_;
      slow_fraction_ = 0.5 - static_cast<double>(m) / count;
      is_first_ = m == 0;
      evaluate();
      if (scene_.work != nullptr) note_accelerations();
      for (SubCycledParticle& p : block_.particles) advance(p, sub_step_);
    }
  }

 private:
  [[nodiscard]] SubCycledParticle& particle(const CandidateContact& c) {
    return block_.particles[static_cast<std::size_t>(c.particle)];
  }
  [[nodiscard]] SubCycledParticle& partner(const CandidateContact& c) {
    return block_.particles[static_cast<std::size_t>(c.partner)];
  }
  [[nodiscard]] double* history(const CandidateContact& c) const {
    return scene_.contacts.history +
           static_cast<std::size_t>(c.entry) * scene_.contacts.history_stride;
  }
  void set(int column, const Vec3& v) {
    for (int d = 0; d < 3; ++d) columns_.column(column + d)[count_] = v[d];
  }
  [[nodiscard]] Vec3 get(int column, std::size_t q) {
    return {columns_.column(column)[q], columns_.column(column + 1)[q],
            columns_.column(column + 2)[q]};
  }

  void evaluate();
  bool load_pair(const CandidateContact& c);
  bool load_surface(const CandidateContact& c);
  [[nodiscard]] SurfaceContact surface_contact(const CandidateContact& c) const {
    return {static_cast<std::size_t>(c.entry), &scene_.surface(c.surface)};
  }
  [[nodiscard]] bool is_handed_over(const CandidateContact& c);
  void flush(const CandidateContact& open);
  void derive_pairs();
  void derive_walls(const Surface& surface);
  void note_work(const CandidateContact& open);
  void note_accelerations();
  void apply(const CandidateContact& c, std::size_t q);
  void apply_to_wall(const CandidateContact& c, std::size_t q);

  const FineScene& scene_;
  Block& block_;
  double sub_step_ = 0.0;
  double time_ = 0.0;
  double slow_fraction_ = 0.0;  ///< of a coarse particle's own kick still to come, less half of it
  bool is_first_ = false;       ///< sub-step of the coarse step
  std::size_t count_ = 0;
  const CandidateContact* in_batch_[k_batch] = {};
  bool is_new_[k_batch] = {};
  BatchColumns& columns_ = thread_columns();
};

void SubCycle::evaluate() {
  count_ = 0;
  const CandidateContact* open = nullptr;
  for (const CandidateContact& c : block_.candidates) {
    if (open != nullptr &&
        (open->law != c.law || open->surface != c.surface || count_ == k_batch)) {
      flush(*open);
    }
    open = &c;
    const bool is_touching = c.surface >= 0 ? load_surface(c) : load_pair(c);
    std::uint8_t& touching = scene_.contacts.is_touching[c.entry];
    if (is_touching) {
      is_new_[count_] = touching == 0 && !is_handed_over(c);
      in_batch_[count_++] = &c;
    } else if (touching != 0 && !is_handed_over(c)) {
      std::fill_n(history(c), scene_.contacts.history_stride, 0.0);
    }
    touching = static_cast<std::uint8_t>(is_touching ? 1 + block_.level : 0);
  }
  if (open != nullptr) flush(*open);
}

/// With another surface that the same particle may touch.
bool SubCycle::is_handed_over(const CandidateContact& c) {
  if (c.surface < 0) return false;
  auto others =
      block_.candidates | std::views::filter([&](const CandidateContact& e) {
        return e.particle == c.particle && e.surface >= 0;
      }) |
      std::views::transform([&](const CandidateContact& e) { return surface_contact(e); });
  const SubCycledParticle& i = particle(c);
  const double reach = i.radius + scene_.law(c.law).range;
  return join_handover(scene_.contacts, surface_contact(c), others, [&](const Surface& other) {
    return other.contact_at(time_, i.position, reach).distance < reach;
  });
}

bool SubCycle::load_pair(const CandidateContact& c) {
  const SubCycledParticle& i = particle(c);
  const SubCycledParticle& j = partner(c);
  const Vec3 d = contact::nearest_image(scene_.images, &j.position.x, &i.position.x);
  const double reach = i.radius + j.radius + scene_.law(c.law).range;
  if (!(dot(d, d) < reach * reach)) return false;
  set(B::separation_x, d);
  // A coarse particle's own step is a straight line; its velocity changes along it.
  set(B::velocity_x, i.velocity.linear - j.velocity.linear + slow_fraction_ * j.coarse.kick.linear);
  set(B::rotation_i_x, i.velocity.angular);
  set(B::rotation_j_x, j.velocity.angular - slow_fraction_ * j.coarse.kick.angular);
  set(B::angle_i_x, i.displacement.angular);
  if (j.is_coarse && is_first_) {
    // The contact was last evaluated in the coarse step before, on the line of then.
    const double since = 2.0 * i.since_kick;
    set(B::displacement_x,
        i.displacement.linear - since * (j.coarse.velocity.linear - j.coarse.kick.linear));
    set(B::angle_j_x, since * (j.coarse.velocity.angular - j.coarse.kick.angular));
  } else {
    set(B::displacement_x, i.displacement.linear - j.displacement.linear);
    set(B::angle_j_x, j.displacement.angular);
  }
  columns_.column(B::radius_i)[count_] = i.radius;
  columns_.column(B::radius_j)[count_] = j.radius;
  // How the two answer a force, see apply(); docs/theory/rare_grains.md, eq. (2).
  columns_.column(B::inverse_mass_i)[count_] = felt_share(i.weight, j.weight) * i.inverse_mass;
  columns_.column(B::inverse_mass_j)[count_] = felt_share(j.weight, i.weight) * j.inverse_mass;
  return true;
}

bool SubCycle::load_surface(const CandidateContact& c) {
  const SubCycledParticle& i = particle(c);
  const Surface& surface = scene_.surface(c.surface);
  const double reach = i.radius + scene_.law(c.law).range;
  const bodies::SurfacePoint s = surface.contact_at(time_, i.position, reach);
  const double overlap = i.radius - s.distance;
  if (surface.opening >= 0 && overlap > 0.0) {
    scene_.opening_marks.note(surface, i.particle, i.position - s.distance * s.normal);
  }
  if (!(overlap > -scene_.law(c.law).range)) return false;
  put_at_wall({.position = i.position,
               .velocity = i.velocity.linear,
               .rotation = i.velocity.angular,
               .radius = i.radius,
               .inverse_mass = i.inverse_mass,
               .displacement = i.displacement.linear,
               .angle = i.displacement.angular,
               .since = 2.0 * i.since_kick},
              s, count_, columns_);
  block_.largest_overlap = std::max(block_.largest_overlap, overlap / i.radius);
  return true;
}

void SubCycle::derive_pairs() {
  contact::repeat_last(columns_, count_, B::separation_x, B::displacement_z);
  contact::repeat_last(columns_, count_, B::rotation_i_x, B::rotation_j_z);
  contact::repeat_last(columns_, count_, B::angle_i_x, B::angle_j_z);
  block_.largest_overlap =
      std::max(block_.largest_overlap, contact::derive_pair_columns(columns_, count_));
}

/// Notes, too, the impacts that begin with contacts of the batch.
void SubCycle::derive_walls(const Surface& surface) {
  derive_wall_columns(surface, time_, sub_step_, count_, columns_);
  if (!scene_.wall_loads.is_on()) return;
  for (std::size_t q = 0; q < count_; ++q) {
    const CandidateContact& c = *in_batch_[q];
    const bool is_new = scene_.law(c.law).range > 0.0 ? has_struck(columns_, q) : is_new_[q];
    if (!is_new) continue;
    const SubCycledParticle& i = particle(c);
    block_.wall_impacts.push_back(impact_of(surface.wall, 1.0 / i.inverse_mass, i.weight,
                                            get(B::velocity_x, q), get(B::normal_x, q)));
  }
}

void SubCycle::flush(const CandidateContact& open) {
  if (count_ == 0) return;
  const std::size_t stride = scene_.contacts.history_stride;
  for (std::size_t q = 0; q < contact::padded(count_); ++q) {
    const double* h = history(*in_batch_[std::min(q, count_ - 1)]);
    for (std::size_t k = 0; k < stride; ++k) columns_.history()[k][q] = h[k];
  }
  if (open.surface < 0) {
    derive_pairs();
  } else {
    derive_walls(scene_.surface(open.surface));
  }
  evaluate_laws(scene_.law(open.law), columns_, count_, sub_step_);
  if (scene_.work != nullptr) note_work(open);
  for (std::size_t q = 0; q < count_; ++q) {
    const CandidateContact& c = *in_batch_[q];
    double* h = history(c);
    for (std::size_t k = 0; k < stride; ++k) h[k] = columns_.history()[k][q];
    if (c.surface < 0) {
      apply(c, q);
    } else {
      apply_to_wall(c, q);
    }
  }
  count_ = 0;
}

/// What the batch dissipates: half of it at either particle, where weights differ by the share of
/// the force that it feels; all of it at the particle of a wall.
void SubCycle::note_work(const CandidateContact& open) {
  Dissipation lost;
  find_dissipation(scene_.law(open.law), columns_, count_, sub_step_, scene_.laws.work_column(),
                   lost);
  for (std::size_t q = 0; q < count_; ++q) {
    const CandidateContact& c = *in_batch_[q];
    if (c.surface >= 0) {
      block_.wall_work.push_back(
          {c.particle, scene_.surface(c.surface).wall, lost.normal[q], lost.tangential[q]});
      continue;
    }
    const double weight_i = particle(c).weight;
    const double weight_j = partner(c).weight;
    const auto add = [&](std::int32_t side, double share) {
      BlockWork& work = block_.work[static_cast<std::size_t>(side)];
      work.normal += 0.5 * share * lost.normal[q];
      work.tangential += 0.5 * share * lost.tangential[q];
    };
    add(c.particle, felt_share(weight_i, weight_j));
    add(c.partner, felt_share(weight_j, weight_i));
  }
}

void SubCycle::note_accelerations() {
  for (std::size_t n = 0; n < block_.particles.size(); ++n) {
    const SubCycledParticle& p = block_.particles[n];
    const double kick = p.since_kick + 0.5 * sub_step_;
    double& largest = block_.work[n].acceleration;
    largest = std::max(largest, norm(p.impulse.linear) * p.inverse_mass / kick);
  }
}

void SubCycle::apply(const CandidateContact& c, std::size_t q) {
  SubCycledParticle& i = particle(c);
  SubCycledParticle& j = partner(c);
  const Vec3 force = get(B::force_x, q);
  double duration = i.since_kick + 0.5 * sub_step_;
  // Two particles that come together with different times since their kicks share one duration,
  // so that their impulses are opposite. A coarse one has had its own step already.
  if (!j.is_coarse) duration = 0.5 * (duration + j.since_kick + 0.5 * sub_step_);
  const double share_i = felt_share(i.weight, j.weight);
  const double share_j = felt_share(j.weight, i.weight);
  i.impulse.linear += (share_i * duration) * force;
  i.impulse.angular += (share_i * duration) * get(B::torque_i_x, q);
  j.impulse.linear -= (share_j * duration) * force;
  j.impulse.angular += (share_j * duration) * get(B::torque_j_x, q);
}

void SubCycle::apply_to_wall(const CandidateContact& c, std::size_t q) {
  SubCycledParticle& i = particle(c);
  const Vec3 force = get(B::force_x, q);
  const Vec3 torque = get(B::torque_i_x, q);
  const double duration = i.since_kick + 0.5 * sub_step_;
  i.impulse.linear += duration * force;
  i.impulse.angular += duration * torque;
  if (block_.wall_sums.empty()) return;
  const auto wall = static_cast<std::size_t>(scene_.surface(c.surface).wall);
  add_load(block_.wall_sums.data() + WallLoads::k_sums * wall, i.position, force, torque,
           wall_power(scene_.surface(c.surface), scene_.law(c.law).rolling != nullptr, q, columns_),
           i.weight * duration);
  if (!scene_.wall_loads.has_sliding()) return;
  block_.slidings.add(sliding_contact(columns_, q,
                                      {.particle = c.particle,
                                       .wall = scene_.surface(c.surface).wall,
                                       .point = i.position,
                                       .weighted_time = i.weight * duration}));
}

}  // namespace

void sub_cycle(const FineScene& scene, Block& block) { SubCycle(scene, block).run(); }

}  // namespace dust::particles
