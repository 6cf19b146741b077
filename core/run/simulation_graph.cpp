// SPDX-License-Identifier: Apache-2.0
#include "run/simulation.hpp"

#include <algorithm>

/// The nodes of a grain step and of a fluid step, by what they read and write.
namespace dust::run {

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

}  // namespace dust::run
