// SPDX-License-Identifier: Apache-2.0
#include "run/fluid_stage.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace dust::run {
namespace {

fluid::Grid grid_of(const scenario::Setup& setup) {
  std::array<bool, 3> periodic{};
  for (std::size_t d = 0; d < 3; ++d) {
    periodic[d] = setup.domain.sides[2 * d].grains == scenario::GrainSide::periodic;
  }
  return fluid::Grid::make(setup.domain.min, setup.domain.max, setup.fluid->cells, periodic);
}

/// Whether emitters give particles that a drag law is for.
bool has_unresolved(const scenario::Setup& setup) {
  return std::any_of(
      setup.emitters.begin(), setup.emitters.end(), [&](const scenario::EmitterSpec& e) {
        const int material = e.more_materials.empty() ? e.material : e.more_materials.front();
        return !setup.fluid->resolves(material);
      });
}

void copy(const std::vector<double>& from, std::vector<double>& to) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, from.size(), 1U << 15), [&](const auto& r) {
    std::copy_n(from.data() + r.begin(), r.size(), to.data() + r.begin());
  });
}

}  // namespace

FluidStage::FluidStage(const scenario::Setup& setup, const Models& models)
    : setup_(setup), models_(models), grid_(grid_of(setup)) {
  fluid::Boundaries boundaries{};
  for (std::size_t s = 0; s < 6; ++s) boundaries[s] = models_.sides->models()[s];
  solver_ = std::make_unique<fluid::FluidSolver>(grid_, *setup_.fluid, models_.bodies, boundaries);
  const sdk::Vec3 initial = setup_.fluid->initial_velocity;
  solver_->set_velocity([initial](sdk::Vec3) { return initial; });
  if (models_.turbulence) solver_->use(*models_.turbulence);
  if (!setup_.fluid->resolved.empty()) make_resolved();
  if (models_.class_diameters.empty() || (resolved_ && !has_unresolved(setup_))) {
    no_particles_ = std::make_unique<NoParticles>(NoParticles{
        fluid::CellField(grid_.size, 1.0), {fluid::FaceField(grid_), fluid::FaceField(grid_)}});
    momentum_exchange_.assign(
        3 * static_cast<std::size_t>(grid_.count[0]) * grid_.count[1] * grid_.count[2], 0.0F);
  } else {
    make_coupling(boundaries);
  }
}

void FluidStage::make_coupling(const fluid::Boundaries& boundaries) {
  coupling_ = std::make_unique<coupling::Coupling>(setup_, grid_, solver_->open_fraction(),
                                                   *models_.voidage, *models_.drag);
  coupling_->use(models_.fluid_forces, particles::surfaces_of(setup_, models_.bodies));
  coupling_->use_boundaries(boundaries);
  coupling_->use_thin_bodies(solver_->thin_bodies());
  if (!setup_.fluid->overlaps_grains) return;
  lagged_ = std::make_unique<LaggedFluid>(
      LaggedFluid{solver_->velocity(), fluid::FaceField(grid_), solver_->pressure()});
}

void FluidStage::make_resolved() {
  resolved::FluidAround around{setup_.fluid->density, setup_.time.fluid_step, {}};
  if (coupling::takes_over_buoyancy(models_.fluid_forces)) {
    around.buoyancy = -setup_.fluid->density * setup_.gravity;
  }
  resolved_ = std::make_unique<resolved::ResolvedSpheres>(
      grid_,
      std::vector<std::int32_t>(setup_.fluid->resolved.begin(), setup_.fluid->resolved.end()),
      around);
  solver_->use(resolved_->forcing());
}

const particles::GrainRows& FluidStage::unresolved(const particles::GrainRows& rows) {
  if (!resolved_) return rows;
  return unresolved_.take(rows, [this](int material) { return resolved_->is_resolved(material); });
}

const fluid::CellField& FluidStage::void_fraction() const {
  return coupling_ ? coupling_->void_fraction() : no_particles_->void_fraction;
}

void FluidStage::begin_step(double time, const particles::GrainRows& rows) {
  if (resolved_) resolved_->begin_step(rows, solver_->velocity());
  if (!coupling_) return;
  if (solver_->has_moving_bodies()) {
    solver_->look_ahead(time + setup_.time.fluid_step);
    coupling_->set_open_fraction(solver_->open_fraction());
  }
  assembled_ = coupling_->begin_step(unresolved(rows), setup_.time.fluid_step);
}

/// What particles do to the fluid, and a force besides.
const fluid::Exchange& FluidStage::exchange(const fluid::FaceField* force) {
  const fluid::Exchange& of_particles = coupling_ ? coupling_->exchange() : no_particles_->exchange;
  if (force == nullptr) return of_particles;
  if (!forced_) {
    forced_ = std::make_unique<fluid::Exchange>(
        fluid::Exchange{fluid::FaceField(grid_), fluid::FaceField(grid_)});
  }
  for (std::size_t d = 0; d < 3; ++d) {
    copy(of_particles.coefficient.component[d], forced_->coefficient.component[d]);
    const double* given = of_particles.source.component[d].data();
    const double* more = force->component[d].data();
    double* sum = forced_->source.component[d].data();
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, grid_.size, 1U << 15), [&](const auto& r) {
      for (std::size_t n = r.begin(); n < r.end(); ++n) sum[n] = given[n] + more[n];
    });
  }
  return *forced_;
}

void FluidStage::advance(double time, const fluid::FaceField* force) {
  const fluid::CellField& before =
      coupling_ ? coupling_->void_fraction_before() : no_particles_->void_fraction;
  solver_->advance(time, setup_.time.fluid_step, before, void_fraction(), exchange(force));
  if (resolved_) resolved_->evaluate(solver_->velocity());
  // Found here and not when first asked for: that brings the eddies up to date, which the dust
  // reads while the grains move.
  if (coupling_) static_cast<void>(solver_->stress_divergence());
  sub_steps_ += solver_->report().sub_steps;
  pressure_iterations_ += solver_->report().pressure_iterations;
}

void FluidStage::evaluate_drag(const particles::GrainRows& rows) {
  if (!coupling_) return;
  evaluated_ = coupling_->evaluate(std::move(assembled_).value(), unresolved(rows),
                                   solver_->drag_velocity());
  assembled_.reset();
}

void FluidStage::refresh(const particles::GrainRows& all, double now, double held) {
  const particles::GrainRows& rows = unresolved(all);
  if (lagged_) {
    coupling_->refresh(
        assembled_.value(), rows,
        {lagged_->velocity, lagged_->stress_divergence, &lagged_->pressure, now, held});
  } else {
    coupling_->refresh(
        evaluated_.value(), rows,
        {solver_->velocity(), solver_->stress_divergence(), &solver_->mean_pressure(), now, held});
  }
  if (resolved_) unresolved_.give_back_drag(all);
}

void FluidStage::end_step(const particles::GrainRows& rows) {
  if (resolved_) resolved_->end_step(rows);
  if (!coupling_) return;
  coupling_->end_step(std::move(evaluated_).value(), unresolved(rows));
  evaluated_.reset();
  if (resolved_) unresolved_.give_back_impulses(rows);
}

void FluidStage::keep_for_particles() {
  const fluid::FaceField& velocity = solver_->mean_velocity();
  const fluid::FaceField& stress = solver_->stress_divergence();
  for (std::size_t d = 0; d < 3; ++d) {
    copy(velocity.component[d], lagged_->velocity.component[d]);
    copy(stress.component[d], lagged_->stress_divergence.component[d]);
  }
  copy(solver_->mean_pressure(), lagged_->pressure);
}

void FluidStage::bodies_changed(double time) {
  solver_->bodies_changed(time);
  if (coupling_) coupling_->bodies_changed(solver_->open_fraction());
}

const std::vector<float>& FluidStage::momentum_exchange() {
  if (coupling_) coupling_->momentum_exchange(momentum_exchange_);
  return momentum_exchange_;
}

void FluidStage::set_velocity(const fluid::FaceField& velocity) {
  // The faces of each direction are asked for by their places.
  solver_->set_velocity([&](sdk::Vec3 place) {
    const std::array<int, 3> cell = grid_.cell_at(place);
    sdk::Vec3 u;
    for (std::size_t d = 0; d < 3; ++d) {
      const int axis = static_cast<int>(d);
      const double at = (place[axis] - grid_.origin[axis]) / grid_.spacing[axis];
      std::array<int, 3> n = cell;
      n[d] = std::clamp(static_cast<int>(std::lround(at)), 0, grid_.count[d]);
      u[static_cast<int>(d)] =
          velocity.component[d][static_cast<std::size_t>(grid_.index(n[0], n[1], n[2]))];
    }
    return u;
  });
}

void FluidStage::load_velocity(sdk::ArchiveReader& archive) {
  fluid::FaceField velocity;
  for (std::size_t d = 0; d < 3; ++d) {
    velocity.component[d] = archive.numbers(std::string("velocity_") + "xyz"[d]);
  }
  set_velocity(velocity);
}

void FluidStage::adapt_velocity(double time) {
  bodies_changed(time);
  set_velocity(fluid::FaceField(solver_->velocity()));
}

template <class Fluid, class Visit>
void FluidStage::for_fields(Fluid& fluid, const Visit& visit) {
  for (std::size_t d = 0; d < 3; ++d) {
    const std::string axis(1, "xyz"[d]);
    visit("velocity_" + axis, fluid.velocity.component[d]);
    visit("stress_" + axis, fluid.stress_divergence.component[d]);
  }
  visit(std::string("pressure"), fluid.pressure);
}

void FluidStage::add_parts(SaveParts& parts) {
  parts.emplace_back("fluid", [this](sdk::ArchiveWriter& a) { solver_->save(a); });
  if (coupling_) {
    parts.emplace_back("coupling", [this](sdk::ArchiveWriter& a) { coupling_->save(a); });
  }
  if (resolved_) {
    parts.emplace_back("resolved", [this](sdk::ArchiveWriter& a) { resolved_->save(a); });
  }
  if (!lagged_) return;
  parts.emplace_back("held_fluid", [this](sdk::ArchiveWriter& a) {
    for_fields(*lagged_,
               [&](const std::string& name, const auto& field) { a.numbers(name, field); });
  });
}

void FluidStage::add_parts(LoadParts& parts, const std::function<double()>& time,
                           const std::function<void()>& loaded) {
  parts.emplace_back("fluid", [this, time, loaded](sdk::ArchiveReader& a) {
    solver_->load(a, time());
    open_fraction_changed();
    loaded();
  });
  if (coupling_) {
    parts.emplace_back("coupling", [this, loaded](sdk::ArchiveReader& a) {
      coupling_->load(a);
      loaded();
    });
  }
  if (resolved_) {
    parts.emplace_back("resolved", [this](sdk::ArchiveReader& a) { resolved_->load(a); });
  }
  if (!lagged_) return;
  parts.emplace_back("held_fluid", [this](sdk::ArchiveReader& a) {
    for_fields(*lagged_, [&](const std::string& name, auto& field) { field = a.numbers(name); });
  });
}

}  // namespace dust::run
