// SPDX-License-Identifier: Apache-2.0
#include "particles/impl.hpp"

#include "dust/sdk/sphere.hpp"
#include "particles/motion/free_acceleration.hpp"
#include "particles/particle_error.hpp"
#include "particles/transfer/translation.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

/// The solver between steps: the particles that come and go, and its checkpoint.
namespace dust::particles {
namespace {

/// Widening of an opening in diagonals of the domain.
constexpr double k_opening_rounding = 1e-9;

/// Where each number of the solver stands in its checkpoint: new ones at the end.
enum Number : std::size_t {
  k_coarse_count,
  k_next_id,
  k_list_age,
  k_outer_lifetime,
  k_next_outer_lifetime,
  k_rebuild_due,
  k_reorder_due,
  k_has_drag,
  k_steps,
  k_particle_steps,
  k_sub_steps,
  k_rebuilds,
  k_missed_contact_onsets,
  k_free_flight_steps,
  k_skin_level,
  k_inner_lifetime,
  k_update_due,
  k_list_updated,
  k_list_repairs,
  k_list_lifetime,
  k_numbers
};

}  // namespace

Dem::Impl::Impl(const scenario::Setup& setup, const bodies::BodySet& bodies,
                std::vector<PairLaws> laws, const std::vector<double>& diameters,
                DemOptions options)
    : conditions(setup, bodies, std::move(laws), diameters, options,
                 DustLoads(options.dust_shares).is_on()),
      store(setup.fluid.has_value()),
      inner(conditions.laws.history_stride()),
      loads(std::move(options.dust_shares)) {
  const std::size_t walls = wall_count();
  if (loads.is_on()) accounts.work.begin(walls, 0);
  if (options.catches_dust) loads.let_catch();
  if (options.keeps_wind) store.keep_wind();
  set_openings(std::move(options.openings));
  if (options.records_wall_loads) {
    wall_loads.begin(conditions.surfaces, walls, options.records_wall_sliding);
  }
  if (setup.audit.energy) accounts.energy.begin();
  if (options.all_step || setup.audit.energy) inner.let_all_step();
}

std::size_t Dem::Impl::wall_count() const {
  std::size_t walls = 0;
  for (const Surface& s : conditions.surfaces) walls = std::max<std::size_t>(walls, s.wall + 1u);
  return walls;
}

void Dem::Impl::insert(std::span<const NewGrain> grains) {
  if (grains.empty()) return;
  for (const NewGrain& g : grains) {
    const auto& material = conditions.materials[static_cast<std::size_t>(g.material)];
    const double mass = material.density * sdk::sphere_volume(g.diameter);
    const std::int32_t population = ledger.population(g.diameter, g.weight, g.material, mass);
    store.append(g, mass, population);
    loads.enter(static_cast<std::size_t>(g.material), mass, g.weight);
    accounts.energy.enter(store, store.size() - 1);
    ledger.enter(population);
  }
  rows_added();
  ledger.close();
}

void Dem::Impl::rows_added() {
  outer.resize(store.size());
  accounts.work.resize(store.size());
  outer.require(OuterList::Due::reorder);
}

void Dem::Impl::reorder_rows(std::span<const std::int32_t> order) {
  std::vector<std::int32_t> new_row(store.size(), -1);
  for (std::size_t n = 0; n < order.size(); ++n) {
    new_row[static_cast<std::size_t>(order[n])] = static_cast<std::int32_t>(n);
  }
  inner.renumber(new_row);
  fine_level.renumber(new_row);
  store.reorder(order);
  accounts.work.reorder(order);
  loads.reorder(order);
  outer.reorder(order);
}

void Dem::Impl::set_openings(std::vector<Opening> openings) {
  for (std::size_t o = 0; o < openings.size(); ++o) {
    for (Surface& surface : conditions.surfaces) {
      const bool is_body = surface.body != nullptr;
      if (surface.name == openings[o].name && is_body == (openings[o].side < 0)) {
        surface.opening = static_cast<int>(o);
      }
    }
  }
  const ParticleDomain& domain = conditions.domain;
  conditions.opening_rounding = k_opening_rounding * norm(domain.max() - domain.min());
  conditions.openings = std::move(openings);
  store.set_openings(!conditions.openings.empty());
  ledger.set_openings(conditions.openings.size());
}

bool Dem::Impl::leaves(std::size_t n) {
  if (const int touched = store.touched_opening(n); touched >= 0) {
    ledger.extract(store.population(n), static_cast<std::size_t>(touched));
    loads.leave(store, n, true);
    return true;
  }
  const ParticleDomain::Place place = conditions.domain.place_of(store.position(n));
  if (place.where == ParticleDomain::Where::lost) {
    throw_particle_error(
        contact_scene(), inner, n,
        "left the domain through the wall '" + std::string(scenario::k_side_names[place.side]) +
            "'",
        "the time step is too long for the speed of the impact: give time.expected_speed or a "
        "smaller time.dem_step");
  }
  if (place.where == ParticleDomain::Where::inside) return false;
  const sdk::Vec3 position = vector_of(store.position(n));
  for (std::size_t o = 0; o < conditions.openings.size(); ++o) {
    const Opening& opening = conditions.openings[o];
    if (opening.side != static_cast<int>(place.side)) continue;
    if (!opening.holds(position, conditions.opening_rounding)) continue;
    ledger.extract(store.population(n), o);
    loads.leave(store, n, true);
    return true;
  }
  ledger.leave(store.population(n));
  loads.leave(store, n, false);
  return true;
}

void Dem::Impl::remove_escaped() {
  std::vector<std::int32_t> keep;
  keep.reserve(store.size());
  for (std::size_t n = 0; n < store.size(); ++n) {
    if (!leaves(n)) {
      keep.push_back(static_cast<std::int32_t>(n));
    } else {
      accounts.energy.leave(store, n, conditions.gravity.data(), conditions.step());
    }
  }
  if (keep.size() == store.size()) return;
  // Histories and deferred impulses of the others survive: the next rebuild takes them up.
  reorder_rows(keep);
  ledger.close();
  outer.require(OuterList::Due::reorder);
}

TransferReport Dem::Impl::transfer_from(const Impl& other, std::span<const LawTransfer> laws,
                                        bool keeps_dust) {
  const Translation names(other.conditions, conditions);
  std::vector<double> density;
  for (const auto& material : conditions.materials) density.push_back(material.density);
  ledger.transfer_from(other.ledger, names.materials(), names.openings(), density);
  store.transfer_from(other.store, names.materials(), names.openings(), ledger.masses());
  loads.transfer_from(other.loads, store, keeps_dust);
  store.update_decay(conditions.step());
  for (std::size_t n = 0; n < store.size(); ++n) accounts.energy.enter(store, n);
  fine_level.transfer_from(other.fine_level);

  ContactTransfer transfer({other.conditions, other.store}, {conditions, store}, names, laws);
  ContactList pairs(PartnerKind::particles, conditions.laws.history_stride());
  ContactList walls(PartnerKind::surfaces, conditions.laws.history_stride());
  for (std::size_t t = 0; t < other.inner.tiles(); ++t) {
    pairs.append(transfer.translated(other.inner.contacts(t).pairs));
    walls.append(transfer.translated(other.inner.contacts(t).walls));
  }
  inner.receive(std::move(pairs), std::move(walls), transfer.translated(other.inner.fine()));
  tuner.restore(other.tuner.state());
  rows_added();
  const auto inside = find_inside_hoods({other.conditions, other.store}, conditions, names);
  for (const auto& [row, opening] : inside) store.touched_openings()[row] = opening;
  if (!inside.empty()) remove_escaped();
  return {.particles = static_cast<std::int64_t>(store.size()),
          .contacts = transfer.contacts(),
          .without_past = transfer.without_past(),
          .drawn_out = static_cast<std::int64_t>(inside.size())};
}

void Dem::Impl::gather_wall_loads() {
  if (wall_loads.is_on()) tile_step.contact_forces().give_wall_loads(wall_loads);
}

void Dem::Impl::move_to(double time) {
  conditions.time = time;
  particles::move_to(time, conditions.surfaces);
}

void Dem::Impl::require_synchronised() const {
  if (inner.life().is_running()) {
    throw std::logic_error("particles between two looks at them: call Dem::synchronise() first");
  }
}

void Dem::Impl::fill_last_force() {
  last_force.assign(4 * store.size(), 0.0);
  for (std::size_t n = 0; n < store.size(); ++n) {
    const double mass = 1.0 / store.inverse_mass(n);
    const sdk::Vec3 force = mass * free_acceleration(store, conditions.gravity, n);
    for (int d = 0; d < 3; ++d) last_force[4 * n + static_cast<std::size_t>(d)] = force[d];
  }
  if (outer.is_reorder_due()) return;  // rows have changed since the forces were computed
  const std::span<const double> contact_force = tile_step.contact_force();
  for (std::size_t q = 0; q < contact_force.size(); ++q) last_force[q] += contact_force[q];
  const std::span<const double> fine_force = fine_level.force();
  for (std::size_t q = 0; q < fine_force.size(); ++q)
    last_force[4 * tiling.coarse_count + q] += fine_force[q];
}

void Dem::Impl::save(sdk::ArchiveWriter& archive) const {
  store.save(archive);
  outer.save(archive);
  inner.save(archive);
  tile_step.save(archive, tiling);
  fine_level.save(archive);
  ledger.save(archive);
  loads.save(archive);
  accounts.energy.save(archive);
  archive.number("time", conditions.time);
  const ListTuner::State lifetimes = tuner.state();
  const OuterList::State list = outer.state();
  std::vector<std::int64_t> state(k_numbers);
  state[k_coarse_count] = static_cast<std::int64_t>(tiling.coarse_count);
  state[k_next_id] = store.next_id();
  state[k_list_age] = list.age;
  state[k_outer_lifetime] = lifetimes.outer_lifetime;
  state[k_next_outer_lifetime] = lifetimes.next_outer_lifetime;
  state[k_rebuild_due] = list.due >= OuterList::Due::rebuild;
  state[k_reorder_due] = list.due == OuterList::Due::reorder;
  state[k_has_drag] = store.has_drag();
  state[k_steps] = counters.steps;
  state[k_particle_steps] = counters.particle_steps;
  state[k_sub_steps] = fine_level.sub_steps();
  state[k_rebuilds] = counters.rebuilds;
  state[k_missed_contact_onsets] = counters.missed_contact_onsets;
  state[k_free_flight_steps] = counters.free_flight_steps;
  state[k_skin_level] = lifetimes.skin_level;
  state[k_inner_lifetime] = lifetimes.inner_lifetime;
  state[k_update_due] = list.due == OuterList::Due::update;
  state[k_list_updated] = list.updated;
  state[k_list_repairs] = counters.list_repairs;
  state[k_list_lifetime] = list.lifetime;
  archive.integers("state", state);
}

void Dem::Impl::load(sdk::ArchiveReader& archive) {
  const auto state = archive.integers("state");
  tiling = Tiling::of(static_cast<std::size_t>(state.at(k_coarse_count)));
  counters.steps = state.at(k_steps);
  counters.particle_steps = state.at(k_particle_steps);
  counters.rebuilds = state.at(k_rebuilds);
  counters.missed_contact_onsets = state.at(k_missed_contact_onsets);
  counters.free_flight_steps = state.at(k_free_flight_steps);
  counters.list_repairs = state.at(k_list_repairs);
  tuner.restore({state.at(k_outer_lifetime), state.at(k_next_outer_lifetime),
                 state.at(k_skin_level), state.at(k_inner_lifetime)});
  OuterList::Due due = OuterList::Due::nothing;
  if (state.at(k_update_due) != 0) due = OuterList::Due::update;
  if (state.at(k_rebuild_due) != 0) due = OuterList::Due::rebuild;
  if (state.at(k_reorder_due) != 0) due = OuterList::Due::reorder;
  store.load(archive, state.at(k_next_id), state.at(k_has_drag) != 0);
  const std::size_t tiles = tile_step.load(archive, wall_loads);
  // Checkpoints of before are of runs whose lists had been made with it.
  const std::int64_t lifetime =
      state.size() > k_list_lifetime ? state[k_list_lifetime] : tuner.outer_lifetime();
  outer.load(archive, tiles,
             {.age = state.at(k_list_age),
              .updated = state.at(k_list_updated),
              .lifetime = lifetime,
              .due = due});
  inner.load(archive, tiles);
  fine_level.load(archive, state.at(k_sub_steps));
  ledger.load(archive);
  loads.load(archive);
  accounts.work.resize(store.size());
  accounts.energy.restart(tiles);
  accounts.energy.load(archive);
  move_to(archive.number("time"));
  has_weights = store.has_weights(tiling.coarse_count);
}

}  // namespace dust::particles
