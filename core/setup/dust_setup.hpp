// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"
#include "setup/dust_rule.hpp"
#include "setup/mark.hpp"
#include "setup/setup.hpp"

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace dust::scenario {

/// Dust in the air at the start: a box of one concentration.
struct DustCloudSpec {
  std::string name;
  sdk::Vec3 min;
  sdk::Vec3 max;
  std::vector<double> concentration;  ///< [kg/m3] by class
};

/// Dust that is set free in a box at a given rate.
struct DustSourceSpec {
  std::string name;
  sdk::Vec3 min;
  sdk::Vec3 max;
  std::vector<double> mass_flow;                         ///< [kg/s] by class
  double begin = 0.0;                                    ///< [s]
  double end = std::numeric_limits<double>::infinity();  ///< [s]
};

/// Dust that the wind takes off walls and bodies again; sdk::WindErosion.
struct ResuspensionSpec {
  double emission_coefficient = 0.0;  ///< [1/m]
  double cohesion = 0.0;              ///< [kg/s2]
};

/// Dust as concentrations on the fluid's grid.
struct DustFieldSpec {
  std::vector<double> diameters;  ///< [m] ascending, one class each
  double density = 0.0;           ///< [kg/m3] of the dust itself
  double schmidt_number = 0.7;    ///< [-] eddy viscosity over turbulent diffusivity
  bool inertia = true;            ///< dust drifts off where the gas turns
  bool scavenging = false;        ///< grains catch the dust that they meet
  std::optional<ResuspensionSpec> resuspension;
  bool has_smooth_walls = false;  ///< turbulence brings dust to them, not settling alone
  std::vector<DustCloudSpec> clouds;
  std::vector<DustSourceSpec> sources;
  Mark where;
};

/// A part of a side through which air is drawn out.
struct SideOpeningSpec {
  int side = 0;  ///< in the order of k_side_names
  sdk::Vec3 min;
  sdk::Vec3 max;
  double flow = 0.0;  ///< [m3/s] as given, without its course over time
};

/// The dust that grains of a material bring along.
struct DustLoadSpec {
  std::vector<double> share;  ///< [-] kg per kg of grain, by class; empty: none
  double moisture = 0.0;      ///< [-] water over dry solids, by mass
};

/// A box in which grains keep their dust: where a scenario feeds them, not where its plant does.
struct FeedZoneSpec {
  std::string name;
  sdk::Vec3 min;
  sdk::Vec3 max;
};

/// What a scenario says of dust, beside the Setup: only who counts and carries dust asks.
struct DustSetup {
  std::optional<DustSpec> given;          ///< the block `dust:`
  std::vector<double> coarse_graining;    ///< [-] by material
  std::vector<SideOpeningSpec> openings;  ///< of the sides, whether there is a block or not
  std::optional<DustFieldSpec> field;
  std::vector<DustLoadSpec> loads;        ///< by material
  std::optional<ModelChoice> liberation;  ///< how loads become airborne
  std::vector<FeedZoneSpec> feed_zones;   ///< where they do not

  /// By material and class, as particles take them; empty where no load ever becomes airborne.
  [[nodiscard]] std::vector<std::vector<double>> shares_on_grains() const {
    std::vector<std::vector<double>> shares;
    if (!liberation || !field) return shares;
    for (const DustLoadSpec& load : loads) shares.push_back(load.share);
    return shares;
  }

  /// Which grains are dust; the usual rule where the scenario says nothing.
  [[nodiscard]] DustRule rule() const {
    return given ? DustRule(*given, coarse_graining) : DustRule();
  }
};

}  // namespace dust::scenario
