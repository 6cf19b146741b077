// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/model.hpp"

#include <cstddef>

namespace dust::sdk {

/// What dust is, and the gas it comes off into: the same for a whole run.
struct DustProperties {
  std::size_t classes = 0;
  const double* diameter = nullptr;  ///< [m] of each class, ascending
  double density = 0.0;              ///< [kg/m3] of the dust itself
  double gas_density = 0.0;          ///< [kg/m3]
  double gas_viscosity = 0.0;        ///< [Pa s]
  double gravity = 0.0;              ///< [m/s2] its size
};

/// Grains that carry dust: columns of `count` grains. What belongs to a class stands in columns of
/// its own: class k of grain q at k stride + q.
struct DustyGrains {
  std::size_t count = 0;
  std::size_t classes = 0;
  std::size_t stride = 0;
  double time_step = 0.0;            ///< [s] since the law was last asked
  const double* diameter = nullptr;  ///< [m] of the grain
  const double* mass = nullptr;      ///< [kg] of the grain
  const double* moisture = nullptr;  ///< [-] water over dry solids, by mass
  const double* load = nullptr;      ///< [kg] of dust on the grain, by class
  const double* fresh = nullptr;     ///< [kg] of dust that it came with, by class
  double* released = nullptr;        ///< [kg] out, by class: at least 0, at most the load
                                     ///< (LiberationLaw::k_rounding)

  /// [kg] of dust of all classes that grain q came with.
  [[nodiscard]] double fresh_sum(std::size_t q) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < classes; ++k) sum += fresh[k * stride + q];
    return sum;
  }
};

/// What the contacts of each grain have done to it in the time step. A grain takes half of what a
/// contact with another grain dissipates, and all of it at a wall.
struct GrainImpacts {
  DustyGrains grains;
  /// [J] dissipated along the normals of the contacts (dampers, cohesion that parts).
  const double* normal_energy = nullptr;
  /// [J] dissipated by sliding and rolling.
  const double* tangential_energy = nullptr;
  /// [m/s2] largest acceleration that the sum of its contacts has given the grain.
  const double* acceleration = nullptr;
};

/// The wind at each grain.
struct GrainWind {
  DustyGrains grains;
  const double* slip = nullptr;           ///< [m/s] of the gas relative to the grain, interstitial
  const double* shear = nullptr;          ///< [Pa] drag of the grain over its surface, pi D^2
  const double* void_fraction = nullptr;  ///< [-] at the grain, in (0, 1]
};

/// How much of the dust on grains comes off, in contacts and in wind. Asked once per fluid step for
/// what has happened in it; what comes off is airborne at the place of the grain.
/// Owns: its coefficients. May: read the inputs, write `released`. Must not: allocate, lock, keep
/// state, look at other rows than that which it writes. Called from several threads at once.
class LiberationLaw : public Model {
 public:
  static constexpr const char* k_kind = "liberation";
  /// Of the load, by which `released` may lie above it: shares of a load need not sum to 1 in their
  /// last digits. All of the load comes off then; more than that ends the run.
  static constexpr double k_rounding = 1e-12;

  /// Called once before any batch; the arrays live as long as the law.
  virtual void prepare(const DustProperties& dust) = 0;
  virtual void in_contacts(const GrainImpacts& impacts) const = 0;
  /// Asked only where needs_wind().
  virtual void in_wind(const GrainWind&) const {}
  /// Does wind alone set dust free? Asked once, at the start.
  [[nodiscard]] virtual bool needs_wind() const { return false; }
  /// Does it read the moisture? A moisture that no law reads is refused. Asked once, at the start.
  [[nodiscard]] virtual bool uses_moisture() const { return false; }
};

}  // namespace dust::sdk
