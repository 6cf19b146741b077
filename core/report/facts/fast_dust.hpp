// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/dust_sizes.hpp"
#include "report/h5_source.hpp"

#include <cstddef>
#include <string>

namespace dust::report {

/// Dust in the frames of a run that moves faster than all that carries it: it was thrown.
struct FastDust {
  std::size_t fast = 0;  ///< computed dust grains above the limit, summed over frames
  std::size_t all = 0;   ///< computed dust grains, summed over frames
  double limit = 0.0;    ///< [m/s] 1.2 times the fastest coarse grain or air of any frame
};

/// Looks through all frames; `air_speed` is the highest of the air [m/s], 0 without air. What is
/// thrown and stopped between two frames is not seen.
[[nodiscard]] FastDust fast_dust_of(const H5Source& source, const DustSizes& sizes,
                                    double air_speed);

/// Speed of a fine grain set free by the elastic energy of coarse ones of the softness that such
/// runs are made with [m/s]: the order of magnitude that core/particles/dem_step.cpp tells of.
constexpr double k_thrown = 10.0;

/// Where air stops a grain of `diameter` [m] thrown at that speed [m]: v rho d^2 / (18 mu). Stokes'
/// drag is the weakest, so the true path is shorter. 0 where an argument is not known.
[[nodiscard]] double stopping_distance(double diameter, double density, double viscosity);

}  // namespace dust::report
