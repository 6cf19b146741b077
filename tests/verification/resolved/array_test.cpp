// SPDX-License-Identifier: Apache-2.0
#include "support/approx.hpp"
#include "unit/resolved/resolved_box.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

namespace dust::test {

TEST_CASE(
    "V-ARRAY: Stokes drag of cubic arrays of spheres, 8 to 16 cells across, shall be that of Zick "
    "and Homsy (1982)") {
  struct Known {
    double solids, drag;
  };
  for (const Known known : {Known{0.027, 2.008}, Known{0.064, 2.810}, Known{0.125, 4.292},
                            Known{0.216, 7.442}, Known{0.343, 15.4}}) {
    const double edge = std::cbrt(std::numbers::pi / 6.0 / known.solids);
    for (const int across : {8, 12, 16}) {
      // Even numbers of cells, which the multigrid halves.
      const int cells = 2 * static_cast<int>(std::ceil(0.5 * across * edge));
      const double drag = array_drag(cells, known.solids);
      MESSAGE(known.solids << ", " << cells / edge << " across: " << drag << " of " << known.drag
                           << ", " << 100.0 * (drag / known.drag - 1.0) << " %");
      CHECK(drag == test::approx(known.drag).epsilon(known.solids < 0.3 ? 0.01 : 0.03));
    }
  }
}

}  // namespace dust::test
