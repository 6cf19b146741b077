// SPDX-License-Identifier: Apache-2.0
#include "resolved/inner_fluid.hpp"
#include "resolved_box.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <memory>

namespace dust::test {
namespace {

std::unique_ptr<ResolvedBox> falling_sphere(double density) {
  auto box = cubic_array(24, 3.0);
  box->step = 0.02;
  box->gravity = {0.0, 0.0, -1.0};
  box->grains.add({1.5, 1.45, 1.55}, 1.0, density);
  box->begin();
  return box;
}

}  // namespace

TEST_CASE("resolved: fluid inside that turns as a whole shall have the sphere's momentum") {
  auto box = cubic_array(24, 3.0);
  box->start();
  const resolved::Sphere sphere{0, {1.53, 1.41, 1.47}, {}, {}, 0.5};
  const Vec3 drift{0.3, -0.1, 0.2};
  const Vec3 spin{1.0, 2.0, -0.5};
  fluid::FaceField u(box->grid);
  for (int d = 0; d < 3; ++d) {
    box->each_face(d, [&](int i, int j, int k, Vec3 place, double) {
      const Vec3 v = drift + cross(spin, place - sphere.position);
      u.component[static_cast<std::size_t>(d)][static_cast<std::size_t>(box->grid.index(i, j, k))] =
          v[d];
    });
  }
  const auto inner = resolved::inner_momentum(box->grid, u, 2.0, sphere, sphere.position);
  const double mass = 2.0 * sdk::sphere_volume(1.0);
  CHECK(norm(inner.linear - mass * drift) < 0.01 * mass * norm(drift));
  const Vec3 turning = 0.4 * mass * 0.25 * spin;
  CHECK(norm(inner.angular - turning) < 0.03 * norm(turning));
}

TEST_CASE("resolved: a heavier sphere shall fall faster, and both towards an end") {
  const auto fall = [](double density) {
    auto box = falling_sphere(density);
    double before = 0.0;
    double speed = 0.0;
    // The fluid's mean stays at rest: its weight is held by the box.
    for (int n = 0; n < 25; ++n) {
      before = speed;
      box->one_step();
      box->set_source({0.0, 0.0, box->mean_force[0].z / 27.0});
      speed = -box->grains.velocity(0).z;
    }
    CHECK(speed > 0.0);
    CHECK(speed - before < 0.3 * 0.02);  // much of the weight is carried
    return speed;
  };
  CHECK(fall(4.0) > fall(2.0));
}

TEST_CASE("resolved: a sphere of the fluid's density shall stay with a uniform stream") {
  auto box = cubic_array(24, 3.0);
  box->step = 0.02;
  const Vec3 stream{0.5, 0.25, 0.0};
  box->grains.add({1.5, 1.45, 1.55}, 1.0, 1.0, stream);
  box->begin();
  box->solver->set_velocity([&](Vec3) { return stream; });
  for (int n = 0; n < 5; ++n) box->one_step();
  CHECK(norm(box->grains.velocity(0) - stream) < 1e-4 * norm(stream));
}

// The fluid meets the spin of the step before: a free sphere of 0.8 of the fluid's density spun up
// by itself at long steps.
TEST_CASE(
    "resolved: the spin of a light sphere shall die away, also with the longest step allowed") {
  auto box = cubic_array(24, 3.0);
  const double h = 3.0 / 24;
  box->step = h * h;
  box->grains.add({1.5, 1.45, 1.55}, 1.0, 0.8);
  box->grains.turn(0, {0.3, -0.2, 1.0});
  box->begin();
  const double at_first = norm(box->grains.rotation(0));
  for (int n = 0; n < 20; ++n) box->one_step();
  const double before = norm(box->grains.rotation(0));
  CHECK(before < 0.5 * at_first);
  for (int n = 0; n < 80; ++n) box->one_step();
  CHECK(norm(box->grains.rotation(0)) < 0.5 * before);
}

TEST_CASE("resolved: spheres shall go on from a checkpoint with the same bits") {
  auto whole = falling_sphere(2.0);
  auto half = falling_sphere(2.0);
  for (int n = 0; n < 3; ++n) {
    whole->one_step();
    half->one_step();
  }
  MemoryArchive fluid;
  MemoryArchive spheres;
  half->solver->save(fluid);
  half->spheres->save(spheres);
  auto resumed = falling_sphere(2.0);
  resumed->grains = half->grains;
  resumed->time = half->time;
  resumed->solver->load(fluid, half->time);
  resumed->spheres->load(spheres);
  for (int n = 0; n < 2; ++n) {
    whole->one_step();
    resumed->one_step();
  }
  CHECK(whole->grains.position(0) == resumed->grains.position(0));
  CHECK(whole->grains.velocity(0) == resumed->grains.velocity(0));
  CHECK(whole->grains.rotation(0) == resumed->grains.rotation(0));
}

}  // namespace dust::test
