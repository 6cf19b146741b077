// SPDX-License-Identifier: Apache-2.0
#include "run/branch/branch.hpp"

#include "base/named.hpp"
#include "base/text.hpp"
#include "preflight/particle_models.hpp"
#include "run/branch/air_transfer.hpp"
#include "run/branch/past.hpp"
#include "run/summary/plant_begin.hpp"
#include "scenario/text/suggest.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace dust::run {
namespace {

bool is_at(const auto& a, const auto& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

}  // namespace

Branch::Branch(const scenario::ReadResult& now, const std::vector<io::InputFile>& inputs,
               const registry::Registry& registry, scenario::Diagnostics& diagnostics)
    : both_(now, inputs, registry),
      now_(now),
      registry_(registry),
      diagnostics_(diagnostics),
      is_same_world_(both_.is_same_world()) {
  check_time();
  check_domain();
  report_models();
}

void Branch::report_models() {
  for (const ChangedModel& change : both_.changes_of_models()) warn(change.text());
  for (const ChangedModel& model : rebuilt_models(origin().state(), used_models(now_, registry_))) {
    if (!both_.is_changed(model.now.kind, model.now.name)) warn(model.rebuilt_text());
  }
}

void Branch::check_time() {
  const double time = origin().time();
  const double step = now_.setup.time.fluid_step;
  const double steps = time / step;
  if (std::abs(steps - std::round(steps)) > 1e-6) {
    error("its time, " + seconds(time) + ", is no multiple of time.fluid_step, " + seconds(step) +
          ": give a step that divides it, or start from another time");
  }
  if (now_.setup.time.end <= time * (1.0 + 1e-9)) {
    diagnostics_.error(now_.start.end_where,
                       "time.end: " + seconds(now_.setup.time.end) +
                           " is not after the time that the run starts from, " + seconds(time) +
                           ": time goes on from there");
  }
}

void Branch::check_domain() {
  const auto& here = now_.setup.domain;
  const auto& there = origin().scenario().setup.domain;
  if (is_at(here.min, there.min) && is_at(here.max, there.max)) return;
  error("its domain reaches from " + base::place_text(there.min) + " to " +
        base::place_text(there.max) + ", this one from " + base::place_text(here.min) + " to " +
        base::place_text(here.max) + ": what comes along keeps its place; give the same domain");
}

Models& Branch::their_models() {
  if (their_models_) return *their_models_;
  their_models_.emplace(make_models(origin().scenario().setup, registry_));
  Models& models = *their_models_;
  if (!origin().class_diameters().empty())
    preflight::set_class_diameters(models, origin().class_diameters());
  origin().state().read({{"bodies", [&](sdk::ArchiveReader& a) {
                            const auto removed_at = a.numbers("removed_at");
                            for (std::size_t b = 0; b < models.bodies.size(); ++b) {
                              models.bodies[b].removed_at = removed_at.at(b);
                            }
                          }}});
  return models;
}

/// Emitters that the other run did not have, whose grains would all have come before.
void Branch::check_emitters(const Models& models) {
  for (std::size_t n = 0; n < models.emitters.size(); ++n) {
    const scenario::EmitterSpec& spec = now_.setup.emitters[n];
    if (base::find_named(origin().scenario().setup.emitters, spec.name) != nullptr) continue;
    const sdk::EmitterRequest request = models.emitters[n]->request();
    const bool is_stream = request.mass_flow > 0.0;
    if (!is_stream && !(request.mass > 0.0) && request.count == 0) continue;
    const double last = is_stream ? request.end : request.begin;
    if (last >= origin().time() * (1.0 - 1e-9)) continue;
    diagnostics_.error(spec.model.where, spec.model.path + ": its grains come " +
                                             (is_stream ? "until " : "at ") + seconds(last) +
                                             ", before this run begins at " +
                                             seconds(origin().time()) + ": give it a later " +
                                             (is_stream ? "'end'" : "'time'"));
  }
}

void Branch::check(Models& models, particles::Dem& particles) {
  if (both_.is_same() || diagnostics_.has_errors()) return;
  check_emitters(models);
  transfer_bodies(models);
  report_obstacles(particles.obstacles_to(their_particles(), origin().time()));
  is_same_world_ = is_same_world_ && models.class_diameters == origin().class_diameters();
  report_what_air_drops(both_, is_same_world_, [this](const std::string& text) { warn(text); });
  report_grains_anew();
  report_sensors_anew(models);
}

void Branch::give_to(Simulation& simulation) {
  if (!both_.is_same()) {
    simulation.start_from([this](const Simulation::Owners& to) {
      check(to.models, to.particles);
      diagnostics_.throw_errors();
      transfer(to);
    });
    note_counts(simulation);
    simulation.begin_sensors(sensors_going_on_);
    simulation.begin_dust_figures();
    return;
  }
  origin().state().read(simulation.load_parts());
  note_counts(simulation);
  simulation.begin_dust_figures();
  report_.particles = simulation.dem().balance().in_domain;
  report_.contacts = simulation.dem().report().contacts;
  for (const auto& sensor : now_.setup.sensors) sensors_going_on_.push_back(sensor.name);
}

void Branch::transfer(const Simulation::Owners& to) {
  const double steps = origin().time() / now_.setup.time.fluid_step;
  to.clock.start_at(std::llround(steps));
  transfer_particles(to);
  transfer_insertion(to);
  const Warn warn_of = [this](const std::string& text) { warn(text); };
  if (to.fluid != nullptr) transfer_fluid(both_, to, is_same_world_);
  if (to.dust != nullptr) transfer_dust(both_, to, is_same_world_, warn_of);
  if (to.liberation != nullptr) transfer_liberation(to);
  transfer_sensors(to.models);
  // Last, so that the places of the last sample are those saved, not those just published.
  origin().state().read({{"columns", [&](sdk::ArchiveReader& a) {
                            to.snapshots.take(to.particles, to.clock.end_of_last_step());
                            to.snapshots.load(a);
                          }}});
}

void Branch::transfer_sensors(Models& models) {
  for (std::size_t n = 0; n < models.sensors.size(); ++n) {
    const std::string& name = now_.setup.sensors[n].name;
    if (!both_.keeps_statistics(name, models.class_diameters)) continue;
    sdk::Sensor& sensor = *models.sensors[n];
    origin().state().read({{"sensor." + name, [&](sdk::ArchiveReader& a) { sensor.load(a); }}});
    sensors_going_on_.push_back(name);
  }
}

void Branch::report_sensors_anew(const Models& models) {
  std::vector<std::string> anew;
  for (const scenario::SensorSpec& sensor : now_.setup.sensors) {
    if (base::find_named(origin().scenario().setup.sensors, sensor.name) == nullptr) continue;
    if (!both_.keeps_statistics(sensor.name, models.class_diameters)) anew.push_back(sensor.name);
  }
  if (anew.empty()) return;
  warn("these sensors begin anew, for something is set otherwise than in that run: " +
       scenario::listed(anew) + "; a steady_after leaves out the time in which the change settles");
}

void Branch::note_counts(const Simulation& simulation) {
  const Past past = load_past(origin().state());
  const CountsBefore then = past.start ? past.start->before : CountsBefore{};
  note_changed_emitters(then, simulation.insertion());
  const bool is_same_plant =
      both_.is_same() || both_.is_same_plant(simulation.models().class_diameters);
  before_.plant = is_same_plant ? then.plant : plant_begin_now(simulation);
}

void Branch::note_changed_emitters(const CountsBefore& then, const Insertion& insertion) {
  auto& changed = before_.changed_emitters;
  std::vector<std::string> names = then.new_emitters;
  for (const auto& emitter : then.changed_emitters) names.push_back(emitter.name);
  for (const std::string& name : names) {
    if (base::find_named(changed, name) == nullptr) changed.push_back({.name = name});
  }
  std::erase_if(changed, [&](const CountsBefore::ChangedEmitter& emitter) {
    return base::find_named(now_.setup.emitters, emitter.name) == nullptr;
  });
  for (CountsBefore::ChangedEmitter& emitter : changed) {
    const auto n = static_cast<std::size_t>(base::number_of(now_.setup.emitters, emitter.name));
    emitter.mass = insertion.ledger().totals_of(n).mass + insertion.waiting_mass(n);
  }
}

}  // namespace dust::run
