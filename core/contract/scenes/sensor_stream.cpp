// SPDX-License-Identifier: Apache-2.0
#include "contract/scenes/sensor_stream.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace dust::contract {

namespace {

constexpr int k_nx = 33;
constexpr int k_ny = 5;
constexpr int k_nz = 35;

/// Pressure in a plane of cells across y: three wells, of which two are 4 cells apart.
std::vector<double> wells() {
  std::vector<double> all;
  all.reserve(k_nx * k_nz);
  for (int k = 0; k < k_nz; ++k) {
    for (int i = 0; i < k_nx; ++i) {
      const auto well = [&](double x, double z) {
        return std::exp(-((i - x) * (i - x) + (k - z) * (k - z)));
      };
      all.push_back(-well(8.0, 20.0) - 0.6 * well(20.5, 9.5) - 0.9 * well(12.0, 20.0));
    }
  }
  return all;
}

}  // namespace

SensorStream::SensorStream(bool is_empty, const Units& units) : is_empty_(is_empty) {
  scene_.units = units;
  if (is_empty_) return;
  set_cells(scene_, k_nx, k_ny, k_nz);
  scene_.spacing = {0.01, 0.0022, 0.01};
}

void SensorStream::show(sdk::Sensor& sensor) {
  if (!is_empty_) {
    fill(scene_.time + scene_.interval);
    scene_.emitted_mass += 6e-6;
  }
  step(sensor, scene_);
}

void SensorStream::fill(double time) {
  scene_.grains.clear();
  for (int n = 0; n < 400; ++n) {
    // Grain n starts at its own moment and height again and again.
    const double phase = random_.uniform(static_cast<std::uint64_t>(n), 0);
    const double since = std::fmod(time + 0.2 * phase, 0.2);
    if (since < scene_.interval) continue;
    add(n, since, 0.7 + 0.2 * random_.uniform(static_cast<std::uint64_t>(n), 1));
  }
  for (int n = 0; n < 60; ++n) ride(n, time);
  touch(time);
  load_walls(time);
  // The same for every sensor and step: these scenes are shown thousands of times.
  static const std::vector<double> k_wells = wells();
  const double swing = 1 + 0.3 * std::sin(300 * time);
  for (int k = 0; k < k_nz; ++k) {
    for (int j = 0; j < k_ny; ++j) {
      for (int i = 0; i < k_nx; ++i) {
        const double well = k_wells[static_cast<std::size_t>(k * k_nx + i)];
        pressure_at(scene_, i, j, k) = static_cast<float>(swing * well);
      }
    }
  }
  blow(time);
}

/// Air that turns, and rises through solids below, faster and then slower again, with a bubble in
/// them that grows; beside the wells a bed that costs pressure until it is carried.
void SensorStream::blow(double time) {
  const double rise = 0.56 - 8.0 * std::abs(time - 0.045);
  const double drop = 1000.0 * std::min(rise, 0.35);
  const double swing = 1.0 + 0.2 * std::sin(250 * time);
  const double reach = 0.012 + 0.2 * time;
  for_cells(scene_, [&](std::size_t c, sdk::Vec3 x) {
    scene_.velocity[0][c] = static_cast<float>(swing * 3.0 * (x.z - 0.15));
    scene_.velocity[1][c] = static_cast<float>(0.1 * swing * x.x);
    scene_.velocity[2][c] = static_cast<float>(rise - 2.0 * (x.x - 0.15) * (x.x - 0.15));
    const double across = x.x - 0.05;
    const double up = x.z - 0.02 - 0.4 * time;
    const bool is_bubble = across * across + up * up < reach * reach;
    scene_.void_fraction[c] = x.z < 0.1 && !is_bubble ? 0.6f : 0.95f;
    if (x.x > 0.28) scene_.pressure[c] += static_cast<float>(drop * (0.35 - x.z) / 0.35);
  });
}

/// Riders press each other and the belt, more and more of them as time swings.
void SensorStream::touch(double time) {
  scene_.contacts.clear();
  scene_.slidings.clear();
  const auto last = static_cast<std::int32_t>(scene_.grains.size());
  const int pairs = 20 + static_cast<int>(15 * std::sin(200 * time));
  for (std::int32_t i = last - 60; i < last - 60 + pairs; ++i) {
    const double force = 1e-6 * (1 + i % 7);
    const sdk::Vec3 branch{1e-4 * (1 + i % 3), 0, 2e-4};
    scene_.contacts.push_back({i, i + 1, (-force / norm(branch)) * branch, branch, 1e-9});
    scene_.contacts.push_back({i, -1, {0, 0, force}, {0, 0, -2e-4}, 1e-9, {0.1, 0, 0}});
    scene_.contacts.push_back({i + 1, i + 3, {0, 0, 0}, {0, 0, 2e-4}, -1e-9});
    const Grain& g = scene_.grains[static_cast<std::size_t>(i)];
    const double impulse = g.weight * force * scene_.interval;
    const double sliding = impulse * norm(g.velocity - sdk::Vec3{0.1, 0, 0});
    scene_.slidings.push_back(
        {i % 4 == 0 ? 1 : 0, g.now - sdk::Vec3{0, 0, 2e-4}, impulse, sliding, 0.3 * sliding});
  }
}

/// A belt that carries and is hit, and a plate of the group "chute".
void SensorStream::load_walls(double time) {
  const double swing = std::sin(300 * time);
  scene_.walls = {{"belt",
                   "",
                   {0.01, 0, -0.1 - 0.02 * swing},
                   {0, 1e-3, 0},
                   0.02 + 0.004 * swing,
                   0.01 + 0.001 * swing,
                   40},
                  {"plate", "chute", {0.2, 0, -0.3 * swing}, {0, 2e-3, 1e-4}, 0, 2e-3, 7}};
  scene_.impacts.clear();
  for (int n = 0; n < 20; ++n) {
    const double u = random_.uniform(static_cast<std::uint64_t>(n), 3);
    scene_.impacts.push_back(
        {n % 2, std::pow(10.0, -11 + 4 * u), 1e-10 * u, n % 3 == 0 ? 0.05 : 1.0});
  }
}

void SensorStream::finish(Grain& g, int n) {
  g.diameter = n % 3 == 0 ? 10e-6 : n % 3 == 1 ? 300e-6 : 600e-6;
  g.mass = 1388.0 * g.diameter * g.diameter * g.diameter;
  g.weight = n % 3 == 0 ? 0.05 : 1.0;
  g.force = {0, 0, -9.81 * g.mass};
  scene_.grains.push_back(g);
}

void SensorStream::add(int n, double since, double speed) {
  Grain g;
  const double y = 0.011 * random_.uniform(static_cast<std::uint64_t>(n), 2);
  const auto place = [&](double t) {
    return sdk::Vec3{0.07 + speed * t, y, 0.205 - 0.5 * 9.81 * t * t};
  };
  g.before = place(since - scene_.interval);
  g.now = place(since);
  g.velocity = {speed, 0, -9.81 * since};
  finish(g, n);
}

void SensorStream::ride(int n, double time) {
  const double speed = n % 2 == 0 ? 0.8 : 0.3;
  const double place = std::fmod(0.08 * n / 60 + 10.0 - speed * time, 0.08);
  Grain g;
  g.now = {place, 0.005, 0.115};
  g.before = g.now + sdk::Vec3{speed * scene_.interval, 0, 0};
  g.velocity = {-speed, 0, 0};
  finish(g, n);
}

}  // namespace dust::contract
