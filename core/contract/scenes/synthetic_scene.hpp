// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contract/input/units.hpp"
#include "contract/scenes/figures.hpp"
#include "dust/sdk/sensor.hpp"

#include <cstdint>
#include <string>
#include <vector>

/// A scene made by hand for sensors to look at: plain data, and what fills it.
namespace dust::contract {

struct Grain {
  sdk::Vec3 before;
  sdk::Vec3 now;
  sdk::Vec3 velocity;
  double diameter = 300e-6;
  double mass = 1e-9;
  double weight = 1.0;
  sdk::Vec3 force;
  sdk::Vec3 angular_velocity = {};
};

/// A contact of grain `i` with grain `j`, or with a wall (-1).
struct Contact {
  std::int32_t i = 0;
  std::int32_t j = -1;
  sdk::Vec3 force;   ///< on i
  sdk::Vec3 branch;  ///< from i to j, or to the wall
  double overlap = 1e-9;
  sdk::Vec3 wall_velocity{};  ///< of its surface
};

struct Wall {
  std::string name;
  std::string group;
  sdk::Vec3 force;
  sdk::Vec3 torque;
  double power = 0.0;
  double mass = 0.0;
  std::int64_t contacts = 0;
};

/// Particles, contacts, walls and air at one moment, in SI.
struct SyntheticScene {
  double time = 0.0;
  double interval = 0.001;
  sdk::Vec3 domain_min{0, 0, 0};
  sdk::Vec3 domain_max{0.33, 0.011, 0.35};
  sdk::Vec3 gravity{0, 0, -9.81};
  std::vector<double> class_diameters = {10e-6, 300e-6, 600e-6};
  double emitted_mass = 0.0;
  std::vector<Grain> grains;
  std::vector<Contact> contacts;
  std::vector<Wall> walls;
  std::vector<sdk::WallImpact> impacts;
  std::vector<sdk::WallSliding> slidings;
  int count[3] = {0, 0, 0};
  sdk::Vec3 spacing{0.001, 0.001, 0.001};
  double density = 1.2;
  double viscosity = 1.8e-5;
  std::vector<float> pressure;
  std::vector<float> open_fraction;
  std::vector<float> velocity[3];
  std::vector<float> void_fraction;
  Units units;  ///< in which it is shown to a sensor; everything above is SI
};

/// Sets the number of cells; quiescent air, pressure 0, all open, no solids.
void set_cells(SyntheticScene& scene, int nx, int ny, int nz);

/// Number of cell (i, j, k) in the scene's columns, x fastest.
inline std::size_t cell_at(const SyntheticScene& scene, int i, int j, int k) {
  return static_cast<std::size_t>(i + scene.count[0] * (j + scene.count[1] * k));
}
inline float& pressure_at(SyntheticScene& scene, int i, int j, int k) {
  return scene.pressure[cell_at(scene, i, j, k)];
}

/// Calls set(cell, centre [m]) for all cells.
template <class Set>
void for_cells(const SyntheticScene& scene, const Set& set) {
  const sdk::Vec3& d = scene.spacing;
  for (int k = 0; k < scene.count[2]; ++k) {
    for (int j = 0; j < scene.count[1]; ++j) {
      for (int i = 0; i < scene.count[0]; ++i) {
        set(cell_at(scene, i, j, k),
            scene.domain_min + sdk::Vec3{(i + 0.5) * d.x, (j + 0.5) * d.y, (k + 0.5) * d.z});
      }
    }
  }
}

/// Shows the scene to `sensor` as the world in which it begins; see sdk::Sensor::begin.
void begin(sdk::Sensor& sensor, const SyntheticScene& scene);
/// Advances the scene's time by its interval and shows it to `sensor` as the next sample.
void step(sdk::Sensor& sensor, SyntheticScene& scene);

}  // namespace dust::contract
