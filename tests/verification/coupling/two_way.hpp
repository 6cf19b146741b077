// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fluid/fluid_solver.hpp"
#include "unit/coupling/world.hpp"
#include "verification/fluid/fluid_case.hpp"

#include <array>
#include <cmath>
#include <memory>

namespace dust::test {

/// A world whose fluid is solved, coupled both ways as a run couples them. Sides left out are
/// periodic in World::Choice and null here. `drive` [N/m3] is a uniform pressure gradient (its
/// negative) that a periodic box cannot hold: it acts on fluid and grains alike.
struct TwoWay {
  using Sides = std::array<std::unique_ptr<TestSide>, 6>;

  TwoWay(const World::Choice& choice, Sides boundaries,
         std::vector<scenario::FluidRegion> regions = {}, double tolerance = 1e-8,
         bodies::BodySet solids = {})
      : sides(std::move(boundaries)), world(choice), bodies(std::move(solids)) {
    scenario::FluidSpec& fluid = *world.setup.fluid;
    fluid.pressure_tolerance = tolerance;
    fluid.regions = std::move(regions);
    world.setup.gravity = {0, 0, -k_gravity};
    fluid.disturbance_correction =
        choice.disturbance_correction.value_or(scenario::DisturbanceCorrection::automatic);
    fluid::Boundaries pointers{};
    for (std::size_t n = 0; n < 6; ++n) pointers[n] = sides[n].get();
    solver = std::make_unique<fluid::FluidSolver>(world.grid, fluid, bodies, pointers);
    world.open = solver->open_fraction();
    world.restart();
    world.coupling->use({}, particles::surfaces_of(world.setup, bodies));
    world.coupling->use_boundaries(pointers);
    world.coupling->use_thin_bodies(solver->thin_bodies());
  }

  /// One fluid step in the order of a run. Grains move under `gravity`, or are held where they are.
  void step(sdk::Vec3 gravity, bool is_held = false) {
    coupling::Coupling& coupling = *world.coupling;
    const double length = world.choice.fluid_step;
    // The grains were there before: the first step must not push their volume of fluid aside.
    if (time == 0.0) world.begin_step(length);
    const bool overlaps = world.choice.overlaps;
    world.begin_step(length);
    solver->advance(time, length, coupling.void_fraction_before(), coupling.void_fraction(),
                    driven(coupling.exchange()));
    time += length;
    if (!overlaps) {
      world.evaluate(solver->drag_velocity());
      hold_fluid();
    }
    const int refreshes = static_cast<int>(std::lround(length / coupling.refresh_interval()));
    for (int n = 0; n < refreshes; ++n) {
      world.refresh();
      if (is_held) {
        world.grains.hold(length / refreshes);
      } else {
        world.grains.move(length / refreshes, gravity);
      }
    }
    if (overlaps) {
      world.evaluate(solver->drag_velocity());
      hold_fluid();
    }
    world.end_step();
  }
  /// What the grains see from now on.
  void hold_fluid() {
    world.velocity = world.choice.overlaps ? solver->mean_velocity() : solver->velocity();
    world.stress = solver->stress_divergence();
    for (int d = 0; d < 3; ++d) {
      for (double& s : world.stress.component[d]) s += drive[d];
    }
  }
  const fluid::Exchange& driven(const fluid::Exchange& exchange) {
    if (norm(drive) == 0.0) return exchange;
    with_drive = exchange;
    for (int d = 0; d < 3; ++d) {
      for (double& s : with_drive.source.component[d]) s += drive[d];
    }
    return with_drive;
  }

  static constexpr double k_gravity = 9.81;
  Sides sides;
  World world;
  bodies::BodySet bodies;
  std::unique_ptr<fluid::FluidSolver> solver;
  fluid::Exchange with_drive;
  sdk::Vec3 drive;
  double time = 0.0;
};

}  // namespace dust::test
