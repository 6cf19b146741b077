// SPDX-License-Identifier: Apache-2.0
#include "contract/scenes/synthetic_scene.hpp"

#include "contract/scenes/scene_columns.hpp"

namespace dust::contract {

void set_cells(SyntheticScene& scene, int nx, int ny, int nz) {
  scene.count[0] = nx;
  scene.count[1] = ny;
  scene.count[2] = nz;
  const auto cells = static_cast<std::size_t>(nx) * ny * nz;
  scene.pressure.assign(cells, 0.0f);
  scene.open_fraction.assign(cells, 1.0f);
  for (auto& component : scene.velocity) component.assign(cells, 0.0f);
  scene.void_fraction.assign(cells, 1.0f);
}

void step(sdk::Sensor& sensor, SyntheticScene& scene) {
  scene.time += scene.interval;
  SceneColumns columns(scene);
  sensor.observe(columns.view());
}

}  // namespace dust::contract
