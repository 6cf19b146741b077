// SPDX-License-Identifier: Apache-2.0
#include "run/simulation.hpp"

#include "base/text.hpp"
#include "run/body_removal.hpp"
#include "run/dust/hoods.hpp"
#include "run/run_checks.hpp"
#include "run/state_digest.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dust::run {
namespace {

Snapshots::Wanted wanted_by_sensors(const Models& models) {
  Snapshots::Wanted wanted;
  for (const auto& sensor : models.sensors) {
    wanted.contacts |= sensor->wants_contacts();
    wanted.face_fluxes |= sensor->wants_face_fluxes();
  }
  return wanted;
}

particles::DemOptions dem_options(const scenario::Setup& setup, const Models& models,
                                  const scenario::DustSetup& dust) {
  particles::DemOptions options{
      .dust_shares = dust.shares_on_grains(),
      .release_speed = models.release_speed,
      .catches_dust = dust.field && dust.field->scavenging,
      .keeps_wind = dust.field && models.liberation && models.liberation->needs_wind(),
      .openings = openings_of(setup, dust)};
  // Buoyancy is part of the weight, unless a model gives it.
  if (setup.fluid && !coupling::takes_over_buoyancy(models.fluid_forces)) {
    options.fluid_density = setup.fluid->density;
  }
  for (const auto& sensor : models.sensors) {
    options.records_wall_sliding |= sensor->wants_sliding();
    options.records_wall_loads |= sensor->wants_walls() || sensor->wants_sliding();
  }
  return options;
}

}  // namespace

std::unique_ptr<particles::Dem> make_particles(const scenario::Setup& setup, Models& models,
                                               const scenario::DustSetup& dust) {
  particles::DemOptions options = dem_options(setup, models, dust);
  if (!models.class_diameters.empty()) {
    return std::make_unique<particles::Dem>(setup, models.bodies, std::move(models.laws),
                                            models.class_diameters, std::move(options));
  }
  // Nothing asks how large particles are that never come, and nothing shortens the step.
  constexpr double k_any_diameter = 1e-3;
  scenario::Setup empty = setup;
  empty.time.dem_step = empty.time.fluid_step;
  options.catches_dust = false;
  return std::make_unique<particles::Dem>(empty, models.bodies, std::move(models.laws),
                                          std::vector<double>{k_any_diameter}, std::move(options));
}

Simulation::Simulation(const scenario::Setup& setup, Models models, int check_every,
                       scenario::DustSetup dust)
    : setup_(setup),
      dust_setup_(std::move(dust)),
      models_(std::move(models)),
      clock_(setup_.time.fluid_step, setup_.time.end),
      snapshots_(setup_.domain, wanted_by_sensors(models_)) {
  if (setup_.fluid) {
    fluid_ = std::make_unique<FluidStage>(setup_, models_);
    snapshots_.use_fluid(fluid_->grid(), *setup_.fluid, fluid_->solver().open_fraction());
  }
  dem_ = make_particles(setup_, models_, dust_setup_);
  if (dust_setup_.field) {
    dust_ = std::make_unique<DustStage>(setup_, *dust_setup_.field, models_, *fluid_,
                                        openings_of(setup_, dust_setup_));
  }
  if (dust_ && models_.liberation) {
    liberation_ = std::make_unique<LiberationStage>(setup_, dust_setup_,
                                                    std::move(models_.liberation), *dust_, *dem_);
  }
  if (dust_) {
    const double given = steady_after_given();
    dust_figures_ =
        std::make_unique<DustFigures>(*this, given > 0.0 ? given : 0.5 * setup_.time.end);
  }
  cycle_.emplace(clock_.fluid_step(), dem_->coarse_step());
  insertion_ = std::make_unique<Insertion>(setup_, models_);
  build_dem_graph(check_every);
  build_step_graph(check_every > 0);
  snapshots_.take(*dem_, clock_.end_of_last_step());
  take_fluid_snapshot(FaceTable::Moment::before_step);
}

Simulation::~Simulation() = default;

const fluid::FluidSolver* Simulation::fluid() const { return fluid_ ? &fluid_->solver() : nullptr; }
const coupling::Coupling* Simulation::coupling() const {
  return fluid_ ? fluid_->coupling() : nullptr;
}

void Simulation::start() {
  insertion_->start(*dem_);
  snapshots_.note_insertions(dem_->rows());
  // Particles that are there at the start do not push their volume out of the air in the first
  // step, and the first frame shows the air between them.
  if (coupling() != nullptr && dem_->rows().count > 0) {
    fluid_->start(dem_->rows());
    take_fluid_snapshot(FaceTable::Moment::before_step);
  }
  snapshots_.take(*dem_, clock_.end_of_last_step());
  if (dust_) dust_->start();
}

double Simulation::steady_after_given() const {
  return dust_setup_.given ? dust_setup_.given->steady_after : 0.0;
}

void Simulation::begin_sensors(std::span<const std::string> going_on) {
  sdk::WorldView view = world();
  view.interval = 0.0;  // nothing has been looked at
  for (std::size_t n = 0; n < models_.sensors.size(); ++n) {
    const std::string& name = setup_.sensors[n].name;
    if (std::find(going_on.begin(), going_on.end(), name) != going_on.end()) continue;
    models_.sensors[n]->begin(view);
  }
}

void Simulation::begin_dust_figures_at(double time) {
  dust_figures_->rates.begin_at(time);
  dust_figures_->indices.begin_at(time);
}

void Simulation::begin_dust_figures() {
  if (!dust_figures_ || steady_after_given() > 0.0) return;
  const double begin = time();
  begin_dust_figures_at(begin + 0.5 * (setup_.time.end - begin));
}

std::string Simulation::go_on_with_dust_figures(double begin) {
  if (!dust_figures_ || steady_after_given() > 0.0) return {};
  const double step = clock_.fluid_step();
  const SteadyWindow before = dust_figures_->rates.steady();
  const double middle = begin + 0.5 * (setup_.time.end - begin);
  if (std::abs(middle - before.begin()) < SteadyWindow::k_rounding * step) return {};
  // Means that had not begun know no amounts to take the first rate from.
  const bool had_begun = before.holds(time(), step);
  const double earliest = had_begun ? time() : time() + step;
  const bool is_in_time = SteadyWindow(earliest).holds(middle, step);
  if (is_in_time || !had_begun) begin_dust_figures_at(std::max(middle, earliest));
  if (is_in_time) return {};
  const auto seconds = [](double value) { return base::digits_text(value, 10) + " s"; };
  return "dust_rates and stream_indices are means from " +
         seconds(dust_figures_->rates.steady().begin()) + " on, not from the middle of the run, " +
         seconds(middle) + ", which had passed when it was given its end of " +
         seconds(setup_.time.end) +
         ": in a run that is to be extended, dust.steady_after says when they begin";
}

void Simulation::start_from(const std::function<void(const Owners&)>& give) {
  give({models_, clock_, *dem_, *insertion_, snapshots_, fluid_.get(), dust_.get(),
        liberation_.get()});
  if (fluid_) snapshots_.set_open_fraction(fluid_->solver().open_fraction());
  take_fluid_snapshot(FaceTable::Moment::before_step);
  if (dust_) dust_->take_columns();
}

void Simulation::step() {
  step_graph_.run();
  clock_.advance();
}

void Simulation::sample_forces(ForceShares& shares) {
  ForceShares::Surroundings in{.gravity = setup_.gravity};
  if (setup_.fluid && !coupling::takes_over_buoyancy(models_.fluid_forces)) {
    in.fluid_density = setup_.fluid->density;
  }
  // Set III has the pressure in its drag.
  if (coupling() != nullptr &&
      fluid::momentum_set_of(setup_.fluid->momentum_set) != fluid::MomentumSet::three) {
    in.fluid = world().fluid;
  }
  shares.sample(dem_->rows(), dem_->contacts(clock_.end_of_last_step()), in);
}

void Simulation::insert() {
  if (insertion_->run(time(), *dem_)) snapshots_.note_insertions(dem_->rows());
}

void Simulation::remove_bodies() {
  if (!run::remove_bodies(setup_, time(), dem_->rows(), models_.bodies)) return;
  dem_->bodies_changed();
  if (!fluid_) return;
  fluid_->bodies_changed(time());
  snapshots_.set_open_fraction(fluid_->solver().open_fraction());
  if (dust_) dust_->bodies_changed();
}

bool Simulation::has_changing_walls() const {
  return bodies::do_surfaces_change(setup_, models_.bodies);
}

void Simulation::advance_fluid() { fluid_->advance(time(), dust_ ? dust_->weigh() : nullptr); }

void Simulation::run_dem_cycle() {
  if (models_.class_diameters.empty()) return;
  if (fluid_ && fluid_->resolved() != nullptr) act_on_resolved();
  if (coupling() != nullptr) {
    cycle_->begin(coupling()->refresh_interval());
  } else {
    cycle_->begin();
  }
  for (; !cycle_->is_done(); cycle_->advance()) dem_graph_.run();
  dem_->synchronise();
}

void Simulation::act_on_resolved() {
  fluid_->act(dem_->rows(), [this](std::size_t row, sdk::Vec3 change) { dem_->turn(row, change); });
  dem_->drag_relaxation_changed();
}

void Simulation::refresh_drag() {
  if (!cycle_->is_refresh_due()) return;
  fluid_->refresh(dem_->rows(), time() + cycle_->time(), cycle_->refresh_held());
  dem_->drag_relaxation_changed();
}

void Simulation::take_fluid_snapshot(FaceTable::Moment moment) {
  if (fluid_) snapshots_.take(fluid_->solver(), fluid_->void_fraction(), moment);
}

sdk::WorldView Simulation::world() const {
  sdk::WorldView view;
  view.time = time();
  view.interval = setup_.time.fluid_step;
  view.domain_min = setup_.domain.min;
  view.domain_max = setup_.domain.max;
  view.gravity = setup_.gravity;
  snapshots_.show(view);
  view.walls = dem_->wall_loads();
  view.class_diameters = models_.class_diameters;
  view.emitted_mass = dem_->balance().mass_emitted;
  return view;
}

const std::vector<float>& Simulation::momentum_exchange() {
  static const std::vector<float> none;
  return fluid_ ? fluid_->momentum_exchange() : none;
}

std::string Simulation::state_digest() const {
  return run::state_digest(snapshots_.particles(), fluid(),
                           fluid_ ? fluid_->grid() : fluid::Grid{});
}

SaveParts Simulation::save_parts() {
  SaveParts parts;
  parts.emplace_back("clock", [this](sdk::ArchiveWriter& a) {
    clock_.save(a);
    a.integer("fluid_sub_steps", fluid_ ? fluid_->sub_steps() : 0);
    a.integer("pressure_iterations", fluid_ ? fluid_->pressure_iterations() : 0);
    insertion_->save(a);
    a.numbers("class_diameters", models_.class_diameters);
  });
  parts.emplace_back("bodies", [this](sdk::ArchiveWriter& a) {
    std::vector<double> removed_at;
    for (const auto& body : models_.bodies) removed_at.push_back(body.removed_at);
    a.numbers("removed_at", removed_at);
  });
  parts.emplace_back("grains", [this](sdk::ArchiveWriter& a) { dem_->save(a); });
  parts.emplace_back("columns", [this](sdk::ArchiveWriter& a) { snapshots_.save(a); });
  if (fluid_) fluid_->add_parts(parts);
  if (dust_) dust_->add_parts(parts);
  if (liberation_) std::as_const(*liberation_).add_parts(parts);
  if (dust_figures_) {
    dust_rates()->add_parts(parts);
    stream_indices()->add_parts(parts);
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

void Simulation::load_clock(sdk::ArchiveReader& a) {
  clock_.load(a);
  const std::int64_t sub_steps = a.integer("fluid_sub_steps");
  const std::int64_t iterations = a.integer("pressure_iterations");
  if (fluid_) fluid_->set_counts(sub_steps, iterations);
  insertion_->load(a);
}

LoadParts Simulation::load_parts() {
  LoadParts parts;
  parts.emplace_back("clock", [this](sdk::ArchiveReader& a) { load_clock(a); });
  parts.emplace_back("bodies", [this](sdk::ArchiveReader& a) {
    const auto removed_at = a.numbers("removed_at");
    for (std::size_t b = 0; b < models_.bodies.size(); ++b) {
      models_.bodies[b].removed_at = removed_at.at(b);
    }
  });
  parts.emplace_back("grains", [this](sdk::ArchiveReader& a) { dem_->load(a); });
  if (fluid_) {
    fluid_->add_parts(
        parts, [this] { return clock_.end_of_last_step(); },
        [this] {
          snapshots_.set_open_fraction(fluid_->solver().open_fraction());
          take_fluid_snapshot(FaceTable::Moment::before_step);
        });
  }
  if (dust_) dust_->add_parts(parts);
  if (liberation_) liberation_->add_parts(parts);
  if (dust_figures_) {
    dust_figures_->rates.add_parts(parts);
    dust_figures_->indices.add_parts(parts);
  }
  // Last, so that the places of the last sample are those saved, not those just published.
  parts.emplace_back("columns", [this](sdk::ArchiveReader& a) {
    snapshots_.take(*dem_, clock_.end_of_last_step());
    snapshots_.load(a);
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
