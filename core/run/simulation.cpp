// SPDX-License-Identifier: Apache-2.0
#include "run/simulation.hpp"

#include "base/finite.hpp"
#include "base/log.hpp"
#include "dust/sdk/error.hpp"
#include "scenario/units.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dust::run {
namespace {

fluid::Grid grid_of(const scenario::Setup& setup) {
  std::array<bool, 3> periodic{};
  for (std::size_t d = 0; d < 3; ++d) {
    periodic[d] = setup.domain.sides[2 * d].grains == scenario::GrainSide::periodic;
  }
  return fluid::Grid::make(setup.domain.min, setup.domain.max, setup.fluid->cells, periodic);
}

EntryScene entry_scene_of(const scenario::Setup& setup, const Models& models) {
  EntryScene scene;
  scene.min = setup.domain.min;
  scene.max = setup.domain.max;
  for (std::size_t d = 0; d < 3; ++d) {
    scene.is_periodic[d] = setup.domain.sides[2 * d].grains == scenario::GrainSide::periodic;
  }
  scene.surfaces = particles::surfaces_of(setup, models.bodies);
  for (std::size_t n = 0; n < models.emitters.size(); ++n) {
    const auto& choice = setup.emitters[n].model;
    scene.rules.push_back(models.emitters[n]->insertion_rule());
    scene.names.push_back(scenario::place(choice.where) + ": error: " + choice.path);
  }
  return scene;
}

/// [J] Translation and rotation, mean over the computed grains; infinite without grains.
double kinetic_energy_per_grain(const particles::GrainRows& rows) {
  double sum = 0.0;
  for (std::size_t n = 0; n < rows.count; ++n) {
    const double* v = rows.velocity_of(n);
    const double* w = rows.rotation_of(n);
    const double r = rows.position[4 * n + 3];
    const double inertia = 0.4 * r * r / v[3];
    sum += 0.5 / v[3] * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) +
           0.5 * inertia * (w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
  }
  return rows.count > 0 ? sum / static_cast<double>(rows.count)
                        : std::numeric_limits<double>::infinity();
}

}  // namespace

Simulation::Simulation(const scenario::Setup& setup, Models models, int check_every)
    : setup_(setup), models_(std::move(models)) {
  const double step = setup_.time.fluid_step;
  steps_wanted_ = static_cast<std::int64_t>(std::ceil(setup_.time.end / step - 1e-9));

  if (setup_.fluid) {
    grid_ = grid_of(setup_);
    fluid::Boundaries boundaries{};
    for (std::size_t s = 0; s < 6; ++s) boundaries[s] = models_.boundaries[s].get();
    fluid_ = std::make_unique<fluid::FluidSolver>(grid_, *setup_.fluid, models_.bodies, boundaries);
    const sdk::Vec3 initial = setup_.fluid->initial_velocity;
    fluid_->set_velocity([initial](sdk::Vec3) { return initial; });
    fluid_table_ = std::make_unique<FluidTable>(grid_, *setup_.fluid, fluid_->open_fraction());
    if (models_.turbulence) fluid_->use(*models_.turbulence);
    if (has_grains()) {
      coupling_ = std::make_unique<coupling::Coupling>(setup_, grid_, fluid_->open_fraction(),
                                                       *models_.voidage, *models_.drag);
      coupling_->use(models_.fluid_forces, particles::surfaces_of(setup_, models_.bodies));
      coupling_->use_boundaries(boundaries);
      if (setup_.fluid->overlaps_grains) {
        held_fluid_ = std::make_unique<HeldFluid>(
            HeldFluid{fluid_->velocity(), fluid::FaceField(grid_), fluid_->pressure()});
      }
    } else {
      no_grains_ = std::make_unique<NoGrains>(grid_);
      momentum_exchange_.assign(
          3 * static_cast<std::size_t>(grid_.count[0]) * grid_.count[1] * grid_.count[2], 0.0F);
    }
  }
  make_grains();
  wants_contacts_ = std::any_of(models_.sensors.begin(), models_.sensors.end(),
                                [](const auto& s) { return s->wants_contacts(); });
  entry_scene_ = entry_scene_of(setup_, models_);
  emissions_ = EmissionBook(models_.emitters.size());
  for (const auto& sensor : models_.sensors) wants_walls_ |= sensor->wants_walls();
  if (wants_walls_) dem_->watch_walls();
  dem_steps_per_fluid_step_ =
      std::max(1, static_cast<int>(std::lround(step / dem_->coarse_step())));
  build_dem_graph(check_every);
  build_step_graph();
  publish_grains();
  if (fluid_) fluid_table_->publish(*fluid_, void_fraction());
}

void Simulation::make_grains() {
  // Buoyancy is part of the weight, unless a model gives it.
  const bool has_buoyancy = setup_.fluid && !coupling::takes_over_buoyancy(models_.fluid_forces);
  const double density = has_buoyancy ? setup_.fluid->density : 0.0;
  if (has_grains()) {
    dem_ = std::make_unique<particles::Dem>(setup_, models_.bodies, std::move(models_.laws),
                                            models_.class_diameters, density);
    return;
  }
  // Nobody asks how large grains are that never come, and nothing shortens the step.
  constexpr double k_any_diameter = 1e-3;
  scenario::Setup empty = setup_;
  empty.time.dem_step = empty.time.fluid_step;
  dem_ = std::make_unique<particles::Dem>(empty, models_.bodies, std::move(models_.laws),
                                          std::vector<double>{k_any_diameter}, density);
}

const fluid::CellField& Simulation::void_fraction() const {
  return coupling_ ? coupling_->void_fraction() : no_grains_->void_fraction;
}

Simulation::~Simulation() = default;

double Simulation::time() const {
  return static_cast<double>(steps_done_) * setup_.time.fluid_step;
}

void Simulation::start() {
  emit();
  is_started_ = true;
  // Grains that are there at the start do not push their volume out of the air in the first step,
  // and the first frame shows the air between them.
  if (coupling_ && dem_->rows().count > 0) {
    coupling_->start(dem_->rows());
    fluid_table_->publish(*fluid_, void_fraction());
  }
  publish_grains();
}

/// Takes away the bodies whose time has come or whose grains have come to rest, at the beginning of
/// a fluid step.
void Simulation::remove_bodies() {
  // Times in decimal meet the steps to a few roundings.
  const double now = time() + 1e-9 * setup_.time.fluid_step;
  bool has_changed = false;
  for (std::size_t b = 0; b < setup_.bodies.size(); ++b) {
    const auto& removal = setup_.bodies[b].removal;
    bodies::Body& body = models_.bodies[b];
    if (!removal || body.is_removed()) continue;
    std::string cause;
    if (now >= removal->at) {
      cause = "its time has come";
    } else if (removal->kinetic_energy_per_grain > 0.0 && now >= removal->after) {
      const double energy = kinetic_energy_per_grain(dem_->rows());
      if (energy < removal->kinetic_energy_per_grain) {
        cause = "the mean kinetic energy per grain is " + scenario::number_text(energy) + " J";
      }
    }
    if (cause.empty()) continue;
    body.removed_at = time();
    has_changed = true;
    base::log_info("the body " + body.name + " is taken away at " + scenario::number_text(time()) +
                   " s: " + cause);
  }
  if (!has_changed) return;
  dem_->bodies_changed();
  if (fluid_) air_bodies_changed();
}

/// Tells the air that bodies are elsewhere than it knows.
void Simulation::air_bodies_changed() {
  fluid_->bodies_changed(time());
  take_open_fraction();
}

void Simulation::take_open_fraction() {
  if (coupling_) coupling_->set_open_fraction(fluid_->open_fraction());
  fluid_table_->set_open_fraction(fluid_->open_fraction());
}

bool Simulation::has_changing_walls() const {
  bool is_changing = false;
  for (std::size_t b = 0; b < setup_.bodies.size(); ++b) {
    is_changing |= setup_.bodies[b].removal.has_value() || models_.bodies[b].displaces();
  }
  return is_changing;
}

void Simulation::run_dem_cycle() {
  if (!has_grains()) return;
  if (coupling_) {
    const double interval = coupling_->refresh_interval();
    dem_steps_per_refresh_ =
        std::max(1, static_cast<int>(std::floor(interval / dem_->coarse_step() + 1e-6)));
  }
  for (dem_step_ = 0; dem_step_ < dem_steps_per_fluid_step_; ++dem_step_) dem_graph_.run();
  dem_->land();
}

void Simulation::publish_grains() {
  grain_table_.publish(dem_->rows(), dem_->last_force());
  if (wants_contacts_) contact_table_.publish(dem_->contacts(), grain_table_.order());
}

void Simulation::check_health() const {
  const auto c = grain_table_.columns();
  for (std::size_t n = 0; n < c.id.size(); ++n) {
    if (!base::is_finite({c.x[n], c.y[n], c.z[n]}) ||
        !base::is_finite({c.velocity_x[n], c.velocity_y[n], c.velocity_z[n]}) ||
        !base::is_finite(
            {c.angular_velocity_x[n], c.angular_velocity_y[n], c.angular_velocity_z[n]})) {
      throw sdk::ModelError("grain " + std::to_string(c.id[n]) +
                            " has a position or velocity that is not a number; likely causes: a "
                            "time step too long for the stiffness, or an overlap at entry");
    }
  }
}

void Simulation::step() {
  step_graph_.run();
  ++steps_done_;
}

sdk::WorldView Simulation::world() const {
  sdk::WorldView view;
  view.time = time();
  view.interval = setup_.time.fluid_step;
  view.domain_min = setup_.domain.min;
  view.domain_max = setup_.domain.max;
  view.gravity = setup_.gravity;
  view.grains = grain_table_.columns();
  if (wants_contacts_) view.contacts = contact_table_.columns();
  if (fluid_table_) view.fluid = fluid_table_->columns();
  view.walls = dem_->wall_loads();
  view.class_diameters = models_.class_diameters;
  view.emitted_mass = dem_->balance().mass_emitted;
  return view;
}

const std::vector<float>& Simulation::momentum_exchange() {
  if (coupling_) coupling_->momentum_exchange(momentum_exchange_);
  return momentum_exchange_;
}

}  // namespace dust::run
