// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/body_set.hpp"
#include "support/dem_rig.hpp"

#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace dust::test {

constexpr double k_g = 9.81;

/// One material against itself, bodies by name of their shape.
struct WallRig : DemRig {
  int sand;
  WallRig(double restitution, double friction, double diameter, double rolling = -1.0) {
    sand = material(2650, 50e6, 0.3);
    law(sand, sand, restitution, friction, rolling);
    diameters = {diameter};
    // Every set-up at the same step, whatever its walls do.
    setup.time.expected_speed = 2.0;
  }
  bodies::Body& body(const std::string& shape, const std::map<std::string, sdk::Value>& values,
                     std::vector<std::unique_ptr<sdk::Motion>> motions = {}) {
    scenario::BodySpec spec;
    spec.name = shape;
    spec.material = sand;
    spec.shape.kind = "shape";
    spec.shape.name = shape;
    for (const auto& kind : bodies::shape_catalogue()) {
      if (kind.name != shape) continue;
      for (const sdk::Parameter& p : kind.parameters) {
        const auto given = values.find(p.name);
        spec.shape.values.push_back(given == values.end() ? sdk::Value{} : given->second);
      }
    }
    bodies.push_back(bodies::make_body(setup, spec, std::move(motions)));
    return bodies.back();
  }
  static std::vector<std::unique_ptr<sdk::Motion>> motion(
      const std::string& name, const std::map<std::string, sdk::Value>& values) {
    std::vector<std::unique_ptr<sdk::Motion>> all;
    all.push_back(ModelLoader::make<sdk::Motion>("motion", name, values));
    return all;
  }
  [[nodiscard]] double mass() const {
    return 2650 * std::numbers::pi / 6 * std::pow(diameters[0], 3);
  }
  /// Overlap [m] of a grain that rests on a wall.
  [[nodiscard]] double resting_overlap(double gravity = k_g) const {
    const double young = 50e6 / (1 - 0.09) / 2;
    return std::pow(mass() * gravity / (4.0 / 3.0 * young * std::sqrt(0.5 * diameters[0])),
                    2.0 / 3.0);
  }
};

/// A grain among walls, and the steps that it makes.
struct SingleGrain {
  WallRig rig;
  std::unique_ptr<particles::Dem> dem;
  std::unique_ptr<Stepper> stepper;

  SingleGrain(double half_width, double restitution, double friction, double diameter,
              double rolling = -1.0, double gravity = k_g)
      : rig(restitution, friction, diameter, rolling) {
    rig.setup.domain.min = {-half_width, -half_width, -half_width};
    rig.setup.domain.max = {half_width, half_width, half_width};
    rig.setup.gravity = {0, 0, -gravity};
  }
  /// Once its walls stand.
  void begin(particles::NewGrain grain) {
    dem = rig.make();
    grain.diameter = rig.diameters[0];
    dem->insert(std::vector<particles::NewGrain>{grain});
    stepper = std::make_unique<Stepper>(*dem);
  }
  void until(double time) {
    while (stepper->time() < time) stepper->step();
  }
  GrainState now() { return grain(*dem, 0); }
};

}  // namespace dust::test
