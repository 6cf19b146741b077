// SPDX-License-Identifier: Apache-2.0
#include "resolved/marker_lattice.hpp"
#include "resolved/roma_kernel.hpp"
#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

namespace dust::test {

using resolved::RomaPoints;
using sdk::Vec3;

TEST_CASE(
    "resolved: the delta function shall have the whole weight, and its mean place, wherever it "
    "is") {
  for (double place = 3.0; place < 4.0; place += 0.0625) {
    const RomaPoints points = RomaPoints::around(place);
    double sum = 0.0;
    double first = 0.0;
    double squares = 0.0;
    for (int n = 0; n < 3; ++n) {
      const double weight = points.weight[static_cast<std::size_t>(n)];
      sum += weight;
      first += weight * (points.first + n - place);
      squares += weight * weight;
    }
    CAPTURE(place);
    CHECK(sum == test::approx(1.0).epsilon(1e-14));
    CHECK(std::abs(first) < 1e-14);
    CHECK(squares == test::approx(0.5).epsilon(1e-14));  // the property that defines it
  }
}

TEST_CASE("resolved: markers shall cover the sphere evenly") {
  const auto lattice = resolved::make_lattice(12.0, 1.0);
  CHECK(static_cast<int>(lattice.direction.size()) == resolved::marker_count(12.0));
  CHECK(lattice.radius == test::approx(12.0 / 2.0 - resolved::retraction(12.0)));
  const auto count = static_cast<double>(lattice.direction.size());
  Vec3 sum;
  double xx = 0.0;
  double xy = 0.0;
  for (const Vec3& n : lattice.direction) {
    CHECK(norm(n) == test::approx(1.0).epsilon(1e-14));
    sum += n;
    xx += n.x * n.x;
    xy += n.x * n.y;
  }
  CHECK(norm(sum) / count < 1e-3);
  CHECK(xx / count == test::approx(1.0 / 3.0).epsilon(1e-3));
  CHECK(std::abs(xy) / count < 1e-3);
  // The layer of one cell that they stand for, and pieces no larger than two and a half.
  const double layer = 4.0 / 3.0 * std::numbers::pi *
                       (std::pow(lattice.radius + 0.5, 3) - std::pow(lattice.radius - 0.5, 3));
  CHECK(count * lattice.volume == test::approx(layer).epsilon(1e-12));
  CHECK(lattice.volume < resolved::k_cells_per_marker);
  CHECK(lattice.volume > 0.8 * resolved::k_cells_per_marker);
  // None stands so near another one that a place would count twice, none so far that fluid passes.
  for (const Vec3& a : lattice.direction) {
    double nearest = 10.0;
    for (const Vec3& b : lattice.direction) {
      if (&a != &b) nearest = std::min(nearest, lattice.radius * norm(a - b));
    }
    CHECK(nearest > 1.2);
    CHECK(nearest < 1.7);
  }
}

}  // namespace dust::test
