// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/model.hpp"
#include "dust/sdk/random.hpp"
#include "dust/sdk/vec3.hpp"

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace dust::sdk {

/// Asks the core to insert a grain.
struct InsertionRequest {
  double time = 0.0;      ///< [s] when its centre would be at `position`, moving with `velocity`
  Vec3 position;          ///< [m] domain frame
  Vec3 velocity;          ///< [m/s]
  Vec3 angular_velocity;  ///< [rad/s]
  double diameter = 0.0;  ///< [m]
  double weight = 1.0;    ///< [-] real grains per computed grain, w = 1/k for rare dust
  std::int32_t material = -1;  ///< index into Emitter::materials(), -1 = the emitter's own
  std::int64_t line = 0;       ///< of the file it was read from, for messages; 0 = none
};

/// What is in the domain when grains enter.
class Surroundings {
 public:
  virtual ~Surroundings() = default;
  /// Whether a sphere [m] inside the domain would touch no grain, body or wall.
  [[nodiscard]] virtual bool is_free(Vec3 centre, double radius) const = 0;
};

/// What an emitter is given to work with.
struct EmitterContext {
  double begin = 0.0;  ///< [s] requests wanted for begin <= time < end
  double end = 0.0;
  double grain_density = 0.0;                  ///< [kg/m3] of the emitter's material
  Vec3 gravity;                                ///< [m/s2]
  Random random{0, 0};                         ///< keyed by (scenario seed, emitter name)
  const Surroundings* surroundings = nullptr;  ///< null while a scenario is only checked
};

/// What the scenario asks of an emitter; the summary puts beside it what came.
struct EmitterRequest {
  double mass_flow = 0.0;  ///< [kg/s] of a stream between begin and end
  double begin = 0.0;      ///< [s]
  double end = std::numeric_limits<double>::infinity();
  double mass = 0.0;       ///< [kg] of grains that come at once, 0 = not asked for by mass
  std::int64_t count = 0;  ///< the same by number
  struct Share {
    double diameter = 0.0;         ///< [m]
    double number_fraction = 0.0;  ///< of the real grains
  };
  std::vector<Share> shares;  ///< ascending; empty = no distribution is asked for
};

/// What happens to a request whose place is taken.
struct InsertionRule {
  bool waits = true;             ///< it tries again; otherwise the run ends and names both grains
  double allowed_overlap = 0.0;  ///< [-] of the smaller radius, as in a bed pressed by its weight
};

/// Proposes grains; the core inserts them at the beginning of the interval, carried back along
/// their velocity, gives ids and counts mass. A request that would touch a grain is treated by
/// insertion_rule(). Calls come with consecutive intervals from one thread; what a later call needs
/// is state, saved by save/load. A call with an empty interval asks for no requests, only for a
/// check. Positions and directions given as parameters are in the emitter's own frame = the
/// domain's frame unless the scenario puts the emitter into a named frame; the core turns the
/// requests.
class Emitter : public Model {
 public:
  static constexpr const char* k_kind = "emitter";
  virtual void propose(const EmitterContext& context, std::vector<InsertionRequest>& requests) = 0;
  /// Mass rate the scenario asks for [kg/s], 0 if not a stream; the summary compares.
  [[nodiscard]] virtual double requested_mass_flow() const = 0;
  /// Diameters that may come [m], ascending: size classes, time steps and sensors derive from them.
  [[nodiscard]] virtual std::vector<double> diameters() const = 0;
  /// Largest starting speed [m/s].
  [[nodiscard]] virtual double largest_speed() const = 0;
  [[nodiscard]] virtual EmitterRequest request() const {
    EmitterRequest r;
    r.mass_flow = requested_mass_flow();
    return r;
  }
  [[nodiscard]] virtual InsertionRule insertion_rule() const { return {}; }
  /// Names of materials that requests may have beside the emitter's own.
  [[nodiscard]] virtual std::vector<std::string> materials() const { return {}; }
};

}  // namespace dust::sdk
