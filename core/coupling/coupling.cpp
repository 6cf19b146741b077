// SPDX-License-Identifier: Apache-2.0
#include "coupling/coupling.hpp"

#include "base/error.hpp"
#include "coupling/drag/drag_exchange.hpp"
#include "coupling/drag/drag_linearisation.hpp"
#include "coupling/drag/drag_relaxation.hpp"
#include "coupling/flow_sampler.hpp"
#include "coupling/refresh_schedule.hpp"
#include "coupling/self_disturbance/self_disturbance.hpp"
#include "coupling/size_ratios.hpp"
#include "coupling/stencils/own_sides.hpp"
#include "coupling/stress_balance.hpp"
#include "dust/sdk/error.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

namespace dust::coupling {
namespace {

/// Rounding allowed in D / dx at the rule's limit (cells of exactly two diameters).
constexpr double k_ratio_rounding = 1e-9;

/// The parts written one after another, numbers to six digits.
template <class... Part>
std::string text(const Part&... parts) {
  std::ostringstream stream;
  (stream << ... << parts);
  return stream.str();
}

DragLinearisation::Order order_of(const scenario::FluidSpec& fluid) {
  return fluid.overlaps_grains ? DragLinearisation::Order::overlapped
                               : DragLinearisation::Order::fluid_first;
}

double least_edge(const fluid::Grid& grid) {
  return std::min({grid.spacing.x, grid.spacing.y, grid.spacing.z});
}

}  // namespace

/// The parts of an exchange, and what is passed from one to the next:
///   begin_step   void fraction -> linearised drag of each batch -> its contributions at the faces
///   refresh      fluid at the particles -> their relaxation
///   evaluate     what each particle's drag took from the fluid
///   end_step     the difference to what it received: its residual
struct Coupling::Impl {
  Impl(const scenario::Setup& setup, const scenario::FluidSpec& fluid, const fluid::Grid& grid,
       const fluid::CellField& open_fraction, const sdk::VoidageRule& rule,
       const sdk::DragLaw& law);

  Lattice lattice;
  OwnSides sides;
  DragModel drag;
  const sdk::VoidageRule& voidage;
  ParticleStates states;
  VoidFractionField void_fraction;
  FaceVoidFraction face_void;
  CouplingScene scene;
  SelfDisturbance self;
  SizeRatios size_ratios;
  DragLinearisation linearisation;
  DragExchange exchange;
  FlowSampler sampler;
  DragRelaxation relaxation;
  RefreshSchedule schedule;
  std::unique_ptr<ForceModels> forces;            ///< null without forces besides drag
  std::unique_ptr<StressBalance> stress_balance;  ///< null where both do not see one stress
  /// Memory for the next step's AssembledDrag.
  FaceStencils assembled_storage, sampled_storage;
  CouplingReport report;
  bool is_one_way;
  bool is_overlapped;  ///< the particles move while the fluid that they were mapped for is solved
};

Coupling::Impl::Impl(const scenario::Setup& setup, const scenario::FluidSpec& fluid,
                     const fluid::Grid& grid, const fluid::CellField& open_fraction,
                     const sdk::VoidageRule& rule, const sdk::DragLaw& law)
    : lattice(grid, open_fraction),
      drag(law, fluid, grid, setup.materials),
      voidage(rule),
      void_fraction(lattice, rule),
      face_void(lattice),
      scene{lattice, rule, drag, face_void, void_fraction, states},
      self(fluid.is_one_way ? scenario::DisturbanceCorrection::felt : fluid.disturbance_correction,
           scene),
      size_ratios(lattice),
      linearisation(scene, self,
                    {fluid.initial_velocity.x, fluid.initial_velocity.y, fluid.initial_velocity.z},
                    order_of(fluid)),
      exchange(lattice, face_void, rule, drag.momentum_set()),
      sampler(scene, self),
      relaxation(drag, self, states, setup.gravity),
      schedule(setup.time.fluid_step, least_edge(grid)),
      is_one_way(fluid.is_one_way),
      is_overlapped(fluid.overlaps_grains && !fluid.is_one_way) {
  // Where the air overlaps, the stress that particles see is a step older than that of the air: as
  // a residual it would rock a dense bed.
  if (!is_one_way && !drag.is_set_three() && !is_overlapped && drag.properties().is_uniform()) {
    stress_balance = std::make_unique<StressBalance>(lattice, rule);
  }
}

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

void Coupling::use(std::span<const std::unique_ptr<sdk::FluidForce>> forces,
                   std::vector<particles::Surface> surfaces) {
  Impl& s = *impl_;
  s.lattice.use_walls(surfaces);
  if (forces.empty()) return;
  s.forces = std::make_unique<ForceModels>(forces, std::move(surfaces), s.lattice, s.drag,
                                           s.relaxation.gravity());
  s.states.add_columns(s.forces->state_columns());
  s.sampler.sample_stress();
  s.relaxation.use(*s.forces);
  // Models take over parts of the stress, and walls carry others.
  s.stress_balance.reset();
}

void Coupling::use_boundaries(const std::array<const sdk::BoundaryCondition*, 6>& boundaries) {
  impl_->self.use_boundaries(boundaries);
}

void Coupling::check_diameters(std::span<const double> diameters) const {
  const double limit = impl_->voidage.largest_diameter_over_spacing();
  const double spacing = least_edge(impl_->lattice.grid());
  for (const double diameter : diameters) {
    if (impl_->is_one_way || diameter <= limit * (1.0 + k_ratio_rounding) * spacing) continue;
    throw base::UserError(
        text("error: grains of ", diameter, " m are too large for fluid cells of ", spacing,
             " m: the voidage rule is valid for D/dx up to ", limit, "; use fewer fluid cells"));
  }
}

void Coupling::use_thin_bodies(const fluid::ThinBodies& bodies) {
  impl_->sides.use(bodies);
  impl_->lattice.close(bodies.faces());
}

void Coupling::set_open_fraction(const fluid::CellField& open_fraction) {
  impl_->lattice.set_open_fraction(open_fraction);
  if (const auto* bodies = impl_->sides.bodies()) impl_->lattice.close(bodies->faces());
}

void Coupling::bodies_changed(const fluid::CellField& open_fraction) {
  const std::vector<double> solids = impl_->void_fraction.solids();
  set_open_fraction(open_fraction);
  impl_->void_fraction.keep_solids(solids);
}

void Coupling::start(const particles::GrainRows& rows) {
  Impl& s = *impl_;
  const particles::GrainRows grains = s.sides.take(rows);
  s.states.align(grains);
  if (!s.is_one_way) deposit(grains);
}

/// The void fraction of cells and faces round the particles where they are. Asks no drag law.
void Coupling::deposit(const particles::GrainRows& grains) {
  Impl& s = *impl_;
  s.self.prepare(grains);
  const VoidFractionField::Counts counts = s.void_fraction.deposit(grains);
  const double limit = s.voidage.largest_diameter_over_spacing();
  if (counts.largest_ratio > limit * (1.0 + k_ratio_rounding)) {
    const std::size_t row = counts.largest_row;
    throw sdk::ModelError(text("grain ", grains.id[row], " of diameter ", grains.diameter(row),
                               " m is too large for cells of ", least_edge(s.lattice.grid()),
                               " m: the voidage rule is valid for D/dx up to ", limit,
                               "; use fewer cells"));
  }
  CouplingReport& report = s.report;
  report.moved_shares += counts.moved_shares;
  report.limited_cells += counts.limited_cells;
  report.unplaced_grains += counts.unplaced_grains;
  report.smallest_void_fraction = std::min(report.smallest_void_fraction, counts.smallest);
  report.largest_diameter_over_spacing =
      std::max(report.largest_diameter_over_spacing, counts.largest_ratio);
  if (counts.smallest <= 0.0) {
    throw sdk::ModelError(
        text("the grains in one cell fill ", 1.0 - counts.smallest,
             " of its open volume and no cell around has room; use fewer cells, or look for grains "
             "that overlap or lie inside bodies"));
  }
  if (s.states.has_self_flow()) s.self.spread_solids(grains);
  s.face_void.update(s.void_fraction.after(), s.void_fraction.filled_cells());
}

AssembledDrag Coupling::begin_step(const particles::GrainRows& all, double fluid_step) {
  Impl& s = *impl_;
  const particles::GrainRows grains = s.sides.take(all);
  s.states.align(grains);
  s.schedule.begin_step(fluid_step, s.drag.fastest_relaxation(grains));
  if (s.drag.needs_size_ratio()) s.size_ratios.find(grains, s.drag.graining(), s.states);
  FaceStencils here = std::move(s.assembled_storage);
  here.sort(s.lattice.grid(), grains, s.states.order());
  if (s.is_one_way) return {{}, std::move(here)};
  deposit(grains);
  const fluid::CellField& eps = s.void_fraction.after();
  s.exchange.resize(here.size());
  here.for_batches([&](std::size_t batch, FaceStencils::Rows rows) {
    LinearisedDrag drag;
    const ParticleBatch particles{grains, rows, here.locate(s.lattice, grains, batch)};
    s.linearisation.evaluate(particles, batch, fluid_step, drag);
    s.exchange.assemble(particles, batch, drag, s.states, eps, fluid_step);
  });
  s.report.unpaired_forces +=
      s.exchange.scatter(here, s.states, eps, fluid_step, s.stress_balance.get());
  if (!s.is_overlapped) return {std::move(here), {}};
  FaceStencils sampled = std::move(s.sampled_storage);
  sampled = here;
  return {std::move(here), std::move(sampled)};
}

const fluid::CellField& Coupling::void_fraction_before() const {
  return impl_->void_fraction.before();
}
const fluid::CellField& Coupling::void_fraction() const { return impl_->void_fraction.after(); }
const fluid::Exchange& Coupling::exchange() const { return impl_->exchange.exchange(); }

EvaluatedDrag Coupling::evaluate(AssembledDrag drag, const particles::GrainRows& grains,
                                 const fluid::FaceField& velocity) {
  Impl& s = *impl_;
  s.states.align(grains);
  if (s.is_one_way) return EvaluatedDrag(std::move(drag.sampled_));
  FaceStencils there = std::move(drag.assembled_);
  const std::vector<std::int32_t> now = s.states.rows_now(there.order(), there.rows());
  const FaceStencils::Rows rows = now.empty() ? there.rows() : FaceStencils::Rows(now);
  const double step = s.schedule.fluid_step();
  const double imbalance =
      s.exchange.evaluate(there, rows, s.states, s.void_fraction.after(), velocity, step);
  s.report.largest_imbalance = std::max(s.report.largest_imbalance, imbalance);
  s.self.end_step(step);
  // The fluid is first sampled where the drag was assembled.
  if (!s.is_overlapped) return EvaluatedDrag(std::move(there));
  s.assembled_storage = std::move(there);
  return EvaluatedDrag(std::move(drag.sampled_));
}

void Coupling::refresh(EvaluatedDrag& drag, const particles::GrainRows& grains,
                       const FluidState& fluid) {
  Impl& s = *impl_;
  s.states.align(grains);
  if (!drag.sampled_.are_in_order(s.states.order(), grains.count)) {
    drag.sampled_.sort(s.lattice.grid(), grains, s.states.order());
    s.states.number(drag.sampled_.rows());
  }
  relax(drag.sampled_, grains, fluid);
}

/// The numbers of the particles stay those of the drag that is still to be evaluated.
void Coupling::refresh(AssembledDrag& drag, const particles::GrainRows& grains,
                       const FluidState& fluid) {
  Impl& s = *impl_;
  s.states.align(grains);
  if (!drag.sampled_.are_in_order(s.states.order(), grains.count)) {
    drag.sampled_.sort(s.lattice.grid(), grains, s.states.order());
  }
  relax(drag.sampled_, grains, fluid);
}

/// The action of the fluid, sampled at the stencils, on the particles until the next refresh.
void Coupling::relax(FaceStencils& stencils, const particles::GrainRows& grains,
                     const FluidState& fluid) {
  Impl& s = *impl_;
  const bool is_first = s.schedule.is_first();
  const double held = fluid.held > 0.0 ? fluid.held : s.schedule.interval();
  const double last_held = s.schedule.last_held();
  if (s.forces) s.forces->begin(fluid, s.schedule.fluid_step(), is_first);
  if (s.stress_balance && is_first) {
    s.stress_balance->leave(s.void_fraction.after(), fluid.stress_divergence,
                            s.schedule.fluid_step());
  }
  const particles::GrainRows sided = s.sides.take(grains);
  stencils.for_batches([&](std::size_t batch, FaceStencils::Rows rows) {
    s.relaxation.fetch(grains, rows);
    // Half way through the interval that the action holds for.
    const StencilBatch& here = stencils.locate(s.lattice, sided, batch, 0.5 * held);
    SampledFlow flow;
    DragColumns columns;
    s.sampler.sample({sided, rows, here}, fluid, flow, columns);
    s.relaxation.update({grains, rows, here}, fluid, flow, {held, last_held}, columns);
  });
  if (s.forces) s.forces->end(fluid);
  s.schedule.note(held);
}

double Coupling::refresh_interval() const { return impl_->schedule.interval(); }

void Coupling::end_step(EvaluatedDrag drag, const particles::GrainRows& grains) {
  Impl& s = *impl_;
  s.states.align(grains);
  std::span<Triple> stress;
  if (s.stress_balance) stress = s.stress_balance->room_for(grains.count);
  const tbb::blocked_range<std::size_t> all(0, grains.count, 4 * StencilBatch::k_size);
  tbb::parallel_for(all, [&](const tbb::blocked_range<std::size_t>& range) {
    for (std::size_t row = range.begin(); row < range.end(); ++row) {
      double* received = grains.fluid_impulse + 4 * row;
      ParticleState& r = s.states[row];
      if (s.forces) s.forces->impulse_was_read(s.states, row, received);
      for (std::size_t d = 0; !stress.empty() && d < 3; ++d) {
        stress[row][d] = grains.weight[row] * r.stress_impulse[d];
      }
      for (int d = 0; d < 3; ++d) {
        const double drag_impulse = received[d] - r.stress_impulse[d];
        if (!s.is_one_way && r.is_paired[d]) {
          r.deferred[d] += r.given[d] - grains.weight[row] * drag_impulse;
        }
        r.place[d] = grains.position[4 * row + d];
        r.stress_impulse[d] = 0.0;
        received[d] = 0.0;
      }
    }
  });
  if (s.stress_balance) {
    // In the cells where the fluid was sampled, however the particles were reordered since.
    const FaceStencils& there = drag.sampled_;
    const std::vector<std::int32_t> now = s.states.rows_now(there.order(), there.rows());
    s.stress_balance->receive(there, now.empty() ? there.rows() : FaceStencils::Rows(now), stress);
  }
  (s.is_overlapped ? s.sampled_storage : s.assembled_storage) = std::move(drag.sampled_);
}

void Coupling::momentum_exchange(std::vector<float>& per_cell) const {
  impl_->exchange.per_cell(per_cell);
}
const CouplingReport& Coupling::report() const { return impl_->report; }

void Coupling::save(sdk::ArchiveWriter& archive) const {
  impl_->void_fraction.save(archive);
  impl_->states.save(archive);
  if (impl_->forces) impl_->forces->save(archive);
  impl_->schedule.save(archive);
  if (impl_->stress_balance) impl_->stress_balance->save(archive);
  coupling::save(impl_->report, archive);
}

void Coupling::load(sdk::ArchiveReader& archive) {
  impl_->void_fraction.load(archive);
  impl_->states.load(archive);
  if (impl_->forces) impl_->forces->load(archive);
  impl_->schedule.load(archive);
  if (impl_->stress_balance) impl_->stress_balance->load(archive);
  coupling::load(impl_->report, archive);
}

bool takes_over_buoyancy(std::span<const std::unique_ptr<sdk::FluidForce>> forces) {
  return std::any_of(forces.begin(), forces.end(),
                     [](const auto& force) { return force->takes_over().buoyancy; });
}

}  // namespace dust::coupling
