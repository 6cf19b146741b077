// SPDX-License-Identifier: Apache-2.0
#include "dust/sdk/contact_plane.hpp"

#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <cmath>

using dust::sdk::in_contact_plane;
using dust::sdk::Vec3;
using dust::test::approx;

TEST_CASE("a spring along the plane shall stay as it is, one along the normal shall be gone") {
  const auto stays = in_contact_plane({3.0, 0.0, -4.0}, {0.0, 1.0, 0.0});
  CHECK(stays.part == Vec3{3.0, 0.0, -4.0});
  CHECK(stays.squared_before == 25.0);
  CHECK(stays.squared == 25.0);
  const auto gone = in_contact_plane({0.0, 2.0, 0.0}, {0.0, 1.0, 0.0});
  CHECK(gone.part == Vec3{});
  CHECK(gone.squared_before == 4.0);
  CHECK(gone.squared == 0.0);
}

TEST_CASE("a spring that turns with its contact once round shall come back, at its length") {
  // The normal goes round the z axis in small steps; the spring is across it, half along z. What is
  // along z stays, what is across follows the normal: after one turn both are where they were.
  constexpr int k_steps = 100000;
  Vec3 spring{0.0, 3.0, 4.0};
  for (int n = 1; n <= k_steps; ++n) {
    const double angle = 2.0 * 3.14159265358979323846 * n / k_steps;
    const Vec3 normal{std::cos(angle), std::sin(angle), 0.0};
    const auto turned = in_contact_plane(spring, normal);
    CHECK(dot(turned.part, normal) == approx(0.0).scale(1.0).epsilon(1e-12));
    spring = std::sqrt(turned.squared_before / turned.squared) * turned.part;
  }
  CHECK(norm(spring) == approx(5.0).epsilon(1e-10));
  // Of first order in the angle of a step: the length kept is that of the whole vector.
  CHECK(spring.y == approx(3.0).epsilon(1e-3));
  CHECK(spring.z == approx(4.0).epsilon(1e-3));
}
