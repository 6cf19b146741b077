// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contract/memory_archive.hpp"
#include "contract/plugin_library.hpp"
#include "coupling/coupling.hpp"
#include "dust/sdk/random.hpp"
#include "dust/sdk/sphere.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dust::test {

/// Sand and air of the thesis.
inline constexpr double k_sand = 2650.0;           // kg/m3
inline constexpr double k_air = 1.2139;            // kg/m3
inline constexpr double k_air_viscosity = 1.8e-5;  // Pa s

/// Grains by hand, with the columns the DEM would hold, and a motion that obeys drag_relaxation to
/// the letter: dv/dt = rate (target - v) + g, integrated exactly while the action is constant.
struct Grains {
  std::vector<double> position, velocity, rotation, action, impulse, weight;
  std::vector<std::int64_t> id;
  std::vector<std::int32_t> material;

  void add(sdk::Vec3 p, sdk::Vec3 v, double diameter, double density = k_sand, double w = 1.0) {
    const double mass = density * sdk::sphere_volume(diameter);
    position.insert(position.end(), {p.x, p.y, p.z, 0.5 * diameter});
    velocity.insert(velocity.end(), {v.x, v.y, v.z, 1.0 / mass});
    rotation.insert(rotation.end(), 4, 0.0);
    action.insert(action.end(), 4, 0.0);
    impulse.insert(impulse.end(), 4, 0.0);
    weight.push_back(w);
    id.push_back(next_id++);
    material.push_back(0);
  }
  [[nodiscard]] std::size_t count() const { return id.size(); }
  [[nodiscard]] particles::GrainRows rows() {
    return {count(),         position.data(), velocity.data(), rotation.data(), id.data(),
            material.data(), weight.data(),   action.data(),   impulse.data()};
  }
  [[nodiscard]] double solid_volume() const {
    double sum = 0.0;
    for (std::size_t g = 0; g < count(); ++g) {
      sum += weight[g] * sdk::sphere_volume(2.0 * position[4 * g + 3]);
    }
    return sum;
  }
  void swap(std::size_t a, std::size_t b) {
    for (auto* c : {&position, &velocity, &rotation, &action, &impulse}) {
      for (std::size_t n = 0; n < 4; ++n) std::swap((*c)[4 * a + n], (*c)[4 * b + n]);
    }
    std::swap(weight[a], weight[b]);
    std::swap(id[a], id[b]);
    std::swap(material[a], material[b]);
  }
  void remove_last() {
    for (auto* c : {&position, &velocity, &rotation, &action, &impulse}) c->resize(c->size() - 4);
    weight.pop_back();
    id.pop_back();
    material.pop_back();
  }
  /// Free flight over `step` under `gravity`.
  void move(double step, sdk::Vec3 gravity) {
    for (std::size_t g = 0; g < count(); ++g) {
      const double rate = action[4 * g + 3];
      const double mass = 1.0 / velocity[4 * g + 3];
      const double loss = -std::expm1(-rate * step);
      for (int d = 0; d < 3; ++d) {
        double& v = velocity[4 * g + d];
        const double end = action[4 * g + d] + gravity[d] / rate;
        const double change = (end - v) * loss;
        position[4 * g + d] += end * step - (end - v) * loss / rate;
        impulse[4 * g + d] += mass * (change - gravity[d] * step);
        v += change;
      }
    }
  }
  /// Held in place by something else, whatever the fluid does.
  void hold(double step) {
    for (std::size_t g = 0; g < count(); ++g) {
      const double mass = 1.0 / velocity[4 * g + 3];
      for (int d = 0; d < 3; ++d) {
        impulse[4 * g + d] +=
            mass * action[4 * g + 3] * (action[4 * g + d] - velocity[4 * g + d]) * step;
      }
    }
  }

  std::int64_t next_id = 1;
};

/// A drag law from a function F(Re, eps).
class FunctionLaw final : public sdk::DragLaw {
 public:
  explicit FunctionLaw(std::function<double(double, double)> factor) : factor_(std::move(factor)) {}
  void evaluate(const sdk::DragBatch& batch) const override {
    for (std::size_t g = 0; g < batch.count; ++g) {
      batch.factor[g] = factor_(batch.reynolds[g], batch.void_fraction[g]);
    }
  }

 private:
  std::function<double(double, double)> factor_;
};

/// A prescribed fluid on a grid, and a coupling to it.
struct World {
  struct Choice {
    sdk::Vec3 min{0, 0, 0};
    sdk::Vec3 max{1, 1, 1};
    std::array<int, 3> cells{4, 4, 4};
    std::array<bool, 3> periodic{false, false, false};
    std::string drag = "gidaspow";  ///< a plugin, unless `factor` is given
    std::function<double(double, double)> factor;
    std::string voidage = "divided";
    std::string momentum_set = "I";
    double fluid_step = 1e-3;
    double density = k_air;
    double viscosity = k_air_viscosity;
    bool is_one_way = false;
    /// In a prescribed fluid grains feel what that shows; where it is solved, as by default.
    std::optional<scenario::DisturbanceCorrection> disturbance_correction;
    bool overlaps = false;
    std::vector<double> coarse_graining{1.0};   ///< by material
    std::function<double(int, int, int)> open;  ///< open fraction of a cell; null = 1 everywhere
  };

  World(World&&) = delete;
  explicit World(const Choice& c)
      : choice(c),
        grid(fluid::Grid::make(c.min, c.max, c.cells, c.periodic)),
        open(grid.size, 1.0),
        velocity(grid),
        stress(grid),
        voidage(make_model<sdk::VoidageRule>("voidage", c.voidage)),
        drag(c.factor ? std::make_unique<FunctionLaw>(c.factor)
                      : make_model<sdk::DragLaw>("drag", c.drag)) {
    setup.time.fluid_step = c.fluid_step;
    setup.fluid.emplace();
    setup.fluid->cells = c.cells;
    setup.fluid->density = c.density;
    setup.fluid->viscosity = c.viscosity;
    setup.fluid->momentum_set = c.momentum_set;
    setup.fluid->is_one_way = c.is_one_way;
    setup.fluid->disturbance_correction =
        c.disturbance_correction.value_or(scenario::DisturbanceCorrection::felt);
    setup.fluid->overlaps_grains = c.overlaps;
    for (const double ratio : c.coarse_graining) setup.materials.push_back({"sand", {}, ratio});
    if (c.open) {
      for_cells([&](int i, int j, int k) { open[grid.index(i, j, k)] = c.open(i, j, k); });
    }
    restart();
  }
  void restart() {
    assembled.reset();
    evaluated.reset();
    coupling = std::make_unique<coupling::Coupling>(setup, grid, open, *voidage, *drag);
  }

  // The stages of an exchange: each takes what the one before has left.
  void begin_step(double step) {
    evaluated.reset();
    assembled = coupling->begin_step(grains.rows(), step);
  }
  void evaluate(const fluid::FaceField& drag_velocity) {
    evaluated = coupling->evaluate(std::move(assembled).value(), grains.rows(), drag_velocity);
    assembled.reset();
  }
  /// A fluid that was not evaluated is prescribed: drag acted on the velocity that it has.
  void refresh(const coupling::FluidState& fluid) {
    if (assembled && !choice.overlaps) evaluate(fluid.velocity);
    if (assembled) {
      coupling->refresh(*assembled, grains.rows(), fluid);
    } else {
      coupling->refresh(evaluated.value(), grains.rows(), fluid);
    }
  }
  void refresh() { refresh({velocity, stress}); }
  void end_step() {
    if (assembled) evaluate(velocity);
    coupling->end_step(std::move(evaluated).value(), grains.rows());
    evaluated.reset();
  }

  template <class Work>
  void for_cells(const Work& work) const {
    for (int k = 0; k < grid.count[2]; ++k) {
      for (int j = 0; j < grid.count[1]; ++j) {
        for (int i = 0; i < grid.count[0]; ++i) work(i, j, k);
      }
    }
  }
  /// Sets a face field from a function of place, halo included.
  void set(fluid::FaceField& field, const std::function<sdk::Vec3(sdk::Vec3)>& value) const {
    for (int d = 0; d < 3; ++d) {
      for (int k = -2; k < grid.count[2] + 2; ++k) {
        for (int j = -2; j < grid.count[1] + 2; ++j) {
          for (int i = -2; i < grid.count[0] + 2; ++i) {
            field.component[d][grid.index(i, j, k)] = value(grid.face(d, i, j, k))[d];
          }
        }
      }
    }
  }
  /// Void fraction of the face as the fluid solver forms it, sides as the cell next to them.
  [[nodiscard]] double face_void_fraction(int d, int i, int j, int k) const {
    std::array<int, 3> low{i, j, k};
    std::array<int, 3> high{i, j, k};
    low[d] -= 1;
    const auto eps = [&](std::array<int, 3> c) {
      for (int e = 0; e < 3; ++e) {
        const int n = grid.count[e];
        c[e] = grid.is_periodic[e] ? ((c[e] % n) + n) % n : std::clamp(c[e], 0, n - 1);
      }
      return coupling->void_fraction()[grid.index(c[0], c[1], c[2])];
    };
    return 0.5 * (eps(low) + eps(high));
  }
  /// Force on the fluid [N] from the exchange and the present velocity: sum over the faces of
  /// eps open V (source - coefficient u). Open shares as the mean of the two cells.
  [[nodiscard]] sdk::Vec3 force_on_fluid() const {
    sdk::Vec3 sum;
    for (int d = 0; d < 3; ++d) {
      for_cells([&](int i, int j, int k) {
        const std::ptrdiff_t f = grid.index(i, j, k);
        const double s = coupling->exchange().source.component[d][f];
        const double c = coupling->exchange().coefficient.component[d][f];
        if (s == 0.0 && c == 0.0) return;
        std::array<int, 3> low{i, j, k};
        low[d] = (low[d] - 1 + grid.count[d]) % grid.count[d];
        // The exchange holds open shares in single precision.
        const double share =
            static_cast<float>(0.5 * (open[f] + open[grid.index(low[0], low[1], low[2])]));
        sum[d] += face_void_fraction(d, i, j, k) * share * grid.cell_volume() *
                  (s - c * velocity.component[d][f]);
      });
    }
    return sum;
  }

  Choice choice;
  fluid::Grid grid;
  fluid::CellField open;
  fluid::FaceField velocity;
  fluid::FaceField stress;
  scenario::Setup setup;
  std::unique_ptr<sdk::VoidageRule> voidage;
  std::unique_ptr<sdk::DragLaw> drag;
  std::unique_ptr<coupling::Coupling> coupling;
  std::optional<coupling::AssembledDrag> assembled;
  std::optional<coupling::EvaluatedDrag> evaluated;
  Grains grains;
};

/// Numbers between 0 and 1 for tests, the same everywhere.
class Numbers {
 public:
  double next() { return random_.uniform(1, count_++); }
  double between(double low, double high) { return low + (high - low) * next(); }

 private:
  sdk::Random random_{1, sdk::stream_of("test")};
  std::uint32_t count_ = 0;
};

using contract::MemoryArchive;

}  // namespace dust::test
