// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "io/report_h5.hpp"

#include <cstddef>
#include <string>

namespace dust::io {

/// Dust in the frames of a run that moves faster than all that carries it: it was thrown.
struct FastDust {
  std::size_t fast = 0;  ///< computed dust grains above the limit, summed over frames
  std::size_t all = 0;   ///< computed dust grains, summed over frames
  double limit = 0.0;    ///< [m/s] 1.2 times the fastest coarse grain or air of any frame
};

/// Looks through all frames; `air_speed` is the highest of the air [m/s], 0 without air. What is
/// thrown and stopped between two frames is not seen.
[[nodiscard]] FastDust fast_dust_of(const H5Source& source, double air_speed);

/// What it means that fine grains overlap by more than contact laws hold for, and what that does to
/// the dust figures. `overlap` in radii; `diameter` [m], `density` [kg/m3] of the finest dust and
/// `viscosity` [Pa s] of the air may be 0: not known.
[[nodiscard]] std::string crushed_dust_html(double overlap, const FastDust& fast, double diameter,
                                            double density, double viscosity);

}  // namespace dust::io
