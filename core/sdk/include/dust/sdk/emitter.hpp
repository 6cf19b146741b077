// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/model.hpp"
#include "dust/sdk/random.hpp"
#include "dust/sdk/vec3.hpp"

#include <span>
#include <string>
#include <vector>

namespace dust::sdk {

/// A grain about to enter.
struct Seed {
  double time = 0.0;      ///< [s] when its centre would be at `position`, moving with `velocity`
  Vec3 position;          ///< [m] domain frame
  Vec3 velocity;          ///< [m/s]
  double diameter = 0.0;  ///< [m]
  double weight = 1.0;    ///< [-] real grains per computed grain, w = 1/k for rare dust
};

/// What an emitter is given to work with.
struct EmitterContext {
  double begin = 0.0;  ///< [s] seeds wanted for begin <= time < end
  double end = 0.0;
  double grain_density = 0.0;  ///< [kg/m3] of the emitter's material
  Vec3 gravity;                ///< [m/s2]
  Random random{0, 0};         ///< keyed by (scenario seed, emitter name)
};

/// Proposes grains; the core inserts them at the beginning of the interval, carried back along
/// their velocity, gives ids and books mass. A seed that would touch a grain waits. Calls come with
/// consecutive intervals from one thread; what a later call needs is state, saved by save/load.
/// Positions and directions given as parameters are in the emitter's own frame = the domain's frame
/// unless the scenario puts the emitter into a named frame; the core turns the seeds.
class Emitter : public Model {
 public:
  static constexpr const char* k_kind = "emitter";
  virtual void propose(const EmitterContext& context, std::vector<Seed>& seeds) = 0;
  /// Mass rate the scenario asks for [kg/s], 0 if not a stream; the summary compares.
  [[nodiscard]] virtual double requested_mass_flow() const = 0;
  /// Diameters that may come [m], ascending: size classes, time steps and sensors derive from them.
  [[nodiscard]] virtual std::vector<double> diameters() const = 0;
  /// Largest starting speed [m/s].
  [[nodiscard]] virtual double largest_speed() const = 0;
};

}  // namespace dust::sdk
