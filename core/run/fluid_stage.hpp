// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "coupling/coupling.hpp"
#include "fluid/fluid_solver.hpp"
#include "resolved/resolved_spheres.hpp"
#include "resolved/unresolved_rows.hpp"
#include "run/archive_parts.hpp"
#include "run/models.hpp"
#include "setup/setup.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dust::run {

/// The fluid of a run and its coupling to the particles, in the stages of a fluid step.
class FluidStage {
 public:
  /// `setup` has a fluid; both are kept by reference. Without particles it is one of the fluid
  /// alone.
  FluidStage(const scenario::Setup& setup, const Models& models);

  [[nodiscard]] const fluid::Grid& grid() const { return grid_; }
  [[nodiscard]] const fluid::FluidSolver& solver() const { return *solver_; }
  [[nodiscard]] fluid::FluidSolver& solver() { return *solver_; }
  /// Null without particles that a drag law is for.
  [[nodiscard]] const coupling::Coupling* coupling() const { return coupling_.get(); }
  /// Null without particles whose surfaces the fluid meets.
  [[nodiscard]] const resolved::ResolvedSpheres* resolved() const { return resolved_.get(); }
  [[nodiscard]] bool has_particles() const { return coupling_ || resolved_; }
  /// Whether particles see the fluid of the step before, while the next is solved.
  [[nodiscard]] bool is_lagged() const { return lagged_ != nullptr; }
  [[nodiscard]] const fluid::CellField& void_fraction() const;
  [[nodiscard]] std::int64_t sub_steps() const { return sub_steps_; }
  [[nodiscard]] std::int64_t pressure_iterations() const { return pressure_iterations_; }

  /// The void fraction of particles that are there at the start.
  void start(const particles::GrainRows& rows) { coupling_->start(unresolved(rows)); }
  /// Void fraction and drag of the particles, or their surfaces, for the step from `time` [s] on.
  void begin_step(double time, const particles::GrainRows& rows);
  /// Solves for the fluid; `force` [N/m3] acts on it besides those of particles, null: none.
  void advance(double time, const fluid::FaceField* force);
  /// The impulses that the fluid took in advance().
  void evaluate_drag(const particles::GrainRows& rows);
  /// Before the particles move: the fluid's action on those that are resolved, and what it turns
  /// them by.
  void act(const particles::GrainRows& rows, const resolved::ResolvedSpheres::Turn& turn) {
    resolved_->act(rows, turn);
  }
  /// The fluid's action on the particles at `now` [s], for `held` [s].
  void refresh(const particles::GrainRows& rows, double now, double held);
  void end_step(const particles::GrainRows& rows);
  /// Keeps the fluid as it is for the particles of the next step, where it is lagged.
  void keep_for_particles();

  /// Bodies were taken away.
  void bodies_changed(double time);
  /// The fluid's open fraction is another.
  void open_fraction_changed() {
    if (coupling_) coupling_->set_open_fraction(solver_->open_fraction());
  }

  /// Of a state without what only other bodies make necessary: the velocity alone.
  void load_velocity(sdk::ArchiveReader& archive);
  /// Among bodies that are not those the velocity was computed with: it goes round them, and the
  /// next step makes it consistent. At `time` [s].
  void adapt_velocity(double time);

  /// Momentum exchange per cell for a frame.
  [[nodiscard]] const std::vector<float>& momentum_exchange();

  /// Of a checkpoint.
  void set_counts(std::int64_t sub_steps, std::int64_t pressure_iterations) {
    sub_steps_ = sub_steps;
    pressure_iterations_ = pressure_iterations;
  }
  void add_parts(SaveParts& parts);
  /// `time()` [s] of the checkpoint, once its clock is loaded; `loaded` is called after each part.
  void add_parts(LoadParts& parts, const std::function<double()>& time,
                 const std::function<void()>& loaded);

 private:
  /// What a fluid alone meets: no solids and no forces of particles.
  struct NoParticles {
    fluid::CellField void_fraction;
    fluid::Exchange exchange;
  };
  /// The fluid of the step before.
  struct LaggedFluid {
    fluid::FaceField velocity, stress_divergence;
    fluid::CellField pressure;
  };
  /// Visits the fields of a lagged fluid with their names in a checkpoint.
  template <class Fluid, class Visit>
  static void for_fields(Fluid& fluid, const Visit& visit);
  void make_coupling(const fluid::Boundaries& boundaries);
  [[nodiscard]] const fluid::Exchange& exchange(const fluid::FaceField* force);
  void set_velocity(const fluid::FaceField& velocity);
  void make_resolved();
  /// Of all rows those that a drag law is for; given back to them where
  /// they are copies.
  const particles::GrainRows& unresolved(const particles::GrainRows& rows);

  const scenario::Setup& setup_;
  const Models& models_;
  fluid::Grid grid_;
  std::unique_ptr<fluid::FluidSolver> solver_;
  std::unique_ptr<coupling::Coupling> coupling_;
  /// Of the present step: what one node of the graph leaves to the next.
  std::optional<coupling::AssembledDrag> assembled_;
  std::optional<coupling::EvaluatedDrag> evaluated_;
  std::unique_ptr<resolved::ResolvedSpheres> resolved_;
  resolved::UnresolvedRows unresolved_;
  std::unique_ptr<NoParticles> no_particles_;  ///< only without coupling
  std::unique_ptr<LaggedFluid> lagged_;        ///< only where fluid and particles overlap
  std::unique_ptr<fluid::Exchange> forced_;    ///< of a step with a force besides
  std::int64_t sub_steps_ = 0;
  std::int64_t pressure_iterations_ = 0;
  std::vector<float> momentum_exchange_;
};

}  // namespace dust::run
