// SPDX-License-Identifier: Apache-2.0
#include "run/simulation.hpp"

#include "base/error.hpp"
#include "base/log.hpp"
#include "dust/sdk/error.hpp"
#include "dust/sdk/sphere.hpp"
#include "scenario/diagnostics.hpp"
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
    scene.rules.push_back(models.emitters[n]->entry_rule());
    scene.names.push_back(scenario::place(choice.where) + ": error: " + choice.path);
  }
  return scene;
}

/// [J] Translation and rotation, mean over the computed grains; infinite without grains.
double kinetic_energy_per_grain(const particles::GrainRows& rows) {
  double sum = 0.0;
  for (std::size_t n = 0; n < rows.count; ++n) {
    const double* v = rows.velocity + 4 * n;
    const double* w = rows.rotation + 4 * n;
    const double r = rows.position[4 * n + 3];
    const double inertia = 0.4 * r * r / v[3];
    sum += 0.5 / v[3] * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) +
           0.5 * inertia * (w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
  }
  return rows.count > 0 ? sum / static_cast<double>(rows.count)
                        : std::numeric_limits<double>::infinity();
}

}  // namespace

Simulation::Simulation(const scenario::Setup& setup, Models models)
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
  for (const auto& sensor : models_.sensors) looks_at_walls_ |= sensor->looks_at_walls();
  if (looks_at_walls_) dem_->watch_walls();
  dem_steps_per_fluid_step_ =
      std::max(1, static_cast<int>(std::lround(step / dem_->coarse_step())));
  build_graphs();
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

void Simulation::build_graphs() {
  dem_graph_.given({"grain.position", "grain.velocity", "contact.list", "contact.history",
                    "grain.fluid_action", "fluid.velocity", "fluid.void_fraction", "body.motion"});
  if (coupling_) {
    dem_graph_.add(
        {"drag",
         {"grain.position", "grain.velocity", "fluid.velocity", "fluid.void_fraction"},
         {"grain.fluid_action"},
         [this] {
           if (dem_step_ % dem_steps_per_refresh_ != 0) return;
           const int held = std::min(dem_steps_per_refresh_, dem_steps_per_fluid_step_ - dem_step_);
           const double step = dem_->coarse_step();
           coupling_->refresh(dem_->rows(),
                              {fluid_->velocity(), fluid_->stress_divergence(), &fluid_->pressure(),
                               time() + dem_step_ * step, held * step});
           dem_->fluid_action_changed();
         }});
  }
  dem_graph_.add({"neighbour",
                  {"grain.position", "grain.velocity", "grain.fluid_action"},
                  {"contact.list", "contact.history", "grain.position", "grain.velocity",
                   "grain.fluid_action"},
                  [this] { dem_->neighbours(); }});
  dem_graph_.add({"contact",
                  {"grain.position", "grain.velocity", "contact.list", "body.motion"},
                  {"contact.history", "contact.force"},
                  [this] {
                    // The published forces are those of a fluid step's last grain step.
                    dem_->contact(time() + dem_step_ * dem_->coarse_step(),
                                  dem_step_ + 1 == dem_steps_per_fluid_step_);
                  }});
  dem_graph_.add({"force",
                  {"contact.force", "grain.position", "grain.velocity", "grain.fluid_action"},
                  {"grain.force"},
                  [this] { dem_->force(); }});
  dem_graph_.add({"integration",
                  {"grain.force", "grain.fluid_action", "grain.position"},
                  {"grain.position", "grain.velocity", "grain.fluid_impulse"},
                  [this] { dem_->integrate(); }});
  dem_graph_.build();

  step_graph_.given({"emitter.state", "grain.state", "fluid.velocity", "fluid.exchange"});
  bool has_removals = false;
  for (const auto& body : setup_.bodies) has_removals |= body.removal.has_value();
  if (has_removals) {
    std::vector<std::string> looks_at{"grain.state"};
    if (fluid_) looks_at.emplace_back("fluid.velocity");
    step_graph_.add({"bodies", looks_at, looks_at, [this] { remove_bodies(); }});
  }
  step_graph_.add(
      {"emit", {"emitter.state", "grain.state"}, {"emitter.state", "grain.state"}, [this] {
         emit();
       }});
  if (fluid_) add_fluid_nodes();
  step_graph_.add(
      {"dem_cycle",
       coupling_ ? std::vector<std::string>{"grain.state", "fluid.velocity", "fluid.void_fraction"}
                 : std::vector<std::string>{"grain.state"},
       {"grain.state", "grain.fluid_impulse"},
       [this] { run_dem_cycle(); }});
  if (coupling_) {
    step_graph_.add({"collect",
                     {"grain.state", "grain.fluid_impulse", "fluid.void_fraction"},
                     {"fluid.exchange"},
                     [this] { coupling_->collect(dem_->rows(), setup_.time.fluid_step); }});
  }
  if (fluid_) {
    step_graph_.add(
        {"publish_fluid", {"fluid.velocity", "fluid.void_fraction"}, {"fluid.columns"}, [this] {
           if (fluid_->has_moving_bodies()) {
             fluid_table_->set_open_fraction(fluid_->open_fraction());
           }
           fluid_table_->publish(*fluid_, void_fraction());
         }});
  }
  step_graph_.add({"publish_grains", {"grain.state"}, {"grain.columns"}, [this] {
                     publish_grains();
                     if (looks_at_walls_) dem_->close_wall_loads(setup_.time.fluid_step);
                   }});
  step_graph_.add({"health", {"grain.columns"}, {"health"}, [this] { check_health(); }});
  add_sensor_nodes();
  step_graph_.build();
}

void Simulation::add_fluid_nodes() {
  if (!coupling_) {
    step_graph_.add(
        {"fluid", {"fluid.velocity"}, {"fluid.velocity", "fluid.void_fraction"}, [this] {
           fluid_->advance(time(), setup_.time.fluid_step, no_grains_->void_fraction,
                           no_grains_->void_fraction, no_grains_->exchange);
           fluid_sub_steps_ += fluid_->report().sub_steps;
           pressure_iterations_ += fluid_->report().pressure_iterations;
         }});
    return;
  }
  step_graph_.add({"voidage",
                   {"grain.state", "fluid.exchange"},
                   {"fluid.void_fraction", "fluid.exchange"},
                   [this] {
                     if (fluid_->has_moving_bodies()) {
                       fluid_->look_ahead(time() + setup_.time.fluid_step);
                       coupling_->set_open_fraction(fluid_->open_fraction());
                     }
                     coupling_->map(dem_->rows(), setup_.time.fluid_step);
                   }});
  step_graph_.add({"fluid",
                   {"fluid.void_fraction", "fluid.exchange", "fluid.velocity", "grain.state"},
                   {"fluid.velocity", "fluid.exchange"},
                   [this] {
                     fluid_->advance(time(), setup_.time.fluid_step,
                                     coupling_->void_fraction_before(), coupling_->void_fraction(),
                                     coupling_->exchange());
                     coupling_->settle(dem_->rows(), fluid_->drag_velocity());
                     fluid_sub_steps_ += fluid_->report().sub_steps;
                     pressure_iterations_ += fluid_->report().pressure_iterations;
                   }});
}

void Simulation::add_sensor_nodes() {
  std::vector<std::string> reads{"grain.columns"};
  if (fluid_) reads.push_back("fluid.columns");
  for (std::size_t n = 0; n < models_.sensors.size(); ++n) {
    const std::string& name = setup_.sensors[n].name;
    step_graph_.add({"sensor " + name, reads, {"sensor." + name}, [this, n] {
                       sdk::WorldView view = world();
                       // The clock moves on after the graph: sensors see the end of this step.
                       view.time += setup_.time.fluid_step;
                       models_.sensors[n]->observe(view);
                     }});
  }
}

void Simulation::propose_seeds(double begin, double end) {
  for (std::size_t n = 0; n < models_.emitters.size(); ++n) propose_seeds_of(n, begin, end);
}

void Simulation::propose_seeds_of(std::size_t n, double begin, double end) {
  const auto& spec = setup_.emitters[n];
  const scenario::FrameSpec* frame =
      spec.frame >= 0 ? &setup_.frames[static_cast<std::size_t>(spec.frame)] : nullptr;
  sdk::EmitterContext context;
  context.begin = begin;
  context.end = end;
  context.grain_density =
      setup_.materials[static_cast<std::size_t>(spec.material)].properties.density;
  context.gravity = setup_.gravity;
  context.random = sdk::Random(setup_.seed, sdk::stream_of(spec.name.c_str()));
  const LazySurroundings surroundings(entry_scene_, dem_->rows(), waiting_,
                                      models_.class_diameters.back(), frame);
  context.surroundings = &surroundings;
  seeds_.clear();
  try {
    models_.emitters[n]->propose(context, seeds_);
  } catch (const std::exception& problem) {
    throw sdk::ModelError(entry_scene_.names[n] + ": " + problem.what());
  }
  for (const sdk::Seed& seed : seeds_) {
    // Carried back to the beginning of the interval; inside the feed nothing but the feed acts.
    Entrant e;
    e.emitter = static_cast<std::int32_t>(n);
    e.line = seed.line;
    particles::NewGrain& grain = e.grain;
    grain.position = seed.position - (seed.time - begin) * seed.velocity;
    grain.velocity = seed.velocity;
    grain.rotation = seed.rotation;
    if (frame != nullptr) {
      const sdk::Vec3 axis = frame->axis / norm(frame->axis);
      grain.position = turned(grain.position, *frame);
      grain.velocity = rotate(grain.velocity, axis, frame->angle);
      grain.rotation = rotate(grain.rotation, axis, frame->angle);
    }
    grain.diameter = seed.diameter;
    grain.weight = seed.weight;
    grain.material = seed.material < 0
                         ? spec.material
                         : spec.more_materials.at(static_cast<std::size_t>(seed.material));
    waiting_.push_back(e);
  }
}

void Simulation::start() {
  emit();
  is_started_ = true;
  const bool is_filled = std::any_of(entry_scene_.rules.begin(), entry_scene_.rules.end(),
                                     [](const sdk::EntryRule& rule) { return !rule.waits; });
  // A bed that is there at the start does not push its volume out of the air in the first step.
  if (coupling_ && is_filled) coupling_->map(dem_->rows(), setup_.time.fluid_step);
  publish_grains();
}

void Simulation::emit() {
  if (is_started_) {
    is_started_ = false;
    return;
  }
  entry_scene_.time = time();
  propose_seeds(time(), time() + setup_.time.fluid_step);
  dem_->remove_leavers();
  const auto entering = take_free_places(waiting_, dem_->rows(), entry_scene_);
  delayed_entries_ += static_cast<std::int64_t>(waiting_.size());
  if (!entering.empty()) {
    std::vector<particles::NewGrain> grains;
    grains.reserve(entering.size());
    for (const Entrant& e : entering) {
      grains.push_back(e.grain);
      const auto& material = setup_.materials[static_cast<std::size_t>(e.grain.material)];
      emissions_.enter(static_cast<std::size_t>(e.emitter), e.grain.diameter, e.grain.weight,
                       material.properties.density * sdk::sphere_volume(e.grain.diameter));
    }
    dem_->insert(grains);
  }
  grain_table_.note_births(dem_->rows());
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
    const double sum = c.x[n] + c.y[n] + c.z[n] + c.velocity_x[n] + c.velocity_y[n] +
                       c.velocity_z[n] + c.rotation_x[n] + c.rotation_y[n] + c.rotation_z[n];
    if (!std::isfinite(sum)) {
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

std::string Simulation::state_digest() const {
  io::Sha256 sha;
  const auto update = [&sha](const auto& span) { sha.update(span.data(), span.size_bytes()); };
  const auto c = grain_table_.columns();
  update(c.id);
  for (const auto& column : {c.x, c.y, c.z, c.velocity_x, c.velocity_y, c.velocity_z, c.rotation_x,
                             c.rotation_y, c.rotation_z}) {
    update(column);
  }
  if (fluid_) {
    for (int k = 0; k < grid_.count[2]; ++k) {
      for (int j = 0; j < grid_.count[1]; ++j) {
        const auto from = static_cast<std::size_t>(grid_.index(0, j, k));
        const auto count = static_cast<std::size_t>(grid_.count[0]);
        for (const auto& component : fluid_->velocity().component) {
          update(std::span(component).subspan(from, count));
        }
        update(std::span(fluid_->pressure()).subspan(from, count));
      }
    }
  }
  return sha.hex_digest();
}

Simulation::SaveParts Simulation::save_parts() const {
  SaveParts parts;
  parts.emplace_back("clock", [this](sdk::ArchiveWriter& a) {
    a.integer("steps_done", steps_done_);
    a.integer("fluid_sub_steps", fluid_sub_steps_);
    a.integer("pressure_iterations", pressure_iterations_);
    a.integer("delayed_entries", delayed_entries_);
    a.integer("is_started", is_started_ ? 1 : 0);
    save_waiting(waiting_, a);
    emissions_.save(a);
  });
  parts.emplace_back("bodies", [this](sdk::ArchiveWriter& a) {
    std::vector<double> removed_at;
    for (const auto& body : models_.bodies) removed_at.push_back(body.removed_at);
    a.numbers("removed_at", removed_at);
  });
  parts.emplace_back("grains", [this](sdk::ArchiveWriter& a) { dem_->save(a); });
  parts.emplace_back("columns", [this](sdk::ArchiveWriter& a) { grain_table_.save(a); });
  if (fluid_) {
    parts.emplace_back("fluid", [this](sdk::ArchiveWriter& a) { fluid_->save(a); });
  }
  if (coupling_) {
    parts.emplace_back("coupling", [this](sdk::ArchiveWriter& a) { coupling_->save(a); });
  }
  for (std::size_t n = 0; n < models_.emitters.size(); ++n) {
    parts.emplace_back("emitter." + setup_.emitters[n].name,
                       [this, n](sdk::ArchiveWriter& a) { models_.emitters[n]->save(a); });
  }
  for (std::size_t n = 0; n < models_.sensors.size(); ++n) {
    parts.emplace_back("sensor." + setup_.sensors[n].name,
                       [this, n](sdk::ArchiveWriter& a) { models_.sensors[n]->save(a); });
  }
  return parts;
}

Simulation::LoadParts Simulation::load_parts() {
  LoadParts parts;
  parts.emplace_back("clock", [this](sdk::ArchiveReader& a) {
    steps_done_ = a.integer("steps_done");
    fluid_sub_steps_ = a.integer("fluid_sub_steps");
    pressure_iterations_ = a.integer("pressure_iterations");
    delayed_entries_ = a.integer("delayed_entries");
    is_started_ = a.integer("is_started") != 0;
    load_waiting(waiting_, a);
    emissions_.load(a);
  });
  parts.emplace_back("bodies", [this](sdk::ArchiveReader& a) {
    const auto removed_at = a.numbers("removed_at");
    for (std::size_t b = 0; b < models_.bodies.size(); ++b) {
      models_.bodies[b].removed_at = removed_at.at(b);
    }
  });
  parts.emplace_back("grains", [this](sdk::ArchiveReader& a) { dem_->load(a); });
  if (fluid_) {
    parts.emplace_back("fluid", [this](sdk::ArchiveReader& a) {
      fluid_->load(a, time());
      take_open_fraction();
      if (!coupling_) fluid_table_->publish(*fluid_, void_fraction());
    });
  }
  if (coupling_) {
    parts.emplace_back("coupling", [this](sdk::ArchiveReader& a) {
      coupling_->load(a);
      fluid_table_->publish(*fluid_, void_fraction());
    });
  }
  // Last, so that the places of the last sample are those saved, not those just published.
  parts.emplace_back("columns", [this](sdk::ArchiveReader& a) {
    publish_grains();
    grain_table_.load(a);
  });
  for (std::size_t n = 0; n < models_.emitters.size(); ++n) {
    parts.emplace_back("emitter." + setup_.emitters[n].name,
                       [this, n](sdk::ArchiveReader& a) { models_.emitters[n]->load(a); });
  }
  for (std::size_t n = 0; n < models_.sensors.size(); ++n) {
    parts.emplace_back("sensor." + setup_.sensors[n].name,
                       [this, n](sdk::ArchiveReader& a) { models_.sensors[n]->load(a); });
  }
  return parts;
}

}  // namespace dust::run
