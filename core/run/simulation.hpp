// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "coupling/coupling.hpp"
#include "fluid/fluid_solver.hpp"
#include "graph/task_graph.hpp"
#include "io/run_files.hpp"
#include "particles/dem.hpp"
#include "run/columns.hpp"
#include "run/contact_table.hpp"
#include "run/emission_book.hpp"
#include "run/entry.hpp"
#include "run/models.hpp"
#include "setup/setup.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace dust::run {

/// Everything a run holds: models, grains, fluid, the two task graphs and the clock.
class Simulation {
 public:
  /// `check_every`, for tests, if not 0: the nodes of a grain step run one by one, and at one step
  /// in so many one that changes what it does not declare to write is a std::logic_error.
  Simulation(const scenario::Setup& setup, Models models, int check_every = 0);
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Lets in what is there before the first step. Not for a run that is resumed. Throws ModelError
  /// where that is impossible.
  void start();
  /// One fluid step: one pass of the outer graph.
  void step();

  [[nodiscard]] double time() const;  ///< [s]
  [[nodiscard]] std::int64_t steps_done() const { return steps_done_; }
  [[nodiscard]] bool is_finished() const { return steps_done_ >= steps_wanted_; }

  [[nodiscard]] const scenario::Setup& setup() const { return setup_; }
  [[nodiscard]] const Models& models() const { return models_; }
  [[nodiscard]] const particles::Dem& dem() const { return *dem_; }
  [[nodiscard]] const fluid::FluidSolver* fluid() const { return fluid_.get(); }
  [[nodiscard]] const coupling::Coupling* coupling() const { return coupling_.get(); }
  [[nodiscard]] std::int64_t fluid_sub_steps() const { return fluid_sub_steps_; }
  [[nodiscard]] std::int64_t pressure_iterations() const { return pressure_iterations_; }
  /// Grains that had to wait a fluid step or more because their place was taken, and those waiting.
  [[nodiscard]] std::int64_t delayed_entries() const { return delayed_entries_; }
  [[nodiscard]] std::size_t waiting_entries() const { return waiting_.size(); }
  [[nodiscard]] const std::vector<Entrant>& waiting() const { return waiting_; }
  [[nodiscard]] const EmissionBook& emissions() const { return emissions_; }

  /// The world as of the last step; spans stay valid until the next.
  [[nodiscard]] sdk::WorldView world() const;
  /// Momentum exchange per cell for a frame.
  [[nodiscard]] const std::vector<float>& momentum_exchange();

  /// Whether bodies move or are taken away.
  [[nodiscard]] bool has_changing_walls() const;

  /// SHA-256 of ids, positions, velocities, angular velocities (by id) and the fluid fields.
  [[nodiscard]] std::string state_digest() const;

  [[nodiscard]] const graph::TaskGraph& step_graph() const { return step_graph_; }
  [[nodiscard]] const graph::TaskGraph& dem_graph() const { return dem_graph_; }

  using SaveParts = std::vector<std::pair<std::string, std::function<void(sdk::ArchiveWriter&)>>>;
  using LoadParts = std::vector<std::pair<std::string, std::function<void(sdk::ArchiveReader&)>>>;
  [[nodiscard]] SaveParts save_parts() const;
  [[nodiscard]] LoadParts load_parts();

 private:
  void build_dem_graph(int check_every);
  void build_step_graph();
  void add_fluid_nodes();
  void air_bodies_changed();
  void take_open_fraction();
  void add_sensor_nodes();
  void emit();
  void propose_seeds(double begin, double end);
  void propose_seeds_of(std::size_t emitter, double begin, double end);
  void remove_bodies();
  void run_dem_cycle();
  void make_grains();
  /// Whether any grain may ever come in; without, the run is one of the fluid alone.
  [[nodiscard]] bool has_grains() const { return !models_.class_diameters.empty(); }
  [[nodiscard]] const fluid::CellField& void_fraction() const;
  void advance_fluid();
  void hold_fluid();
  [[nodiscard]] bool is_refresh_due() const;
  void refresh_drag();
  void check_health() const;
  void publish_grains();

  scenario::Setup setup_;
  Models models_;
  std::unique_ptr<fluid::FluidSolver> fluid_;
  std::unique_ptr<coupling::Coupling> coupling_;
  std::unique_ptr<particles::Dem> dem_;
  fluid::Grid grid_;
  /// What a fluid alone meets: no solids and no forces of grains.
  struct NoGrains {
    explicit NoGrains(const fluid::Grid& grid)
        : void_fraction(grid.size, 1.0), exchange{fluid::FaceField(grid), fluid::FaceField(grid)} {}
    fluid::CellField void_fraction;
    fluid::Exchange exchange;
  };
  std::unique_ptr<NoGrains> no_grains_;  ///< only for a fluid alone
  /// The fluid of the step before, which the grains see while it is solved.
  struct HeldFluid {
    fluid::FaceField velocity, stress_divergence;
    fluid::CellField pressure;

    /// What a checkpoint keeps of it, by name.
    template <class Visit>
    void each(Visit&& visit) {
      for (std::size_t d = 0; d < 3; ++d) {
        const std::string axis(1, "xyz"[d]);
        visit("velocity_" + axis, velocity.component[d]);
        visit("stress_" + axis, stress_divergence.component[d]);
      }
      visit("pressure", pressure);
    }
  };
  std::unique_ptr<HeldFluid> held_fluid_;  ///< only where fluid and grains overlap
  GrainTable grain_table_;
  ContactTable contact_table_;
  bool wants_contacts_ = false;
  std::unique_ptr<FluidTable> fluid_table_;
  graph::TaskGraph step_graph_{"fluid_step"};
  graph::TaskGraph dem_graph_{"dem_step"};

  bool wants_walls_ = false;
  std::int64_t steps_done_ = 0;
  std::int64_t steps_wanted_ = 0;
  int dem_steps_per_fluid_step_ = 1;
  int dem_steps_per_refresh_ = 1;
  int dem_step_ = 0;  ///< within the cycle
  std::int64_t fluid_sub_steps_ = 0;
  std::int64_t pressure_iterations_ = 0;
  std::vector<float> momentum_exchange_;
  std::int64_t delayed_entries_ = 0;
  std::vector<sdk::InsertionRequest> requests_;
  EntryScene entry_scene_;
  EmissionBook emissions_;
  bool is_started_ = false;       ///< the first step's grains are in already
  std::vector<Entrant> waiting_;  ///< proposed, not yet in the domain
};

}  // namespace dust::run
