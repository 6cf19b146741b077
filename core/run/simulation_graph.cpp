// SPDX-License-Identifier: Apache-2.0
#include "run/simulation.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

/// The nodes of a grain step and of a fluid step, by what they read and write.
namespace dust::run {

/// A step of the coarse rate. What a node says it writes is checked in a test.
void Simulation::build_dem_graph(int check_every) {
  const std::string seen_air = held_fluid_ ? "fluid.held" : "fluid.velocity";
  // What a sort of the rows, or grains that have flown, change.
  const std::vector<std::string> grains{"grain.position", "grain.velocity", "grain.fluid_action",
                                        "grain.fluid_impulse"};
  const auto with = [](std::vector<std::string> names, std::initializer_list<const char*> more) {
    names.insert(names.end(), more.begin(), more.end());
    return names;
  };
  dem_graph_.given(with(grains, {"contact.list", "contact.history", "contact.force", "fine.force",
                                 "fine.deferred_impulse", "fluid.void_fraction", "body.motion"}));
  dem_graph_.given({seen_air});
  if (coupling_) {
    dem_graph_.add({"synchronise",
                    with(grains, {"contact.list", "contact.history"}),
                    {"grain.position", "grain.velocity", "grain.fluid_impulse", "contact.history"},
                    [this] {
                      if (is_refresh_due()) dem_->land();
                    }});
    dem_graph_.add({"drag",
                    {"grain.position", "grain.velocity", seen_air, "fluid.void_fraction"},
                    {"grain.fluid_action"},
                    [this] { refresh_drag(); }});
  }
  dem_graph_.add(
      {"neighbour", with(grains, {"contact.list", "contact.history", "fine.deferred_impulse"}),
       with(grains, {"contact.list", "contact.history", "contact.force", "contact.ghost_force",
                     "grain.force", "fine.force", "fine.deferred_impulse"}),
       [this] { dem_->neighbours(); }});
  const auto now = [this] { return time() + dem_step_ * dem_->coarse_step(); };
  // The published forces are those of a fluid step's last grain step.
  const auto keeps_force = [this] { return dem_step_ + 1 == dem_steps_per_fluid_step_; };
  dem_graph_.add(
      {"contact",
       {"grain.position", "grain.velocity", "contact.list", "contact.history", "body.motion"},
       {"contact.history", "contact.force", "contact.ghost_force", "grain.force"},
       [this, now, keeps_force] { dem_->contact(now(), keeps_force()); }});
  dem_graph_.add(
      {"force", {"contact.ghost_force", "grain.force"}, {"grain.force", "contact.force"}, [this] {
         dem_->force();
       }});
  dem_graph_.add({"integration",
                  with(grains, {"grain.force", "fine.deferred_impulse"}),
                  {"grain.position", "grain.velocity", "grain.fluid_impulse", "grain.force"},
                  [this] { dem_->integrate(); }});
  dem_graph_.add({"fine_level",
                  with(grains, {"contact.list", "contact.history", "body.motion"}),
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
  if (check_every > 0) dem_graph_.check_writes(dem_->digests(), check_every);
  dem_graph_.build();
}

void Simulation::build_step_graph() {
  const std::string seen_air = held_fluid_ ? "fluid.held" : "fluid.velocity";
  step_graph_.given(
      {"emitter.state", "grain.state", "fluid.velocity", "fluid.exchange", "fluid.held"});
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
  std::vector<std::string> seen_by_grains{"grain.state"};
  if (coupling_) {
    seen_by_grains.push_back(seen_air);
    seen_by_grains.emplace_back("fluid.void_fraction");
  }
  step_graph_.add({"dem_cycle", seen_by_grains, {"grain.state", "grain.fluid_impulse"}, [this] {
                     run_dem_cycle();
                   }});
  if (coupling_) {
    step_graph_.add(
        {"collect",
         {"grain.state", "grain.fluid_impulse", "fluid.void_fraction", "fluid.velocity"},
         {"fluid.exchange"},
         [this] {
           if (held_fluid_) coupling_->evaluate(dem_->rows(), fluid_->drag_velocity());
           coupling_->end_step(dem_->rows(), setup_.time.fluid_step);
         }});
  }
  if (held_fluid_) {
    step_graph_.add({"hold_fluid", {"fluid.velocity"}, {"fluid.held"}, [this] { hold_fluid(); }});
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
                     if (wants_walls_) dem_->close_wall_loads(setup_.time.fluid_step);
                   }});
  step_graph_.add({"health", {"grain.columns"}, {"health"}, [this] { check_health(); }});
  add_sensor_nodes();
  step_graph_.build();
}

void Simulation::add_fluid_nodes() {
  if (!coupling_) {
    step_graph_.add(
        {"fluid", {"fluid.velocity"}, {"fluid.velocity", "fluid.void_fraction"}, [this] {
           advance_fluid();
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
                     coupling_->begin_step(dem_->rows(), setup_.time.fluid_step);
                   }});
  if (held_fluid_) {
    step_graph_.add({"fluid",
                     {"fluid.void_fraction", "fluid.exchange", "fluid.velocity"},
                     {"fluid.velocity"},
                     [this] { advance_fluid(); }});
    return;
  }
  step_graph_.add({"fluid",
                   {"fluid.void_fraction", "fluid.exchange", "fluid.velocity", "grain.state"},
                   {"fluid.velocity", "fluid.exchange"},
                   [this] {
                     advance_fluid();
                     coupling_->evaluate(dem_->rows(), fluid_->drag_velocity());
                   }});
}

void Simulation::advance_fluid() {
  const fluid::CellField& before =
      coupling_ ? coupling_->void_fraction_before() : no_grains_->void_fraction;
  const fluid::Exchange& exchange = coupling_ ? coupling_->exchange() : no_grains_->exchange;
  fluid_->advance(time(), setup_.time.fluid_step, before, void_fraction(), exchange);
  fluid_sub_steps_ += fluid_->report().sub_steps;
  pressure_iterations_ += fluid_->report().pressure_iterations;
}

void Simulation::hold_fluid() {
  const fluid::FaceField& velocity = fluid_->mean_velocity();
  const fluid::FaceField& stress = fluid_->stress_divergence();
  const auto copy = [](const std::vector<double>& from, std::vector<double>& to) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, from.size(), 1U << 15),
                      [&](const auto& r) {
                        std::copy_n(from.data() + r.begin(), r.size(), to.data() + r.begin());
                      });
  };
  for (std::size_t d = 0; d < 3; ++d) {
    copy(velocity.component[d], held_fluid_->velocity.component[d]);
    copy(stress.component[d], held_fluid_->stress_divergence.component[d]);
  }
  copy(fluid_->mean_pressure(), held_fluid_->pressure);
}

bool Simulation::is_refresh_due() const { return dem_step_ % dem_steps_per_refresh_ == 0; }

void Simulation::refresh_drag() {
  if (!is_refresh_due()) return;
  const int held = std::min(dem_steps_per_refresh_, dem_steps_per_fluid_step_ - dem_step_);
  const double step = dem_->coarse_step();
  const double now = time() + dem_step_ * step;
  if (held_fluid_) {
    const HeldFluid& h = *held_fluid_;
    coupling_->refresh(dem_->rows(),
                       {h.velocity, h.stress_divergence, &h.pressure, now, held * step});
  } else {
    coupling_->refresh(dem_->rows(), {fluid_->velocity(), fluid_->stress_divergence(),
                                      &fluid_->mean_pressure(), now, held * step});
  }
  dem_->fluid_action_changed();
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

}  // namespace dust::run
