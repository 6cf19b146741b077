// SPDX-License-Identifier: Apache-2.0
#include "base/digest.hpp"
#include "dust/sdk/airborne_dust.hpp"
#include "run/run_checks.hpp"
#include "run/simulation.hpp"

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// The nodes of a grain step and of a fluid step, by what they read and write.
namespace dust::run {
namespace {

/// What a sort of the rows, or grains that have flown, change; and more.
std::vector<std::string> grains_and(std::initializer_list<const char*> more) {
  std::vector<std::string> names{"grain.position", "grain.velocity", "grain.drag_relaxation",
                                 "grain.fluid_impulse"};
  names.insert(names.end(), more.begin(), more.end());
  return names;
}

/// What is saved, as a number, but for what has `a_name_of_its_own`.
class SavedDigest final : public sdk::ArchiveWriter {
 public:
  explicit SavedDigest(std::string_view a_name_of_its_own) : left_out_(a_name_of_its_own) {}
  void numbers(std::string_view name, std::span<const double> values) override {
    if (name != left_out_) digest_.add(values);
  }
  void integers(std::string_view, std::span<const std::int64_t> values) override {
    digest_.add(values);
  }
  [[nodiscard]] std::uint64_t value() const { return digest_.value(); }

 private:
  std::string_view left_out_;
  base::Digest digest_;
};

/// The name that nodes give a part of a checkpoint; empty: several, see step_digests().
std::string name_of_state(const std::string& part) {
  static const std::map<std::string, std::string> k_names = {{"clock", ""},
                                                             {"fluid", ""},
                                                             {"bodies", "body.removal"},
                                                             {"grains", "grain.state"},
                                                             {"columns", "grain.columns"},
                                                             {"coupling", "coupling.state"},
                                                             {"resolved", "coupling.state"},
                                                             {"held_fluid", "fluid.held"},
                                                             {"dust", "dust.concentration"},
                                                             {"liberation", "dust.set_free"},
                                                             {"dust_rates", "dust.rates"},
                                                             {"stream_indices", "dust.indices"}};
  if (part.starts_with("emitter.")) return "emitter.state";
  if (part.starts_with("sensor.")) return part;
  return k_names.at(part);
}

template <class Field>
std::uint64_t digest_of_faces(const Field& field) {
  base::Digest digest;
  for (const auto& component : field.component) digest.add(component);
  return digest.value();
}

}  // namespace

graph::TaskGraph::Digests Simulation::step_digests() {
  using Saves = std::vector<SaveParts::value_type::second_type>;
  std::map<std::string, Saves> states;
  for (const auto& [part, save] : save_parts()) states[name_of_state(part)].push_back(save);
  states.erase("");
  states["emitter.state"].push_back([this](sdk::ArchiveWriter& a) { insertion_->save(a); });
  graph::TaskGraph::Digests digests;
  for (auto& [name, saves] : states) {
    digests[name] = [saves = std::move(saves)] {
      SavedDigest digest("impulse");  // of grains: grain.fluid_impulse
      for (const auto& save : saves) save(digest);
      return digest.value();
    };
  }
  digests["grain.fluid_impulse"] = dem_->digests().at("grain.fluid_impulse");
  if (dust_) {
    digests["dust.columns"] = [this] {
      base::Digest digest;
      for (const auto& column : dust_->columns().concentration) digest.add(column);
      return digest.value();
    };
  }
  if (fluid_) add_fluid_digests(digests);
  return digests;
}

void Simulation::add_fluid_digests(graph::TaskGraph::Digests& digests) const {
  const fluid::FluidSolver& solver = std::as_const(*fluid_).solver();
  digests["fluid.velocity"] = [&solver] {
    return base::Digest().add(solver.pressure()).value() ^ digest_of_faces(solver.velocity());
  };
  digests["fluid.open_fraction"] = [&solver] {
    return base::Digest().add(solver.open_fraction()).value();
  };
  digests["fluid.void_fraction"] = [this] {
    return base::Digest().add(fluid_->void_fraction()).value();
  };
  digests["fluid.columns"] = [this] {
    const sdk::FluidColumns c = world().fluid;
    base::Digest digest;
    for (const auto& column :
         {c.velocity_x, c.velocity_y, c.velocity_z, c.pressure, c.void_fraction, c.open_fraction}) {
      digest.add(column);
    }
    return digest.value();
  };
  if (coupling() == nullptr) return;
  digests["fluid.exchange"] = [this] {
    const fluid::Exchange& exchange = coupling()->exchange();
    return digest_of_faces(exchange.coefficient) ^ digest_of_faces(exchange.source);
  };
}

/// The fluid that particles see.
std::string Simulation::fluid_seen() const {
  return has_lagged_fluid() ? "fluid.held" : "fluid.velocity";
}

/// A step of the coarse rate. What a node says it writes is checked in a test.
void Simulation::build_dem_graph(int check_every) {
  const std::string seen_air = fluid_seen();
  dem_graph_.given(grains_and({"contact.list", "contact.history", "contact.force", "fine.force",
                               "fine.deferred_impulse", "fluid.void_fraction", "body.motion"}));
  dem_graph_.given({seen_air});
  if (coupling() != nullptr) {
    dem_graph_.add({"synchronise",
                    grains_and({"contact.list", "contact.history"}),
                    {"grain.position", "grain.velocity", "grain.fluid_impulse", "contact.history"},
                    [this] {
                      if (cycle_->is_refresh_due()) dem_->synchronise();
                    }});
    dem_graph_.add({"drag",
                    {"grain.position", "grain.velocity", seen_air, "fluid.void_fraction"},
                    {"grain.drag_relaxation"},
                    [this] { refresh_drag(); }});
  }
  dem_graph_.add(
      {"neighbour",
       grains_and({"contact.list", "contact.history", "fine.deferred_impulse", "body.motion"}),
       grains_and({"contact.list", "contact.history", "contact.force", "contact.ghost_force",
                   "grain.force", "fine.force", "fine.deferred_impulse"}),
       [this] { dem_->neighbours(); }});
  add_tile_nodes();
  if (check_every > 0) dem_graph_.check_writes(dem_->digests(), check_every);
  dem_graph_.build();
}

/// Contacts, forces and motion of a tile, which runs them as one where it can; the fine level.
void Simulation::add_tile_nodes() {
  const auto now = [this] { return time() + cycle_->time(); };
  // The published forces are those of a fluid step's last grain step.
  const auto keeps_force = [this] { return cycle_->is_last_step(); };
  dem_graph_.add(
      {"contact",
       {"grain.position", "grain.velocity", "contact.list", "contact.history"},
       {"body.motion", "contact.history", "contact.force", "contact.ghost_force", "grain.force"},
       [this, now, keeps_force] { dem_->contact(now(), keeps_force()); }});
  dem_graph_.add(
      {"force", {"contact.ghost_force", "grain.force"}, {"grain.force", "contact.force"}, [this] {
         dem_->force();
       }});
  dem_graph_.add({"integration",
                  grains_and({"grain.force", "fine.deferred_impulse"}),
                  {"grain.position", "grain.velocity", "grain.fluid_impulse", "grain.force"},
                  [this] { dem_->integrate(); }});
  dem_graph_.add({"fine_level",
                  grains_and({"contact.list", "contact.history", "body.motion"}),
                  {"grain.position", "grain.velocity", "grain.fluid_impulse", "contact.history",
                   "contact.force", "fine.force", "fine.deferred_impulse"},
                  [this] { dem_->advance_fine(); }});
  dem_graph_.fuse({.part = "tile",
                   .nodes = {"contact", "force", "integration"},
                   .work = [this, now, keeps_force] { dem_->step_tiles(now(), keeps_force()); },
                   .shares =
                       [this] {
                         const auto shares = dem_->phase_shares();
                         return std::vector<double>(shares.begin(), shares.end());
                       }});
}

void Simulation::build_step_graph(bool is_checked) {
  step_graph_.given({"body.removal", "emitter.state", "grain.state", "coupling.state",
                     "fluid.velocity", "fluid.open_fraction", "fluid.void_fraction",
                     "fluid.exchange", "fluid.held"});
  if (dust_) step_graph_.given({"dust.concentration", "dust.set_free"});
  add_first_nodes();
  if (fluid_) add_fluid_nodes();
  if (dust_) {
    step_graph_.add(
        {"dust",
         {"fluid.velocity", "fluid.open_fraction", "fluid.void_fraction", "dust.concentration"},
         {"dust.concentration"},
         [this] { dust_->advance(time()); }});
  }
  add_particle_nodes();
  if (dust_ && dust_->has_scavenging()) {
    step_graph_.add({"scavenging",
                     {"grain.state", "fluid.velocity", "fluid.void_fraction", "dust.concentration"},
                     {"grain.state", "dust.concentration"},
                     [this] { dust_->scavenge(*dem_); }});
  }
  if (liberation_) {
    step_graph_.add({"liberation",
                     {"grain.state", "fluid.void_fraction", "dust.concentration"},
                     {"grain.state", "dust.concentration", "dust.set_free"},
                     [this] { liberation_->advance(clock_.fluid_step()); }});
  }
  if (dust_figures_) {
    step_graph_.add({"dust_rates",
                     {"grain.state", "dust.concentration", "dust.set_free"},
                     {"dust.rates"},
                     [this] {
                       dust_figures_->rates.sample(time() + clock_.fluid_step(),
                                                   clock_.fluid_step());
                     }});
    step_graph_.add({"stream_indices",
                     {"grain.state", "fluid.velocity", "fluid.void_fraction", "dust.concentration",
                      "dust.set_free"},
                     {"dust.indices"},
                     [this] {
                       dust_figures_->indices.sample(time() + clock_.fluid_step(),
                                                     clock_.fluid_step());
                     }});
  }
  add_last_nodes();
  add_sensor_nodes();
  if (is_checked) step_graph_.check_writes(step_digests());
  step_graph_.build();
}

void Simulation::add_first_nodes() {
  bool has_removals = false;
  for (const auto& body : setup_.bodies) has_removals |= body.removal.has_value();
  if (has_removals) {
    std::vector<std::string> changes{"body.removal", "grain.state"};
    if (fluid_) {
      changes.insert(changes.end(), {"coupling.state", "fluid.velocity", "fluid.open_fraction",
                                     "fluid.void_fraction", "fluid.columns"});
    }
    step_graph_.add(
        {"bodies", {"body.removal", "grain.state"}, changes, [this] { remove_bodies(); }});
  }
  step_graph_.add({"emit",
                   {"emitter.state", "grain.state"},
                   {"emitter.state", "grain.state", "grain.fluid_impulse"},
                   [this] { insert(); }});
}

void Simulation::add_fluid_nodes() {
  // The weight of what dust there is.
  const auto and_dust = [this](std::vector<std::string> reads) {
    if (dust_) reads.emplace_back("dust.concentration");
    return reads;
  };
  if (!fluid_->has_particles()) {
    step_graph_.add({"fluid",
                     and_dust({"fluid.velocity"}),
                     {"fluid.velocity", "fluid.open_fraction", "fluid.void_fraction"},
                     [this] { advance_fluid(); }});
    return;
  }
  step_graph_.add(
      {"voidage",
       {"grain.state", "coupling.state"},
       {"fluid.open_fraction", "fluid.void_fraction", "fluid.exchange", "coupling.state"},
       [this] { fluid_->begin_step(time(), dem_->rows()); }});
  if (fluid_->is_lagged()) {
    step_graph_.add({"fluid",
                     and_dust({"fluid.void_fraction", "fluid.exchange", "fluid.velocity"}),
                     {"fluid.velocity", "fluid.open_fraction"},
                     [this] { advance_fluid(); }});
    return;
  }
  step_graph_.add(
      {"fluid",
       and_dust({"fluid.void_fraction", "fluid.exchange", "fluid.velocity", "grain.state"}),
       {"fluid.velocity", "fluid.open_fraction", "coupling.state"},
       [this] {
         advance_fluid();
         fluid_->evaluate_drag(dem_->rows());
       }});
}

void Simulation::add_particle_nodes() {
  std::vector<std::string> seen_by_grains{"grain.state"};
  std::vector<std::string> changed{"grain.state", "grain.fluid_impulse"};
  const bool has_exchange = fluid_ && fluid_->has_particles();
  if (has_exchange) {
    seen_by_grains.push_back(fluid_seen());
    seen_by_grains.insert(seen_by_grains.end(), {"fluid.void_fraction", "coupling.state"});
    changed.emplace_back("coupling.state");
  }
  step_graph_.add({"dem_cycle", seen_by_grains, changed, [this] { run_dem_cycle(); }});
  if (has_exchange) {
    step_graph_.add({"collect",
                     {"grain.state", "grain.fluid_impulse", "coupling.state", "fluid.void_fraction",
                      "fluid.velocity"},
                     {"coupling.state", "grain.fluid_impulse"},
                     [this] {
                       if (fluid_->is_lagged()) fluid_->evaluate_drag(dem_->rows());
                       fluid_->end_step(dem_->rows());
                     }});
  }
  if (has_lagged_fluid()) {
    step_graph_.add({"hold_fluid", {"fluid.velocity"}, {"fluid.held"}, [this] {
                       fluid_->keep_for_particles();
                     }});
  }
}

void Simulation::add_last_nodes() {
  if (fluid_) {
    std::vector<std::string> seen{"fluid.velocity", "fluid.open_fraction", "fluid.void_fraction"};
    // Not while the dust asks for what passes the faces, too.
    if (dust_ && snapshots_.has_face_fluxes()) seen.emplace_back("dust.concentration");
    step_graph_.add({"publish_fluid", seen, {"fluid.columns"}, [this] {
                       if (fluid_->solver().has_moving_bodies()) {
                         snapshots_.set_open_fraction(fluid_->solver().open_fraction());
                       }
                       take_fluid_snapshot(FaceTable::Moment::after_step);
                     }});
  }
  step_graph_.add({"publish_grains", {"grain.state"}, {"grain.columns"}, [this] {
                     const double end = time() + clock_.fluid_step();
                     snapshots_.take(*dem_, end);
                     dem_->close_wall_loads(clock_.fluid_step(), end);
                   }});
  step_graph_.add(
      {"health", {"grain.columns"}, {"health"}, [this] { check_finite(snapshots_.particles()); }});
}

void Simulation::add_sensor_nodes() {
  std::vector<std::string> reads{"grain.columns"};
  if (fluid_) reads.push_back("fluid.columns");
  const auto as_observer = [this](std::size_t n) {
    return dust_ ? dynamic_cast<sdk::DustObserver*>(models_.sensors[n].get()) : nullptr;
  };
  bool wants_dust = false;
  for (std::size_t n = 0; n < models_.sensors.size(); ++n) wants_dust |= as_observer(n) != nullptr;
  if (wants_dust) {
    step_graph_.add({"publish_dust", {"dust.concentration"}, {"dust.columns"}, [this] {
                       dust_->take_columns();
                     }});
    reads.push_back("dust.columns");
  }
  for (std::size_t n = 0; n < models_.sensors.size(); ++n) {
    const std::string& name = setup_.sensors[n].name;
    step_graph_.add(
        {"sensor " + name, reads, {"sensor." + name}, [this, n, observer = as_observer(n)] {
           sdk::WorldView view = world();
           // The clock moves on after the graph: sensors see the end of this step.
           view.time += setup_.time.fluid_step;
           models_.sensors[n]->observe(view);
           if (observer != nullptr) observer->observe_dust(view, dust_->columns());
         }});
  }
}

}  // namespace dust::run
