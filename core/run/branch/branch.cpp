// SPDX-License-Identifier: Apache-2.0
#include "run/branch/branch.hpp"

#include "base/error.hpp"
#include "base/named.hpp"
#include "base/text.hpp"
#include "run/branch/dust_places.hpp"
#include "run/branch/past.hpp"
#include "run/dust/hoods.hpp"
#include "run/insertion/entry.hpp"
#include "run/summary/summary_dust.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <utility>

namespace dust::run {
namespace {

/// Settings that what is there does not depend on; the last two are what lets things in and what
/// looks at them, and whole states do depend on those.
constexpr std::array<std::string_view, 10> k_outside_world = {"start_from",
                                                              "name",
                                                              "time.end",
                                                              "time.output_every",
                                                              "time.checkpoint_every",
                                                              "references",
                                                              "time.keep_every",
                                                              "reference_curves",
                                                              "sensors",
                                                              "emitters"};
constexpr std::span k_free = std::span(k_outside_world).first<8>();

/// More than any contact keeps.
constexpr std::size_t k_max_numbers = 64;

std::string grains_text(std::int64_t count) {
  return count == 1 ? "1 grain" : std::to_string(count) + " grains";
}

bool is_at(const auto& a, const auto& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

std::pair<std::string, std::string> ordered(const std::string& a, const std::string& b) {
  return {std::min(a, b), std::max(a, b)};
}

std::pair<std::string, std::string> pair_names(const scenario::Setup& setup,
                                               const scenario::InteractionSpec& pair) {
  return ordered(setup.materials[static_cast<std::size_t>(pair.material_i)].name,
                 setup.materials[static_cast<std::size_t>(pair.material_j)].name);
}

bool is_same_model(const std::optional<scenario::ModelChoice>& a,
                   const std::optional<scenario::ModelChoice>& b) {
  return a.has_value() == b.has_value() && (!a || a->name == b->name);
}

/// Reads a part as if its numbers had another name or length.
class Changed final : public sdk::ArchiveReader {
 public:
  template <class Value>
  using Change = std::function<void(std::string_view name, std::vector<Value>& values)>;
  Changed(sdk::ArchiveReader& from, Change<double> change, Change<std::int64_t> integers = {})
      : from_(from), change_(std::move(change)), change_integers_(std::move(integers)) {}
  std::vector<double> numbers(std::string_view name) override {
    auto values = from_.numbers(name);
    change_(name, values);
    return values;
  }
  std::vector<std::int64_t> integers(std::string_view name) override {
    auto values = from_.integers(name);
    if (change_integers_) change_integers_(name, values);
    return values;
  }

 private:
  sdk::ArchiveReader& from_;
  Change<double> change_;
  Change<std::int64_t> change_integers_;
};

}  // namespace

Branch::Branch(const scenario::ReadResult& now, const std::vector<io::InputFile>& inputs,
               const registry::Registry& registry, scenario::Diagnostics& diagnostics)
    : now_(now),
      registry_(registry),
      diagnostics_(diagnostics),
      origin_(*now.start.from, registry),
      leaves_(now.resolved_yaml, inputs),
      changed_models_(changed_models(origin_.state(), used_models(now, registry))),
      is_same_(changed_models_.empty() &&
               origin_.leaves().first_difference(leaves_, k_free).empty()),
      is_same_world_(changed_models_.empty() &&
                     origin_.leaves().first_difference(leaves_, k_outside_world).empty()) {
  check_time();
  check_domain();
  report_models();
}

void Branch::report_models() {
  for (const ChangedModel& change : changed_models_) warn(change.text());
  for (const ChangedModel& model : rebuilt_models(origin_.state(), used_models(now_, registry_))) {
    if (!is_changed(model.now.kind, model.now.name)) warn(model.rebuilt_text());
  }
}

bool Branch::is_changed(std::string_view kind, std::string_view name) const {
  return std::any_of(changed_models_.begin(), changed_models_.end(), [&](const ChangedModel& c) {
    return c.now.kind == kind && c.now.name == name;
  });
}

bool Branch::has_other_histories() const {
  return std::any_of(changed_models_.begin(), changed_models_.end(),
                     [](const ChangedModel& c) { return c.keeps_other_numbers(); });
}

bool Branch::same(std::string_view path, std::span<const std::string_view> ignored) const {
  return leaves_.is_same_below(std::string(path), origin_.leaves(), ignored);
}

void Branch::check_time() {
  const double time = origin_.time();
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
  const auto& there = origin_.scenario().setup.domain;
  if (is_at(here.min, there.min) && is_at(here.max, there.max)) return;
  error("its domain reaches from " + base::place_text(there.min) + " to " +
        base::place_text(there.max) + ", this one from " + base::place_text(here.min) + " to " +
        base::place_text(here.max) + ": what comes along keeps its place; give the same domain");
}

std::int64_t Branch::particles_there() const {
  std::int64_t count = 0;
  origin_.state().read({{"grains", [&](sdk::ArchiveReader& a) {
                           count = static_cast<std::int64_t>(a.integers("id").size());
                         }}});
  return count;
}

void Branch::add_diameters(std::vector<double>& diameters) const {
  std::vector<double> more = origin_.class_diameters();
  if (!is_same_) {
    // Sizes that none is left of shall not shorten the step.
    more.clear();
    origin_.state().read({{"grains",
                           [&](sdk::ArchiveReader& a) {
                             const auto rows = a.numbers("position");
                             for (std::size_t n = 3; n < rows.size(); n += 4) {
                               more.push_back(2.0 * rows[n]);
                             }
                           }},
                          {"clock", [&](sdk::ArchiveReader& a) {
                             std::vector<InsertionCandidate> waiting;
                             load_waiting(waiting, a);
                             for (const InsertionCandidate& e : waiting)
                               more.push_back(e.grain.diameter);
                           }}});
  }
  diameters.insert(diameters.end(), more.begin(), more.end());
  std::sort(diameters.begin(), diameters.end());
  diameters.erase(std::unique(diameters.begin(), diameters.end()), diameters.end());
}

Models& Branch::their_models() {
  if (their_models_) return *their_models_;
  their_models_.emplace(make_models(origin_.scenario().setup, registry_));
  Models& models = *their_models_;
  if (!origin_.class_diameters().empty()) models.class_diameters = origin_.class_diameters();
  origin_.state().read({{"bodies", [&](sdk::ArchiveReader& a) {
                           const auto removed_at = a.numbers("removed_at");
                           for (std::size_t b = 0; b < models.bodies.size(); ++b) {
                             models.bodies[b].removed_at = removed_at.at(b);
                           }
                         }}});
  return models;
}

/// The other run's particles, as it had them.
particles::Dem& Branch::their_particles() {
  if (their_particles_) return *their_particles_;
  const scenario::Setup& setup = origin_.scenario().setup;
  their_particles_ = make_particles(setup, their_models(), origin_.scenario().dust);
  their_particles_->draw_out_at(openings_of(setup, origin_.scenario().dust));
  std::size_t contacts = 0;
  const auto count = [&](std::string_view name, std::vector<std::int64_t>& values) {
    if (name.ends_with("_a")) contacts = values.size();
  };
  // Histories of other lengths are not read: their contacts begin anew.
  const auto drop_histories = [&](std::string_view name, std::vector<double>& values) {
    if (name.ends_with("_history")) values.assign(contacts * k_max_numbers, 0.0);
  };
  const bool is_other = has_other_histories();
  origin_.state().read({{"grains", [&](sdk::ArchiveReader& a) {
                           Changed changed(a, drop_histories, count);
                           their_particles_->load(is_other ? changed : a);
                         }}});
  return *their_particles_;
}

/// Emitters that the other run did not have, whose grains would all have come before.
void Branch::check_emitters(const Models& models) {
  for (std::size_t n = 0; n < models.emitters.size(); ++n) {
    const scenario::EmitterSpec& spec = now_.setup.emitters[n];
    if (base::find_named(origin_.scenario().setup.emitters, spec.name) != nullptr) continue;
    const sdk::EmitterRequest request = models.emitters[n]->request();
    const bool is_stream = request.mass_flow > 0.0;
    if (!is_stream && !(request.mass > 0.0) && request.count == 0) continue;
    const double last = is_stream ? request.end : request.begin;
    if (last >= origin_.time() * (1.0 - 1e-9)) continue;
    diagnostics_.error(spec.model.where, spec.model.path + ": its grains come " +
                                             (is_stream ? "until " : "at ") + seconds(last) +
                                             ", before this run begins at " +
                                             seconds(origin_.time()) + ": give it a later " +
                                             (is_stream ? "'end'" : "'time'"));
  }
}

void Branch::check(Models& models, particles::Dem& particles) {
  if (is_same_ || diagnostics_.has_errors()) return;
  check_emitters(models);
  transfer_bodies(models);
  report_obstacles(particles.obstacles_to(their_particles(), origin_.time()));
}

void Branch::report_obstacles(const particles::TransferObstacles& found) {
  for (const std::string& material : found.missing_materials) {
    error("there are grains of the material '" + material +
          "', which this scenario does not have: declare it under materials, with its "
          "interactions");
  }
  for (const auto& blocked : found.blocked) {
    const auto* body = base::find_named(now_.setup.bodies, blocked.surface);
    if (blocked.is_hood && now_.dust.rule().is_dust(blocked.largest_diameter)) {
      diagnostics_.warning(body->where, "bodies." + blocked.surface + ": " +
                                            grains_text(blocked.count) +
                                            " of dust lie in it and count as drawn out by it");
      continue;
    }
    const std::string what = grains_text(blocked.count) + " of the run in " +
                             start().folder.string() + " lie in it, the first, number " +
                             std::to_string(blocked.first_id) + ", at " +
                             base::place_text(blocked.first_place) +
                             ": move it, or start from a time at which its place is free";
    if (body != nullptr) {
      diagnostics_.error(body->where, "bodies." + blocked.surface + ": " + what);
    } else {
      error("domain.boundaries." + blocked.surface + ": " + what);
    }
  }
  if (found.outside > 0) {
    error(grains_text(found.outside) + " would be beyond the walls, the first at " +
          base::place_text(found.first_outside) + ": give the sides that the run had");
  }
  if (found.missing_materials.empty()) check_pairs(found.materials);
}

/// What comes along may meet all that is here.
void Branch::check_pairs(const std::vector<std::string>& materials) {
  const scenario::Setup& setup = now_.setup;
  std::vector<std::string> others = materials;
  const auto add = [&](int material) {
    if (material < 0) return;
    const std::string& name = setup.materials[static_cast<std::size_t>(material)].name;
    if (std::find(others.begin(), others.end(), name) == others.end()) others.push_back(name);
  };
  for (const auto& emitter : setup.emitters) add(emitter.material);
  for (const auto& body : setup.bodies) add(body.material);
  for (const auto& side : setup.domain.sides) {
    if (side.grains == scenario::GrainSide::wall) add(side.material);
  }
  for (std::size_t a = 0; a < materials.size(); ++a) {
    // Each pair of materials that come along once.
    for (std::size_t b = a; b < others.size(); ++b) {
      const auto is_pair = [&](const scenario::InteractionSpec& spec) {
        return pair_names(setup, spec) == ordered(materials[a], others[b]);
      };
      if (std::any_of(setup.interactions.begin(), setup.interactions.end(), is_pair)) continue;
      error("grains of " + materials[a] + " come along and may meet " + others[b] +
            ": declare the pair under interactions");
    }
  }
}

/// Laws of the same materials; each number of a history means the same to the same model.
std::vector<particles::LawTransfer> Branch::laws() const {
  const scenario::Setup& here = now_.setup;
  const scenario::Setup& there = origin_.scenario().setup;
  const bool are_kept = !has_other_histories();
  const auto keeps = [&](const std::optional<scenario::ModelChoice>& ours,
                         const std::optional<scenario::ModelChoice>& theirs) {
    return are_kept && is_same_model(ours, theirs) && !(ours && is_changed(ours->kind, ours->name));
  };
  std::vector<particles::LawTransfer> laws;
  for (const scenario::InteractionSpec& theirs : there.interactions) {
    particles::LawTransfer law;
    for (std::size_t n = 0; n < here.interactions.size(); ++n) {
      const scenario::InteractionSpec& ours = here.interactions[n];
      if (pair_names(here, ours) != pair_names(there, theirs)) continue;
      law = {.law = static_cast<int>(n),
             .keeps_contact = keeps(ours.contact, theirs.contact),
             .keeps_rolling = keeps(ours.rolling, theirs.rolling),
             .keeps_cohesion = keeps(ours.cohesion, theirs.cohesion)};
    }
    laws.push_back(law);
  }
  return laws;
}

void Branch::give_to(Simulation& simulation) {
  if (!is_same_) {
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
  origin_.state().read(simulation.load_parts());
  note_counts(simulation);
  simulation.begin_dust_figures();
  report_.particles = simulation.dem().balance().in_domain;
  report_.contacts = simulation.dem().report().contacts;
  for (const auto& sensor : now_.setup.sensors) sensors_going_on_.push_back(sensor.name);
}

void Branch::transfer(const Simulation::Owners& to) {
  is_same_world_ = is_same_world_ && to.models.class_diameters == origin_.class_diameters();
  const double steps = origin_.time() / now_.setup.time.fluid_step;
  to.clock.start_at(std::llround(steps));
  transfer_particles(to);
  transfer_insertion(to);
  if (to.fluid != nullptr) transfer_fluid(to);
  if (to.dust != nullptr) transfer_dust(to);
  if (to.liberation != nullptr) transfer_liberation(to);
  transfer_sensors(to.models);
  // Last, so that the places of the last sample are those saved, not those just published.
  origin_.state().read({{"columns", [&](sdk::ArchiveReader& a) {
                           to.snapshots.take(to.particles, to.clock.end_of_last_step());
                           to.snapshots.load(a);
                         }}});
}

/// Bodies that were taken away stay away.
void Branch::transfer_bodies(Models& models) {
  for (bodies::Body& body : models.bodies) {
    const auto* theirs = base::find_named(their_models().bodies, body.name);
    if (theirs != nullptr) body.removed_at = theirs->removed_at;
  }
}

void Branch::transfer_particles(const Simulation::Owners& to) {
  if (is_same_world_) {
    origin_.state().read({{"grains", [&](sdk::ArchiveReader& a) { to.particles.load(a); }}});
    report_.particles = to.particles.balance().in_domain;
    report_.contacts = to.particles.report().contacts;
    return;
  }
  const auto transfers = laws();
  report_ = to.particles.transfer_from(their_particles(), origin_.time(), transfers, keeps_loads());
  if (report_.without_past == 0) return;
  warn(std::to_string(report_.without_past) + " of " + std::to_string(report_.contacts) +
       " contacts begin anew, without the springs of before: their laws keep other numbers");
}

/// What an emitter remembers, be it a number of grains, stands for the same mass.
bool Branch::has_same_densities(const scenario::EmitterSpec& ours,
                                const scenario::EmitterSpec& theirs) const {
  const auto density = [](const scenario::Setup& setup, int material) {
    return setup.materials[static_cast<std::size_t>(material)].properties.density;
  };
  const auto is_same_density = [&](int here, int there) {
    return density(now_.setup, here) == density(origin_.scenario().setup, there);
  };
  return is_same_density(ours.material, theirs.material) &&
         std::equal(ours.more_materials.begin(), ours.more_materials.end(),
                    theirs.more_materials.begin(), theirs.more_materials.end(), is_same_density);
}

void Branch::transfer_insertion(const Simulation::Owners& to) {
  Insertion theirs(origin_.scenario().setup, their_models());
  origin_.state().read({{"clock", [&](sdk::ArchiveReader& a) { theirs.load(a); }}});
  if (const std::int64_t lost = to.insertion.transfer_from(theirs); lost > 0) {
    warn(grains_text(lost) + " that waited for their place do not come: their emitters are gone");
  }
  for (std::size_t n = 0; n < now_.setup.emitters.size(); ++n) {
    const std::string& name = now_.setup.emitters[n].name;
    const auto* before = base::find_named(origin_.scenario().setup.emitters, name);
    const scenario::ModelChoice& model = now_.setup.emitters[n].model;
    if (before != nullptr && same("emitters." + name) && same("frames") && same("seed") &&
        has_same_densities(now_.setup.emitters[n], *before) &&
        !is_changed(model.kind, model.name)) {
      origin_.state().read(
          {{"emitter." + name, [&](sdk::ArchiveReader& a) { to.models.emitters[n]->load(a); }}});
      continue;
    }
    to.insertion.pass_time(n, origin_.time());
    if (before == nullptr) {
      before_.new_emitters.push_back(name);
      continue;
    }
    before_.changed_emitters.push_back({.name = name});
    warn("emitters." + name +
         " is set otherwise, or its grains are: it goes on as if it had been so from the start");
  }
}

void Branch::note_counts(const Simulation& simulation) {
  const Past past = load_past(origin_.state());
  const CountsBefore then = past.start ? past.start->before : CountsBefore{};
  note_changed_emitters(then, simulation.insertion());
  note_beginnings(then, simulation);
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

void Branch::note_beginnings(const CountsBefore& then, const Simulation& simulation) {
  const CountedSince now = {origin_.time(), simulation.dem().balance().mass_emitted,
                            dust_so_far(simulation)};
  before_.field = is_field_new_ ? now : then.field;
  before_.loads = are_loads_new_ ? now : then.loads;
  const auto there = openings_of(origin_.scenario().setup, origin_.scenario().dust);
  for (const particles::Opening& hood : openings_of(now_.setup, now_.dust)) {
    if (base::find_named(there, hood.name) == nullptr) {
      before_.new_hoods.push_back({hood.name, now});
    } else if (const auto* known = base::find_named(then.new_hoods, hood.name)) {
      before_.new_hoods.push_back(*known);
    }
  }
}

bool Branch::is_same_grid() const {
  const auto& here = now_.setup;
  const auto& there = origin_.scenario().setup;
  if (!here.fluid || !there.fluid || here.fluid->cells != there.fluid->cells) return false;
  for (std::size_t d = 0; d < 3; ++d) {
    const auto is_periodic = [d](const scenario::Setup& s) {
      return s.domain.sides[2 * d].grains == scenario::GrainSide::periodic;
    };
    if (is_periodic(here) != is_periodic(there)) return false;
  }
  return true;
}

void Branch::transfer_fluid(const Simulation::Owners& to) {
  const io::StoredState& state = origin_.state();
  FluidStage& fluid = *to.fluid;
  const double time = origin_.time();
  const bool has_grains = fluid.coupling() != nullptr;
  if (!is_same_grid()) {
    warn("the fluid has another grid, or there was none: it starts with fluid.initial_velocity");
    if (has_grains) fluid.start(to.particles.rows());
    return;
  }
  LoadParts parts;
  fluid.add_parts(
      parts, [time] { return time; }, [] {});
  const bool had_moving_bodies = state.has("fluid", "open_cells");
  static constexpr std::array<std::string_view, 4> k_ways = {"fluid_forces", "voidage", "drag",
                                                             "coupling"};
  const bool is_changed_way =
      std::any_of(changed_models_.begin(), changed_models_.end(), [](const ChangedModel& c) {
        return c.now.kind == "drag" || c.now.kind == "voidage" || c.now.kind == "fluid_force";
      });
  const bool is_coupled_so =
      !is_changed_way && state.has("coupling", "grain_ids") && same("materials") && same("fluid") &&
      std::all_of(k_ways.begin(), k_ways.end(), [&](std::string_view way) { return same(way); });
  for (const auto& [name, load] : parts) {
    if (name == "fluid" && had_moving_bodies != fluid.solver().has_moving_bodies()) {
      state.read({{name, [&](sdk::ArchiveReader& a) { fluid.load_velocity(a); }}});
      continue;
    }
    if (name == "coupling" && !is_coupled_so) continue;
    if (name == "held_fluid" && !state.has(name, "pressure")) continue;
    state.read({{name, load}});
  }
  if (is_same_world_) return;
  fluid.adapt_velocity(time);
  if (has_grains) fluid.start(to.particles.rows());
  if (has_grains && !is_coupled_so && state.has("coupling", "grain_ids")) {
    warn(
        "fluid, drag, voidage or the other forces are set otherwise: what grains and fluid owe "
        "each other from the step before is dropped");
  }
}

void Branch::transfer_dust(const Simulation::Owners& to) {
  const io::StoredState& state = origin_.state();
  static constexpr std::array<std::string_view, 6> k_free_of_field = {
      "dust.field.clouds",     "dust.field.sources",
      "dust.field.cohesion",   "dust.field.emission_coefficient",
      "dust.field.deposition", "dust.field.schmidt_number"};
  const scenario::ReadResult& theirs = origin_.scenario();
  // What lies where is stored in two ways.
  const bool do_surfaces_run = has_running_surfaces(now_.setup);
  if (!is_same_grid() || !state.has("dust", "volume") || !same("dust.field", k_free_of_field) ||
      do_surfaces_run != has_running_surfaces(theirs.setup)) {
    warn(
        "dust.field has another grid or other classes, bodies move where none did or none where "
        "some did, or there was none: its air starts as the scenario says");
    to.dust->start();
    is_field_new_ = true;
    return;
  }
  DustPlaces places(theirs, now_);
  state.read({{"dust", [&](sdk::ArchiveReader& a) { places.find_dropped(a); }}});
  if (places.dropped() > 0.0) {
    warn(base::digits_text(places.dropped(), 3) +
         " kg of dust that bodies or openings had taken which are gone are in no balance from "
         "here on: `released` is without them");
  }
  const auto change = [&](std::string_view name, auto& values) { places.change(name, values); };
  LoadParts parts;
  to.dust->add_parts(parts);
  for (const auto& part : parts) {
    state.read({{part.first, [&](sdk::ArchiveReader& a) {
                   Changed changed(a, change, change);
                   part.second(changed);
                 }}});
  }
}

bool Branch::keeps_loads() const {
  if (!same("dust.field.classes")) return false;
  const auto share_of = [](const scenario::ReadResult& read, std::size_t material) {
    const auto& loads = read.dust.loads;
    return material < loads.size() ? loads[material].share : std::vector<double>{};
  };
  const auto& there = origin_.scenario();
  for (std::size_t n = 0; n < there.setup.materials.size(); ++n) {
    const int here = base::number_of(now_.setup.materials, there.setup.materials[n].name);
    if (here < 0) continue;
    if (share_of(now_, static_cast<std::size_t>(here)) != share_of(there, n)) return false;
  }
  return true;
}

/// What came off so far, by the names of its causes.
void Branch::transfer_liberation(const Simulation::Owners& to) {
  if (!origin_.state().has("liberation", "set_free") || !keeps_loads()) {
    warn(
        "grains carried no dust, or dust of other classes, or their materials have another "
        "dust_load: they carry what materials say");
    are_loads_new_ = true;
    return;
  }
  const std::vector<std::string> walls = their_particles().wall_names();
  origin_.state().read({{"liberation", [&](sdk::ArchiveReader& a) {
                           to.liberation->transfer_from(a, walls, is_same_grid());
                         }}});
}

/// What a sensor has added up means the same to it.
bool Branch::keeps_statistics(const std::string& name, const sdk::Sensor& model,
                              const std::vector<double>& class_diameters) const {
  if (class_diameters != origin_.class_diameters()) return false;
  const auto* theirs_of_name = base::find_named(origin_.scenario().setup.sensors, name);
  if (theirs_of_name == nullptr) return false;
  if (is_changed(theirs_of_name->model.kind, theirs_of_name->model.name)) return false;
  if (!same("sensors." + name) || !same("dust") || !same("time.fluid_step")) return false;
  // Sums by cell; and the air, which begins anew on another grid.
  const bool has_air = now_.setup.fluid.has_value() || origin_.scenario().setup.fluid.has_value();
  if (has_air && !is_same_grid()) return false;
  const auto names = [](const auto& things) {
    std::vector<std::string> all;
    all.reserve(things.size());
    for (const auto& thing : things) all.push_back(thing.name);
    return all;
  };
  const auto& theirs = origin_.scenario().setup;
  if (names(theirs.materials) != names(now_.setup.materials)) return false;
  // All that was emitted, counted or held weighs what its material weighs now. Other numbers of
  // materials, as of laws, are what a branch tries: sums mean the same.
  const auto is_as_dense = [](const auto& a, const auto& b) {
    return a.properties.density == b.properties.density;
  };
  if (!std::equal(theirs.materials.begin(), theirs.materials.end(), now_.setup.materials.begin(),
                  is_as_dense)) {
    return false;
  }
  return !model.wants_walls() || names(theirs.bodies) == names(now_.setup.bodies);
}

void Branch::transfer_sensors(Models& models) {
  for (std::size_t n = 0; n < models.sensors.size(); ++n) {
    const std::string& name = now_.setup.sensors[n].name;
    sdk::Sensor& sensor = *models.sensors[n];
    if (keeps_statistics(name, sensor, models.class_diameters)) {
      origin_.state().read({{"sensor." + name, [&](sdk::ArchiveReader& a) { sensor.load(a); }}});
      sensors_going_on_.push_back(name);
    } else if (base::find_named(origin_.scenario().setup.sensors, name) != nullptr) {
      warn("sensors." + name + " begins anew: it, or what it looks at, is set otherwise");
    }
  }
}

}  // namespace dust::run
