// SPDX-License-Identifier: Apache-2.0
#include "bodies/body_set.hpp"
#include "dust/sdk/error.hpp"
#include "motion/belt/belt.hpp"
#include "support/approx.hpp"
#include "support/dem_rig.hpp"
#include "unit/bodies/shapes.hpp"
#include "verification/walls/wall_rig.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

namespace {

using dust::bodies::Body;
using dust::sdk::Motion;
using dust::sdk::RigidPose;
using dust::sdk::Value;
using dust::sdk::Vec3;
using dust::test::approx;
using dust::test::make_shape;
using dust::test::ModelLoader;
using dust::test::WallRig;

std::unique_ptr<Motion> motion(const std::string& name,
                               const std::map<std::string, Value>& values) {
  return ModelLoader::make<Motion>("motion", name, values);
}

/// Where a point fixed to the body is.
Vec3 carried(const Body& body, Vec3 point, double time) {
  return body.placement(time).to_domain(point);
}

Body box_with(std::vector<std::unique_ptr<Motion>> motions) {
  Body body;
  body.shape = make_shape("box", {{"min", Vec3{-1, -1, -1}}, {"max", Vec3{1, 1, 1}}});
  body.motions = std::move(motions);
  return body;
}

template <class... M>
std::vector<std::unique_ptr<Motion>> list(M... m) {
  std::vector<std::unique_ptr<Motion>> all;
  (all.push_back(std::move(m)), ...);
  return all;
}

/// Angular velocity of the surface nearest to a point of the domain.
Vec3 rotation_near(const Body& body, Vec3 over, double time) {
  const auto at = body.placement(time);
  const auto s = body.nearest(over, at);
  const Vec3 p = over - s.distance * s.normal;
  Vec3 v;
  Vec3 w{7, 7, 7};
  const dust::bodies::SurfaceMotion now{time, {&v.x, &v.y, &v.z}, {&w.x, &w.y, &w.z}};
  body.find_motion({1, {&p.x, &p.y, &p.z}, {&s.normal.x, &s.normal.y, &s.normal.z}}, at, {&now, 1});
  return w;
}

std::string problem(const std::string& name, const std::map<std::string, Value>& values) {
  try {
    motion(name, values);
  } catch (const dust::sdk::ParameterError& e) {
    return e.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a lifted body shall go as far as it is told and no farther") {
  const auto lift =
      motion("translate", {{"velocity", Vec3{0, 0, 0.01}}, {"start", 0.5}, {"travel", 0.01}});
  CHECK(lift->pose(0.3).shift == Vec3{});
  CHECK(lift->pose(0.3).velocity == Vec3{});
  CHECK(lift->pose(1.0).shift.z == approx(0.005).epsilon(1e-14));
  CHECK(lift->pose(1.0).velocity.z == approx(0.01).epsilon(1e-14));
  CHECK(lift->pose(2.0).shift.z == 0.01);  // to the last bit
  CHECK(lift->pose(2.0).velocity == Vec3{});
  CHECK(lift->largest_speed() == approx(0.01).epsilon(1e-14));
  const auto stopped =
      motion("translate", {{"velocity", Vec3{2, 0, 0}}, {"stop", 0.25}, {"ramp", 0.1}});
  CHECK(stopped->pose(0.05).shift.x == approx(0.5 * 2 * 0.05 * 0.05 / 0.1).epsilon(1e-14));
  CHECK(stopped->pose(0.05).velocity.x == approx(1.0).epsilon(1e-14));
  CHECK(stopped->pose(9.0).shift.x == approx(2 * (0.25 - 0.05)).epsilon(1e-14));
  // An end on the ramp.
  const auto short_way =
      motion("translate", {{"velocity", Vec3{2, 0, 0}}, {"travel", 0.025}, {"ramp", 0.1}});
  CHECK(short_way->pose(0.049).velocity.x > 0.9);
  CHECK(short_way->pose(0.051).velocity.x == 0.0);
  CHECK(short_way->pose(0.051).shift.x == 0.025);
}

TEST_CASE("velocities shall be the rates at which places change, alone and combined") {
  std::vector<Body> bodies;
  bodies.push_back(
      box_with(list(motion("translate", {{"velocity", Vec3{0.1, 0.2, -0.3}}, {"ramp", 3.0}}))));
  bodies.push_back(box_with(list(motion(
      "rotate", {{"pivot", Vec3{0.5, 0, 0.2}}, {"spin_axis", Vec3{1, 2, 2}}, {"spin", -3.0}}))));
  const std::map<std::string, Value> swing = {{"amplitude", std::vector<double>{0.01, 0.002}},
                                              {"frequency", std::vector<double>{3.0, 11.0}},
                                              {"phase", std::vector<double>{0.3, 1.0}},
                                              {"along", std::vector<Vec3>{{0, 0, 1}, {1, 1, 0}}}};
  bodies.push_back(box_with(list(motion("oscillate", swing))));
  bodies.push_back(box_with(list(
      motion("rotate", {{"pivot", Vec3{0.5, 0, 0}}, {"spin_axis", Vec3{0, 0, 1}}, {"spin", 2.0}}),
      motion("oscillate", swing),
      motion("rotate", {{"pivot", Vec3{0, 1, 0}}, {"spin_axis", Vec3{1, 0, 0}}, {"spin", 0.7}}))));
  for (Body& body : bodies) {
    body.frame_origin = {0.1, 0.2, 0.3};
    body.frame_axis = {0, 0.6, 0.8};
    body.frame_angle = 0.4;
    for (const double time : {0.1, 0.37, 1.2}) {
      for (const Vec3 point : {Vec3{1, 0.3, -0.2}, Vec3{-1, 1, 1}}) {
        constexpr double h = 1e-5;
        const Vec3 rate =
            (carried(body, point, time + h) - carried(body, point, time - h)) / (2 * h);
        const Vec3 now = carried(body, point, time);
        const Vec3 v = body.surface_velocity(now, {0, 0, 1}, time);
        // Central difference: third derivative times h^2 / 6, below 1e-6 here.
        CHECK(norm(v - rate) < 1e-6);
        // The surface has gone with the body.
        CHECK(std::abs(body.nearest(now, body.placement(time)).distance) < 1e-12);
      }
    }
  }
}

TEST_CASE("an oscillation shall start where the body stands and stop where it is") {
  const auto swing = motion("oscillate", {{"amplitude", std::vector<double>{0.01}},
                                          {"frequency", std::vector<double>{2.0}},
                                          {"phase", std::vector<double>{std::numbers::pi / 2}},
                                          {"along", std::vector<Vec3>{{0, 0, 3}}},
                                          {"start", 1.0},
                                          {"stop", 1.25}});
  CHECK(swing->pose(0.9).shift == Vec3{});
  CHECK(norm(swing->pose(1.0).shift) < 1e-15);
  CHECK(swing->pose(1.2499999).shift.z == approx(-0.02).epsilon(1e-6));
  CHECK(swing->pose(5.0).shift.z == approx(-0.02).epsilon(1e-12));
  CHECK(swing->pose(5.0).velocity == Vec3{});
  CHECK(swing->largest_speed() == approx(2 * std::numbers::pi * 2 * 0.01).epsilon(1e-12));
}

TEST_CASE("a belt shall gather speed evenly, and shake when it is told to") {
  for (const double speed : {0.8, -0.8}) {  // backwards too
    const auto belt = motion("belt", {{"speed", speed}, {"start", 0.1}, {"ramp", 0.5}});
    CHECK(belt->pose(0.05).velocity.x == 0.0);
    CHECK(belt->pose(0.35).velocity.x == approx(0.5 * speed).epsilon(1e-14));
    CHECK(belt->pose(0.7).velocity.x == speed);
    CHECK(belt->pose(0.05).shift.x == 0.0);
    CHECK(belt->pose(0.7).shift.x == approx(speed * (0.25 + 0.1)).epsilon(1e-14));
  }
  Body body;
  body.shape =
      make_shape("conveyor", {{"head", Vec3{1, 0, 0}}, {"tail", Vec3{-1, 0, 0}}, {"radius", 0.1}});
  body.motions = list(motion("belt", {{"speed", 0.8}, {"ramp", 1.0}}),
                      motion("oscillate", {{"amplitude", std::vector<double>{0.001}},
                                           {"frequency", std::vector<double>{10.0}},
                                           {"along", std::vector<Vec3>{{0, 0, 1}}}}));
  CHECK(body.displaces());
  const Vec3 v = body.surface_velocity({0, 0, 0.1}, {0, 0, 1}, 0.5);
  CHECK(v.x == approx(0.4).epsilon(1e-12));
  CHECK(v.z ==
        approx(0.001 * 2 * std::numbers::pi * 10 * std::cos(10 * std::numbers::pi)).epsilon(1e-9));
}

TEST_CASE("a belt shall keep its speed where idlers lean its surface to the axis") {
  using dust::model::belt::velocity;
  for (const double degrees : {0.0, 20.0, 35.0, 45.0, 80.0}) {
    const double lean = degrees * std::numbers::pi / 180.0;
    const auto v = velocity(2.0, 0, 1, 0, 0, -std::sin(lean), std::cos(lean));
    CAPTURE(degrees);
    CHECK(v.x == approx(2.0).epsilon(1e-12));
    CHECK(v.y == 0.0);
    CHECK(v.z == 0.0);
  }
  // At the face of a pulley's end nothing tells where to.
  const auto v = velocity(2.0, 0, 1, 0, 0, 1, 0);
  CHECK(std::hypot(v.x, v.y, v.z) == 0.0);
}

TEST_CASE("a troughed belt in a turned frame shall run along its wings as fast as in its middle") {
  Body body;
  body.shape = make_shape("belt_conveyor", {{"head", Vec3{}},
                                            {"tail", Vec3{-6, 0, 0}},
                                            {"radius", 0.3},
                                            {"thickness", 0.02},
                                            {"width", 1.0},
                                            {"trough_angle", 0.6}});
  body.motions = list(motion("belt", {{"speed", 2.5}}));
  body.frame_origin = {1, 2, 3};
  body.frame_axis = {0, 0, 1};
  body.frame_angle = 1.1;
  const auto at = body.placement(0.0);
  // A fluid asks for all its wall points at once, grains for a batch of contacts.
  std::vector<double> in[6];
  std::vector<double> out[3];
  for (const double x : {-3.0, -0.9}) {
    for (const double y : {-0.4, -0.2, 0.0, 0.3}) {
      const auto s = body.nearest(at.to_domain({x, y, 0.8}));
      const Vec3 p = at.to_domain({x, y, 0.8}) - s.distance * s.normal;
      for (int d = 0; d < 3; ++d) {
        in[d].push_back(p[d]);
        in[3 + d].push_back(s.normal[d]);
        out[d].push_back(0.0);
      }
    }
  }
  body.surface_velocities({.count = in[0].size(),
                           .time = 0.0,
                           .axis = {},
                           .position = {in[0].data(), in[1].data(), in[2].data()},
                           .normal = {in[3].data(), in[4].data(), in[5].data()},
                           .velocity = {out[0].data(), out[1].data(), out[2].data()}});
  const Vec3 along = at.turn({1, 0, 0});
  for (std::size_t n = 0; n < in[0].size(); ++n) {
    CAPTURE(n);
    const Vec3 v{out[0][n], out[1][n], out[2][n]};
    CHECK(norm(v) == approx(2.5).epsilon(1e-9));
    CHECK(std::abs(dot(v, {in[3][n], in[4][n], in[5][n]})) < 1e-9);
    // In the trough straight along the belt, in the transition nearly so.
    CHECK(dot(v, along) > (n < 4 ? 2.5 * (1 - 1e-9) : 2.5 * 0.97));
  }
}

TEST_CASE("velocities asked for at two times at once shall be those of each") {
  const std::map<std::string, Value> plain{{"head", Vec3{}}, {"tail", Vec3{-6, 0, 0}},
                                           {"radius", 0.3},  {"thickness", 0.02},
                                           {"width", 1.0},   {"trough_angle", 0.6}};
  auto with_cleats = plain;
  with_cleats.insert({{"cleat_height", 0.05}, {"cleat_thickness", 0.02}, {"cleat_spacing", 0.5}});
  for (const auto& belt : {plain, with_cleats}) {
    Body body;
    body.shape = make_shape("belt_conveyor", belt);
    body.motions = list(motion("belt", {{"speed", 2.0}, {"ramp", 1.0}}));
    body.frame_origin = {1, 2, 3};
    body.frame_angle = 0.3;
    const auto at = body.placement(0.0);
    std::vector<double> in[6];
    for (const Vec3 over : {Vec3{-3.0, 0.2, 0.8}, Vec3{-0.9, -0.4, 0.8}, Vec3{-2.0, 0.1, -0.8}}) {
      const auto s = body.nearest(at.to_domain(over), at);
      const Vec3 p = at.to_domain(over) - s.distance * s.normal;
      for (int d = 0; d < 3; ++d) {
        in[d].push_back(p[d]);
        in[3 + d].push_back(s.normal[d]);
      }
    }
    const std::size_t count = in[0].size();
    std::vector<double> out[6];
    for (auto& column : out) column.assign(count, -1.0);
    const dust::sdk::SurfaceBatch batch{.count = count,
                                        .time = 1.5,
                                        .axis = {},
                                        .position = {in[0].data(), in[1].data(), in[2].data()},
                                        .normal = {in[3].data(), in[4].data(), in[5].data()},
                                        .velocity = {out[0].data(), out[1].data(), out[2].data()}};
    const dust::bodies::SurfaceMotion instants[] = {
        {1.5, {out[0].data(), out[1].data(), out[2].data()}, {}},
        {0.25, {out[3].data(), out[4].data(), out[5].data()}, {}}};
    body.find_motion({count, batch.position, batch.normal}, at, instants);
    std::vector<double> alone[3];
    for (auto& column : alone) column.assign(count, -1.0);
    auto one = batch;
    one.velocity = {alone[0].data(), alone[1].data(), alone[2].data()};
    for (const int first : {0, 3}) {
      CAPTURE(first);
      one.time = first == 0 ? 1.5 : 0.25;
      body.surface_velocities(one, at);
      for (int d = 0; d < 3; ++d) {
        for (std::size_t n = 0; n < count; ++n) CHECK(out[first + d][n] == alone[d][n]);
      }
      // At full speed, and in the first quarter of the ramp.
      const double speed = first == 0 ? 2.0 : 0.5;
      if (belt.size() == plain.size()) {
        CHECK(std::hypot(out[first][0], out[first + 1][0], out[first + 2][0]) ==
              approx(speed).epsilon(1e-9));
      }
    }
  }
}

TEST_CASE("a drum about its own axis shall stand while its surface turns") {
  Body drum;
  drum.shape = make_shape("cylinder", {{"base", Vec3{}},
                                       {"axis", Vec3{0, 1, 0}},
                                       {"length", 1.0},
                                       {"radius", 0.5},
                                       {"thickness", 0.1}});
  drum.motions = list(
      motion("rotate", {{"pivot", Vec3{0, 9, 0}}, {"spin_axis", Vec3{0, 1, 0}}, {"spin", 2.0}}));
  CHECK_FALSE(drum.displaces());
  CHECK(drum.largest_displacing_speed() == 0.0);
  const Vec3 v = drum.surface_velocity({0, 0.5, -0.5}, {0, 0, 1}, 3.0);
  CHECK(norm(v - Vec3{-1, 0, 0}) < 1e-12);
  drum.motions = list(
      motion("rotate", {{"pivot", Vec3{0.1, 0, 0}}, {"spin_axis", Vec3{0, 1, 0}}, {"spin", 2.0}}));
  CHECK(drum.displaces());
}

TEST_CASE("a body that turns shall be as fast as its farthest point in the domain can be") {
  constexpr double k_spin = 2.0;
  const auto speed_of = [&](const std::string& shape, const std::map<std::string, Value>& values) {
    WallRig rig(0.5, 0.2, 1e-3);
    rig.setup.domain.min = {0, 0, 0};
    rig.setup.domain.max = {0.3, 0.2, 0.4};
    const std::map<std::string, Value> about_y = {
        {"pivot", Vec3{0, 0, -1e-3}}, {"spin_axis", Vec3{0, -1, 0}}, {"spin", k_spin}};
    return rig.body(shape, values, WallRig::motion("rotate", about_y)).largest_displacing_speed();
  };
  // An endless one just below the domain: nothing of it is inside at first.
  const double of_plane =
      speed_of("plane", {{"point", Vec3{0, 0, -1e-3}}, {"normal", Vec3{0, 0, 1}}});
  CHECK(of_plane == approx(k_spin * std::hypot(0.3, 0.401)));
  const double of_box =
      speed_of("box", {{"min", Vec3{0.1, 0.1, 0.1}}, {"max", Vec3{0.2, 0.12, 0.15}}});
  CHECK(of_box == approx(k_spin * std::hypot(0.2, 0.151)));
}

TEST_CASE("motions that contradict themselves shall be refused") {
  CHECK(problem("translate", {{"velocity", Vec3{}}}) == "velocity is zero: nothing would move");
  CHECK(problem("translate", {{"velocity", Vec3{1, 0, 0}}, {"start", 2.0}, {"stop", 1.0}}) ==
        "stop is not after start");
  CHECK(problem("rotate", {{"pivot", Vec3{}}, {"spin_axis", Vec3{}}, {"spin", 1.0}}) ==
        "spin_axis has no direction");
  CHECK(problem("rotate", {{"pivot", Vec3{}}, {"spin_axis", Vec3{1, 0, 0}}, {"spin", 0.0}}) ==
        "spin is zero: nothing would move");
  CHECK(problem("oscillate", {{"amplitude", std::vector<double>{0.01}},
                              {"frequency", std::vector<double>{2.0, 3.0}},
                              {"along", std::vector<Vec3>{{0, 0, 3}}}}) ==
        "amplitude and frequency differ in length");
}

TEST_CASE("a cleat shall go round with its belt: places in closed form, speed, and a full round") {
  using std::numbers::pi;
  constexpr double k_radius = 0.31;  // of the belt's middle surface
  constexpr double k_length = 5.0;
  const Vec3 tail{-4, 1, 2};
  const Vec3 along{0.8, 0.6, 0};
  const auto circulate = [&](double ahead) {
    return motion("circulate", {{"head", tail + k_length * along},
                                {"tail", tail},
                                {"radius", k_radius},
                                {"speed", 2.0},
                                {"ahead", ahead}});
  };
  Body cleat = box_with(list(circulate(0.0)));
  Body belt;
  belt.shape = make_shape("belt_conveyor", {{"head", tail + k_length * along},
                                            {"tail", tail},
                                            {"radius", 0.3},
                                            {"thickness", 0.02},
                                            {"width", 1.0}});
  const Vec3 up{0, 0, 1};
  const Vec3 foot = tail + k_radius * up;
  const Vec3 tip = foot + 0.1 * up;
  const double half = pi * k_radius;

  CHECK(norm(carried(cleat, tip, 1.0) - (tip + 2.0 * along)) < 1e-12);
  const double over_head = (k_length + 0.5 * half) / 2.0;  // a quarter of the way round
  CHECK(norm(carried(cleat, tip, over_head) - (tail + (k_length + 0.41) * along)) < 1e-12);
  const double back = (1.5 * k_length + half) / 2.0;
  CHECK(norm(carried(cleat, tip, back) - (tail + 2.5 * along - 0.41 * up)) < 1e-12);
  const double at_tail = (2 * k_length + 1.5 * half) / 2.0;
  CHECK(norm(carried(cleat, tip, at_tail) - (tail - 0.41 * along)) < 1e-12);
  const double round = k_length + half;
  CHECK(norm(carried(cleat, tip, round + 1.0) - carried(cleat, tip, 1.0)) < 1e-11);
  // One drawn farther ahead, or behind, is where the other will be, or was.
  Body other = box_with(list(circulate(1.2 - 4 * round)));
  CHECK(norm(carried(other, tip, 0.5) - carried(cleat, tip, 1.1)) < 1e-11);

  for (double time = 0.05; time < 1.1 * round; time += 0.173) {
    CAPTURE(time);
    const Vec3 now = carried(cleat, foot, time);
    // Half the thickness below the belt's surface, all the way round.
    CHECK(belt.nearest(now, belt.placement(0)).distance == approx(-0.01).epsilon(1e-9));
    CHECK(norm(cleat.surface_velocity(now, up, time)) == approx(2.0).epsilon(1e-12));
    constexpr double h = 1e-5;
    const Vec3 rate = (carried(cleat, tip, time + h) - carried(cleat, tip, time - h)) / (2 * h);
    CHECK(norm(cleat.surface_velocity(carried(cleat, tip, time), up, time) - rate) < 1e-6);
  }
}

TEST_CASE("a cleat whose path is none shall be refused") {
  const std::map<std::string, Value> good = {
      {"head", Vec3{1, 0, 0}}, {"tail", Vec3{}}, {"radius", 0.1}, {"speed", 1.0}};
  CHECK(problem("circulate", good).empty());
  auto bad = good;
  bad["head"] = Vec3{};
  CHECK(problem("circulate", bad) == "head and tail are the same point");
  bad = good;
  bad["up"] = Vec3{2, 0, 0};
  CHECK(problem("circulate", bad) == "up is along the belt");
}

TEST_CASE("the surface of a body that turns shall turn with it, that of one that shifts not") {
  const Body bar =
      box_with(list(motion("rotate", {{"spin_axis", Vec3{0, 2, 0}}, {"spin", 3.0}, {"ramp", 2.0}}),
                    motion("translate", {{"velocity", Vec3{1, 0, 0}}})));
  CHECK(bar.is_turning());
  CHECK(norm(rotation_near(bar, {0, 0, 2}, 1.0) - Vec3{0, 1.5, 0}) < 1e-12);
  CHECK(norm(rotation_near(bar, {0, 0, 2}, 5.0) - Vec3{0, 3.0, 0}) < 1e-12);
  const Body sledge = box_with(list(motion("translate", {{"velocity", Vec3{1, 0, 0}}})));
  CHECK_FALSE(sledge.is_turning());
  CHECK(rotation_near(sledge, {0, 0, 2}, 1.0) == Vec3{});
}

TEST_CASE("a belt shall turn round its pulleys and nowhere else") {
  for (const char* shape : {"conveyor", "belt_conveyor"}) {
    CAPTURE(shape);
    Body body;
    body.shape = make_shape(shape, {{"head", Vec3{0, 0, 0}},
                                    {"tail", Vec3{-4, 0, 0}},
                                    {"radius", 0.4},
                                    {"thickness", 0.1},
                                    {"width", 1.0}});
    body.motions = list(motion("belt", {{"speed", 2.0}}));
    body.frame_origin = {1, 2, 3};
    body.frame_axis = {0, 0, 1};
    body.frame_angle = 0.5 * std::numbers::pi;
    const auto at = body.placement(0.0);
    CHECK(body.is_turning());
    // The frame turns the pulleys' axis from y to -x; the belt's face is 0.5 from it.
    for (const Vec3 over : {Vec3{0.4, 0.1, 0.4}, Vec3{-4.3, 0, -0.6}}) {
      CHECK(norm(rotation_near(body, at.to_domain(over), 1.0) - Vec3{-2.0 / 0.5, 0, 0}) < 1e-9);
    }
    for (const Vec3 over : {Vec3{-2, 0, 0.7}, Vec3{-1, 0.2, -0.7}}) {
      CHECK(rotation_near(body, at.to_domain(over), 1.0) == Vec3{});
    }
  }
}

TEST_CASE("a cleat shall turn with the pulley it is on") {
  Body body;
  body.shape = make_shape("belt_conveyor", {{"head", Vec3{0, 0, 0}},
                                            {"tail", Vec3{-4, 0, 0}},
                                            {"radius", 0.4},
                                            {"thickness", 0.1},
                                            {"width", 1.0},
                                            {"cleat_height", 0.2},
                                            {"cleat_thickness", 0.1},
                                            {"cleat_spacing", 1.0}});
  body.motions = list(motion("belt", {{"speed", 0.9}}));
  // A quarter round the head pulley, whose middle surface is 0.45 from its axis.
  const double time = 0.5 * std::numbers::pi * 0.45 / 0.9;
  CHECK(norm(rotation_near(body, {0.8, 0, 0}, time) - Vec3{0, 0.9 / 0.45, 0}) < 1e-9);
  CHECK(norm(rotation_near(body, {0.65, 0, 0.08}, time) - Vec3{0, 0.9 / 0.45, 0}) < 1e-9);
  CHECK(rotation_near(body, {-2, 0, 0.8}, time) == Vec3{});
}

TEST_CASE("a belt round a drum shall turn as the drum does, inside the other way") {
  Body drum;
  drum.shape = make_shape("cylinder", {{"base", Vec3{0, -1, 0}},
                                       {"axis", Vec3{0, 1, 0}},
                                       {"length", 2.0},
                                       {"radius", 0.5},
                                       {"thickness", 0.1}});
  drum.motions = list(motion("belt", {{"speed", 1.2}}));
  CHECK(norm(rotation_near(drum, {0.7, 0, 0}, 0.0) - Vec3{0, 2.0, 0}) < 1e-9);
  CHECK(norm(rotation_near(drum, {0, 0, -0.4}, 0.0) - Vec3{0, -2.4, 0}) < 1e-9);
}
