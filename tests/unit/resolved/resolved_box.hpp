// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/sphere.hpp"
#include "fluid_case.hpp"
#include "resolved/resolved_spheres.hpp"

#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

namespace dust::test {

/// Grains without contacts, as the resolved spheres see them: those of material 0 are resolved.
class FreeGrains {
 public:
  void add(Vec3 position, double diameter, double density, Vec3 velocity = {}) {
    const double mass = density * sdk::sphere_volume(diameter);
    position_.insert(position_.end(), {position.x, position.y, position.z, 0.5 * diameter});
    velocity_.insert(velocity_.end(), {velocity.x, velocity.y, velocity.z, 1.0 / mass});
    rotation_.insert(rotation_.end(), {0.0, 0.0, 0.0, 0.5 * diameter});
    action_.resize(position_.size());
    impulse_.resize(position_.size());
    weight_.push_back(1.0);
    material_.push_back(0);
    id_.push_back(static_cast<std::int64_t>(id_.size()));
  }
  [[nodiscard]] particles::GrainRows rows() {
    return {.count = id_.size(),
            .position = position_.data(),
            .velocity = velocity_.data(),
            .rotation = rotation_.data(),
            .id = id_.data(),
            .material = material_.data(),
            .weight = weight_.data(),
            .drag_relaxation = action_.data(),
            .fluid_impulse = impulse_.data()};
  }
  void turn(std::size_t n, Vec3 change) {
    for (int d = 0; d < 3; ++d) rotation_[4 * n + d] += change[d];
  }
  /// The motion in the fluid's action over `step` [s], exactly, under `gravity` [m/s2] given in
  /// one.
  void move(double step, Vec3 gravity = {}) {
    for (std::size_t n = 0; n < id_.size(); ++n) {
      const double left = std::exp(-action_[4 * n + 3] * step);
      for (int d = 0; d < 3; ++d) {
        double& v = velocity_[4 * n + d];
        const double before = v;
        const double change = (action_[4 * n + d] - before) * (1.0 - left);
        impulse_[4 * n + d] += change / velocity_[4 * n + 3];
        v += change + gravity[d] * step;
        position_[4 * n + d] += 0.5 * step * (before + v);
      }
    }
  }
  [[nodiscard]] Vec3 velocity(std::size_t n) const { return at(velocity_, n); }
  [[nodiscard]] Vec3 position(std::size_t n) const { return at(position_, n); }
  [[nodiscard]] Vec3 rotation(std::size_t n) const { return at(rotation_, n); }
  [[nodiscard]] Vec3 momentum() const {
    Vec3 sum;
    for (std::size_t n = 0; n < id_.size(); ++n) sum += velocity(n) / velocity_[4 * n + 3];
    return sum;
  }

 private:
  static Vec3 at(const std::vector<double>& rows, std::size_t n) {
    return {rows[4 * n], rows[4 * n + 1], rows[4 * n + 2]};
  }
  std::vector<double> position_, velocity_, rotation_, action_, impulse_, weight_;
  std::vector<std::int32_t> material_;
  std::vector<std::int64_t> id_;
};

/// A box of fluid with resolved spheres, step by step as in a run.
struct ResolvedBox : Case {
  FreeGrains grains;
  std::unique_ptr<resolved::ResolvedSpheres> spheres;
  double step = 0.0;              ///< [s]
  Vec3 gravity;                   ///< [m/s2] of the grains, buoyancy taken off
  bool is_held = false;           ///< spheres keep position and velocity
  std::vector<Vec3> mean_force;   ///< [N] of the fluid on each sphere in the last step
  std::vector<Vec3> mean_torque;  ///< [N m] likewise

  void begin() {
    start();
    spheres = std::make_unique<resolved::ResolvedSpheres>(
        grid, std::vector<std::int32_t>{0}, resolved::FluidAround{fluid.density, step, {}});
    solver->use(spheres->forcing());
  }
  void one_step() {
    spheres->begin_step(grains.rows(), solver->velocity());
    advance(step);
    spheres->evaluate(solver->velocity());
    mean_force.clear();
    mean_torque.clear();
    for (std::size_t n = 0; n < spheres->forcing().spheres().size(); ++n) {
      mean_force.push_back(spheres->forcing().given(n).linear / -step);
      mean_torque.push_back(spheres->forcing().given(n).angular / -step);
    }
    if (is_held) return;
    spheres->act(grains.rows(), [&](std::size_t n, Vec3 change) { grains.turn(n, change); });
    grains.move(step, gravity);
    spheres->end_step(grains.rows());
  }
  /// [N s] that the fluid has too much of and gives back in the next step: docs/theory/fluid.md,
  /// eq. (8).
  [[nodiscard]] Vec3 excess_momentum() const {
    MemoryArchive archive;
    solver->save(archive);
    Vec3 sum;
    for (int d = 0; d < 3; ++d) {
      const auto excess = archive.numbers(std::string("excess_") + "xyz"[d]);
      each_face(d, [&](int i, int j, int k, Vec3, double) {
        sum[d] += excess[static_cast<std::size_t>(grid.index(i, j, k))];
      });
    }
    return grid.cell_volume() * sum;
  }
  /// [N s] of the fluid in the whole box.
  [[nodiscard]] Vec3 fluid_momentum() const {
    Vec3 sum;
    for (int d = 0; d < 3; ++d) {
      each_face(d, [&](int, int, int, Vec3, double u) { sum[d] += u; });
    }
    return fluid.density * grid.cell_volume() * sum;
  }
};

/// A periodic box of fluid around a sphere of diameter 1 in its middle, viscosity and density one.
inline std::unique_ptr<ResolvedBox> cubic_array(int cells, double edge) {
  auto box = std::make_unique<ResolvedBox>();
  box->max = {edge, edge, edge};
  box->cells = {cells, cells, cells};
  box->fluid.density = 1.0;
  box->fluid.viscosity = 1.0;
  box->fluid.pressure_tolerance = 1e-6;
  return box;
}

/// Stokes drag on a sphere of a cubic array over that of a lone one in the same superficial flow,
/// once it is steady; `ratio` is viscosity x step / (density cell^2).
inline double array_drag(int cells, double solids, double ratio = 0.5) {
  const double edge = std::cbrt(std::numbers::pi / 6.0 / solids);
  auto box = cubic_array(cells, edge);
  const double h = edge / cells;
  box->step = ratio * h * h;
  box->is_held = true;
  box->grains.add({0.5 * edge, 0.5 * edge, 0.5 * edge}, 1.0, 1.0);
  box->begin();
  box->solver->set_velocity([&](Vec3) { return Vec3{1e-3, 0.0, 0.0}; });
  // Steady: the same to 2e-5 over a hundredth of the time in which viscosity crosses the sphere.
  const int pause = static_cast<int>(std::ceil(0.01 / box->step));
  double drag = 0.0;
  double before = 0.0;
  do {
    before = drag;
    for (int n = 0; n < pause; ++n) {
      box->one_step();
      // The flow through the box keeps its mean.
      box->set_source({box->mean_force[0].x / std::pow(edge, 3), 0.0, 0.0});
    }
    const double mean = box->fluid_momentum().x / std::pow(edge, 3);
    drag = box->mean_force[0].x / (3.0 * std::numbers::pi * mean);
  } while (std::abs(drag - before) > 2e-5 * drag && box->time < 2.0);
  return drag;
}

}  // namespace dust::test
