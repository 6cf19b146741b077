// SPDX-License-Identifier: Apache-2.0
#include "particles/motion/leapfrog.hpp"

#include "base/lanes.hpp"
#include "dust/sdk/vec3.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <initializer_list>

namespace leapfrog = dust::particles::leapfrog;
using dust::lanes::Lanes;
using dust::sdk::Vec3;

namespace {

constexpr double k_step = 1e-4;
const Vec3 k_target{0.7, -0.2, 3.0};
const Vec3 k_gravity{0.0, 0.5, -9.81};

/// A particle after whole steps: its position and the velocity half a step before.
struct Flight {
  Vec3 position{1.0, 2.0, 3.0};
  Vec3 half_velocity{-0.4, 0.1, 0.2};
};

Flight step_by_step(std::int64_t count, double rate) {
  const leapfrog::Relaxation drag = leapfrog::relaxation(rate, k_step);
  const Vec3 push = k_step * k_gravity;
  Flight f;
  for (std::int64_t n = 0; n < count; ++n) {
    const Vec3 old = f.half_velocity;
    leapfrog::kick(old, push, k_target, drag.decay, drag.mean, f.half_velocity);
    f.position += k_step * f.half_velocity;
  }
  return f;
}

Flight at_once(std::int64_t count, double rate) {
  const leapfrog::Relaxation drag = leapfrog::relaxation(rate, k_step);
  Flight f;
  Vec3 change;
  leapfrog::first_change(f.half_velocity, k_step * k_gravity, k_target, drag.decay, drag.mean,
                         change);
  const auto flight = leapfrog::FreeFlight::of(count, drag.decay);
  f.position += k_step * (static_cast<double>(count) * f.half_velocity + flight.h * change);
  f.half_velocity += flight.g * change;
  return f;
}

/// dv/dt = k (u - v) + a: towards u + a / k by exp(-k t). The way is the sum of the half steps'.
Flight closed_form(std::int64_t count, double rate) {
  Flight f;
  const auto n = static_cast<double>(count);
  const Vec3 start = f.half_velocity;
  if (rate == 0.0) {
    f.half_velocity += n * k_step * k_gravity;
    f.position += n * k_step * start + (0.5 * n * (n + 1.0) * k_step * k_step) * k_gravity;
    return f;
  }
  const Vec3 end = k_target + k_gravity / rate;
  const double decay = std::exp(-rate * k_step);
  const double whole = std::exp(-rate * k_step * n);
  f.half_velocity = end + whole * (start - end);
  const double sum = decay * -std::expm1(-rate * k_step * n) / -std::expm1(-rate * k_step);
  f.position += k_step * (n * end + sum * (start - end));
  return f;
}

void check_near(const Flight& a, const Flight& b) {
  CHECK(norm(a.half_velocity - b.half_velocity) < 1e-13);
  CHECK(norm(a.position - b.position) < 1e-13);
}

}  // namespace

TEST_CASE("many steps of the leapfrog at once shall be the steps one by one and the closed form") {
  for (const double rate : {0.0, 3.0, 800.0, 2e5}) {
    for (const std::int64_t count : {1, 2, 3, 7, 64, 127, 256}) {
      CAPTURE(rate);
      CAPTURE(count);
      const Flight exact = closed_form(count, rate);
      check_near(step_by_step(count, rate), exact);
      check_near(at_once(count, rate), exact);
    }
  }
}

TEST_CASE("the leapfrog in vector registers shall give the bits of the scalar one") {
  for (const double rate : {0.0, 3.0, 800.0}) {
    const leapfrog::Relaxation drag = leapfrog::relaxation(rate, k_step);
    const Vec3 old{-0.4, 0.1, 0.2};
    const Vec3 push = k_step * k_gravity;
    const double mass_inverse = 3.7e5;
    Vec3 half;
    Vec3 velocity;
    Vec3 impulse;
    leapfrog::kick(old, push, k_target, drag.decay, drag.mean, half);
    leapfrog::predict(half, old, 0.5 * drag.decay, velocity);
    leapfrog::drag_impulse(half, old, push, mass_inverse, impulse);

    const auto lanes = [](const Vec3& v, Lanes& l) { l = Lanes{v.x, v.y, v.z, 0.0}; };
    Lanes l_old;
    Lanes l_push;
    Lanes l_target;
    lanes(old, l_old), lanes(push, l_push), lanes(k_target, l_target);
    Lanes l_half;
    Lanes l_velocity;
    Lanes l_impulse;
    const Lanes decay = Lanes{} + drag.decay;
    const Lanes mean = Lanes{} + drag.mean;
    const Lanes ahead = 0.5 * decay;
    const Lanes l_mass_inverse = Lanes{} + mass_inverse;
    leapfrog::kick(l_old, l_push, l_target, decay, mean, l_half);
    leapfrog::predict(l_half, l_old, ahead, l_velocity);
    leapfrog::drag_impulse(l_half, l_old, l_push, l_mass_inverse, l_impulse);
    for (int d = 0; d < 3; ++d) {
      CHECK(l_half[d] == half[d]);
      CHECK(l_velocity[d] == velocity[d]);
      CHECK(l_impulse[d] == impulse[d]);
    }
  }
}

TEST_CASE("the predicted velocity shall be exact under a constant acceleration") {
  // From rest at the time of the position: the first kick lasts half a step.
  const Vec3 still;
  const Vec3 push = 0.5 * k_step * k_gravity;
  Vec3 half;
  Vec3 velocity;
  leapfrog::kick(still, push, still, 1.0, 1.0, half);
  leapfrog::predict(half, still, 1.0, velocity);
  CHECK(norm(velocity - k_step * k_gravity) < 1e-18);
  // And on: the rest of the step is half of a whole kick.
  const Vec3 old = half;
  leapfrog::kick(old, k_step * k_gravity, still, 1.0, 1.0, half);
  leapfrog::predict(half, old, 0.5, velocity);
  CHECK(norm(velocity - 2.0 * k_step * k_gravity) < 1e-18);
}

TEST_CASE("drag shall hand over exactly the momentum that it changes") {
  const double rate = 800.0;
  const leapfrog::Relaxation drag = leapfrog::relaxation(rate, k_step);
  const Vec3 old{-0.4, 0.1, 0.2};
  const Vec3 push = k_step * k_gravity;
  const double mass = 3e-7;
  Vec3 half;
  Vec3 impulse;
  leapfrog::kick(old, push, k_target, drag.decay, drag.mean, half);
  leapfrog::drag_impulse(half, old, push, 1.0 / mass, impulse);
  CHECK(norm(mass * (half - old - push) - impulse) < 1e-15 * norm(impulse));
  // Over a short time it is the force at the beginning.
  const leapfrog::Relaxation brief = leapfrog::relaxation(rate, 1e-9);
  leapfrog::kick(old, 1e-9 * k_gravity, k_target, brief.decay, brief.mean, half);
  leapfrog::drag_impulse(half, old, 1e-9 * k_gravity, 1.0 / mass, impulse);
  CHECK(norm(impulse - (mass * rate * 1e-9) * (k_target - old)) < 1e-5 * norm(impulse));
}
