// SPDX-License-Identifier: Apache-2.0
#include "support/approx.hpp"
#include "unit/airborne/box.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

using namespace dust;
using namespace dust::test;

namespace {

/// Mean error of a blob that went once round a periodic row of `cells`.
double error_after_a_round(int cells) {
  Box box({cells, 1, 1}, {1, 1.0 / cells, 1.0 / cells}, {true, true, true});
  const auto blob = [](Vec3 x) { return smooth_blob({x.x, 0, 0}, {0.5, 0, 0}, 0.4); };
  box.set_velocity([](Vec3) { return Vec3{1, 0, 0}; });
  box.set_mass(blob);
  box.run(1.0, 8);
  double error = 0.0;
  box.each_cell([&](std::size_t cell, Vec3 x) { error += std::abs(box.mass()[cell] - blob(x)); });
  return error / cells;
}

}  // namespace

TEST_CASE("the advection of a smooth blob shall be of second order") {
  const double coarse = error_after_a_round(64);
  const double fine = error_after_a_round(128);
  const double order = std::log2(coarse / fine);
  INFO("errors " << coarse << " and " << fine << ", order " << order);
  // Van Leer's slopes are of first order at the blob's one extremum.
  CHECK(order > 1.75);
}

TEST_CASE("a sharp blob in a vortex shall stay between its bounds and keep its mass") {
  Box box({40, 1, 40}, {1, 0.025, 1}, {false, true, false});
  // Free of divergence on the grid: differences of a stream function at the edges.
  const double h = 1.0 / 40;
  const auto psi = [](double x, double z) {
    return std::pow(std::sin(std::numbers::pi * x) * std::sin(std::numbers::pi * z), 2) /
           std::numbers::pi;
  };
  box.set_velocity([&](Vec3 x) {
    return Vec3{(psi(x.x, x.z + 0.5 * h) - psi(x.x, x.z - 0.5 * h)) / h, 0,
                -(psi(x.x + 0.5 * h, x.z) - psi(x.x - 0.5 * h, x.z)) / h};
  });
  box.set_mass([](Vec3 x) { return norm(x - Vec3{0.5, x.y, 0.75}) < 0.15 ? 1.0 : 0.0; });
  const double before = box.in_air();
  box.run(1.0, 20);
  CHECK(box.in_air() == test::approx(before).epsilon(1e-13));
  const auto [least, most] = std::minmax_element(box.mass().begin(), box.mass().end());
  CHECK(*least >= 0.0);
  CHECK(*most <= 1.0 + 1e-12);
  CHECK(*most > 0.5);
}

TEST_CASE("a puff in a stream shall spread with the variance 2 D t") {
  constexpr int k_cells = 128;
  constexpr double k_diffusivity = 2e-3;
  constexpr double k_width = 0.06;
  constexpr double k_time = 0.5;
  Box box({k_cells, 1, 1}, {2, 1.0 / 64, 1.0 / 64}, {true, true, true});
  box.dust().diffusivity = k_diffusivity;
  box.set_velocity([](Vec3) { return Vec3{1, 0, 0}; });
  box.set_mass([](Vec3 x) { return std::exp(-0.5 * std::pow((x.x - 0.6) / k_width, 2)); });
  box.run(k_time, 10);
  double sum = 0.0, first = 0.0, second = 0.0;
  box.each_cell([&](std::size_t cell, Vec3 x) {
    sum += box.mass()[cell];
    first += x.x * box.mass()[cell];
    second += x.x * x.x * box.mass()[cell];
  });
  const double mean = first / sum;
  CHECK(mean == test::approx(0.6 + k_time).epsilon(2e-4));
  const double expected = k_width * k_width + 2.0 * k_diffusivity * k_time;
  // The limiter adds to the spread at the extremum: 4 % of it, nine tenths of a cell squared.
  CHECK(second / sum - mean * mean > expected);
  CHECK(second / sum - mean * mean == test::approx(expected).epsilon(0.05));
}

TEST_CASE("in still gas a clear front shall sink and the floor shall take what settles") {
  constexpr double k_speed = 0.1, k_start = 2.0;
  Box box({2, 2, 50}, {0.04, 0.04, 1}, {true, true, false});
  box.dust().drift = {0, 0, -k_speed};
  box.add_floor();
  box.set_mass([](Vec3) { return k_start; });
  const double before = box.in_air();
  box.run(5.0, 25);
  // Half a metre has settled; c0 w t on each square metre, in cells of 0.02 m.
  const double on_floor =
      std::accumulate(box.losses().walls.begin(), box.losses().walls.end(), 0.0) * 0.02 / 4;
  CHECK(on_floor == test::approx(k_start * k_speed * 5.0).epsilon(1e-12));
  CHECK(box.in_air() + box.lost() == test::approx(before).epsilon(1e-13));
  double above = 0.0;
  box.each_cell([&](std::size_t cell, Vec3 x) {
    if (x.z > 0.64) above = std::max(above, box.mass()[cell]);
    if (x.z < 0.4) CHECK(box.mass()[cell] == test::approx(k_start).epsilon(1e-3));
  });
  CHECK(above < 1e-2 * k_start);
  box.run(8.0, 40);
  CHECK(box.in_air() < 1e-3 * before);
}

TEST_CASE("a floor that lets gas in shall take only what sinks faster") {
  constexpr double k_sinking = 0.1, k_start = 2.0;
  for (const double speed : {0.0, 0.04, 0.1, 0.25}) {
    CAPTURE(speed);
    Box box({2, 2, 50}, {0.04, 0.04, 1}, {true, true, false});
    box.dust().drift = {0, 0, -k_sinking};
    box.set_velocity([&](Vec3) { return Vec3{0, 0, speed}; });
    box.add_sieve(speed);
    box.set_mass([](Vec3) { return k_start; });
    const double before = box.in_air();
    box.run(2.0, 40);
    const double on_floor =
        std::accumulate(box.losses().walls.begin(), box.losses().walls.end(), 0.0) * 0.02 / 4;
    CHECK(on_floor == test::approx(k_start * std::max(0.0, k_sinking - speed) * 2.0).epsilon(1e-9));
    CHECK(box.in_air() + box.lost() == test::approx(before).epsilon(1e-12));
  }
}

TEST_CASE("settling against diffusion shall leave the exponential profile") {
  constexpr double k_speed = 0.02, k_diffusivity = 2e-3;
  Box box({1, 1, 40}, {0.01, 0.01, 0.4}, {true, true, false});
  box.dust() = {10e-6, {0, 0, -k_speed}, k_diffusivity};
  box.set_mass([](Vec3) { return 1.0; });
  // No floor takes anything: the profile settles within H^2 / D.
  box.run(120.0, 240);
  std::vector<double> profile;
  box.each_cell([&](std::size_t cell, Vec3) { profile.push_back(box.mass()[cell]); });
  // exp(-w z / D) between the middles of neighbours, 10 mm apart.
  for (std::size_t n = 5; n < 35; n += 5) {
    CHECK(profile[n + 1] / profile[n] ==
          test::approx(std::exp(-k_speed * 0.01 / k_diffusivity)).epsilon(3e-3));
  }
}

TEST_CASE("a hood shall take what is drawn into it, and nothing shall be lost at slivers") {
  // A stream from left to right past a floor that cuts the lowest cells to a tenth.
  Box box({30, 1, 10}, {0.3, 0.01, 0.1}, {false, true, false});
  const double sliver = 0.1;
  for (int i = 0; i < 30; ++i) {
    const auto cell = static_cast<std::size_t>(box.grid().index(i, 0, 0));
    box.flow().volume_before[cell] = box.flow().volume_after[cell] = sliver;
  }
  box.each_face(0, [&](std::size_t face, Vec3 x, bool) {
    const double share = x.z < 0.01 ? sliver : 1.0;
    box.flow().passage.component[0][face] = share;
    box.flow().throughflow.component[0][face] = share * 0.5;
  });
  // The last cell of the top row draws a part of its stream out.
  const auto last = static_cast<std::int32_t>(box.grid().index(29, 0, 9));
  box.flow().sinks.push_back({last, 20.0, 1});
  box.flow().throughflow.component[0][static_cast<std::size_t>(last) + 1] = 0.5 - 20.0 * 0.01;
  box.set_mass([](Vec3) { return 1e-3; });
  const double before = box.in_air();
  box.run(0.1, 10);
  const auto [least, most] = std::minmax_element(box.mass().begin(), box.mass().end());
  CHECK(*least >= 0.0);
  CHECK(*most <= 1e-3 * (1.0 + 1e-12));
  box.run(2.0, 100);
  CHECK(box.in_air() < 1e-9 * before);
  CHECK(box.in_air() + box.lost() == test::approx(before).epsilon(1e-13));
  // 0.1 s after the start the tail has passed half a row: all of the top row's dust met the hood.
  CHECK(box.losses().outlets[1] == test::approx(0.4 * before / 9.1).epsilon(1e-6));
  CHECK(box.losses().outlets[0] == 0.0);
}

TEST_CASE("a cell that a body has closed before the end of a step shall keep no dust") {
  // The second of four cells closes; its gas goes to the right. No face of it is open by then.
  Box box({4, 1, 1}, {0.04, 0.01, 0.01}, {false, true, true});
  const auto closed = static_cast<std::size_t>(box.grid().index(1, 0, 0));
  constexpr double k_step = 0.1;
  box.flow().volume_after[closed] = 0.0;
  box.each_face(0, [&](std::size_t face, Vec3, bool is_side) {
    const bool is_its_own = face == closed || face == closed + 1;
    box.flow().passage.component[0][face] = is_side || is_its_own ? 0.0 : 1.0;
    box.flow().throughflow.component[0][face] = face > closed ? 0.01 / k_step : 0.0;
  });
  box.set_mass([](Vec3) { return 1e-3; });
  box.mass()[closed] = 1e-3;
  const double before = box.in_air();
  box.run(k_step, 1);
  CHECK(box.mass()[closed] == 0.0);
  CHECK(box.in_air() + box.lost() == test::approx(before).epsilon(1e-13));
}

TEST_CASE("gas that fills up with solids shall press its dust out without loss") {
  Box box({10, 1, 1}, {0.1, 0.01, 0.01}, {false, true, true});
  box.each_cell([&](std::size_t cell, Vec3 x) {
    box.flow().volume_before[cell] = 1.0;
    box.flow().volume_after[cell] = x.x < 0.05 ? 0.6 : 1.0;
  });
  box.each_face(0, [&](std::size_t face, Vec3 x, bool) {
    // What the left half loses goes to the right, out at the end.
    box.flow().throughflow.component[0][face] = 0.4 * std::min(x.x, 0.05) / 0.1;
    box.flow().passage.component[0][face] = 1.0;
  });
  box.each_cell([&](std::size_t cell, Vec3) { box.mass()[cell] = 1e-3; });
  const double before = box.in_air();
  box.run(0.1, 1);
  CHECK(box.in_air() + box.lost() == test::approx(before).epsilon(1e-13));
  box.each_cell([&](std::size_t cell, Vec3) {
    CHECK(box.mass()[cell] / box.flow().volume_after[cell] == test::approx(1e-3).epsilon(1e-12));
  });
}

TEST_CASE("dust shall stay where it is in a slot of slivers, not be mixed along all of it") {
  for (const bool is_at_end : {true, false}) {
    Box box({20, 1, 1}, {0.2, 0.01, 0.01}, {false, true, true});
    for (auto* volume : {&box.flow().volume_before, &box.flow().volume_after}) {
      std::fill(volume->begin(), volume->end(), 0.2);
    }
    auto& passage = box.flow().passage.component[0];
    std::fill(passage.begin(), passage.end(), 0.2);
    const double place = is_at_end ? 0.195 : 0.005;
    box.set_mass([&](Vec3 x) { return std::abs(x.x - place) < 1e-6 ? 1.0 : 0.0; });
    box.run(1.0, 10);
    double near = 0.0;
    box.each_cell([&](std::size_t cell, Vec3 x) {
      if (std::abs(x.x - place) > 0.025) {
        CHECK(box.mass()[cell] == 0.0);
      } else {
        near += box.mass()[cell];
      }
    });
    CHECK(near == test::approx(0.2).epsilon(1e-12));
  }
}
