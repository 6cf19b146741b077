// SPDX-License-Identifier: Apache-2.0
#include "contract/sensor_scene.hpp"

#include <algorithm>
#include <cmath>

namespace dust::contract {

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
  touch(time);
  load_walls(time);
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
  blow(time);
}

/// Air that turns, and rises through solids below, faster and then slower again, with a bubble in
/// them that grows; beside the wells a bed that costs pressure until it is carried.
void Scene::blow(double time) {
  const double rise = 0.56 - 8.0 * std::abs(time - 0.045);
  const double drop = 1000.0 * std::min(rise, 0.35);
  const double swing = 1.0 + 0.2 * std::sin(250 * time);
  world.for_cells([&](std::size_t c, sdk::Vec3 x) {
    world.velocity[0][c] = static_cast<float>(swing * 3.0 * (x.z - 0.15));
    world.velocity[1][c] = static_cast<float>(0.1 * swing * x.x);
    world.velocity[2][c] = static_cast<float>(rise - 2.0 * (x.x - 0.15) * (x.x - 0.15));
    const bool is_bubble = std::hypot(x.x - 0.05, x.z - 0.02 - 0.4 * time) < 0.012 + 0.2 * time;
    world.void_fraction[c] = x.z < 0.1 && !is_bubble ? 0.6f : 0.95f;
    if (x.x > 0.28) world.pressure[c] += static_cast<float>(drop * (0.35 - x.z) / 0.35);
  });
}

/// Riders press each other and the belt, more and more of them as time swings.
void Scene::touch(double time) {
  world.contacts.clear();
  const auto last = static_cast<std::int32_t>(world.grains.size());
  const int pairs = 20 + static_cast<int>(15 * std::sin(200 * time));
  for (std::int32_t i = last - 60; i < last - 60 + pairs; ++i) {
    const double force = 1e-6 * (1 + i % 7);
    const sdk::Vec3 branch{1e-4 * (1 + i % 3), 0, 2e-4};
    world.contacts.push_back({i, i + 1, (-force / norm(branch)) * branch, branch, 1e-9});
    world.contacts.push_back({i, -1, {0, 0, force}, {0, 0, -2e-4}, 1e-9});
    world.contacts.push_back({i + 1, i + 3, {0, 0, 0}, {0, 0, 2e-4}, -1e-9});
  }
}

/// A belt that carries and is hit, and a plate of the group "chute".
void Scene::load_walls(double time) {
  const double swing = std::sin(300 * time);
  world.walls = {{"belt",
                  "",
                  {0.01, 0, -0.1 - 0.02 * swing},
                  {0, 1e-3, 0},
                  0.02 + 0.004 * swing,
                  0.01 + 0.001 * swing,
                  40},
                 {"plate", "chute", {0.2, 0, -0.3 * swing}, {0, 2e-3, 1e-4}, 0, 2e-3, 7}};
  world.impacts.clear();
  for (int n = 0; n < 20; ++n) {
    const double u = random_.uniform(static_cast<std::uint64_t>(n), 3);
    world.impacts.push_back(
        {n % 2, std::pow(10.0, -11 + 4 * u), 1e-10 * u, n % 3 == 0 ? 0.05 : 1.0});
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
