// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/archive.hpp"
#include "dust/sdk/sensor.hpp"
#include "dust/sdk/vec3.hpp"
#include "particles/dem.hpp"
#include "setup/force_kinds.hpp"

#include <array>
#include <cstdint>
#include <span>

namespace dust::run {

using scenario::ForceKind;
using scenario::k_force_kinds;
using scenario::k_force_names;

/// How large the forces on grains are beside each other. At each sample the forces of a kind are
/// added up on each grain, \f$ \vec F_{k,i} \f$; kept is \f$ S_k = \sum w_i |\vec F_{k,i}| \f$ over
/// grains and samples, so that the share of a kind is \f$ S_k / \sum_j S_j \f$. In a bed at rest
/// the contacts on a grain add up to its weight: half and half.
class ForceShares {
 public:
  /// What the grains are in.
  struct Surroundings {
    sdk::Vec3 gravity;           ///< [m/s2]
    double fluid_density = 0.0;  ///< [kg/m3] that gives buoyancy, 0 = none
    /// Empty where the grains do not feel the pressure by itself.
    sdk::FluidColumns fluid;
  };

  void sample(const particles::GrainRows& grains,
              std::span<const particles::ContactRecord> contacts, const Surroundings& in);

  [[nodiscard]] std::int64_t samples() const { return samples_; }
  /// [-] of the sum over all kinds; 0 before the first sample with grains.
  [[nodiscard]] double share(ForceKind kind) const;
  /// [-] over the weight of the grains; 0 without gravity.
  [[nodiscard]] double over_weight(ForceKind kind) const;

  void save(sdk::ArchiveWriter& archive) const;
  void load(sdk::ArchiveReader& archive);

 private:
  std::array<double, k_force_kinds> sums_{};  ///< [N]
  std::int64_t samples_ = 0;
};

}  // namespace dust::run
