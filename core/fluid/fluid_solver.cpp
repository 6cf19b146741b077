// SPDX-License-Identifier: Apache-2.0
#include "fluid/fluid_solver.hpp"

#include "dust/sdk/error.hpp"
#include "fluid/solver_impl.hpp"

#include <algorithm>
#include <string>

namespace dust::fluid {

using sdk::Vec3;
using Ghosts = Momentum::Ghosts;

FluidSolver::Impl::Impl(const Grid& grid, const scenario::FluidSpec& fluid,
                        const bodies::BodySet& bodies, const Boundaries& boundaries)
    : grid_(grid),
      sides_(grid_, boundaries),
      properties_(grid_, fluid),
      cut_(grid_, bodies, sides_, properties_),
      momentum_(grid_, geometry(), sides_, properties_),
      projection_(grid_, cut_, sides_, properties_, momentum_, fluid.pressure_tolerance),
      u_(grid_),
      stages_(grid_, geometry(), sides_, properties_, momentum_),
      void_fraction_(grid_),
      drag_velocity_(grid_),
      balance_(grid_, geometry(), properties_),
      stress_(grid_, geometry(), sides_, momentum_),
      limits_(grid_, geometry(), momentum_, fluid.largest_cfl) {
  cut_.complete(0.0);
  sides_.set_flow_data(geometry().open_area, properties_.by_place());
  sides_.evaluate_velocity(0.0, void_fraction_.field());
  sides_.evaluate_pressure(0.0);
  for (int d = 0; d < 3; ++d) {
    std::fill(u_.component[d].begin(), u_.component[d].end(), fluid.initial_velocity[d]);
  }
  momentum_.extend(u_, Ghosts::all);
  sides_.fill_velocity(u_);
}

void FluidSolver::Impl::use(const sdk::TurbulenceModel& turbulence) {
  eddies_ = std::make_unique<EddyStress>(grid_, geometry(), sides_, properties_, cut_.bodies(),
                                         turbulence);
}

/// Cuts the grid by the bodies as they move from `begin` to `end` [s], for all that depends on it.
void FluidSolver::Impl::recut(double begin, double end) {
  cut_.cut(begin, end);
  momentum_.geometry_changed();
  cut_.complete(end);
  sides_.set_flow_data(geometry().open_area, properties_.by_place());
  projection_.geometry_changed();
  if (eddies_) eddies_->bodies_moved(cut_.bodies(), end);
}

void FluidSolver::Impl::bodies_changed(double time) {
  cut_.bodies_changed();
  recut(time, time);
  momentum_.extend(u_, Ghosts::all);
  sides_.fill_velocity(u_);
  limits_.velocity_changed();
}

void FluidSolver::Impl::set_velocity(const std::function<Vec3(Vec3)>& velocity) {
  for (int d = 0; d < 3; ++d) {
    const auto& n = geometry().extent[d];
    for (int k = 0; k < n[2]; ++k) {
      for (int j = 0; j < n[1]; ++j) {
        for (int i = 0; i < n[0]; ++i) {
          u_.component[d][grid_.index(i, j, k)] = velocity(grid_.face(d, i, j, k))[d];
        }
      }
    }
  }
  momentum_.extend(u_, Ghosts::all);
  sides_.fill_velocity(u_);
  projection_.set_consistent(false);
  limits_.velocity_changed();
}

void FluidSolver::Impl::save(sdk::ArchiveWriter& archive) {
  const FaceField& stress = stress_divergence();
  archive.numbers("velocity_x", u_.component[0]);
  archive.numbers("velocity_y", u_.component[1]);
  archive.numbers("velocity_z", u_.component[2]);
  archive.numbers("pressure", pressure());
  archive.numbers("stress_x", stress.component[0]);
  archive.numbers("stress_y", stress.component[1]);
  archive.numbers("stress_z", stress.component[2]);
  archive.integer("is_consistent", projection_.is_consistent() ? 1 : 0);
  if (has_moving_bodies()) archive.integers("open_cells", projection_.continuity().open_cells());
  balance_.save(archive);
}

void FluidSolver::Impl::load(sdk::ArchiveReader& archive, double time) {
  // The bodies may have moved or gone since the start.
  const bool has_changed =
      has_moving_bodies() || std::any_of(cut_.bodies().begin(), cut_.bodies().end(),
                                         [](const bodies::Body& b) { return b.is_removed(); });
  if (has_changed) bodies_changed(time);
  if (has_moving_bodies()) projection_.continuity().was_open(archive.integers("open_cells"));
  const auto take = [&](const char* name, std::vector<double>& into) {
    auto values = archive.numbers(name);
    if (values.size() != grid_.size) {
      throw sdk::ModelError(std::string("the checkpoint's fluid field ") + name +
                            " belongs to another grid");
    }
    into = std::move(values);
  };
  take("velocity_x", u_.component[0]);
  take("velocity_y", u_.component[1]);
  take("velocity_z", u_.component[2]);
  take("pressure", projection_.pressure());
  FaceField& stress = stress_.write();
  take("stress_x", stress.component[0]);
  take("stress_y", stress.component[1]);
  take("stress_z", stress.component[2]);
  projection_.set_consistent(archive.integer("is_consistent") != 0);
  balance_.load(archive);
  limits_.velocity_changed();
  cut_.walls_have_changed();
}

FluidSolver::FluidSolver(const Grid& grid, const scenario::FluidSpec& fluid,
                         const bodies::BodySet& bodies, const Boundaries& boundaries)
    : impl_(std::make_unique<Impl>(grid, fluid, bodies, boundaries)) {}
FluidSolver::~FluidSolver() = default;

void FluidSolver::use(const sdk::TurbulenceModel& turbulence) { impl_->use(turbulence); }
void FluidSolver::use(VelocityForcing& forcing) { impl_->use(forcing); }
const CellField* FluidSolver::eddy_viscosity() const { return impl_->eddy_viscosity(); }
void FluidSolver::advance(double time, double step, const CellField& before, const CellField& after,
                          const Exchange& exchange) {
  impl_->advance(time, step, before, after, exchange);
}
const FaceField& FluidSolver::velocity() const { return impl_->velocity(); }
const FaceField& FluidSolver::drag_velocity() const { return impl_->drag_velocity(); }
const FaceField& FluidSolver::mean_velocity() const { return impl_->mean_velocity(); }
const CellField& FluidSolver::pressure() const { return impl_->pressure(); }
const CellField& FluidSolver::mean_pressure() const { return impl_->mean_pressure(); }
const FaceField& FluidSolver::stress_divergence() { return impl_->stress_divergence(); }
const CellField& FluidSolver::open_fraction() const { return impl_->open_fraction(); }
const FaceField& FluidSolver::open_area() const { return impl_->open_area(); }
const ThinBodies& FluidSolver::thin_bodies() const { return impl_->thin_bodies(); }
FaceField FluidSolver::passable_area() const { return impl_->passable_area(); }
void FluidSolver::find_throughflow(FaceField& throughflow) { impl_->find_throughflow(throughflow); }
void FluidSolver::each_sink(
    const std::function<void(std::int32_t, double, std::int32_t)>& visit) const {
  for (const Continuity::Sink& sink : impl_->mean_sinks()) visit(sink.cell, sink.rate, sink.body);
}
const FluidReport& FluidSolver::report() const { return impl_->report(); }
bool FluidSolver::has_moving_bodies() const { return impl_->has_moving_bodies(); }
void FluidSolver::look_ahead(double time) { impl_->predict_open_fraction(time); }
void FluidSolver::bodies_changed(double time) { impl_->bodies_changed(time); }
void FluidSolver::set_velocity(const std::function<Vec3(Vec3)>& velocity) {
  impl_->set_velocity(velocity);
}
void FluidSolver::save(sdk::ArchiveWriter& archive) { impl_->save(archive); }
void FluidSolver::load(sdk::ArchiveReader& archive, double time) { impl_->load(archive, time); }

}  // namespace dust::fluid
