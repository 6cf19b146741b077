// SPDX-License-Identifier: Apache-2.0
#include "particles/dem.hpp"

#include "dust/sdk/error.hpp"
#include "dust/sdk/sphere.hpp"
#include "particles/forces/contact_snapshot.hpp"
#include "particles/impl.hpp"
#include "particles/motion/leapfrog.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dust::particles {
namespace {

std::vector<std::string> names_of(const auto& materials) {
  std::vector<std::string> names;
  for (const auto& m : materials) names.push_back(m.name);
  return names;
}

double largest_of(std::span<const double> diameters) {
  return diameters.empty() ? 0.0 : *std::max_element(diameters.begin(), diameters.end());
}

}  // namespace

Dem::Impl::Impl(const scenario::Setup& setup, const bodies::BodySet& bodies,
                std::vector<PairLaws> pair_laws, std::vector<double> diameters,
                double fluid_density)
    : laws(std::move(pair_laws), names_of(setup.materials), largest_of(diameters)),
      surfaces(surfaces_of(setup, bodies)),
      domain_min(setup.domain.min),
      domain_max(setup.domain.max),
      steps(particles::time_steps(setup, bodies, laws.all(), diameters)) {
  store.has_fluid = setup.fluid.has_value();
  for (const auto& m : setup.materials) {
    materials.push_back(m.properties);
    // Buoyancy of the hydrostatic pressure: the fluid's own pressure does not hold it.
    const double share = 1.0 - fluid_density / m.properties.density;
    gravity.insert(gravity.end(), {share * setup.gravity.x, share * setup.gravity.y,
                                   share * setup.gravity.z, 0.0});
  }
  for (int d = 0; d < 3; ++d) {
    const auto low = setup.domain.sides[static_cast<std::size_t>(2 * d)].grains;
    const auto high = setup.domain.sides[static_cast<std::size_t>(2 * d + 1)].grains;
    sides[static_cast<std::size_t>(2 * d)] = low;
    sides[static_cast<std::size_t>(2 * d + 1)] = high;
    images.half[d] = std::numeric_limits<double>::infinity();
    if (low == scenario::GrainSide::periodic) {
      is_periodic = true;
      images.length[d] = domain_max[d] - domain_min[d];
      images.half[d] = 0.5 * images.length[d];
    }
  }
}

void Dem::Impl::insert(std::span<const NewGrain> grains) {
  if (grains.empty()) return;
  std::size_t n = store.size();
  store.resize(n + grains.size());
  outer.resize(n + grains.size());
  for (const NewGrain& g : grains) {
    const double mass =
        materials[static_cast<std::size_t>(g.material)].density * sdk::sphere_volume(g.diameter);
    const double row[3][4] = {{g.position.x, g.position.y, g.position.z, 0.5 * g.diameter},
                              {g.velocity.x, g.velocity.y, g.velocity.z, 1.0 / mass},
                              {g.rotation.x, g.rotation.y, g.rotation.z, 0.5 * g.diameter}};
    for (std::size_t d = 0; d < 4; ++d) {
      store.position[4 * n + d] = row[0][d];
      store.velocity(n)[d] = row[1][d];
      store.rotation(n)[d] = row[2][d];
      // Lag 0: the first kick lasts half a step, as if positions and velocities had come together.
      store.half_velocity(n)[d] = d < 3 ? row[1][d] : 0.0;
      store.half_rotation(n)[d] = row[2][d];
    }
    if (store.has_fluid) {
      std::fill_n(store.action.begin() + 4 * static_cast<std::ptrdiff_t>(n), 4, 0.0);
      std::fill_n(store.impulse.begin() + 4 * static_cast<std::ptrdiff_t>(n), 4, 0.0);
      store.decay[2 * n] = store.decay[2 * n + 1] = 1.0;
    }
    store.id[n] = next_id++;
    store.material[n] = g.material;
    store.weight[n] = g.weight;
    store.population[n] = book.population(g.diameter, g.weight, g.material, mass);
    book.enter(store.population[n]);
    ++n;
  }
  book.close();
  outer.require(OuterList::Due::reorder);
}

void Dem::Impl::remove_leavers() {
  std::vector<std::int32_t> keep;
  keep.reserve(store.size());
  for (std::size_t n = 0; n < store.size(); ++n) {
    const double* p = store.position.data() + 4 * n;
    bool leaves = false;
    for (int d = 0; d < 3; ++d) {
      const bool below = p[d] < domain_min[d];
      const bool above = p[d] > domain_max[d];
      if (!below && !above && std::isfinite(p[d])) continue;
      const auto side = static_cast<std::size_t>(2 * d + (above ? 1 : 0));
      if (sides[side] == scenario::GrainSide::wall) {
        // Dust squeezed against a wall by a coarse grain gets its centre into it and comes back out
        // (the overlap is reported); a grain wholly beyond is lost.
        const double depth = above ? p[d] - domain_max[d] : domain_min[d] - p[d];
        if (depth <= p[3]) continue;
        fail(n,
             "left the domain through the wall '" + std::string(scenario::k_side_names[side]) + "'",
             "the time step is too long for the speed of the impact: give time.expected_speed or a "
             "smaller time.dem_step");
      }
      leaves = leaves || sides[side] == scenario::GrainSide::open;
    }
    if (leaves) {
      book.leave(store.population[n]);
    } else {
      keep.push_back(static_cast<std::int32_t>(n));
    }
  }
  if (keep.size() == store.size()) return;
  // History and left-over velocities of the others survive: the lists still name the rows as they
  // are, so the rows are dropped at the next rebuild's sort through this order.
  std::vector<std::int32_t> new_row(store.size(), -1);
  for (std::size_t n = 0; n < keep.size(); ++n)
    new_row[static_cast<std::size_t>(keep[n])] = static_cast<std::int32_t>(n);
  inner.renumber(new_row);
  fine_level.renumber(new_row);
  store.reorder(keep);
  outer.reorder(keep);
  book.close();
  outer.require(OuterList::Due::reorder);
}

void Dem::Impl::refresh_decay() {
  has_fluid = false;
  if (!store.has_fluid) return;
  const double step = steps.coarse_step;
  for (std::size_t n = 0; n < store.size(); ++n) {
    const double rate = store.action[4 * n + 3];
    has_fluid = has_fluid || rate * step > 0.0;
    const leapfrog::Relaxation drag = leapfrog::relaxation(rate, step);
    store.decay[2 * n] = drag.decay;
    store.decay[2 * n + 1] = drag.mean;
  }
}

void Dem::Impl::gather_wall_loads() {
  if (wall_loads.is_on()) contact_forces.give_wall_loads(wall_loads);
}

void Dem::Impl::look_at_weights() {
  has_weights = false;
  for (std::size_t n = 1; n < tiling.coarse_count; ++n) {
    has_weights = has_weights || store.weight[n] != store.weight[0];
  }
}

void Dem::Impl::fill_last_force() const {
  last_force.assign(4 * store.size(), 0.0);
  for (std::size_t n = 0; n < store.size(); ++n) {
    const double mass = 1.0 / store.velocity(n)[3];
    const double* action = store.action_of(n);
    const double* g = gravity.data() + 4 * static_cast<std::ptrdiff_t>(store.material[n]);
    for (std::size_t d = 0; d < 3; ++d) {
      last_force[4 * n + d] = mass * (g[d] + action[3] * (action[d] - store.velocity(n)[d]));
    }
  }
  if (outer.is_reorder_due()) return;  // rows have changed since the forces were computed
  for (std::size_t q = 0; q < contact_force.size(); ++q) last_force[q] += contact_force[q];
  const std::span<const double> fine_force = fine_level.force();
  for (std::size_t q = 0; q < fine_force.size(); ++q)
    last_force[4 * tiling.coarse_count + q] += fine_force[q];
}

Dem::Dem(const scenario::Setup& setup, const bodies::BodySet& bodies, std::vector<PairLaws> laws,
         std::vector<double> class_diameters, double fluid_density)
    : impl_(std::make_unique<Impl>(setup, bodies, std::move(laws), std::move(class_diameters),
                                   fluid_density)) {}
Dem::~Dem() = default;

double Dem::coarse_step() const { return impl_->steps.coarse_step; }
std::span<const ClassStep> Dem::class_steps() const { return impl_->steps.classes; }
const TimeSteps& Dem::time_steps() const { return impl_->steps; }
void Dem::insert(std::span<const NewGrain> grains) {
  impl_->land();
  impl_->insert(grains);
}
void Dem::remove_leavers() {
  impl_->land();
  impl_->remove_leavers();
}
void Dem::neighbours() { impl_->neighbours(); }
void Dem::contact(double time, bool keeps_force) { impl_->contact(time, keeps_force); }
void Dem::force() { impl_->force(); }
void Dem::integrate() { impl_->integrate(); }
void Dem::step_tiles(double time, bool keeps_force) { impl_->step_tiles(time, keeps_force); }
void Dem::advance_fine() { impl_->advance_fine(); }
void Dem::add_force(const std::function<sdk::Vec3(std::size_t)>& force) {
  impl_->each_deferred([&](Tile tile) {
    const auto active = impl_->inner.active(static_cast<std::size_t>(tile.index)).all();
    double* f = impl_->deferred.rows(tile.index).data();
    for (const std::int32_t row : active.subspan(impl_->deferred.moved(tile.index))) {
      const sdk::Vec3 more = force(static_cast<std::size_t>(row));
      for (int d = 0; d < 3; ++d) f[d] += more[d];
      f += k_force_row;
    }
  });
}

void Dem::let_all_step() { impl_->all_step = true; }

std::array<double, 3> Dem::phase_shares() const { return impl_->phase_times.shares(); }
void Dem::fluid_action_changed() { impl_->refresh_decay(); }
void Dem::bodies_changed() { impl_->outer.require(OuterList::Due::rebuild); }

void Dem::land() { impl_->land(); }
GrainRows Dem::rows() {
  impl_->land();
  GrainStore& s = impl_->store;
  return {.count = s.size(),
          .position = s.position.data(),
          .velocity = s.motion.data(),
          .rotation = s.spin.data(),
          .id = s.id.data(),
          .material = s.material.data(),
          .weight = s.weight.data(),
          .fluid_action = s.action.data(),
          .fluid_impulse = s.impulse.data(),
          .motion_stride = GrainStore::k_motion_stride};
}

std::span<const double> Dem::last_force() const {
  impl_->land();
  impl_->fill_last_force();
  return impl_->last_force;
}

std::vector<ContactRecord> Dem::contacts() const {
  impl_->land();
  // Since grains came or went, the lists name other rows; they are made new at the next step.
  if (impl_->outer.is_reorder_due()) return {};
  return contact_snapshot(impl_->contact_scene(), impl_->inner);
}

const BalanceBook& Dem::book() const { return impl_->book; }
const Balance& Dem::balance() const { return impl_->book.balance(); }

DemReport Dem::report() const {
  DemReport out = impl_->counters;
  out.contacts = impl_->contact_forces.contacts();
  out.largest_coarse_overlap = impl_->contact_forces.largest_overlap();
  out.fine_steps = impl_->fine_level.sub_steps();
  out.largest_fine_overlap = impl_->fine_level.largest_overlap();
  out.largest_overlap = std::max(out.largest_coarse_overlap, out.largest_fine_overlap);
  return out;
}

std::vector<std::pair<std::int64_t, std::int64_t>> Dem::listed_pairs() const {
  std::vector<std::pair<std::int64_t, std::int64_t>> out;
  const auto& id = impl_->store.id;
  const auto add = [&](std::int32_t a, std::int32_t b) {
    const std::int64_t i = id[static_cast<std::size_t>(a)];
    const std::int64_t j = id[static_cast<std::size_t>(b)];
    out.emplace_back(std::min(i, j), std::max(i, j));
  };
  const auto add_all = [&](const PairList& list) {
    for (std::size_t q = 0; q < list.size(); ++q) {
      if (list.b()[q] >= 0) add(list.a()[q], list.b()[q]);
    }
  };
  for (std::size_t t = 0; t < impl_->outer.tiles(); ++t) add_all(impl_->outer.pairs(t));
  add_all(impl_->outer.fine());
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

void Dem::watch_walls() {
  std::size_t walls = 0;
  for (const Surface& s : impl_->surfaces) walls = std::max<std::size_t>(walls, s.wall + 1u);
  impl_->wall_loads.begin(impl_->surfaces, walls);
  impl_->outer.require(OuterList::Due::rebuild);
}

sdk::WallColumns Dem::close_wall_loads(double interval) {
  if (!impl_->wall_loads.is_on()) return {};
  impl_->gather_wall_loads();
  impl_->wall_loads.close(interval);
  impl_->wall_loads.note_contacts(impl_->contact_scene(), impl_->inner);
  return impl_->wall_loads.columns();
}

sdk::WallColumns Dem::wall_loads() const { return impl_->wall_loads.columns(); }

void Dem::save(sdk::ArchiveWriter& archive) const {
  impl_->land();
  impl_->save(archive);
}
void Dem::load(sdk::ArchiveReader& archive) { impl_->load(archive); }

}  // namespace dust::particles
