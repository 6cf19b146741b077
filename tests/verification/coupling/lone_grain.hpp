// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "two_way.hpp"
#include "verification/fluid/test_bodies.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace dust::test {

struct TestFluid {
  const char* name;
  double density, viscosity;
};
inline constexpr TestFluid k_test_air{"air", k_air, k_air_viscosity};
inline constexpr TestFluid k_test_water{"water", 998.2, 0.998e-3};

/// Drag [N] of one sphere after Schiller and Naumann (1935), to which wen_yu tends without others.
inline double isolated_drag(double diameter, const TestFluid& fluid, double slip) {
  const double re = fluid.density * slip * diameter / fluid.viscosity;
  const double factor = re < 1000.0 ? 1.0 + 0.15 * std::pow(re, 0.687) : 0.44 / 24.0 * re;
  return 3.0 * std::numbers::pi * fluid.viscosity * diameter * factor * slip;
}
/// Slip [m/s] at which that drag is `force`.
inline double isolated_slip(double diameter, const TestFluid& fluid, double force) {
  double low = 0.0;
  double high = 100.0;
  for (int n = 0; n < 100; ++n) {
    const double middle = 0.5 * (low + high);
    (isolated_drag(diameter, fluid, middle) < force ? low : high) = middle;
  }
  return low;
}
inline double isolated_weight(double diameter, const TestFluid& fluid) {
  return (k_sand - fluid.density) * TwoWay::k_gravity * sdk::sphere_volume(diameter);
}

/// Velocity [m/s] per force [N] that the images of a force in a periodic box take from the one at
/// its place after the time t: Oseen's unsteady flow in free space less that in the box. The width
/// of the force hardly matters, for all short waves are in both.
inline double part_of_images(const TestFluid& fluid, double side, double speed, double width,
                             double time) {
  const double nu = fluid.viscosity / fluid.density;
  const auto built_up = [&](double k2, double along) {
    const double a = nu * k2;
    const double b = speed * along;
    const double fades = std::exp(-a * time);
    return (a - fades * (a * std::cos(b * time) - b * std::sin(b * time))) / (a * a + b * b);
  };
  constexpr double k_pi = std::numbers::pi;
  constexpr double k_reach = 5.0;
  constexpr int k_radial = 4000;
  constexpr int k_angles = 64;
  const double dk = k_reach / width / k_radial;
  double free = 0.0;
  for (int r = 0; r < k_radial; ++r) {
    const double k = (r + 0.5) * dk;
    for (int a = 0; a < k_angles; ++a) {
      const double x = (a + 0.5) / k_angles;
      free += k * k * std::exp(-k * k * width * width) * (1.0 - x * x) * built_up(k * k, k * x);
    }
  }
  free *= 2.0 * dk / k_angles / (4.0 * k_pi * k_pi);
  double box = 0.0;
  const double first = 2.0 * k_pi / side;
  const int most = static_cast<int>(k_reach / width / first) + 1;
  for (int k = 0; k <= most; ++k) {
    for (int j = 0; j <= most; ++j) {
      for (int i = 0; i <= most; ++i) {
        if (i + j + k == 0) continue;
        const double k2 = first * first * (i * i + j * j + k * k);
        const double twins = (i > 0 ? 2 : 1) * (j > 0 ? 2 : 1) * (k > 0 ? 2 : 1);
        const double along = first * k;
        box += twins * std::exp(-k2 * width * width) * (1.0 - along * along / k2) *
               built_up(k2, along);
      }
    }
  }
  box /= side * side * side;
  return (free - box) / fluid.density;
}

/// One grain in an otherwise empty fluid.
struct IsolatedGrain {
  enum class Motion { held, towed, free };  ///< in a stream; or through still fluid against z

  double diameter;  ///< [m]
  double ratio;     ///< D/dx
  TestFluid fluid;
  sdk::Vec3 place{0.21, 0.37, 0.68};  ///< in the cell, 0..1
  Motion motion = Motion::held;
  scenario::DisturbanceCorrection disturbance_correction =
      scenario::DisturbanceCorrection::automatic;
  std::string set = "I";
  bool overlaps = false;
  double beside = 0.0;          ///< cells to a side in y, 0 = periodic there
  bool is_across = false;       ///< moves to the side, not along it
  bool is_beside_slip = false;  ///< the side has no friction
  double floor = 0.0;           ///< cells to the top of a body over that side, 0 = none
  double tilt = 0.0;            ///< [rad] of the body's surface about x, the grain goes along z
  int box = 20;                 ///< cells of the fluid along each axis
  double cells_per_step = 0.3;  ///< way of the grain in a fluid step at most
  double carried = 0.0;         ///< [m/s] along z of grain and fluid together, with Motion::held

  /// Of the drag, in the last third of the run; of the speed with Motion::free.
  struct Error {
    double least = 1e9;
    double largest = -1e9;
    double mean = 0.0;
  };
  [[nodiscard]] Error error() const;
  /// [m/s], its slip unless it is free
  [[nodiscard]] double terminal() const {
    return isolated_slip(diameter, fluid, isolated_weight(diameter, fluid));
  }

 private:
  [[nodiscard]] double cell() const { return diameter / ratio; }
  [[nodiscard]] double duration() const;
  [[nodiscard]] World::Choice choice() const;
  [[nodiscard]] TwoWay::Sides sides() const;
  /// The body's surface: its normal, and the point of it that the grain is beside.
  [[nodiscard]] sdk::Vec3 normal() const { return {0.0, std::cos(tilt), std::sin(tilt)}; }
  [[nodiscard]] sdk::Vec3 foot() const {
    const sdk::Vec3 middle{0.5 * box + place.x, floor, 0.5 * box + place.z};
    return cell() * middle;
  }
  [[nodiscard]] bodies::BodySet solids() const {
    bodies::BodySet all;
    if (floor > 0.0) {
      all.push_back(body(std::make_unique<HalfSpace>(foot(), normal()), 0.0));
    }
    return all;
  }
};

/// Until the flow around it is built up, but before the grain meets its own wake; when free, until
/// it has its speed.
inline double IsolatedGrain::duration() const {
  constexpr double k_width = 0.7;  // cells
  const double nu = fluid.viscosity / fluid.density;
  const double built_up = (beside > 0.0 ? 120.0 : 30.0) * std::pow(k_width * cell(), 2) / nu;
  const double relaxing = motion == Motion::free ? 5.0 * terminal() / TwoWay::k_gravity : 0.0;
  return std::max(relaxing, std::min(0.8 * box * cell() / terminal(), built_up));
}
inline World::Choice IsolatedGrain::choice() const {
  const double side = box * cell();
  World::Choice c;
  c.max = {side, side, side};
  c.cells = {box, box, box};
  c.periodic = {true, beside == 0.0, !is_across};
  c.drag = "wen_yu";
  c.voidage = ratio > 0.5 ? "big_particle" : "divided";
  c.momentum_set = set;
  c.density = fluid.density;
  c.viscosity = fluid.viscosity;
  c.disturbance_correction = disturbance_correction;
  c.overlaps = overlaps;
  const double fastest = (terminal() + carried) * duration() / (cells_per_step * cell());
  c.fluid_step = duration() / std::max(40.0, std::ceil(fastest));
  return c;
}
inline TwoWay::Sides IsolatedGrain::sides() const {
  TwoWay::Sides all;
  const auto side = [&] { return is_beside_slip ? slip() : wall(); };
  if (beside > 0.0) {
    all[2] = side();
    all[3] = side();
  }
  // What moves to a side pushes fluid out of the box.
  if (is_across) {
    all[4] = side();
    all[5] = open_side(0.0, false);
  }
  return all;
}

inline IsolatedGrain::Error IsolatedGrain::error() const {
  const double length = box * cell();
  const double speed = terminal();
  TwoWay run(choice(), sides(), {}, 1e-6, solids());
  Grains& grains = run.world.grains;
  coupling::Coupling& coupling = *run.world.coupling;
  const double step = run.world.choice.fluid_step;
  const int d = is_across ? 1 : 2;
  sdk::Vec3 at = place;
  for (int axis = 0; axis < 3; ++axis) at[axis] = (box / 2 - 1 + at[axis]) * cell();
  if (beside > 0.0) at.y = beside * cell();
  if (floor > 0.0) at = foot() + beside * cell() * normal();
  sdk::Vec3 velocity;
  const bool is_in_stream = motion == Motion::held && beside == 0.0;
  if (motion != Motion::free) velocity[d] = is_in_stream ? carried : -speed;
  grains.add(at, velocity, diameter);
  if (is_in_stream)
    run.solver->set_velocity([&](sdk::Vec3) { return sdk::Vec3{0, 0, carried + speed}; });
  const sdk::Vec3 gravity{0, 0, -isolated_weight(diameter, fluid) * grains.velocity[3]};
  const int steps = static_cast<int>(std::lround(duration() / step));
  Error error;
  int count = 0;
  for (int n = 0; n < steps; ++n) {
    if (n == 0) run.world.begin_step(step);
    run.world.begin_step(step);
    run.solver->advance(run.time, step, coupling.void_fraction_before(), coupling.void_fraction(),
                        coupling.exchange());
    run.time += step;
    const auto evaluate_drag = [&] {
      run.world.evaluate(run.solver->drag_velocity());
      run.hold_fluid();
    };
    if (!overlaps) evaluate_drag();
    const int refreshes = static_cast<int>(std::lround(step / coupling.refresh_interval()));
    double force = 0.0;
    for (int r = 0; r < refreshes; ++r) {
      run.world.refresh();
      const double before = grains.impulse[static_cast<std::size_t>(d)];
      if (motion == Motion::free) {
        grains.move(step / refreshes, gravity);
      } else {
        grains.hold(step / refreshes);
        if (motion == Motion::towed || is_in_stream) {
          grains.position[static_cast<std::size_t>(d)] += velocity[d] * step / refreshes;
        }
      }
      force += (grains.impulse[static_cast<std::size_t>(d)] - before) / step;
    }
    if (overlaps) evaluate_drag();
    run.world.end_step();
    if (3 * n < 2 * steps) continue;
    const double own = grains.velocity[static_cast<std::size_t>(d)];
    double found = 0.0;
    if (beside > 0.0) {
      // A grain at rest in still fluid of a box with walls: what its images far away do is left in.
      found = force / isolated_drag(diameter, fluid, speed) - 1.0;
    } else {
      // The fluid of a closed box comes back somewhere.
      double mean = 0.0;
      run.world.for_cells([&](int i, int j, int k) {
        mean += run.world.face_void_fraction(d, i, j, k) *
                run.world.velocity.component[d][run.world.grid.index(i, j, k)];
      });
      const double slip = mean / std::pow(box, 3) - own;
      const double images = force * part_of_images(fluid, length, speed, 0.7 * cell(), run.time);
      found = motion == Motion::free ? (slip + images) / isolated_slip(diameter, fluid, force) - 1.0
                                     : force / isolated_drag(diameter, fluid, slip + images) - 1.0;
    }
    error.least = std::min(error.least, found);
    error.largest = std::max(error.largest, found);
    error.mean += (found - error.mean) / ++count;
    // A held grain sees the same until the end.
    if (motion == Motion::held && carried == 0.0) n = std::max(n, steps - 2);
  }
  return error;
}

}  // namespace dust::test
