// SPDX-License-Identifier: Apache-2.0
#include "particles/fine_block.hpp"

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
  m.position += step * half;
  const Vec3 spin = (2.5 * m.inverse_mass / (m.radius * m.radius)) * m.twist;
  m.half_rotation += spin;
  m.rotation = m.half_rotation + (0.5 * step / kick) * spin;
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
      before_end_ = step - m * sub_step;
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
        if (c.surface >= 0 && dem_.wall_loads.is_on() && dem_.fine.is_touching[e] == 0) {
          note_impact(c);
        }
        in_batch_[count_++] = &c;
      } else if (dem_.fine.is_touching[e] != 0) {
        std::fill_n(dem_.fine.history.data() + e * dem_.history_stride, dem_.history_stride, 0.0);
      }
      dem_.fine.is_touching[e] = is_touching ? 1 : 0;
    }
    if (open != nullptr) flush(*open, sub_step);
  }

  void set(int column, const Vec3& v) {
    for (int d = 0; d < 3; ++d) columns_.column(column + d)[count_] = v[d];
  }

  bool load_pair(const Candidate& c) {
    using B = BatchColumns;
    const Member& i = block_.members[static_cast<std::size_t>(c.member)];
    Vec3 position;
    Vec3 velocity;
    Vec3 rotation;
    double radius = 0.0;
    double inverse_mass = 0.0;
    if (c.partner >= 0) {
      const Member& j = block_.members[static_cast<std::size_t>(c.partner)];
      position = j.position, velocity = j.velocity, rotation = j.rotation;
      radius = j.radius, inverse_mass = j.inverse_mass;
    } else {
      // The coarse grain has made its step: its course is the straight line between both ends.
      const auto row = 4 * static_cast<std::size_t>(c.row);
      velocity = vec(dem_.store.half_velocity.data() + row);
      position = vec(dem_.store.position.data() + row) - before_end_ * velocity;
      rotation = vec(dem_.store.half_rotation.data() + row);
      radius = dem_.store.position[row + 3];
      inverse_mass = dem_.store.velocity[row + 3];
    }
    const Vec3 d = dem_.separation(&position.x, &i.position.x);
    const double reach = i.radius + radius + dem_.laws[static_cast<std::size_t>(c.law)].range;
    if (!(dot(d, d) < reach * reach)) return false;
    set(B::separation_x, d);
    set(B::velocity_x, i.velocity - velocity);
    set(B::rotation_i_x, i.rotation);
    set(B::rotation_j_x, rotation);
    columns_.column(B::radius_i)[count_] = i.radius;
    columns_.column(B::radius_j)[count_] = radius;
    columns_.column(B::inverse_mass)[count_] = i.inverse_mass + inverse_mass;
    return true;
  }

  /// Books the impact that begins with what load_surface() has just loaded.
  void note_impact(const Candidate& c) {
    using B = BatchColumns;
    const auto get = [&](int column) {
      return Vec3{columns_.column(column)[count_], columns_.column(column + 1)[count_],
                  columns_.column(column + 2)[count_]};
    };
    const Member& i = block_.members[static_cast<std::size_t>(c.member)];
    block_.wall_impacts.push_back(impact_of(dem_.surfaces[static_cast<std::size_t>(c.surface)].wall,
                                            1.0 / i.inverse_mass, i.weight, get(B::velocity_x),
                                            get(B::normal_x)));
  }

  bool load_surface(Candidate& c) {
    using B = BatchColumns;
    const Member& i = block_.members[static_cast<std::size_t>(c.member)];
    const Surface& surface = dem_.surfaces[static_cast<std::size_t>(c.surface)];
    const bodies::SurfacePoint s = surface.contact_at(time_, i.position);
    const double overlap = i.radius - s.distance;
    if (!(overlap > -dem_.laws[static_cast<std::size_t>(c.law)].range)) return false;
    const double lever = i.radius - 0.5 * overlap;
    const Vec3 point = i.position - s.distance * s.normal;
    Vec3 wall;
    const double* p[3] = {&point.x, &point.y, &point.z};
    const double* n[3] = {&s.normal.x, &s.normal.y, &s.normal.z};
    double* v[3] = {&wall.x, &wall.y, &wall.z};
    surface_velocities(surface, time_, 1, p, n, v);
    c.wall_velocity = wall;
    set(B::velocity_x, i.velocity - lever * cross(i.rotation, s.normal) - wall);
    set(B::rotation_x, i.rotation);
    set(B::normal_x, s.normal);
    columns_.column(B::overlap)[count_] = overlap;
    columns_.column(B::effective_radius)[count_] = i.radius;
    columns_.column(B::effective_mass)[count_] = 1.0 / i.inverse_mass;
    columns_.column(B::lever_i)[count_] = lever;
    columns_.column(B::lever_j)[count_] = 0.0;
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
    for (int c = 0; c < B::normal_force; ++c) {
      double* column = columns_.column(c);
      for (std::size_t q = count_; q < contact::padded(count_); ++q) column[q] = column[count_ - 1];
    }
    if (open.surface < 0) {
      block_.largest_overlap =
          std::max(block_.largest_overlap, contact::derive_pair_columns(columns_, count_));
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
                 c.wall_velocity, i.weight * duration);
      }
      return;
    }
    const Vec3 torque_j = get(B::torque_j_x);
    if (c.partner >= 0) {
      Member& j = block_.members[static_cast<std::size_t>(c.partner)];
      // Two grains that come together with different lags share one duration, so that their
      // impulses are opposite.
      duration = 0.5 * (duration + j.lag + 0.5 * sub_step);
      const double share_i = j.weight < i.weight ? j.weight / i.weight : 1.0;
      const double share_j = i.weight < j.weight ? i.weight / j.weight : 1.0;
      i.impulse += (share_i * duration) * force;
      i.twist += (share_i * duration) * torque_i;
      j.impulse -= (share_j * duration) * force;
      j.twist += (share_j * duration) * torque_j;
      return;
    }
    const double weight = dem_.store.weight[static_cast<std::size_t>(c.row)];
    const double share_i = weight < i.weight ? weight / i.weight : 1.0;
    const double share_j = i.weight < weight ? i.weight / weight : 1.0;
    i.impulse += (share_i * duration) * force;
    i.twist += (share_i * duration) * torque_i;
    for (int d = 0; d < 3; ++d) {
      c.reaction[d] -= share_j * duration * force[d];
      c.reaction[3 + d] += share_j * duration * torque_j[d];
    }
  }

  Dem::Impl& dem_;
  Block& block_;
  double now_;
  double time_ = 0.0;
  double before_end_ = 0.0;
  std::size_t count_ = 0;
  Candidate* in_batch_[k_batch] = {};
  BatchColumns& columns_ = thread_columns();
};

}  // namespace

Member load_member(const GrainStore& s, const contact::AlignedVector<double>& gravity,
                   std::size_t row) {
  Member m;
  m.row = static_cast<std::int32_t>(row);
  m.radius = s.position[4 * row + 3];
  m.inverse_mass = s.velocity[4 * row + 3];
  m.weight = s.weight[row];
  const double* action = s.action_of(row);
  m.rate = action[3];
  m.position = vec(s.position.data() + 4 * row);
  m.velocity = vec(s.velocity.data() + 4 * row);
  m.rotation = vec(s.rotation.data() + 4 * row);
  m.half_velocity = vec(s.half_velocity.data() + 4 * row);
  m.half_rotation = vec(s.half_rotation.data() + 4 * row);
  m.lag = s.half_velocity[4 * row + 3];
  m.target = vec(action);
  m.gravity = vec(gravity.data() + 4 * static_cast<std::ptrdiff_t>(s.material[row]));
  if (s.has_fluid) m.received = vec(s.impulse.data() + 4 * row);
  return m;
}

void store_member(GrainStore& s, const Member& m, double* force) {
  const auto row = static_cast<std::size_t>(m.row);
  for (int d = 0; d < 3; ++d) {
    const auto k = 4 * row + static_cast<std::size_t>(d);
    s.position[k] = m.position[d];
    s.velocity[k] = m.velocity[d];
    s.rotation[k] = m.rotation[d];
    s.half_velocity[k] = m.half_velocity[d];
    s.half_rotation[k] = m.half_rotation[d];
    if (s.has_fluid) s.impulse[k] = m.received[d];
    force[d] = m.force[d];
  }
  s.half_velocity[4 * row + 3] = m.lag;
}

void run_block(Dem::Impl& dem, Block& block, double now) { BlockPass(dem, block, now).run(); }

}  // namespace dust::particles
