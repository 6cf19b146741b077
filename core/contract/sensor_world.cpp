// SPDX-License-Identifier: Apache-2.0
#include "contract/sensor_world.hpp"

#include <cmath>
#include <stdexcept>

namespace dust::contract {

void Figures::figure(std::string_view name, double value, std::string_view unit,
                     double uncertainty) {
  figures_.emplace_back(std::string(name), Figure{value, std::string(unit), uncertainty});
}
const Figure& Figures::at(const std::string& name) const {
  for (const auto& [known, figure] : figures_) {
    if (known == name) return figure;
  }
  throw std::runtime_error("no figure " + name);
}
std::vector<std::string> Figures::names() const {
  std::vector<std::string> names;
  for (const auto& [name, figure] : figures_) names.push_back(name + " [" + figure.unit + "]");
  return names;
}
Figures summary_of(const sdk::Sensor& sensor) {
  Figures figures;
  sensor.summary(figures);
  return figures;
}
Figures series_of(const sdk::Sensor& sensor) {
  Figures figures;
  sensor.series(figures);
  return figures;
}

void World::set_cells(int nx, int ny, int nz) {
  count[0] = nx;
  count[1] = ny;
  count[2] = nz;
  const auto cells = static_cast<std::size_t>(nx) * ny * nz;
  pressure.assign(cells, 0.0f);
  open_fraction.assign(cells, 1.0f);
  still_air_.assign(cells, 0.0f);
  no_solids_.assign(cells, 1.0f);
}

const sdk::WorldView& World::view() {
  const double l = units.length;
  const double v = units.of(sdk::dimension::velocity);
  const double f = units.of(sdk::dimension::force);
  id_.clear();
  for (auto& column : columns_) column.clear();
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const Grain& g = grains[i];
    id_.push_back(static_cast<std::int64_t>(i));
    const double values[18] = {l * g.now.x,
                               l * g.now.y,
                               l * g.now.z,
                               l * g.before.x,
                               l * g.before.y,
                               l * g.before.z,
                               v * g.velocity.x,
                               v * g.velocity.y,
                               v * g.velocity.z,
                               0.0,
                               0.0,
                               0.0,
                               f * g.force.x,
                               f * g.force.y,
                               f * g.force.z,
                               l * g.diameter,
                               units.mass * g.mass,
                               g.weight};
    for (int c = 0; c < 18; ++c) columns_[c].push_back(values[c]);
  }
  material_.assign(grains.size(), 0);
  classes_shown_ = class_diameters;
  for (double& d : classes_shown_) d *= l;
  pressure_shown_ = pressure;
  const auto p = static_cast<float>(units.of(sdk::dimension::pressure));
  for (float& value : pressure_shown_) value *= p;
  view_ = {};
  view_.time = units.time * time;
  view_.interval = units.time * interval;
  view_.domain_min = l * domain_min;
  view_.domain_max = l * domain_max;
  view_.gravity = units.of(sdk::dimension::acceleration) * gravity;
  view_.class_diameters = classes_shown_;
  view_.emitted_mass = units.mass * emitted_mass;
  show_columns();
  return view_;
}

void World::show_columns() {
  sdk::GrainColumns& g = view_.grains;
  g.id = id_;
  g.material = material_;
  std::span<const double>* targets[18] = {
      &g.x,          &g.y,          &g.z,          &g.x_before,   &g.y_before,   &g.z_before,
      &g.velocity_x, &g.velocity_y, &g.velocity_z, &g.rotation_x, &g.rotation_y, &g.rotation_z,
      &g.force_x,    &g.force_y,    &g.force_z,    &g.diameter,   &g.mass,       &g.weight};
  for (int c = 0; c < 18; ++c) *targets[c] = columns_[c];
  sdk::FluidColumns& f = view_.fluid;
  f.spacing = units.length * spacing;
  for (int d = 0; d < 3; ++d) f.count[d] = count[d];
  f.density = units.of(sdk::dimension::density) * density;
  f.viscosity = units.of(sdk::dimension::dynamic_viscosity) * 1.8e-5;
  f.pressure = pressure_shown_;
  f.open_fraction = open_fraction;
  f.velocity_x = f.velocity_y = f.velocity_z = still_air_;
  f.void_fraction = no_solids_;
}

void step(sdk::Sensor& sensor, World& world) {
  world.time += world.interval;
  sensor.observe(world.view());
}

Scene::Scene(bool is_empty) : is_empty_(is_empty) {
  if (is_empty_) return;
  world.set_cells(33, 5, 35);
  world.spacing = {0.01, 0.0022, 0.01};
}

void Scene::show(sdk::Sensor& sensor) {
  if (!is_empty_) {
    fill(world.time + world.interval);
    world.emitted_mass += 6e-6;
  }
  step(sensor, world);
}

void Scene::fill(double time) {
  world.grains.clear();
  for (int n = 0; n < 400; ++n) {
    // Grain n starts at its own moment and height again and again.
    const double phase = random_.uniform(static_cast<std::uint64_t>(n), 0);
    const double since = std::fmod(time + 0.2 * phase, 0.2);
    if (since < world.interval) continue;
    add(n, since, 0.7 + 0.2 * random_.uniform(static_cast<std::uint64_t>(n), 1));
  }
  for (int n = 0; n < 60; ++n) ride(n, time);
  for (int k = 0; k < 35; ++k) {
    for (int j = 0; j < 5; ++j) {
      for (int i = 0; i < 33; ++i) {
        const double a = std::hypot(i - 8.0, k - 20.0);
        const double b = std::hypot(i - 20.5, k - 9.5);
        const double c = std::hypot(i - 12.0, k - 20.0);  // 4 cells from the first
        world.pressure_at(i, j, k) = static_cast<float>(
            (1 + 0.3 * std::sin(300 * time)) *
            (-std::exp(-a * a) - 0.6 * std::exp(-b * b) - 0.9 * std::exp(-c * c)));
      }
    }
  }
}

void Scene::finish(Grain& g, int n) {
  g.diameter = n % 3 == 0 ? 10e-6 : n % 3 == 1 ? 300e-6 : 600e-6;
  g.mass = 1388.0 * g.diameter * g.diameter * g.diameter;
  g.weight = n % 3 == 0 ? 0.05 : 1.0;
  g.force = {0, 0, -9.81 * g.mass};
  world.grains.push_back(g);
}

void Scene::add(int n, double since, double speed) {
  Grain g;
  const double y = 0.011 * random_.uniform(static_cast<std::uint64_t>(n), 2);
  const auto place = [&](double t) {
    return sdk::Vec3{0.07 + speed * t, y, 0.205 - 0.5 * 9.81 * t * t};
  };
  g.before = place(since - world.interval);
  g.now = place(since);
  g.velocity = {speed, 0, -9.81 * since};
  finish(g, n);
}

void Scene::ride(int n, double time) {
  const double speed = n % 2 == 0 ? 0.8 : 0.3;
  const double place = std::fmod(0.08 * n / 60 + 10.0 - speed * time, 0.08);
  Grain g;
  g.now = {place, 0.005, 0.115};
  g.before = g.now + sdk::Vec3{speed * world.interval, 0, 0};
  g.velocity = {-speed, 0, 0};
  finish(g, n);
}

}  // namespace dust::contract
