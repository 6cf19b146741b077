// SPDX-License-Identifier: Apache-2.0
#include "contract/scenes/synthetic_scene.hpp"

#include "contract/scenes/scene_columns.hpp"
#include "dust/sdk/airborne_dust.hpp"

#include <array>
#include <cmath>

namespace dust::contract {
namespace {

/// Two classes of airborne dust that come and go, for sensors that look at dust. Their sizes and
/// density stay in SI, which conventions of sampling are tied to.
void show_dust(sdk::Sensor& sensor, const SyntheticScene& scene, const sdk::WorldView& view) {
  auto* observer = dynamic_cast<sdk::DustObserver*>(&sensor);
  if (observer == nullptr || scene.pressure.empty()) return;
  constexpr std::array<double, 2> k_diameters = {3e-6, 20e-6};
  constexpr double k_density = 2700.0;  // kg/m3
  std::array<std::vector<float>, 2> columns;
  std::array<std::span<const float>, 2> spans;
  const double swing = 1e-4 * (1.0 + 0.2 * std::sin(250.0 * scene.time));
  for (std::size_t n = 0; n < columns.size(); ++n) {
    columns[n].resize(scene.pressure.size());
    for_cells(scene, [&](std::size_t cell, sdk::Vec3 x) {
      const double c = swing * (1.0 + x.x + static_cast<double>(n) * x.z);
      columns[n][cell] = static_cast<float>(scene.units.of(sdk::dimension::density) * c);
    });
    spans[n] = columns[n];
  }
  observer->observe_dust(view, {k_diameters, k_density, spans});
}

}  // namespace

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

void begin(sdk::Sensor& sensor, const SyntheticScene& scene) {
  const SceneColumns columns(scene, sensor);
  sdk::WorldView world = columns.view();
  world.interval = 0.0;
  sensor.begin(world);
}

void step(sdk::Sensor& sensor, SyntheticScene& scene) {
  scene.time += scene.interval;
  SceneColumns columns(scene, sensor);
  sensor.observe(columns.view());
  show_dust(sensor, scene, columns.view());
}

}  // namespace dust::contract
