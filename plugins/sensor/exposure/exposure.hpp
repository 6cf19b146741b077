// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dust/sdk/dust_fractions.hpp>

#include <array>
#include <cstddef>
#include <span>

namespace dust::model::exposure {

/// What a sampler finds of dust of one size: shares of its mass.
inline constexpr std::size_t k_parts = 4;
using Parts = std::array<double, k_parts>;  ///< inhalable, thoracic, respirable, all

/// By EN 481, of a class of `diameter` [m] and `density` [kg/m3].
inline Parts parts_of(double diameter, double density) {
  const auto f = sdk::dust_fractions(sdk::aerodynamic_diameter(diameter, density));
  return {f.inhalable, f.thoracic, f.respirable, 1.0};
}

/// Concentrations [kg/m3] that samplers find where the classes have `concentration` [kg/m3] of gas,
///   C_j = sum_k E_j(D_k) c_k.
inline Parts sampled(std::span<const double> concentration, std::span<const Parts> parts) {
  Parts sum{};
  for (std::size_t k = 0; k < concentration.size(); ++k) {
    for (std::size_t j = 0; j < k_parts; ++j) sum[j] += parts[k][j] * concentration[k];
  }
  return sum;
}

}  // namespace dust::model::exposure
