// SPDX-License-Identifier: Apache-2.0
#include "particles/motion/free_flight.hpp"

#include "base/lanes.hpp"
#include "dust/sdk/plugin.hpp"
#include "particles/motion/leapfrog.hpp"

namespace dust::particles {
namespace {

/// What the kernel works on.
struct FlightRows {
  MotionRows rows;
  const std::uint8_t* activity = nullptr;
  std::size_t begin = 0;
  std::size_t end = 0;
};

DUST_KERNEL void advance_rows(const FlightRows& f, double step, std::int64_t count) {
  using lanes::Lanes;
  const MotionRows& r = f.rows;
  const auto row_of = [](double* p, std::size_t n) __attribute__((always_inline))->Lanes& {
    return *reinterpret_cast<Lanes*>(p + 4 * n);
  };
  const auto velocity = [&r](std::size_t n) __attribute__((always_inline))->Lanes& {
    return *reinterpret_cast<Lanes*>(r.motion + ParticleStore::k_motion_stride * n);
  };
  const auto half_velocity = [&r](std::size_t n) __attribute__((always_inline))->Lanes& {
    return *reinterpret_cast<Lanes*>(r.motion + ParticleStore::k_motion_stride * n + 4);
  };
  const auto fixed =
      [](const double* p, std::size_t n) __attribute__((always_inline))->const Lanes& {
    return *reinterpret_cast<const Lanes*>(p + 4 * n);
  };
  const Lanes three{1.0, 1.0, 1.0, 0.0};
  const Lanes fourth{0.0, 0.0, 0.0, 1.0};
  const auto total = static_cast<double>(count);
  for (std::size_t n = f.begin; n < f.end; ++n) {
    if (f.activity[n] != 0) continue;
    const Lanes push = fixed(r.gravity, static_cast<std::size_t>(r.material[n])) * step * three;
    const Lanes old = half_velocity(n) * three;
    double decay = 1.0;
    Lanes first = push;
    if (r.has_drag) {
      decay = r.decay[2 * n];
      const Lanes target = fixed(r.drag, n) * three;
      leapfrog::first_change(old, push, target, decay, r.decay[2 * n + 1], first);
    }
    const auto flight = leapfrog::FreeFlight::of(count, decay);
    const Lanes half = old + first * flight.g;
    row_of(r.position, n) += (old * total + first * flight.h) * step;
    velocity(n) = (half + first * (0.5 * flight.power)) + fourth * velocity(n);
    half_velocity(n) = half + fourth * half_velocity(n);
    if (r.has_drag) {
      const Lanes whole_push = push * total;
      const double inverse_mass = velocity(n)[3];
      Lanes received;
      leapfrog::drag_impulse(half, old, whole_push, inverse_mass, received);
      row_of(r.impulse, n) += received;
    }
  }
}

}  // namespace

void advance_free_flight(const MotionRows& rows, std::span<const std::uint8_t> activity,
                         std::size_t begin, std::size_t end, double step, std::int64_t count) {
  advance_rows({.rows = rows, .activity = activity.data(), .begin = begin, .end = end}, step,
               count);
}

}  // namespace dust::particles
