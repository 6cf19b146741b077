// SPDX-License-Identifier: Apache-2.0
#include "coupling/coupling.hpp"

#include "base/error.hpp"
#include "coupling/coupling_impl.hpp"
#include "dust/sdk/error.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace dust::coupling {

Coupling::Coupling(const scenario::Setup& setup, const fluid::Grid& grid,
                   const fluid::CellField& open_fraction, const sdk::VoidageRule& voidage,
                   const sdk::DragLaw& drag) {
  if (!setup.fluid) throw std::logic_error("Coupling needs a scenario with a fluid");
  const scenario::FluidSpec& fluid = *setup.fluid;
  if (!(fluid.viscosity > 0.0)) {
    throw sdk::ModelError("drag on grains needs a fluid with a viscosity above zero");
  }
  impl_ = std::make_unique<Impl>(setup, fluid, grid, open_fraction, voidage, drag);
}
Coupling::~Coupling() = default;

void Coupling::check_diameters(std::span<const double> diameters) const {
  const double limit = impl_->voidage.largest_diameter_over_spacing();
  for (const double diameter : diameters) {
    if (impl_->is_one_way || diameter <= limit * (1.0 + k_ratio_rounding) * impl_->least_spacing) {
      continue;
    }
    throw base::UserError(text(
        "error: grains of ", diameter, " m are too large for fluid cells of ", impl_->least_spacing,
        " m: the voidage rule is valid for D/dx up to ", limit, "; use fewer fluid cells"));
  }
}

void Coupling::set_open_fraction(const fluid::CellField& open_fraction) {
  impl_->lattice.set_open_fraction(open_fraction);
}

void Coupling::start(const particles::GrainRows& grains) { impl_->start(grains); }
void Coupling::map(const particles::GrainRows& grains, double fluid_step) {
  impl_->map(grains, fluid_step);
}
const fluid::CellField& Coupling::void_fraction_before() const {
  return impl_->void_fraction.before();
}
const fluid::CellField& Coupling::void_fraction() const { return impl_->void_fraction.after(); }
const fluid::Exchange& Coupling::exchange() const { return impl_->faces.exchange(); }

void Coupling::settle(const particles::GrainRows& grains, const fluid::FaceField& velocity) {
  impl_->memory.align(grains);
  impl_->settle(velocity);
}

void Coupling::refresh(const particles::GrainRows& grains, const fluid::FaceField& velocity,
                       const fluid::FaceField& stress_divergence) {
  refresh(grains, FluidState{velocity, stress_divergence});
}

void Coupling::refresh(const particles::GrainRows& grains, const FluidState& fluid) {
  impl_->memory.align(grains);
  if (!impl_->is_settled && !impl_->is_overlapped) impl_->settle(fluid.velocity);
  ForceTerms* forces = impl_->forces.get();
  if (forces != nullptr) forces->begin(fluid, impl_->step, impl_->done_refreshes == 0);
  impl_->sort_if_changed(grains);
  if (impl_->stress_book && impl_->done_refreshes == 0) {
    impl_->stress_book->leave(impl_->void_fraction.after(), fluid.stress_divergence, impl_->step);
  }
  impl_->for_batches(
      [&](std::size_t batch, Impl::Rows rows) { impl_->refresh(grains, batch, rows, fluid); });
  if (forces != nullptr) forces->end(fluid);
  ++impl_->done_refreshes;
  impl_->last_held = impl_->held(fluid);
}

void Coupling::use(std::span<const std::unique_ptr<sdk::FluidForce>> forces,
                   std::vector<particles::Surface> surfaces) {
  if (forces.empty()) return;
  Impl& s = *impl_;
  s.forces = std::make_unique<ForceTerms>(forces, std::move(surfaces), s.lattice, s.properties,
                                          s.gravity, s.is_set_three, s.graining);
  s.memory.keep(s.forces->kept_numbers());
  // Models take over parts of the stress, and walls carry others.
  s.stress_book.reset();
}

void Coupling::use_sides(const std::array<const sdk::BoundaryCondition*, 6>& sides) {
  using own_disturbance::Side;
  for (std::size_t n = 0; n < sides.size(); ++n) {
    if (sides[n] == nullptr) continue;
    const sdk::SideRules rules = sides[n]->rules();
    if (rules.normal_velocity != sdk::SideRule::fixed) {
      impl_->sides[n] = Side::open;
    } else {
      const bool is_slip = rules.tangential_velocity != sdk::SideRule::fixed;
      impl_->sides[n] = is_slip ? Side::slip : Side::wall;
    }
  }
}

bool takes_over_buoyancy(std::span<const std::unique_ptr<sdk::FluidForce>> forces) {
  return std::any_of(forces.begin(), forces.end(),
                     [](const auto& force) { return force->takes_over().buoyancy; });
}

double Coupling::refresh_interval() const { return impl_->step / impl_->refreshes; }

void Coupling::collect(const particles::GrainRows& grains, double fluid_step) {
  impl_->collect(grains, fluid_step);
}

void Coupling::momentum_exchange(std::vector<float>& per_cell) const {
  impl_->faces.per_cell(per_cell);
}
const CouplingReport& Coupling::report() const { return impl_->report; }

void Coupling::save(sdk::ArchiveWriter& archive) const {
  const CouplingReport& r = impl_->report;
  impl_->void_fraction.save(archive);
  impl_->memory.save(archive);
  if (impl_->forces) impl_->forces->save(archive);
  archive.number("refreshes", impl_->refreshes);
  archive.number("step", impl_->step);
  archive.number("last_held", impl_->last_held);
  if (impl_->stress_book) impl_->stress_book->save(archive);
  archive.integers(
      "counts", std::array{r.moved_shares, r.relieved_cells, r.unplaced_grains, r.unpaired_forces});
  archive.numbers("extremes", std::array{r.smallest_void_fraction, r.largest_imbalance,
                                         r.largest_diameter_over_spacing});
}

void Coupling::load(sdk::ArchiveReader& archive) {
  CouplingReport& r = impl_->report;
  impl_->void_fraction.load(archive);
  impl_->memory.load(archive);
  if (impl_->forces) impl_->forces->load(archive);
  impl_->refreshes = archive.number("refreshes");
  impl_->step = archive.number("step");
  impl_->last_held = archive.number("last_held");
  if (impl_->stress_book) impl_->stress_book->load(archive);
  const std::vector<std::int64_t> counts = archive.integers("counts");
  const std::vector<double> extremes = archive.numbers("extremes");
  r.moved_shares = counts.at(0);
  r.relieved_cells = counts.at(1);
  r.unplaced_grains = counts.at(2);
  r.unpaired_forces = counts.at(3);
  r.smallest_void_fraction = extremes.at(0);
  r.largest_imbalance = extremes.at(1);
  r.largest_diameter_over_spacing = extremes.at(2);
}

}  // namespace dust::coupling
