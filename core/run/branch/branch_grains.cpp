// SPDX-License-Identifier: Apache-2.0
// What a branch does with grains, their contacts and those that are to come.
#include "base/named.hpp"
#include "base/text.hpp"
#include "preflight/particle_models.hpp"
#include "run/branch/branch.hpp"
#include "run/branch/changed_archive.hpp"
#include "run/insertion/entry.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace dust::run {
namespace {

/// More than any contact keeps.
constexpr std::size_t k_max_numbers = 64;

std::string grains_text(std::int64_t count) {
  return count == 1 ? "1 grain" : std::to_string(count) + " grains";
}

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

}  // namespace

std::int64_t Branch::particles_there() const {
  std::int64_t count = 0;
  origin().state().read({{"grains", [&](sdk::ArchiveReader& a) {
                            count = static_cast<std::int64_t>(a.integers("id").size());
                          }}});
  return count;
}

void Branch::add_diameters(Models& models) const {
  std::vector<double> more = origin().class_diameters();
  if (!both_.is_same()) {
    // Sizes that none is left of shall not shorten the step.
    more.clear();
    origin().state().read({{"grains",
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
  more.insert(more.end(), models.class_diameters.begin(), models.class_diameters.end());
  preflight::set_class_diameters(models, std::move(more));
}

/// The other run's particles, as it had them.
particles::Dem& Branch::their_particles() {
  if (their_particles_) return *their_particles_;
  const scenario::Setup& setup = origin().scenario().setup;
  their_particles_ = make_particles(setup, their_models(), origin().scenario().dust);
  std::size_t contacts = 0;
  const auto count = [&](std::string_view name, std::vector<std::int64_t>& values) {
    if (name.ends_with("_a")) contacts = values.size();
  };
  // Histories of other lengths are not read: their contacts begin anew.
  const auto drop_histories = [&](std::string_view name, std::vector<double>& values) {
    if (name.ends_with("_history")) values.assign(contacts * k_max_numbers, 0.0);
  };
  const bool is_other = both_.has_other_histories();
  origin().state().read({{"grains", [&](sdk::ArchiveReader& a) {
                            ChangedArchive changed(a, drop_histories, count);
                            their_particles_->load(is_other ? changed : a);
                          }}});
  return *their_particles_;
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
  const scenario::Setup& there = origin().scenario().setup;
  const bool are_kept = !both_.has_other_histories();
  const auto keeps = [&](const std::optional<scenario::ModelChoice>& ours,
                         const std::optional<scenario::ModelChoice>& theirs) {
    return are_kept && is_same_model(ours, theirs) &&
           !(ours && both_.is_changed(ours->kind, ours->name));
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

/// Bodies that were taken away stay away.
void Branch::transfer_bodies(Models& models) {
  for (bodies::Body& body : models.bodies) {
    const auto* theirs = base::find_named(their_models().bodies, body.name);
    if (theirs != nullptr) body.removed_at = theirs->removed_at;
  }
}

void Branch::transfer_particles(const Simulation::Owners& to) {
  if (is_same_world_) {
    origin().state().read({{"grains", [&](sdk::ArchiveReader& a) { to.particles.load(a); }}});
    report_.particles = to.particles.balance().in_domain;
    report_.contacts = to.particles.report().contacts;
    return;
  }
  const auto transfers = laws();
  report_ = to.particles.transfer_from(their_particles(), origin().time(), transfers,
                                       both_.keeps_loads());
  if (report_.without_past == 0) return;
  warn(std::to_string(report_.without_past) + " of " + std::to_string(report_.contacts) +
       " contacts begin anew, without the springs of before: their laws keep other numbers");
}

void Branch::transfer_insertion(const Simulation::Owners& to) {
  Insertion theirs(origin().scenario().setup, their_models());
  origin().state().read({{"clock", [&](sdk::ArchiveReader& a) { theirs.load(a); }}});
  if (const std::int64_t lost = to.insertion.transfer_from(theirs); lost > 0) {
    warn(grains_text(lost) + " that waited for their place do not come: their emitters are gone");
  }
  for (std::size_t n = 0; n < now_.setup.emitters.size(); ++n) {
    const std::string& name = now_.setup.emitters[n].name;
    if (keeps_emitter(now_.setup.emitters[n])) {
      origin().state().read(
          {{"emitter." + name, [&](sdk::ArchiveReader& a) { to.models.emitters[n]->load(a); }}});
      continue;
    }
    to.insertion.pass_time(n, origin().time());
    if (base::find_named(origin().scenario().setup.emitters, name) == nullptr) {
      before_.new_emitters.push_back(name);
    } else {
      before_.changed_emitters.push_back({.name = name});
    }
  }
}

bool Branch::keeps_emitter(const scenario::EmitterSpec& emitter) const {
  const auto* before = base::find_named(origin().scenario().setup.emitters, emitter.name);
  return before != nullptr && both_.same("emitters." + emitter.name) && both_.same("frames") &&
         both_.same("seed") && both_.has_same_densities(emitter, *before) &&
         !both_.is_changed(emitter.model.kind, emitter.model.name);
}

bool Branch::keeps_dust_on_grains() const {
  return origin().state().has("liberation", "set_free") && both_.keeps_loads();
}

void Branch::report_grains_anew() {
  for (const scenario::EmitterSpec& emitter : now_.setup.emitters) {
    if (base::find_named(origin().scenario().setup.emitters, emitter.name) == nullptr) continue;
    if (keeps_emitter(emitter)) continue;
    warn("emitters." + emitter.name +
         " is set otherwise, or its grains are: it goes on as if it had been so from the start");
  }
  if (!now_.dust.field || !now_.dust.liberation || keeps_dust_on_grains()) return;
  warn(
      "grains carried no dust, or dust of other classes, or their materials have another "
      "dust_load: they carry what materials say");
}

/// What came off so far, by the names of its causes.
void Branch::transfer_liberation(const Simulation::Owners& to) {
  if (!keeps_dust_on_grains()) return;
  const std::vector<std::string> walls = their_particles().wall_names();
  origin().state().read({{"liberation", [&](sdk::ArchiveReader& a) {
                            to.liberation->transfer_from(a, walls, both_.is_same_grid());
                          }}});
}

}  // namespace dust::run
