// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "setup/dust_setup.hpp"
#include "setup/setup.hpp"

#include "dust/sdk/parameter_schema.hpp"
#include "dust/sdk/vec3.hpp"
#include "dust/sdk/wind_erosion.hpp"

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace dust::scenario {

/// The keys of the engine's own blocks, declared as models declare theirs: messages, help, defaults
/// and the JSON Schema derive from here.
struct GeneralBlock {
  std::string name;
  std::int64_t seed = 1;
  sdk::Vec3 gravity;
  static const sdk::ParameterSchema& schema();
};

struct TimeBlock {
  double end = 0.0;
  double fluid_step = 0.0;
  double output_every = 0.0;
  double checkpoint_every = 0.0;
  double keep_every = 0.0;
  double dem_step = 0.0;
  double expected_speed = 0.0;
  std::string rates = "several";
  static const sdk::ParameterSchema& schema();
};

struct DomainBlock {
  sdk::Vec3 min;
  sdk::Vec3 max;
  static const sdk::ParameterSchema& schema();
};

struct SideBlock {
  std::string grains;
  std::string material;
  static const sdk::ParameterSchema& schema();
};

struct MaterialBlock {
  double density = 0.0;
  double young_modulus = 0.0;
  double poisson_ratio = 0.0;
  double coarse_graining = MaterialSpec{}.coarse_graining;
  std::vector<double> dust_load;
  double moisture = 0.0;
  static const sdk::ParameterSchema& schema();
};

struct InteractionBlock {
  std::vector<std::string> between;
  static const sdk::ParameterSchema& schema();
};

struct FrameBlock {
  sdk::Vec3 origin;
  sdk::Vec3 axis;
  double angle = 0.0;
  static const sdk::ParameterSchema& schema();
};

/// What bodies and emitters have in common.
struct PlacedBlock {
  bool enabled = true;
  std::string frame;
  std::string material;
  static const sdk::ParameterSchema& schema();
};

/// What bodies have besides: placed, shape and motions.
struct BodyBlock {
  std::string group;
  static const sdk::ParameterSchema& schema();
};

/// When a body is taken away.
struct RemovalBlock {
  double at = std::numeric_limits<double>::infinity();
  double kinetic_energy_per_grain = 0.0;
  double after = 0.0;
  static const sdk::ParameterSchema& schema();
};

/// An opening in a body that sucks fluid in.
struct SuctionBlock {
  double flow = 0.0;
  sdk::Vec3 min;
  sdk::Vec3 max;
  std::vector<double> times;
  std::vector<double> factors;
  static const sdk::ParameterSchema& schema();
};

struct SensorBlock {
  bool enabled = true;
  static const sdk::ParameterSchema& schema();
};

/// What counts as dust.
struct DustBlock {
  double finer_than = 0.0;
  std::vector<double> classes;
  std::vector<std::string> materials;
  std::vector<std::string> hoods;
  double steady_after = 0.0;
  double fall_height = 0.0;
  double open_area = 0.0;
  static const sdk::ParameterSchema& schema();
};

/// Accounts that a run keeps.
struct AuditBlock {
  bool energy = false;
  static const sdk::ParameterSchema& schema();
};

/// Dust as concentrations on the fluid's grid; clouds and sources are read apart.
struct DustFieldBlock : sdk::WindErosion {
  std::vector<double> classes;
  std::string material;
  double schmidt_number = DustFieldSpec{}.schmidt_number;
  bool inertia = DustFieldSpec{}.inertia;
  bool scavenging = DustFieldSpec{}.scavenging;
  bool resuspension = false;
  std::string deposition = "settling";
  static const sdk::ParameterSchema& schema();
};

struct DustCloudBlock {
  sdk::Vec3 min;
  sdk::Vec3 max;
  std::vector<double> concentration;
  static const sdk::ParameterSchema& schema();
};

struct DustSourceBlock {
  sdk::Vec3 min;
  sdk::Vec3 max;
  std::vector<double> mass_flow;
  double begin = DustSourceSpec{}.begin;
  double end = DustSourceSpec{}.end;
  static const sdk::ParameterSchema& schema();
};

/// A box in which grains keep their dust.
struct FeedZoneBlock {
  sdk::Vec3 min;
  sdk::Vec3 max;
  static const sdk::ParameterSchema& schema();
};

/// A number from elsewhere beside a figure of ours; value and uncertainty bring their units along
/// and are read apart.
struct ReferenceBlock {
  std::string quantity;
  std::string source;
  static const sdk::ParameterSchema& schema();
};

/// A curve from elsewhere behind one of ours; x and y bring their units along and are read apart.
struct ReferenceCurveBlock {
  std::string sensor;
  std::string source;
  static const sdk::ParameterSchema& schema();
};

struct FluidBlock {
  sdk::Vec3 cells;
  double density = 0.0;
  double viscosity = 0.0;
  std::string momentum_set = "I";
  sdk::Vec3 initial_velocity;
  double pressure_tolerance = FluidSpec{}.pressure_tolerance;
  double largest_cfl = FluidSpec{}.largest_cfl;
  static const sdk::ParameterSchema& schema();
};

struct RegionBlock {
  sdk::Vec3 min;
  sdk::Vec3 max;
  double density = 0.0;
  double viscosity = 0.0;
  static const sdk::ParameterSchema& schema();
};

struct CouplingBlock {
  bool one_way = false;
  std::string self_disturbance = "auto";
  bool correct_disturbance_correction = false;
  bool overlap = false;
  std::vector<std::string> resolved;
  static const sdk::ParameterSchema& schema();
};

}  // namespace dust::scenario
