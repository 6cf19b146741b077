// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "graph/task_graph.hpp"
#include "particles/dem.hpp"
#include "run/archive_parts.hpp"
#include "run/audit/force_shares.hpp"
#include "run/dem_cycle.hpp"
#include "run/dust/dust_rates.hpp"
#include "run/dust/dust_stage.hpp"
#include "run/dust/liberation_stage.hpp"
#include "run/dust/stream_indices.hpp"
#include "run/fluid_stage.hpp"
#include "run/insertion/insertion.hpp"
#include "run/models.hpp"
#include "run/snapshots/snapshots.hpp"
#include "run/step_clock.hpp"
#include "setup/dust_setup.hpp"
#include "setup/setup.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace dust::run {

/// The particles of a scenario; takes the laws out of `models` and keeps its bodies by reference.
std::unique_ptr<particles::Dem> make_particles(const scenario::Setup& setup, Models& models,
                                               const scenario::DustSetup& dust = {});

/// Everything a run holds: models, particles, fluid, the two task graphs and the clock.
class Simulation {
 public:
  /// `check_every`, for tests, if not 0: the nodes of both graphs run one by one, and at each fluid
  /// step and one grain step in so many one that changes what it does not declare to write is a
  /// std::logic_error.
  Simulation(const scenario::Setup& setup, Models models, int check_every = 0,
             scenario::DustSetup dust = {});
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Lets in what is there before the first step. Not for a run that is resumed. Throws ModelError
  /// where that is impossible.
  void start();
  /// Those who hold the state of a run.
  struct Owners {
    Models& models;
    StepClock& clock;
    particles::Dem& particles;
    Insertion& insertion;
    Snapshots& snapshots;
    FluidStage* fluid;            ///< null without a fluid
    DustStage* dust;              ///< null without a dust field
    LiberationStage* liberation;  ///< null where no dust comes off grains
  };
  /// In place of start(): `give` gives them the state of another run.
  void start_from(const std::function<void(const Owners&)>& give);
  /// In a run that has started from another: shows the world as it is to sensors that begin now,
  /// all but those that go on.
  void begin_sensors(std::span<const std::string> going_on);
  /// In a run that has started from another: where the scenario does not say when means of dust
  /// begin, they do in the middle of what is ahead, anew.
  void begin_dust_figures();
  /// In a resumed run, which began at `begin` [s] and may end later than it was to: where the
  /// scenario does not say when means of dust begin, they do in the middle of the whole run, as if
  /// it had never been cut. Where that has passed they stay as they are, and what comes back says
  /// since when they are.
  std::string go_on_with_dust_figures(double begin);
  /// One fluid step: one pass of the outer graph.
  void step();

  [[nodiscard]] double time() const { return clock_.time(); }  ///< [s]
  [[nodiscard]] std::int64_t steps_done() const { return clock_.steps_done(); }
  [[nodiscard]] bool is_finished() const { return clock_.is_finished(); }

  [[nodiscard]] const scenario::Setup& setup() const { return setup_; }
  [[nodiscard]] const scenario::DustSetup& dust_setup() const { return dust_setup_; }
  [[nodiscard]] const Models& models() const { return models_; }
  [[nodiscard]] const particles::Dem& dem() const { return *dem_; }
  [[nodiscard]] const Insertion& insertion() const { return *insertion_; }
  /// Null without a fluid.
  [[nodiscard]] const FluidStage* fluid_stage() const { return fluid_.get(); }
  /// Null without a dust field.
  [[nodiscard]] const DustStage* dust_stage() const { return dust_.get(); }
  /// Null where no dust comes off grains.
  [[nodiscard]] const LiberationStage* liberation() const { return liberation_.get(); }
  /// Null without a dust field.
  [[nodiscard]] const DustRates* dust_rates() const {
    return dust_figures_ ? &dust_figures_->rates : nullptr;
  }
  /// Null without a dust field.
  [[nodiscard]] const StreamIndices* stream_indices() const {
    return dust_figures_ ? &dust_figures_->indices : nullptr;
  }
  [[nodiscard]] const fluid::FluidSolver* fluid() const;
  [[nodiscard]] const coupling::Coupling* coupling() const;

  /// The world as of the last step; spans stay valid until the next.
  [[nodiscard]] sdk::WorldView world() const;
  /// Adds the forces on the grains at the end of the last step.
  void sample_forces(ForceShares& shares);
  /// Momentum exchange per cell for a frame.
  [[nodiscard]] const std::vector<float>& momentum_exchange();
  /// Whether bodies move or are taken away.
  [[nodiscard]] bool has_changing_walls() const;
  [[nodiscard]] std::string state_digest() const;

  [[nodiscard]] const graph::TaskGraph& step_graph() const { return step_graph_; }
  [[nodiscard]] const graph::TaskGraph& dem_graph() const { return dem_graph_; }

  /// The state that the nodes of step_graph() name, as numbers: all that a checkpoint holds, and
  /// what is handed on within a step.
  [[nodiscard]] graph::TaskGraph::Digests step_digests();

  [[nodiscard]] SaveParts save_parts();
  [[nodiscard]] LoadParts load_parts();

 private:
  /// What is told of the dust of a steady stream.
  struct DustFigures {
    /// In place: both are referred to by what they hold.
    DustFigures(const Simulation& s, double steady_after)
        : rates(s.setup_, *s.dust_, s.liberation_.get(), *s.dem_, steady_after),
          indices(s.setup_, *s.fluid_, *s.dust_, s.liberation_.get(), *s.dem_, steady_after) {}
    DustRates rates;
    StreamIndices indices;
  };
  /// [s] By the scenario; 0: it does not say.
  [[nodiscard]] double steady_after_given() const;
  void begin_dust_figures_at(double time);
  void build_dem_graph(int check_every);
  void add_tile_nodes();
  void build_step_graph(bool is_checked);
  void add_first_nodes();
  void add_fluid_nodes();
  void add_fluid_digests(graph::TaskGraph::Digests& digests) const;
  void add_particle_nodes();
  void add_last_nodes();
  void add_sensor_nodes();
  [[nodiscard]] std::string fluid_seen() const;
  [[nodiscard]] bool has_lagged_fluid() const { return fluid_ && fluid_->is_lagged(); }

  void insert();
  void remove_bodies();
  /// With what the dust in it weighs.
  void advance_fluid();
  void run_dem_cycle();
  void refresh_drag();
  void act_on_resolved();
  void take_fluid_snapshot(FaceTable::Moment moment);
  void load_clock(sdk::ArchiveReader& archive);

  scenario::Setup setup_;
  scenario::DustSetup dust_setup_;
  Models models_;
  StepClock clock_;
  std::unique_ptr<FluidStage> fluid_;
  std::unique_ptr<DustStage> dust_;
  std::unique_ptr<particles::Dem> dem_;
  std::unique_ptr<LiberationStage> liberation_;
  std::unique_ptr<DustFigures> dust_figures_;
  std::optional<DemCycle> cycle_;  ///< within a fluid step
  std::unique_ptr<Insertion> insertion_;
  Snapshots snapshots_;
  graph::TaskGraph step_graph_{"fluid_step"};
  graph::TaskGraph dem_graph_{"dem_step"};
};

}  // namespace dust::run
