// SPDX-License-Identifier: Apache-2.0
// Sensors of the air on fields that are known in closed form.
#include "support/approx.hpp"
#include "support/sensor_bench.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace dust;
using namespace dust::test;
using sdk::Value;
using sdk::Vec3;

namespace {

/// 20 x 10 x 40 cells of 1 mm.
SyntheticScene air() {
  SyntheticScene world;
  world.domain_max = {0.02, 0.01, 0.04};
  set_cells(world, 20, 10, 40);
  return world;
}
Figures after(sdk::Sensor& sensor, SyntheticScene& world, int samples = 20) {
  for (int s = 0; s < samples; ++s) step(sensor, world);
  return summary_of(sensor);
}
/// Floats carry 7 digits.
constexpr double k_float = 1e-5;

void set_pressure(SyntheticScene& world, const std::function<double(Vec3)>& p) {
  for_cells(world, [&](std::size_t c, Vec3 x) { world.pressure[c] = static_cast<float>(p(x)); });
}
void set_velocity(SyntheticScene& world, const std::function<Vec3(Vec3)>& u) {
  for_cells(world, [&](std::size_t c, Vec3 x) {
    for (int d = 0; d < 3; ++d) world.velocity[d][c] = static_cast<float>(u(x)[d]);
  });
}

}  // namespace

TEST_CASE("pressure_drop shall be exact where the pressure is linear, between centres too") {
  SyntheticScene world = air();
  set_pressure(world, [](Vec3 x) { return 1000.0 - 5e4 * x.z + 300.0 * x.x; });
  const auto planes =
      load_sensor("pressure_drop").make({{"from", Vec3{0, 0, 0.0103}}, {"to", Vec3{0, 0, 0.0311}}});
  CHECK(after(*planes, world)["pressure_drop"] == test::approx(5e4 * 0.0208).epsilon(k_float));
  const auto points = load_sensor("pressure_drop")
                          .make({{"from", Vec3{0.0042, 0.005, 0.0103}},
                                 {"to", Vec3{0.0142, 0.005, 0.0311}},
                                 {"between", std::string("points")}});
  world.time = 0.0;
  CHECK(after(*points, world)["pressure_drop"] ==
        test::approx(5e4 * 0.0208 - 300.0 * 0.01).epsilon(k_float));
  CHECK_THROWS(
      load_sensor("pressure_drop").make({{"from", Vec3{0, 0, 0}}, {"to", Vec3{0.01, 0, 0.01}}}));
}

TEST_CASE("air_flow shall be exact for linear velocities, in rectangles that cut cells") {
  SyntheticScene world = air();
  set_velocity(world, [](Vec3 x) { return Vec3{0.1, 0.2, 3.0 + 100.0 * x.z - 50.0 * x.x}; });
  // 3.25 to 14.5 mm by 1 to 9 mm at a level between two layers of cells.
  const auto sensor =
      load_sensor("air_flow")
          .make({{"min", Vec3{0.00325, 0.001, 0.0213}}, {"max", Vec3{0.0145, 0.009, 0.0213}}});
  const Figures f = after(*sensor, world);
  const double area = 0.01125 * 0.008;
  CHECK(f["open_share"] == test::approx(1.0).epsilon(k_float));
  // The cell that is cut, at 3.5 mm, stands for all of its part: a thousandth of the whole.
  const double mean = 3.0 + 2.13 - 50.0 * 0.5 * (0.00325 + 0.0145);
  CHECK(f["mean_velocity"] == test::approx(mean).epsilon(2e-3));
  CHECK(f["net"] == test::approx(3600.0 * f["mean_velocity"] * area).epsilon(k_float));
  CHECK(f["forward"] == test::approx(f["net"]).epsilon(k_float));
  CHECK(f["backward"] == 0.0);
  CHECK(f["highest_velocity"] == test::approx(5.13 - 50.0 * 0.0035).epsilon(k_float));
  CHECK(f["lowest_velocity"] == test::approx(5.13 - 50.0 * 0.0145).epsilon(k_float));
  CHECK_THROWS(
      load_sensor("air_flow").make({{"min", Vec3{0, 0, 0.01}}, {"max", Vec3{0.01, 0.01, 0.02}}}));
  CHECK_THROWS(
      load_sensor("air_flow").make({{"min", Vec3{0, 0, 0.01}}, {"max", Vec3{0.01, 0, 0.01}}}));
}

TEST_CASE("air_flow shall tell flows both ways, without solids and bodies") {
  SyntheticScene world = air();
  // A body over a quarter of the section with nonsense inside; a bed of half voids through which
  // air goes up at 0.8 m/s in one half of the rest, down at 0.4 m/s in the other.
  for_cells(world, [&](std::size_t c, Vec3 x) {
    const bool is_body = x.x < 0.005;
    world.open_fraction[c] = is_body ? 0.0f : 1.0f;
    world.velocity[2][c] = is_body ? 77.0f : (x.y < 0.005 ? 0.8f : -0.4f);
    world.void_fraction[c] = 0.5f;
  });
  const auto sensor =
      load_sensor("air_flow").make({{"min", Vec3{0, 0, 0.02}}, {"max", Vec3{0.02, 0.01, 0.02}}});
  const Figures f = after(*sensor, world);
  const double half = 0.015 * 0.005;
  CHECK(f["forward"] == test::approx(3600.0 * 0.5 * 0.8 * half).epsilon(k_float));
  CHECK(f["backward"] == test::approx(3600.0 * 0.5 * 0.4 * half).epsilon(k_float));
  CHECK(f["net"] == test::approx(3600.0 * 0.5 * 0.4 * half).epsilon(k_float));
  CHECK(f["open_share"] == test::approx(0.75).epsilon(k_float));
  CHECK(f["lowest_velocity"] == test::approx(-0.4).epsilon(k_float));
  CHECK(f["highest_velocity"] == test::approx(0.8).epsilon(k_float));
  CHECK(f["net_at_end"] == test::approx(f["net"]).epsilon(k_float));
  // Of these the first screen and a comparison of runs show one.
  CHECK(f.at("net").towards == "overview");
  CHECK(f.at("net").role.quantity == sdk::Quantity::volume_rate);
  CHECK(f.at("forward").towards.empty());
}

TEST_CASE("pressure_drop shall leave bodies out of its means and count solids with the area") {
  SyntheticScene world = air();
  // A body over a quarter of the section with nonsense inside; a bed of half voids through which
  // air flows with 0.8 m/s: 0.75 * 0.5 * 0.8 = 0.3 m/s superficial.
  for_cells(world, [&](std::size_t c, Vec3 x) {
    const bool is_body = x.x < 0.005;
    world.open_fraction[c] = is_body ? 0.0f : 1.0f;
    world.pressure[c] = is_body ? -1e6f : static_cast<float>(100.0 - 1000.0 * x.z);
    world.velocity[2][c] = is_body ? 77.0f : -0.8f;
    world.void_fraction[c] = 0.5f;
  });
  const auto sensor =
      load_sensor("pressure_drop").make({{"from", Vec3{0, 0, 0.03}}, {"to", Vec3{0, 0, 0.01}}});
  const Figures figures = after(*sensor, world);
  CHECK(figures["pressure_drop"] == test::approx(-20.0).epsilon(k_float));
  CHECK(figures["superficial_velocity"] == test::approx(0.3).epsilon(k_float));
  CHECK(figures["superficial_velocity_at_end"] == test::approx(0.3).epsilon(k_float));
}

TEST_CASE("probe shall be exact on linear fields, along lines and in planes") {
  SyntheticScene world = air();
  set_velocity(world, [](Vec3 x) { return Vec3{10 * x.z, -5 * x.x, 1 + x.y}; });
  set_pressure(world, [](Vec3 x) { return 7.0 - 400 * x.z; });
  for_cells(world, [&](std::size_t c, Vec3 x) {
    world.void_fraction[c] = static_cast<float>(0.5 + 10 * x.z);
  });
  const auto line = load_sensor("probe").make({{"from", Vec3{0.0052, 0.0045, 0.0103}},
                                               {"to", Vec3{0.0152, 0.0045, 0.0303}},
                                               {"count", std::int64_t{5}}});
  const Figures figures = after(*line, world);
  for (int n = 0; n < 5; ++n) {
    const std::string place = "place_" + std::to_string(n + 1) + "/";
    const double z = 0.0103 + 0.005 * n;
    const double x = 0.0052 + 0.0025 * n;
    CHECK(figures[place + "velocity_x"] == test::approx(10 * z).epsilon(k_float));
    CHECK(figures[place + "velocity_y"] == test::approx(-5 * x).epsilon(k_float));
    CHECK(figures[place + "velocity_z"] == test::approx(1.0045).epsilon(k_float));
    CHECK(figures[place + "pressure"] == test::approx(7.0 - 400 * z).epsilon(k_float));
    CHECK(figures[place + "void_fraction"] == test::approx(0.5 + 10 * z).epsilon(k_float));
  }
  // Two lines 4 mm apart; the series is the mean over all places.
  const auto plane = load_sensor("probe").make({{"from", Vec3{0.005, 0.003, 0.01}},
                                                {"to", Vec3{0.005, 0.003, 0.02}},
                                                {"count", std::int64_t{2}},
                                                {"across", Vec3{0.004, 0, 0}},
                                                {"count_across", std::int64_t{2}}});
  world.time = 0.0;
  const Figures section = after(*plane, world);
  CHECK(section["place_3/velocity_y"] == test::approx(-5 * 0.009).epsilon(k_float));
  CHECK(section["place_4/velocity_x"] == test::approx(0.2).epsilon(k_float));
  CHECK(series_of(*plane)["velocity_x"] == test::approx(0.15).epsilon(k_float));
  CHECK_THROWS(load_sensor("probe").make(
      {{"from", Vec3{}}, {"to", Vec3{}}, {"count_across", std::int64_t{3}}}));
}

TEST_CASE("probe shall look past bodies and stay at the last centre beyond the sides") {
  SyntheticScene world = air();
  set_velocity(world, [](Vec3 x) { return Vec3{0, 0, 100 * x.z}; });
  for_cells(world, [&](std::size_t c, Vec3 x) {
    if (x.z < 0.01) return;
    world.open_fraction[c] = x.z < 0.02 ? 0.2f : 1.0f;
    if (x.z < 0.02) world.velocity[2][c] = -9.0f;
  });
  const auto sensor = load_sensor("probe").make({{"from", Vec3{0.01, 0.005, -0.01}},
                                                 {"to", Vec3{0.01, 0.005, 0.0102}},
                                                 {"count", std::int64_t{2}}});
  const Figures figures = after(*sensor, world);
  CHECK(figures["place_1/velocity_z"] == test::approx(0.05).epsilon(k_float));
  CHECK(figures["place_2/velocity_z"] == test::approx(0.95).epsilon(k_float));
}

TEST_CASE("wall_shear shall be the viscosity times the slope, the wall's motion taken off") {
  SyntheticScene world = air();
  set_velocity(world, [](Vec3 x) { return Vec3{30 * x.z, -40 * x.z, 0}; });
  const auto floor = load_sensor("wall_shear").make({{"side", std::string("bottom")}});
  const Figures figures = after(*floor, world);
  const double area = 0.02 * 0.01;
  CHECK(figures["mean"] == test::approx(1.8e-5 * 50).epsilon(k_float));
  CHECK(figures["largest"] == test::approx(1.8e-5 * 50).epsilon(k_float));
  CHECK(figures["force_x"] == test::approx(1.8e-5 * 30 * area).epsilon(k_float));
  CHECK(figures["force_y"] == test::approx(-1.8e-5 * 40 * area).epsilon(k_float));
  CHECK(figures["force_z"] == 0.0);
  // The lid moves with the air that touches it.
  const auto lid = load_sensor("wall_shear")
                       .make({{"side", std::string("top")}, {"wall_velocity", Vec3{1.2, -1.6, 0}}});
  world.time = 0.0;
  // Half a cell below it the air is slower by 30 * 0.5 mm/s: the lid is held back.
  CHECK(after(*lid, world)["force_x"] == test::approx(-1.8e-5 * 30 * area).epsilon(1e-3));
  // A body that covers half of the side carries its share itself.
  for_cells(world,
            [&](std::size_t c, Vec3 x) { world.open_fraction[c] = x.x < 0.01 ? 0.0f : 1.0f; });
  const auto half = load_sensor("wall_shear").make({{"side", std::string("bottom")}});
  world.time = 0.0;
  CHECK(after(*half, world)["force_x"] == test::approx(1.8e-5 * 15 * area).epsilon(k_float));
}

TEST_CASE("vorticity shall be twice the rate of a solid rotation, about each axis") {
  for (int axis = 0; axis < 3; ++axis) {
    CAPTURE(axis);
    SyntheticScene world = air();
    Vec3 turn;
    turn[axis] = 25.0;
    set_velocity(world, [&](Vec3 x) { return cross(turn, x - Vec3{0.01, 0.005, 0.02}); });
    const auto sensor = load_sensor("vorticity").make({});
    const Figures figures = after(*sensor, world);
    const char* const names[] = {"mean_x", "mean_y", "mean_z"};
    for (int d = 0; d < 3; ++d) {
      CHECK(figures[names[d]] == test::approx(d == axis ? 50.0 : 0.0).epsilon(1e-4));
    }
    CHECK(figures["largest"] == test::approx(50.0).epsilon(1e-4));
    CHECK(figures["mean_size"] == test::approx(50.0).epsilon(1e-4));
  }
}

TEST_CASE("vorticity shall find where the mean flow turns fastest, in its box and in the open") {
  SyntheticScene world = air();
  // An eddy at (14.5, *, 30.5) mm, a stronger one in a body at (5.5, *, 10.5).
  const auto eddy = [](Vec3 x, double cx, double cz, double strength) {
    const double r2 = std::pow((x.x - cx) / 2e-3, 2) + std::pow((x.z - cz) / 2e-3, 2);
    const double s = strength * std::exp(-r2);
    return Vec3{s * (x.z - cz), 0, -s * (x.x - cx)};
  };
  set_velocity(world, [&](Vec3 x) {
    return eddy(x, 0.0145, 0.0305, 200.0) + eddy(x, 0.0055, 0.0105, 300.0);
  });
  const auto whole = load_sensor("vorticity").make({});
  Figures figures = after(*whole, world);
  CHECK(figures["fastest/x"] == test::approx(0.0055).epsilon(1e-9));
  CHECK(figures["fastest/z"] == test::approx(0.0105).epsilon(1e-9));
  const auto upper =
      load_sensor("vorticity").make({{"min", Vec3{0, 0, 0.02}}, {"max", Vec3{0.02, 0.01, 0.04}}});
  world.time = 0.0;
  figures = after(*upper, world);
  CHECK(figures["fastest/x"] == test::approx(0.0145).epsilon(1e-9));
  CHECK(figures["fastest/z"] == test::approx(0.0305).epsilon(1e-9));
  // In the middle -dw/dx + du/dz = 2 * 200 1/s, less by differences over 2 of 4 mm.
  CHECK(figures["fastest/vorticity"] == test::approx(400.0 * std::exp(-0.25)).epsilon(1e-4));
  for_cells(world, [&](std::size_t c, Vec3 x) {
    world.open_fraction[c] = norm(x - Vec3{0.0055, x.y, 0.0105}) < 2.5e-3 ? 0.0f : 1.0f;
  });
  const auto open = load_sensor("vorticity").make({});
  world.time = 0.0;
  figures = after(*open, world);
  CHECK(figures["fastest/z"] == test::approx(0.0305).epsilon(1e-9));
}
