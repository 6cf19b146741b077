// SPDX-License-Identifier: Apache-2.0
#include "particles/dem.hpp"

#include "dust/sdk/sphere.hpp"
#include "particles/forces/contact_snapshot.hpp"
#include "particles/impl.hpp"
#include "particles/particle_error.hpp"
#include "particles/transfer/translation.hpp"

#include <algorithm>
#include <utility>

namespace dust::particles {
namespace {

std::size_t wall_count(const std::vector<Surface>& surfaces) {
  std::size_t walls = 0;
  for (const Surface& s : surfaces) walls = std::max<std::size_t>(walls, s.wall + 1u);
  return walls;
}

/// Widening of an opening in diagonals of the domain.
constexpr double k_opening_rounding = 1e-9;

}  // namespace

Dem::Impl::Impl(const scenario::Setup& setup, const bodies::BodySet& bodies,
                std::vector<PairLaws> laws, const std::vector<double>& diameters,
                double fluid_density, DustLoads dust)
    : conditions(setup, bodies, std::move(laws), diameters, fluid_density, dust.is_on()),
      store(setup.fluid.has_value()),
      inner(conditions.laws.history_stride()),
      loads(std::move(dust)) {
  if (loads.is_on()) accounts.work.begin(wall_count(conditions.surfaces), 0);
  if (!setup.audit.energy) return;
  accounts.energy.begin();
  inner.let_all_step();
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
  outer.resize(store.size());
  accounts.work.resize(store.size());
  ledger.close();
  outer.require(OuterList::Due::reorder);
}

void Dem::Impl::draw_out_at(std::vector<Opening> openings) {
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
  // Histories and deferred impulses of the others survive: contacts name the new rows from here on,
  // and the next rebuild takes them up.
  std::vector<std::int32_t> new_row(store.size(), -1);
  for (std::size_t n = 0; n < keep.size(); ++n)
    new_row[static_cast<std::size_t>(keep[n])] = static_cast<std::int32_t>(n);
  inner.renumber(new_row);
  fine_level.renumber(new_row);
  store.reorder(keep);
  accounts.work.reorder(keep);
  loads.reorder(keep);
  outer.reorder(keep);
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
  accounts.work.resize(store.size());
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
  outer.resize(store.size());
  outer.require(OuterList::Due::reorder);
  const auto inside = find_inside_hoods({other.conditions, other.store}, conditions, names);
  for (const auto& [row, opening] : inside) store.touched_openings()[row] = opening;
  if (!inside.empty()) remove_escaped();
  return {.particles = static_cast<std::int64_t>(store.size()),
          .contacts = transfer.contacts(),
          .without_past = transfer.without_past(),
          .drawn_out = static_cast<std::int64_t>(inside.size())};
}

void Dem::Impl::fill_last_force() const {
  last_force.assign(4 * store.size(), 0.0);
  for (std::size_t n = 0; n < store.size(); ++n) {
    const double mass = 1.0 / store.inverse_mass(n);
    const double* drag = store.drag(n);
    const double* g =
        conditions.gravity.data() + 4 * static_cast<std::ptrdiff_t>(store.material(n));
    for (std::size_t d = 0; d < 3; ++d) {
      last_force[4 * n + d] = mass * (g[d] + drag[3] * (drag[d] - store.velocity(n)[d]));
    }
  }
  if (outer.is_reorder_due()) return;  // rows have changed since the forces were computed
  const std::span<const double> contact_force = tile_step.contact_force();
  for (std::size_t q = 0; q < contact_force.size(); ++q) last_force[q] += contact_force[q];
  const std::span<const double> fine_force = fine_level.force();
  for (std::size_t q = 0; q < fine_force.size(); ++q)
    last_force[4 * tiling.coarse_count + q] += fine_force[q];
}

Dem::Dem(const scenario::Setup& setup, const bodies::BodySet& bodies, std::vector<PairLaws> laws,
         std::vector<double> class_diameters, double fluid_density,
         std::vector<std::vector<double>> dust_shares)
    : impl_(std::make_unique<Impl>(setup, bodies, std::move(laws), std::move(class_diameters),
                                   fluid_density, DustLoads(std::move(dust_shares)))) {}
Dem::~Dem() = default;

double Dem::coarse_step() const { return impl_->conditions.step(); }
std::span<const ClassStep> Dem::class_steps() const { return impl_->conditions.steps.classes; }
const TimeSteps& Dem::time_steps() const { return impl_->conditions.steps; }
void Dem::insert(std::span<const NewGrain> grains) {
  impl_->synchronise();
  impl_->insert(grains);
}
void Dem::draw_out_at(std::vector<Opening> openings) { impl_->draw_out_at(std::move(openings)); }
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
void Dem::let_all_step() { impl_->inner.let_all_step(); }

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

std::span<const double> Dem::last_force() const {
  impl_->synchronise();
  impl_->fill_last_force();
  return impl_->last_force;
}

std::vector<ContactRecord> Dem::contacts(double time) const {
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
void Dem::keep_wind() { impl_->store.keep_wind(); }
void Dem::let_catch_dust() { impl_->loads.let_catch(); }
void Dem::take_up_dust(std::size_t row, std::size_t n, double mass) {
  impl_->loads.take_up(impl_->store, row, n, mass);
}
DustLoads::Balance Dem::dust_balance(std::size_t n) const {
  return impl_->loads.balance(impl_->store, n);
}

void Dem::record_wall_loads() {
  impl_->wall_loads.begin(impl_->conditions.surfaces, wall_count(impl_->conditions.surfaces));
  impl_->outer.require(OuterList::Due::rebuild);
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
  other.impl_->synchronise();
  impl_->move_to(time);
  return impl_->transfer_from(*other.impl_, laws, keeps_dust);
}

void Dem::save(sdk::ArchiveWriter& archive) const {
  impl_->synchronise();
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
  const std::int64_t state[] = {static_cast<std::int64_t>(tiling.coarse_count),
                                store.next_id(),
                                list.age,
                                lifetimes.outer_lifetime,
                                lifetimes.next_outer_lifetime,
                                list.due >= OuterList::Due::rebuild,
                                list.due == OuterList::Due::reorder,
                                store.has_drag(),
                                counters.steps,
                                counters.particle_steps,
                                fine_level.sub_steps(),
                                counters.rebuilds,
                                counters.missed_contact_onsets,
                                counters.free_flight_steps,
                                lifetimes.skin_level,
                                lifetimes.inner_lifetime,
                                list.due == OuterList::Due::update,
                                list.updated,
                                counters.list_repairs,
                                list.lifetime};
  archive.integers("state", state);
}

void Dem::Impl::load(sdk::ArchiveReader& archive) {
  const auto state = archive.integers("state");
  tiling = Tiling::of(static_cast<std::size_t>(state.at(0)));
  counters.steps = state.at(8);
  counters.particle_steps = state.at(9);
  counters.rebuilds = state.at(11);
  counters.missed_contact_onsets = state.at(12);
  counters.free_flight_steps = state.at(13);
  counters.list_repairs = state.at(18);
  tuner.restore({state.at(3), state.at(4), state.at(14), state.at(15)});
  OuterList::Due due = OuterList::Due::nothing;
  if (state.at(16) != 0) due = OuterList::Due::update;
  if (state.at(5) != 0) due = OuterList::Due::rebuild;
  if (state.at(6) != 0) due = OuterList::Due::reorder;
  store.load(archive, state.at(1), state.at(7) != 0);
  const std::size_t tiles = tile_step.load(archive, wall_loads.walls());
  // Checkpoints of before are of runs whose lists had been made with it.
  const std::int64_t lifetime = state.size() > 19 ? state[19] : tuner.outer_lifetime();
  outer.load(archive, tiles,
             {.age = state.at(2), .updated = state.at(17), .lifetime = lifetime, .due = due});
  inner.load(archive, tiles);
  fine_level.load(archive, state.at(10));
  ledger.load(archive);
  loads.load(archive);
  accounts.work.resize(store.size());
  accounts.energy.restart(tiles);
  accounts.energy.load(archive);
  move_to(archive.number("time"));
  has_weights = store.has_weights(tiling.coarse_count);
}

}  // namespace dust::particles
