// SPDX-License-Identifier: Apache-2.0
#include "fluid/fluid_solver.hpp"

#include "dust/sdk/error.hpp"
#include "fluid/solver_impl.hpp"

#include <algorithm>
#include <string>

namespace dust::fluid {

using sdk::Vec3;
using Ghosts = Momentum::Ghosts;

FluidSolver::Impl::Impl(const Grid& g, const scenario::FluidSpec& f, const bodies::BodySet& b,
                        const Boundaries& boundaries)
    : grid(g),
      fluid(f),
      bodies(b),
      sides(grid, boundaries),
      properties(grid, fluid),
      standing(standing_part()),
      geometry(Geometry::build(grid, bodies, sides.kinds(), properties, {}, standing.get())),
      suction(bodies),
      momentum(grid, geometry, sides, properties),
      continuity(grid, geometry, sides, properties, momentum),
      u(grid),
      next(grid),
      right(grid),
      sum(grid),
      stress(grid),
      drag_velocity(grid),
      p(grid.size, 0.0),
      eps(grid.size, 1.0) {
  complete_geometry(0.0);
  sides.set_flow_data(geometry.open_area, properties.by_place());
  sides.evaluate_velocity(0.0, eps);
  sides.evaluate_pressure(0.0);
  for (int d = 0; d < 3; ++d) {
    std::fill(u.component[d].begin(), u.component[d].end(), f.initial_velocity[d]);
  }
  momentum.extend(u, Ghosts::all);
  sides.fill_velocity(u);
}

FluidSolver::FluidSolver(const Grid& grid, const scenario::FluidSpec& fluid,
                         const bodies::BodySet& bodies, const Boundaries& boundaries)
    : impl_(std::make_unique<Impl>(grid, fluid, bodies, boundaries)) {}

FluidSolver::~FluidSolver() = default;

void FluidSolver::use(const sdk::TurbulenceModel& turbulence) {
  Impl& s = *impl_;
  s.all_sources = FaceField(s.grid);
  s.eddies = std::make_unique<EddyStress>(s.grid, s.geometry, s.sides, s.properties, s.bodies,
                                          turbulence, s.u);
}
const CellField* FluidSolver::eddy_viscosity() const {
  return impl_->eddies ? &impl_->eddies->eddy_viscosity() : nullptr;
}

void FluidSolver::advance(double time, double step, const CellField& before, const CellField& after,
                          const Exchange& exchange) {
  impl_->advance(time, step, before, after, exchange);
}

const FaceField& FluidSolver::velocity() const { return impl_->u; }
const FaceField& FluidSolver::drag_velocity() const { return impl_->drag_velocity; }
const FaceField& FluidSolver::mean_velocity() const {
  return impl_->drag_velocity_is_set ? impl_->drag_velocity : impl_->u;
}
const CellField& FluidSolver::pressure() const { return impl_->p; }
const CellField& FluidSolver::mean_pressure() const {
  return impl_->is_booked ? impl_->mean_pressure : impl_->p;
}
const FaceField& FluidSolver::stress_divergence() const {
  impl_->find_stress();
  return impl_->stress;
}
const CellField& FluidSolver::open_fraction() const { return impl_->open_ahead; }
const FluidReport& FluidSolver::report() const { return impl_->report; }

bool FluidSolver::has_moving_bodies() const { return impl_->standing != nullptr; }

void FluidSolver::look_ahead(double time) {
  Impl& s = *impl_;
  if (!s.standing) return;
  s.open_ahead =
      Geometry::open_fractions(s.grid, s.bodies, s.sides.kinds(), s.properties, time, *s.standing);
  s.sides.fill_cells(s.open_ahead);
}

void FluidSolver::bodies_changed(double time) {
  Impl& s = *impl_;
  s.standing = s.standing_part();
  s.geometry = Geometry::build(s.grid, s.bodies, s.sides.kinds(), s.properties, {time, time},
                               s.standing.get());
  s.momentum.geometry_changed();
  s.complete_geometry(time);
  s.continuity.geometry_changed(s.p);
  if (s.eddies) s.eddies->bodies_moved(s.bodies, time);
  s.momentum.extend(s.u, Ghosts::all);
  s.sides.fill_velocity(s.u);
  s.rates_are_known = false;
}

void FluidSolver::set_velocity(const std::function<Vec3(Vec3)>& velocity) {
  Impl& s = *impl_;
  for (int d = 0; d < 3; ++d) {
    for (int k = 0; k < s.geometry.extent[d][2]; ++k) {
      for (int j = 0; j < s.geometry.extent[d][1]; ++j) {
        for (int i = 0; i < s.geometry.extent[d][0]; ++i) {
          s.u.component[d][s.grid.index(i, j, k)] = velocity(s.grid.face(d, i, j, k))[d];
        }
      }
    }
  }
  s.momentum.extend(s.u, Ghosts::all);
  s.sides.fill_velocity(s.u);
  s.is_consistent = false;
  s.rates_are_known = false;
}

void FluidSolver::save(sdk::ArchiveWriter& archive) const {
  Impl& s = *impl_;
  s.find_stress();
  archive.numbers("velocity_x", s.u.component[0]);
  archive.numbers("velocity_y", s.u.component[1]);
  archive.numbers("velocity_z", s.u.component[2]);
  archive.numbers("pressure", s.p);
  archive.numbers("stress_x", s.stress.component[0]);
  archive.numbers("stress_y", s.stress.component[1]);
  archive.numbers("stress_z", s.stress.component[2]);
  archive.integer("is_consistent", s.is_consistent ? 1 : 0);
  if (s.standing) archive.integers("open_cells", s.continuity.open_cells());
  archive.integer("has_book", s.book ? 1 : 0);
  if (s.book) s.book->save(archive);
}

void FluidSolver::load(sdk::ArchiveReader& archive, double time) {
  Impl& s = *impl_;
  // The bodies may have moved or gone since the start.
  const bool has_changed =
      s.standing || std::any_of(s.bodies.begin(), s.bodies.end(),
                                [](const bodies::Body& b) { return b.is_removed(); });
  if (has_changed) bodies_changed(time);
  if (s.standing) s.continuity.was_open(archive.integers("open_cells"));
  const auto take = [&](const char* name, std::vector<double>& into) {
    auto values = archive.numbers(name);
    if (values.size() != s.grid.size) {
      throw sdk::ModelError(std::string("the checkpoint's fluid field ") + name +
                            " belongs to another grid");
    }
    into = std::move(values);
  };
  take("velocity_x", s.u.component[0]);
  take("velocity_y", s.u.component[1]);
  take("velocity_z", s.u.component[2]);
  take("pressure", s.p);
  take("stress_x", s.stress.component[0]);
  take("stress_y", s.stress.component[1]);
  take("stress_z", s.stress.component[2]);
  s.is_consistent = archive.integer("is_consistent") != 0;
  if (archive.integer("has_book") != 0) {
    s.book = std::make_unique<MomentumBook>(s.grid, s.geometry, s.properties);
    s.book->load(archive);
    s.mean_pressure.assign(s.grid.size, 0.0);
  }
  s.rates_are_known = false;
  s.walls_have_changed = true;
  s.stress_is_known = true;
}

}  // namespace dust::fluid
