// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/contact_law.hpp"
#include "dust/sdk/parameter_schema.hpp"
#include "dust/sdk/vec3.hpp"
#include "setup/mark.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace dust::scenario {

/// A model chosen by name with its parsed parameters (in the order of the model's schema).
struct ModelChoice {
  std::string kind;
  std::string name;
  std::vector<sdk::Value> values;
  std::string path;  ///< dotted path in the scenario, for messages
  Mark where;
};

struct TimeSpec {
  double end = 0.0;               ///< [s]
  double fluid_step = 0.0;        ///< [s] also the interval of emission, sampling and interruption
  double output_every = 0.0;      ///< [s] between frames
  double checkpoint_every = 0.0;  ///< [s] between checkpoints, 0 = with every frame
  double dem_step = 0.0;          ///< [s] 0 = derived per size class
  double expected_speed =
      0.0;                    ///< [m/s] largest approach speed of grains, 0 = from bodies and drops
  bool rates_single = false;  ///< one rate for all grains
  Mark dem_step_where;
};

enum class GrainSide { open, wall, periodic };

/// Sides in the order left, right (x), front, back (y), bottom, top (z).
inline constexpr std::array<const char*, 6> k_side_names = {"left", "right",  "front",
                                                            "back", "bottom", "top"};

struct SideSpec {
  GrainSide grains = GrainSide::open;
  int material = -1;               ///< of a wall, index into Setup::materials
  std::optional<ModelChoice> air;  ///< nothing for grains-only scenarios and periodic sides
  Mark where;
};

struct DomainSpec {
  sdk::Vec3 min;
  sdk::Vec3 max;
  std::array<SideSpec, 6> sides;
};

struct MaterialSpec {
  std::string name;
  sdk::MaterialProperties properties;
  double coarse_graining = 1.0;  ///< [-] diameter of a grain over that of those it stands for
};

struct InteractionSpec {
  int material_i = 0;  ///< indices into Setup::materials
  int material_j = 0;
  ModelChoice contact;
  std::optional<ModelChoice> rolling;
  std::optional<ModelChoice> cohesion;
  Mark where;
};

/// A turned frame for bodies and emitters: points are turned about `origin` by `angle` round
/// `axis`.
struct FrameSpec {
  std::string name;
  sdk::Vec3 origin;
  sdk::Vec3 axis{0, 1, 0};
  double angle = 0.0;  ///< [rad]
};

/// When a body is taken away: at a time, or when the grains have come to rest.
struct RemovalSpec {
  double at = std::numeric_limits<double>::infinity();  ///< [s]
  double kinetic_energy_per_grain = 0.0;                ///< [J] below this mean, 0 = not by energy
  double after = 0.0;                                   ///< [s] by energy, but not before
};

/// An opening in a body's surface that sucks fluid in.
struct SuctionSpec {
  double flow = 0.0;  ///< [m3/s] out of the domain
  sdk::Vec3 min;      ///< [m] box round the opening, in the body's frame
  sdk::Vec3 max;
  std::vector<double> times;    ///< [s]
  std::vector<double> factors;  ///< of the flow at `times`
  Mark where;
};

struct BodySpec {
  std::string name;
  ModelChoice shape;  ///< kind "shape": from bodies::shape_catalogue()
  std::vector<ModelChoice> motions;
  int material = 0;
  int frame = -1;     ///< index into Setup::frames, -1 = the domain's
  std::string group;  ///< "" = none
  std::optional<RemovalSpec> removal;
  std::optional<SuctionSpec> suction;
  Mark where;
};

struct EmitterSpec {
  std::string name;
  ModelChoice model;
  int material = 0;
  int frame = -1;
  std::vector<int> more_materials = {};  ///< that requests may have, ordered as the model's names
};

struct SensorSpec {
  std::string name;
  ModelChoice model;
};

/// A box with a fluid of its own: water under air, a layer of warm air.
struct FluidRegion {
  std::string name;
  sdk::Vec3 min;
  sdk::Vec3 max;
  double density = 0.0;    ///< [kg/m3]
  double viscosity = 0.0;  ///< [Pa s] dynamic
};

/// Whether grains feel what they do to the fluid by themselves: not where they are alone and it
/// counts, always, or never more than the fluid shows.
enum class DisturbanceCorrection { automatic, felt, taken_off };

struct FluidSpec {
  std::array<int, 3> cells{1, 1, 1};
  double density = 0.0;    ///< [kg/m3]
  double viscosity = 0.0;  ///< [Pa s] dynamic
  std::string momentum_set = "I";
  sdk::Vec3 initial_velocity;
  double pressure_tolerance = 1e-4;  ///< residual of the pressure solve relative to its right side
  double largest_cfl = 1.0;          ///< sub-steps keep the Courant number below
  bool is_one_way = false;           ///< grains feel the fluid, the fluid does not feel the grains
  DisturbanceCorrection disturbance_correction = DisturbanceCorrection::automatic;
  bool overlaps_grains = false;  ///< solved while the grains move in the fluid of the step before
  std::vector<FluidRegion> regions;  ///< the last one that holds a place counts
  /// Materials whose grains the fluid meets with their surfaces, indices into Setup::materials.
  std::vector<int> resolved;
  Mark resolved_where;
  Mark where;

  [[nodiscard]] bool resolves(int material) const {
    return std::find(resolved.begin(), resolved.end(), material) != resolved.end();
  }
};

/// What a run keeps account of besides its masses.
struct AuditSpec {
  bool energy = false;
  Mark where;
};

/// A scenario with everything resolved: plain data, SI, names turned into indices. Disabled bodies,
/// emitters and sensors are not in it.
struct Setup {
  std::string name;
  std::uint64_t seed = 1;
  TimeSpec time;
  sdk::Vec3 gravity;
  DomainSpec domain;
  std::vector<MaterialSpec> materials;
  std::vector<InteractionSpec> interactions;
  std::vector<FrameSpec> frames;
  std::vector<BodySpec> bodies;
  std::vector<EmitterSpec> emitters;
  std::vector<SensorSpec> sensors;
  std::optional<FluidSpec> fluid;
  std::optional<ModelChoice> drag;
  std::vector<ModelChoice> fluid_forces;  ///< besides drag
  std::optional<ModelChoice> voidage;
  std::optional<ModelChoice> turbulence;  ///< nothing: laminar
  AuditSpec audit;
};

}  // namespace dust::scenario
