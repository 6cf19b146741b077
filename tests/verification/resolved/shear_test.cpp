// SPDX-License-Identifier: Apache-2.0
#include "support/approx.hpp"
#include "unit/resolved/resolved_box.hpp"

#include <doctest/doctest.h>

#include <memory>

namespace dust::test {
namespace {

/// Spin of a free sphere of diameter 1 and the fluid's density halfway between walls that slide
/// against each other, over half the vorticity between them; once it is steady. At `shift` [1] from
/// the middle, where it moves along with the fluid.
double spin_in_shear(int across, double rate, double shift = 0.0) {
  constexpr double k_edge = 4.0;
  auto box = cubic_array(static_cast<int>(k_edge) * across, k_edge);
  const double h = 1.0 / across;
  box->sides[4] = wall({-0.5 * k_edge * rate, 0.0, 0.0});
  box->sides[5] = wall({0.5 * k_edge * rate, 0.0, 0.0});
  box->step = 0.5 * h * h;
  box->grains.add({2.03, 1.98, 2.0 + shift}, 1.0, 1.0, {shift * rate, 0.0, 0.0});
  box->begin();
  box->solver->set_velocity([&](Vec3 at) { return Vec3{rate * (at.z - 0.5 * k_edge), 0.0, 0.0}; });
  // Viscosity crosses the sphere's radius in 0.25 s.
  while (box->time < 1.0) box->one_step();
  return box->grains.rotation(0).y / (0.5 * rate);
}

}  // namespace

TEST_CASE("V-SHEAR: a free sphere in a slow shear shall turn with half its vorticity") {
  for (const int across : {8, 12, 16}) {
    const double spin = spin_in_shear(across, 1e-3);
    MESSAGE(across << " across: " << spin);
    CHECK(spin == test::approx(1.0).epsilon(0.01));
  }
  CHECK(spin_in_shear(8, 1e-3, 0.6) == test::approx(1.0).epsilon(0.03));
}

}  // namespace dust::test
