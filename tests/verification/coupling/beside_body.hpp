// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lone_grain.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace dust::test {

/// A grain in still water that goes along a body's surface and across, at these distances [cells]
/// from it; the surface stands straight in the cells and tilted, `floor` cells over the side.
inline void check_beside_a_body(double ratio, double floor, const std::vector<double>& distances) {
  // Slivers of cells between a grain as large as a cell and the surface that it touches; the images
  // of the box are left in, up to 2 % for such a grain.
  const double gate = ratio <= 0.5 ? 0.025 : 0.05;
  for (const bool is_across : {false, true}) {
    for (const double tilt : {0.0, 0.35}) {
      for (const double beside : distances) {
        IsolatedGrain grain{20e-6, ratio, k_test_water};
        grain.beside = beside;
        grain.is_across = is_across;
        grain.floor = floor;
        grain.tilt = tilt;
        const IsolatedGrain::Error error = grain.error();
        MESSAGE("D/dx " << ratio << ", tilted by " << tilt << ", " << beside
                        << " cells from a body's surface at " << floor << ", "
                        << std::string(is_across ? "across: " : "along: ") << 100.0 * error.largest
                        << " %");
        CHECK(error.least > -gate);
        CHECK(error.largest < gate);
      }
    }
  }
}

}  // namespace dust::test
