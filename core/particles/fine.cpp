// SPDX-License-Identifier: Apache-2.0
#include "particles/impl.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace dust::particles {
namespace {

using contact::BatchColumns;
using contact::k_batch;
using sdk::Vec3;

/// Members of one lockstep block, if clusters allow.
constexpr std::size_t k_block_members = 64;
/// Gap, in radii of the fine grain, below which a partner always counts as in reach.
constexpr double k_reach_margin = 0.05;
/// Steps per contact.
constexpr double k_steps_per_contact = 15.0;

Vec3 vec(const double* p) { return {p[0], p[1], p[2]}; }

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

Member load_member(const GrainStore& s, const std::vector<double>& gravity, std::size_t row) {
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

/// Root of a grain's cluster, with path halving.
std::int32_t root(std::vector<FineState>& states, std::int32_t n) {
  auto at = [&](std::int32_t m) -> std::int32_t& {
    return states[static_cast<std::size_t>(m)].cluster;
  };
  while (at(n) != n) {
    at(n) = at(at(n));
    n = at(n);
  }
  return n;
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

static double sum_of_parts(Vec3 v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

/// A cheap answer for most entries of a list: true only if the partner is out of reach by the rule
/// of look_out(). Sums of components stand for the norms they bound, so there is no root.
static bool is_far(const Dem::Impl& dem, std::size_t i, std::int32_t b, double extra_speed) {
  const GrainStore& s = dem.store;
  const double step = dem.steps.coarse_step;
  const auto j = static_cast<std::size_t>(b);
  const bool is_fine = j >= dem.coarse_count;
  const Vec3 position = vec(s.position.data() + 4 * i);
  const Vec3 velocity = vec(s.velocity.data() + 4 * i);
  const Vec3 other = vec((is_fine ? s.velocity : s.half_velocity).data() + 4 * j);
  Vec3 place = vec(s.position.data() + 4 * j);
  if (!is_fine) place -= step * other;
  const Vec3 d = dem.separation(&place.x, &position.x);
  const double radius = s.position[4 * i + 3];
  const double* g = dem.gravity.data() + 4 * static_cast<std::ptrdiff_t>(s.material[i]);
  const double* action = s.action_of(i);
  const Vec3 free = vec(g) + action[3] * (vec(action) - velocity);
  const double speed = sum_of_parts(velocity - other) + sum_of_parts(free) * step + extra_speed;
  const double reach =
      (1.0 + k_reach_margin) * radius + s.position[4 * j + 3] + dem.largest_range + speed * step;
  return dot(d, d) > reach * reach;
}

/// Looks how near the partner of an entry is, and what step the contact would need.
static Outlook look_out(const Dem::Impl& dem, std::size_t entry, double extra_speed) {
  const GrainStore& s = dem.store;
  const double step = dem.steps.coarse_step;
  const auto i = static_cast<std::size_t>(dem.fine.a[entry]);
  const std::int32_t b = dem.fine.b[entry];
  const Vec3 position = vec(s.position.data() + 4 * i);
  const Vec3 velocity = vec(s.velocity.data() + 4 * i);
  const double radius = s.position[4 * i + 3];
  if (b >= 0 && dem.fine.is_touching[entry] == 0 && is_far(dem, i, b, extra_speed)) return {};
  double gap = 0.0;
  double reduced_radius = radius;
  double mass = 1.0 / s.velocity[4 * i + 3];
  Vec3 normal;
  Vec3 relative = velocity;
  std::int32_t law = 0;
  if (b < 0) {
    const Surface& surface = dem.surfaces[static_cast<std::size_t>(-1 - b)];
    const auto point = surface.contact(position);
    gap = point.distance - radius;
    normal = point.normal;
    law = dem.law_of(s.material[i], surface.material);
  } else {
    const auto j = static_cast<std::size_t>(b);
    const bool is_fine = j >= dem.coarse_count;
    const Vec3 other = vec((is_fine ? s.velocity : s.half_velocity).data() + 4 * j);
    Vec3 place = vec(s.position.data() + 4 * j);
    if (!is_fine) place -= step * other;
    const Vec3 d = dem.separation(&place.x, &position.x);
    const double distance = std::max(norm(d), 1e-300);
    const double partner = s.position[4 * j + 3];
    gap = distance - radius - partner;
    normal = d / distance;
    relative = velocity - other;
    reduced_radius = radius * partner / (radius + partner);
    mass = 1.0 / (s.velocity[4 * i + 3] + s.velocity[4 * j + 3]);
    law = dem.law_of(s.material[i], s.material[j]);
  }
  const double* g = dem.gravity.data() + 4 * static_cast<std::ptrdiff_t>(s.material[i]);
  const double* action = s.action_of(i);
  const Vec3 free = vec(g) + action[3] * (vec(action) - velocity);
  double gain = norm(free) * step;
  if (b < 0) gain += dem.surfaces[static_cast<std::size_t>(-1 - b)].displacing_speed;
  Outlook out;
  out.speed = norm(relative) + gain;
  const PairLaws& laws = dem.laws[static_cast<std::size_t>(law)];
  const double margin = k_reach_margin * radius + laws.range;
  out.is_near = dem.fine.is_touching[entry] != 0 || gap < (out.speed + extra_speed) * step + margin;
  if (!out.is_near) return out;
  const double approach = std::max(0.0, -dot(relative, normal)) + gain + extra_speed;
  double overlap = std::max(-gap, 0.0);
  if (laws.cohesion) overlap = std::max(overlap, laws.cohesion->resting_overlap(reduced_radius));
  out.stable_step =
      std::min(laws.contact->collision_time(reduced_radius, mass, std::max(approach, 1e-12)),
               laws.contact->half_period(reduced_radius, mass, overlap)) /
      k_steps_per_contact;
  return out;
}

void Dem::Impl::fine_pass() {
  FineSpace& w = fine_space;
  w.state.resize(store.size() - coarse_count);
  const auto state = [&](std::int32_t row) -> FineState& {
    return w.state[static_cast<std::size_t>(row) - coarse_count];
  };
  for (const std::int32_t row : fine_awake.rows) {
    state(row) = {};
    std::fill_n(fine_force.begin() + 4 * (row - static_cast<std::ptrdiff_t>(coarse_count)), 4, 0.0);
  }
  const std::size_t entries = fine.size();
  w.outlook.assign(entries, {});
  const auto is_pair = [&](std::size_t e) {
    return fine.b[e] >= static_cast<std::int32_t>(coarse_count);
  };
  oneapi::tbb::parallel_for(std::size_t{0}, (entries + k_fine_block - 1) / k_fine_block,
                            [&](std::size_t b) {
                              const std::size_t end = std::min(entries, (b + 1) * k_fine_block);
                              for (std::size_t e = b * k_fine_block; e < end; ++e) {
                                if (!is_pair(e)) w.outlook[e] = look_out(*this, e, 0.0);
                              }
                            });

  const auto join = [&](std::int32_t row, const Outlook& o) {
    FineState& s = state(row);
    if (s.cluster < 0) {
      s.cluster = row - static_cast<std::int32_t>(coarse_count);
      s.stable_step = o.stable_step;
    }
    s.stable_step = std::min(s.stable_step, o.stable_step);
  };
  for (std::size_t e = 0; e < entries; ++e) {
    if (is_pair(e) || !w.outlook[e].is_near) continue;
    join(fine.a[e], w.outlook[e]);
    state(fine.a[e]).speed = std::max(state(fine.a[e]).speed, w.outlook[e].speed);
  }
  for (std::size_t e = 0; e < entries; ++e) {
    if (!is_pair(e)) continue;
    // A grain that bounces within this step may turn its relative velocity round.
    w.outlook[e] = look_out(*this, e, 2.0 * (state(fine.a[e]).speed + state(fine.b[e]).speed));
    if (!w.outlook[e].is_near) continue;
    join(fine.a[e], w.outlook[e]);
    join(fine.b[e], w.outlook[e]);
    const std::int32_t i = root(w.state, state(fine.a[e]).cluster);
    const std::int32_t j = root(w.state, state(fine.b[e]).cluster);
    w.state[static_cast<std::size_t>(std::max(i, j))].cluster = std::min(i, j);
  }
  make_blocks();

  // Everyone awake moves as if alone; members of blocks, loaded above, then overwrite their rows.
  const auto& rows = fine_awake.rows;
  oneapi::tbb::parallel_for(
      std::size_t{0}, (rows.size() + k_fine_block - 1) / k_fine_block, [&](std::size_t b) {
        const std::size_t first = b * k_fine_block;
        integrate_awake({rows.data() + first, std::min(k_fine_block, rows.size() - first)}, 0,
                        nullptr, ForceOrder::by_row);
      });
  oneapi::tbb::parallel_for(std::size_t{0}, w.block_count, [&](std::size_t b) {
    Block& block = w.blocks[b];
    std::stable_sort(block.candidates.begin(), block.candidates.end(),
                     [](const Candidate& x, const Candidate& y) {
                       return std::tie(x.law, x.surface) < std::tie(y.law, y.surface);
                     });
    block.wall_sums.assign(WallLoads::k_sums * wall_loads.walls(), 0.0);
    BlockPass(*this, block, time).run();
    for (const Member& m : block.members) {
      store_member(store, m,
                   fine_force.data() + 4 * (static_cast<std::size_t>(m.row) - coarse_count));
    }
  });
  counters.fine_steps += static_cast<std::int64_t>(w.state.size() - w.active.size());
  for (std::size_t b = 0; b < w.block_count; ++b) {
    Block& block = w.blocks[b];
    if (wall_loads.is_on()) wall_loads.take(block.wall_sums, block.wall_impacts);
    counters.fine_steps += static_cast<std::int64_t>(block.members.size()) << block.level;
    counters.largest_fine_overlap = std::max(counters.largest_fine_overlap, block.largest_overlap);
    for (const Candidate& c : block.candidates) {
      if (c.row < 0 || std::all_of(c.reaction, c.reaction + 6, [](double x) { return x == 0.0; }))
        continue;
      Reaction r{.row = c.row};
      std::copy_n(c.reaction, 6, r.impulse);
      pending.push_back(r);
    }
  }
}

/// Clusters at the level of their most demanding member, no finer than that member's class needs,
/// then blocks of clusters of one level.
void Dem::Impl::make_blocks() {
  const double step = steps.coarse_step;
  FineSpace& w = fine_space;
  const auto fine_state = [&](std::int32_t n) -> FineState& {
    return w.state[static_cast<std::size_t>(n)];
  };
  w.active.clear();
  for (const std::int32_t row : fine_awake.rows) {
    const std::int32_t n = row - static_cast<std::int32_t>(coarse_count);
    FineState& s = fine_state(n);
    if (s.cluster < 0) continue;
    s.cluster = root(w.state, n);
    const double diameter = 2.0 * store.position[4 * static_cast<std::size_t>(row) + 3];
    const auto size =
        std::lower_bound(steps.classes.begin(), steps.classes.end(), diameter * (1.0 - 1e-9),
                         [](const ClassStep& c, double d) { return c.diameter < d; });
    const int finest = size == steps.classes.end() ? 0 : size->level;
    const int wanted =
        static_cast<int>(std::ceil(std::log2(step / std::max(s.stable_step, 1e-30))));
    auto& level = fine_state(s.cluster).level;
    level = std::max(level, std::clamp(wanted, 0, finest));
    w.active.push_back(n);
  }
  std::sort(w.active.begin(), w.active.end(), [&](std::int32_t a, std::int32_t b) {
    const std::int32_t ca = fine_state(a).cluster;
    const std::int32_t cb = fine_state(b).cluster;
    const std::int32_t la = fine_state(ca).level;
    const std::int32_t lb = fine_state(cb).level;
    return std::tie(lb, ca, a) < std::tie(la, cb, b);
  });
  w.block_count = 0;
  std::int32_t last_cluster = -1;
  for (const std::int32_t n : w.active) {
    const std::int32_t cluster = fine_state(n).cluster;
    const int level = fine_state(cluster).level;
    if (w.block_count == 0 || w.blocks[w.block_count - 1].level != level ||
        (cluster != last_cluster &&
         w.blocks[w.block_count - 1].members.size() >= k_block_members)) {
      if (w.block_count++ == w.blocks.size()) w.blocks.emplace_back();
      Block& next = w.blocks[w.block_count - 1];
      next.members.clear();
      next.candidates.clear();
      next.level = level;
      next.largest_overlap = 0.0;
    }
    last_cluster = cluster;
    Block& block = w.blocks[w.block_count - 1];
    fine_state(n).block = static_cast<std::int32_t>(w.block_count - 1);
    fine_state(n).seat = static_cast<std::int32_t>(block.members.size());
    block.members.push_back(
        load_member(store, gravity, coarse_count + static_cast<std::size_t>(n)));
  }
  const auto coarse = static_cast<std::int32_t>(coarse_count);
  for (std::size_t e = 0; e < fine.size(); ++e) {
    if (!w.outlook[e].is_near) continue;
    const FineState& s = fine_state(fine.a[e] - coarse);
    Candidate c{.entry = static_cast<std::int32_t>(e), .member = s.seat};
    const int material = store.material[static_cast<std::size_t>(fine.a[e])];
    if (fine.b[e] < 0) {
      c.surface = -1 - fine.b[e];
      c.law = law_of(material, surfaces[static_cast<std::size_t>(c.surface)].material);
    } else {
      c.law = law_of(material, store.material[static_cast<std::size_t>(fine.b[e])]);
      if (fine.b[e] >= coarse) {
        c.partner = fine_state(fine.b[e] - coarse).seat;
      } else {
        c.row = fine.b[e];
      }
    }
    w.blocks[static_cast<std::size_t>(s.block)].candidates.push_back(c);
  }
}

}  // namespace dust::particles
