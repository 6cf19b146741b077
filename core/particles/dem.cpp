// SPDX-License-Identifier: Apache-2.0
#include "particles/dem.hpp"

#include "dust/sdk/sphere.hpp"
#include "particles/forces/contact_snapshot.hpp"
#include "particles/impl.hpp"
#include "particles/motion/free_acceleration.hpp"
#include "particles/particle_error.hpp"
#include "particles/transfer/translation.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace dust::particles {
namespace {

std::size_t wall_count(const std::vector<Surface>& surfaces) {
  std::size_t walls = 0;
  for (const Surface& s : surfaces) walls = std::max<std::size_t>(walls, s.wall + 1u);
  return walls;
}

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

/// Widening of an opening in diagonals of the domain.
constexpr double k_opening_rounding = 1e-9;

}  // namespace

Dem::Impl::Impl(const scenario::Setup& setup, const bodies::BodySet& bodies,
                std::vector<PairLaws> laws, const std::vector<double>& diameters,
                DemOptions options)
    : conditions(setup, bodies, std::move(laws), diameters, options.fluid_density,
                 DustLoads(options.dust_shares).is_on()),
      store(setup.fluid.has_value()),
      inner(conditions.laws.history_stride()),
      loads(std::move(options.dust_shares)) {
  const std::size_t walls = wall_count(conditions.surfaces);
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

void Dem::Impl::gather_wall_loads() {
  if (wall_loads.is_on()) tile_step.contact_forces().give_wall_loads(wall_loads);
}

void Dem::Impl::move_to(double time) {
  conditions.time = time;
  particles::move_to(time, conditions.surfaces);
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

Dem::Dem(const scenario::Setup& setup, const bodies::BodySet& bodies, std::vector<PairLaws> laws,
         const std::vector<double>& class_diameters, DemOptions options)
    : impl_(std::make_unique<Impl>(setup, bodies, std::move(laws), class_diameters,
                                   std::move(options))) {}
Dem::~Dem() = default;

double Dem::coarse_step() const { return impl_->conditions.step(); }
std::span<const ClassStep> Dem::class_steps() const { return impl_->conditions.steps.classes; }
const TimeSteps& Dem::time_steps() const { return impl_->conditions.steps; }
void Dem::insert(std::span<const NewGrain> grains) {
  impl_->synchronise();
  impl_->insert(grains);
}
std::span<const Opening> Dem::openings() const { return impl_->conditions.openings; }
void Dem::remove_escaped() {
  impl_->synchronise();
  impl_->remove_escaped();
}
void Dem::neighbours() { impl_->update_pair_lists(); }
void Dem::contact(double time, bool keeps_force) {
  impl_->begin_step(time, keeps_force);
  impl_->tile_step.contact(impl_->step_scene());
}
void Dem::force() { impl_->tile_step.force(impl_->step_scene()); }
void Dem::integrate() {
  impl_->tile_step.integrate(impl_->step_scene());
  impl_->end_step();
}
void Dem::step_tiles(double time, bool keeps_force) {
  impl_->begin_step(time, keeps_force);
  impl_->tile_step.run(impl_->step_scene(), PhaseTimes::is_due(impl_->counters.steps));
  impl_->end_step();
}
void Dem::advance_fine() { impl_->advance_fine(); }
void Dem::add_force(const std::function<sdk::Vec3(std::size_t)>& force) {
  impl_->tile_step.add_force(impl_->step_scene(), force);
}

std::array<double, 3> Dem::phase_shares() const { return impl_->tile_step.phase_shares(); }
void Dem::drag_relaxation_changed() { impl_->store.update_decay(impl_->conditions.step()); }
void Dem::bodies_changed() { impl_->outer.require(OuterList::Due::rebuild); }

void Dem::synchronise() { impl_->synchronise(); }
GrainRows Dem::rows() {
  impl_->synchronise();
  return impl_->store.rows();
}

void Dem::turn(std::size_t row, sdk::Vec3 change) {
  for (double* spin : {impl_->store.rotation(row), impl_->store.half_rotation(row)}) {
    for (int d = 0; d < 3; ++d) spin[d] += change[d];
  }
}

std::span<const double> Dem::last_force() {
  impl_->synchronise();
  impl_->fill_last_force();
  return impl_->last_force;
}

std::vector<ContactRecord> Dem::contacts(double time) {
  impl_->synchronise();
  // Since grains came or went, the lists name other rows; they are made new at the next step.
  if (impl_->outer.is_reorder_due()) return {};
  std::vector<Surface> moved;
  const auto surfaces = surfaces_at(time, impl_->conditions.surfaces, moved);
  return contact_snapshot(impl_->contact_scene_at(time, surfaces), impl_->inner);
}

EnergyBalance Dem::energy() const { return impl_->accounts.energy.balance(); }
const BalanceLedger& Dem::ledger() const { return impl_->ledger; }
const Balance& Dem::balance() const { return impl_->ledger.balance(); }

DemReport Dem::report() const {
  DemReport out = impl_->counters;
  out.contacts = impl_->tile_step.contact_forces().contacts();
  out.largest_coarse_overlap = impl_->tile_step.contact_forces().largest_overlap();
  out.fine_steps = impl_->fine_level.sub_steps();
  out.largest_fine_overlap = impl_->fine_level.largest_overlap();
  out.largest_overlap = std::max(out.largest_coarse_overlap, out.largest_fine_overlap);
  return out;
}

std::vector<std::pair<std::int64_t, std::int64_t>> Dem::listed_pairs() const {
  std::vector<std::pair<std::int64_t, std::int64_t>> out;
  const ParticleStore& store = impl_->store;
  const auto add = [&](std::int32_t a, std::int32_t b) {
    const std::int64_t i = store.id(static_cast<std::size_t>(a));
    const std::int64_t j = store.id(static_cast<std::size_t>(b));
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

const ContactWork& Dem::contact_work() const { return impl_->accounts.work; }
std::vector<std::string> Dem::wall_names() const {
  std::vector<std::string> names(wall_count(impl_->conditions.surfaces));
  for (const Surface& s : impl_->conditions.surfaces) {
    names[static_cast<std::size_t>(s.wall)] = s.name;
  }
  return names;
}
void Dem::clear_contact_work() { impl_->accounts.work.clear(); }
std::span<const double> Dem::dust_load(std::size_t row) const { return impl_->loads.on(row); }
void Dem::set_dust_free(std::size_t row, std::size_t n, double mass) {
  impl_->loads.set_free(impl_->store, row, n, mass);
}
void Dem::take_up_dust(std::size_t row, std::size_t n, double mass) {
  impl_->loads.take_up(impl_->store, row, n, mass);
}
DustLoads::Balance Dem::dust_balance(std::size_t n) const {
  return impl_->loads.balance(impl_->store, n);
}

sdk::WallColumns Dem::close_wall_loads(double interval, double time) {
  if (!impl_->wall_loads.is_on()) return {};
  impl_->gather_wall_loads();
  impl_->wall_loads.close(interval);
  std::vector<Surface> moved;
  const auto surfaces = surfaces_at(time, impl_->conditions.surfaces, moved);
  impl_->wall_loads.note_contacts(impl_->contact_scene_at(time, surfaces), impl_->inner);
  return impl_->wall_loads.columns();
}

sdk::WallColumns Dem::wall_loads() const { return impl_->wall_loads.columns(); }

TransferObstacles Dem::obstacles_to(const Dem& other, double time) {
  impl_->move_to(time);
  return find_obstacles({other.impl_->conditions, other.impl_->store}, impl_->conditions);
}

TransferReport Dem::transfer_from(const Dem& other, double time, std::span<const LawTransfer> laws,
                                  bool keeps_dust) {
  other.impl_->require_synchronised();
  impl_->move_to(time);
  return impl_->transfer_from(*other.impl_, laws, keeps_dust);
}

void Dem::save(sdk::ArchiveWriter& archive) const {
  impl_->require_synchronised();
  impl_->save(archive);
}
void Dem::load(sdk::ArchiveReader& archive) { impl_->load(archive); }

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
