// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "support/dem_rig.hpp"
#include "unit/coupling/world.hpp"

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace dust::test {

/// A prescribed fluid without feedback, grains in it, and forces besides drag by name.
struct Still {
  struct Force {
    std::string name;
    std::map<std::string, sdk::Value> values = {};
  };

  Still(World::Choice choice, const std::vector<Force>& names, sdk::Vec3 gravity_vector = {},
        std::vector<particles::Surface> surfaces = {})
      : world(with_box(std::move(choice))), pressure(world.grid.size, 0.0) {
    world.setup.gravity = gravity_vector;
    world.restart();
    for (const Force& f : names) {
      forces.push_back(ModelLoader::make<sdk::FluidForce>("fluid_force", f.name, f.values));
    }
    world.coupling->use(forces, std::move(surfaces));
  }
  /// Ten metres around the origin, one-way, Stokes drag unless chosen otherwise.
  static World::Choice with_box(World::Choice choice) {
    choice.is_one_way = true;
    if (choice.max.x == 1.0) {
      choice.min = {-10, -10, -10};
      choice.max = {10, 10, 10};
    }
    if (!choice.factor) choice.factor = [](double, double) { return 1.0; };
    return choice;
  }
  /// What the DEM takes for gravity.
  [[nodiscard]] sdk::Vec3 weight(double grain_density) const {
    const bool is_taken = coupling::takes_over_buoyancy(forces);
    return (is_taken ? 1.0 : 1.0 - world.choice.density / grain_density) * world.setup.gravity;
  }
  /// Total force of the fluid [N] on grain g as the last refresh left it.
  [[nodiscard]] sdk::Vec3 force(std::size_t g = 0) const {
    sdk::Vec3 f;
    for (int d = 0; d < 3; ++d) {
      const double mass = 1.0 / world.grains.velocity[4 * g + 3];
      f[d] = mass * world.grains.action[4 * g + 3] *
             (world.grains.action[4 * g + d] - world.grains.velocity[4 * g + d]);
    }
    return f;
  }
  void map() { world.begin_step(world.choice.fluid_step); }
  void refresh(double held) {
    world.refresh({world.velocity, world.stress, &pressure, time, held});
  }
  /// One fluid step of `count` refreshes.
  void step(int count, sdk::Vec3 dem_gravity) {
    const double held = world.choice.fluid_step / count;
    map();
    for (int n = 0; n < count; ++n) {
      refresh(held);
      world.grains.move(held, dem_gravity);
      time += held;
    }
    world.end_step();
  }

  World world;
  fluid::CellField pressure;
  std::vector<std::unique_ptr<sdk::FluidForce>> forces;
  double time = 0.0;
};

/// Stokes drag per slip [kg/s].
inline double stokes_drag(double viscosity, double diameter) {
  return 3.0 * 3.14159265358979323846 * viscosity * diameter;
}

}  // namespace dust::test
