// SPDX-License-Identifier: Apache-2.0
#include "particles/dem.hpp"

#include "particles/forces/contact_snapshot.hpp"
#include "particles/impl.hpp"
#include "particles/transfer/translation.hpp"

#include <algorithm>
#include <utility>

namespace dust::particles {

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
  std::vector<std::string> names(impl_->wall_count());
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

}  // namespace dust::particles
