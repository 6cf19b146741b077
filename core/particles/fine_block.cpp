// SPDX-License-Identifier: Apache-2.0
#include "particles/fine_block.hpp"

#include "particles/wall_contacts.hpp"

#include <algorithm>
#include <cmath>

namespace dust::particles {
namespace {

using contact::BatchColumns;
using contact::k_batch;
using sdk::Vec3;

/// Drag integrated exactly over `kick`, as for coarse grains; then the drift.
void advance(Member& m, double step) {
  const double kick = m.lag + 0.5 * step;
  if (kick != m.kick) {
    const double x = m.rate * kick;
    m.kick = kick;
    m.decay = std::exp(-x);
    m.phi = x > 0.0 ? -std::expm1(-x) / x : 1.0;
  }
  const Vec3 old = m.half_velocity;
  const Vec3 push = kick * m.gravity + m.inverse_mass * m.impulse;
  const Vec3 half = old + (1.0 - m.decay) * (m.target - old) + m.phi * push;
  m.received += (half - old - push) / m.inverse_mass;
  m.velocity = half + (0.5 * step / kick * m.decay) * (half - old);
  m.half_velocity = half;
  m.displacement = step * half;
  m.position += m.displacement;
  const Vec3 spin = (2.5 * m.inverse_mass / (m.radius * m.radius)) * m.twist;
  m.half_rotation += spin;
  m.rotation = m.half_rotation + (0.5 * step / kick) * spin;
  m.angle = step * m.half_rotation;
  if (m.is_guest) {
    m.shift += step * (half - m.course);
    m.turn += step * (m.half_rotation - m.course_rotation);
  }
  m.force = m.impulse / kick;
  m.lag = 0.5 * step;
  m.impulse = m.twist = {};
}

/// Fills the columns of one batch and applies what the laws say.
class BlockPass {
 public:
  BlockPass(Dem::Impl& dem, Block& block, double now) : dem_(dem), block_(block), now_(now) {}

  void run() {
    const double step = dem_.steps.coarse_step;
    const int count = 1 << block_.level;
    const double sub_step = step / count;
    for (int m = 0; m < count; ++m) {
      time_ = now_ + m * sub_step;
      slow_share_ = 0.5 - static_cast<double>(m) / count;
      is_first_ = m == 0;
      evaluate(sub_step);
      for (Member& member : block_.members) advance(member, sub_step);
    }
  }

 private:
  void evaluate(double sub_step) {
    count_ = 0;
    const Candidate* open = nullptr;
    for (Candidate& c : block_.candidates) {
      if (open != nullptr &&
          (open->law != c.law || open->surface != c.surface || count_ == k_batch)) {
        flush(*open, sub_step);
      }
      open = &c;
      const bool is_touching = c.surface >= 0 ? load_surface(c) : load_pair(c);
      const auto e = static_cast<std::size_t>(c.entry);
      if (is_touching) {
        is_new_[count_] = dem_.fine.is_touching[e] == 0;
        in_batch_[count_++] = &c;
      } else if (dem_.fine.is_touching[e] != 0) {
        std::fill_n(dem_.fine.history.data() + e * dem_.history_stride, dem_.history_stride, 0.0);
      }
      dem_.fine.is_touching[e] = is_touching ? 1 + block_.level : 0;
    }
    if (open != nullptr) flush(*open, sub_step);
  }

  void set(int column, const Vec3& v) {
    for (int d = 0; d < 3; ++d) columns_.column(column + d)[count_] = v[d];
  }

  bool load_pair(const Candidate& c) {
    using B = BatchColumns;
    const Member& i = block_.members[static_cast<std::size_t>(c.member)];
    const Member& j = block_.members[static_cast<std::size_t>(c.partner)];
    const Vec3 d = dem_.separation(&j.position.x, &i.position.x);
    const double reach = i.radius + j.radius + dem_.laws[static_cast<std::size_t>(c.law)].range;
    if (!(dot(d, d) < reach * reach)) return false;
    set(B::separation_x, d);
    // A guest's own step is a straight course; its velocity changes along it.
    set(B::velocity_x, i.velocity - j.velocity + slow_share_ * j.slow_kick);
    set(B::rotation_i_x, i.rotation);
    set(B::rotation_j_x, j.rotation - slow_share_ * j.slow_twist);
    set(B::angle_i_x, i.angle);
    if (j.is_guest && is_first_) {
      // The last look was in the coarse step before, on the course of then.
      const double since = 2.0 * i.lag;
      set(B::displacement_x, i.displacement - since * (j.course - j.slow_kick));
      set(B::angle_j_x, since * (j.course_rotation - j.slow_twist));
    } else {
      set(B::displacement_x, i.displacement - j.displacement);
      set(B::angle_j_x, j.angle);
    }
    columns_.column(B::radius_i)[count_] = i.radius;
    columns_.column(B::radius_j)[count_] = j.radius;
    // How the two answer a force: by weight, see apply().
    columns_.column(B::inverse_mass)[count_] = felt_share(i.weight, j.weight) * i.inverse_mass +
                                               felt_share(j.weight, i.weight) * j.inverse_mass;
    return true;
  }

  /// Books the impact that begins with contact q of the batch.
  void note_impact(const Candidate& c, std::size_t q) {
    using B = BatchColumns;
    const auto get = [&](int column) {
      return Vec3{columns_.column(column)[q], columns_.column(column + 1)[q],
                  columns_.column(column + 2)[q]};
    };
    const Member& i = block_.members[static_cast<std::size_t>(c.member)];
    block_.wall_impacts.push_back(impact_of(dem_.surfaces[static_cast<std::size_t>(c.surface)].wall,
                                            1.0 / i.inverse_mass, i.weight, get(B::velocity_x),
                                            get(B::normal_x)));
  }

  bool load_surface(const Candidate& c) {
    const Member& i = block_.members[static_cast<std::size_t>(c.member)];
    const Surface& surface = dem_.surfaces[static_cast<std::size_t>(c.surface)];
    const bodies::SurfacePoint s = surface.contact_at(time_, i.position);
    const double overlap = i.radius - s.distance;
    if (!(overlap > -dem_.laws[static_cast<std::size_t>(c.law)].range)) return false;
    put_at_wall({.position = i.position,
                 .velocity = i.velocity,
                 .rotation = i.rotation,
                 .radius = i.radius,
                 .inverse_mass = i.inverse_mass,
                 .displacement = i.displacement,
                 .angle = i.angle,
                 .since = 2.0 * i.lag},
                s, count_, columns_);
    block_.largest_overlap = std::max(block_.largest_overlap, overlap / i.radius);
    return true;
  }

  void flush(const Candidate& open, double sub_step) {
    using B = BatchColumns;
    if (count_ == 0) return;
    const std::size_t stride = dem_.history_stride;
    for (std::size_t q = 0; q < contact::padded(count_); ++q) {
      const Candidate& c = *in_batch_[std::min(q, count_ - 1)];
      const double* h = dem_.fine.history.data() + static_cast<std::size_t>(c.entry) * stride;
      for (std::size_t k = 0; k < stride; ++k) columns_.history()[k][q] = h[k];
    }
    if (open.surface < 0) {
      for (int c = 0; c <= B::torque_j_z; ++c) {
        double* column = columns_.column(c);
        for (std::size_t q = count_; q < contact::padded(count_); ++q) {
          column[q] = column[count_ - 1];
        }
      }
      block_.largest_overlap =
          std::max(block_.largest_overlap, contact::derive_pair_columns(columns_, count_));
    } else {
      derive_wall_columns(dem_.surfaces[static_cast<std::size_t>(open.surface)], time_, sub_step,
                          count_, columns_);
      for (std::size_t q = 0; dem_.wall_loads.is_on() && q < count_; ++q) {
        if (is_new_[q]) note_impact(*in_batch_[q], q);
      }
    }
    const PairLaws& law = dem_.laws[static_cast<std::size_t>(open.law)];
    evaluate_laws(law, columns_, count_, sub_step);
    for (std::size_t q = 0; q < count_; ++q) apply(*in_batch_[q], q, sub_step);
    count_ = 0;
  }

  void apply(Candidate& c, std::size_t q, double sub_step) {
    using B = BatchColumns;
    double* h = dem_.fine.history.data() + static_cast<std::size_t>(c.entry) * dem_.history_stride;
    for (std::size_t k = 0; k < dem_.history_stride; ++k) h[k] = columns_.history()[k][q];
    const auto get = [&](int column) {
      return Vec3{columns_.column(column)[q], columns_.column(column + 1)[q],
                  columns_.column(column + 2)[q]};
    };
    const Vec3 force = get(B::force_x);
    const Vec3 torque_i = get(B::torque_i_x);
    Member& i = block_.members[static_cast<std::size_t>(c.member)];
    double duration = i.lag + 0.5 * sub_step;
    if (c.surface >= 0) {
      i.impulse += duration * force;
      i.twist += duration * torque_i;
      if (!block_.wall_sums.empty()) {
        const auto wall =
            static_cast<std::size_t>(dem_.surfaces[static_cast<std::size_t>(c.surface)].wall);
        add_load(block_.wall_sums.data() + WallLoads::k_sums * wall, i.position, force, torque_i,
                 get(B::separation_x), i.weight * duration);
      }
      return;
    }
    const Vec3 torque_j = get(B::torque_j_x);
    Member& j = block_.members[static_cast<std::size_t>(c.partner)];
    // Two grains that come together with different lags share one duration, so that their impulses
    // are opposite. A guest has had its own step already.
    if (!j.is_guest) duration = 0.5 * (duration + j.lag + 0.5 * sub_step);
    const double share_i = felt_share(i.weight, j.weight);
    const double share_j = felt_share(j.weight, i.weight);
    i.impulse += (share_i * duration) * force;
    i.twist += (share_i * duration) * torque_i;
    j.impulse -= (share_j * duration) * force;
    j.twist += (share_j * duration) * torque_j;
  }

  Dem::Impl& dem_;
  Block& block_;
  double now_;
  double time_ = 0.0;
  double slow_share_ = 0.0;  ///< of a guest's own kick still to come, less half of it
  bool is_first_ = false;    ///< sub-step of the coarse step
  std::size_t count_ = 0;
  Candidate* in_batch_[k_batch] = {};
  bool is_new_[k_batch] = {};
  BatchColumns& columns_ = thread_columns();
};

}  // namespace

Member load_member(const GrainStore& s, const contact::AlignedVector<double>& gravity,
                   std::size_t row) {
  Member m;
  m.row = static_cast<std::int32_t>(row);
  m.radius = s.position[4 * row + 3];
  m.inverse_mass = s.velocity(row)[3];
  m.weight = s.weight[row];
  const double* action = s.action_of(row);
  m.rate = action[3];
  m.position = vec(s.position.data() + 4 * row);
  m.velocity = vec(s.velocity(row));
  m.rotation = vec(s.rotation(row));
  m.half_velocity = vec(s.half_velocity(row));
  m.half_rotation = vec(s.half_rotation(row));
  m.lag = s.half_velocity(row)[3];
  m.displacement = 2.0 * m.lag * m.half_velocity;
  m.angle = 2.0 * m.lag * m.half_rotation;
  m.target = vec(action);
  m.gravity = vec(gravity.data() + 4 * static_cast<std::ptrdiff_t>(s.material[row]));
  if (s.has_fluid) m.received = vec(s.impulse.data() + 4 * row);
  return m;
}

Member load_guest(const Dem::Impl& dem, std::int32_t row, double sub_step) {
  const GrainStore& s = dem.store;
  const auto n = static_cast<std::size_t>(row);
  Member m;
  m.row = row;
  m.is_guest = true;
  m.radius = s.position[4 * n + 3];
  m.inverse_mass = s.velocity(n)[3];
  m.weight = s.weight[n];
  m.course = m.velocity = m.half_velocity = vec(s.half_velocity(n));
  m.course_rotation = m.rotation = m.half_rotation = vec(s.half_rotation(n));
  m.position = vec(s.position.data() + 4 * n) - dem.steps.coarse_step * m.course;
  m.lag = 0.5 * sub_step;
  // The step has left a velocity predicted from the kick, half of it less what drag takes.
  const double drag = s.has_fluid ? s.decay[2 * n] : 1.0;
  m.slow_kick = (2.0 / drag) * (vec(s.velocity(n)) - m.course);
  m.slow_twist = 2.0 * (vec(s.rotation(n)) - m.course_rotation);
  if (const LeftOver* l = dem.left_over(row)) {
    m.velocity += l->velocity_ahead;
    m.rotation += l->rotation_ahead;
  }
  return m;
}

void store_member(GrainStore& s, const Member& m, double* force) {
  const auto row = static_cast<std::size_t>(m.row);
  for (int d = 0; d < 3; ++d) {
    const auto k = 4 * row + static_cast<std::size_t>(d);
    s.position[k] = m.position[d];
    s.velocity(row)[d] = m.velocity[d];
    s.rotation(row)[d] = m.rotation[d];
    s.half_velocity(row)[d] = m.half_velocity[d];
    s.half_rotation(row)[d] = m.half_rotation[d];
    if (s.has_fluid) s.impulse[k] = m.received[d];
    force[d] = m.force[d];
  }
  s.half_velocity(row)[3] = m.lag;
}

void run_block(Dem::Impl& dem, Block& block, double now) { BlockPass(dem, block, now).run(); }

}  // namespace dust::particles
