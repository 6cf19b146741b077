// SPDX-License-Identifier: Apache-2.0
#include "../bodies/shapes.hpp"
#include "report/pictures/outline.hpp"
#include "report/setup_document.hpp"
#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

using dust::sdk::Vec3;
using dust::test::approx;
using dust::test::make_shape;
using nlohmann::json;

namespace {

/// 2 x 1 x 1 m.
dust::scenario::Setup setup() {
  dust::scenario::Setup s;
  s.name = "drum";
  s.domain.min = {0, 0, 0};
  s.domain.max = {2, 1, 1};
  return s;
}

dust::bodies::Body drum() {
  dust::bodies::Body body;
  body.name = "drum";
  body.shape = make_shape(
      "cylinder",
      {{"base", Vec3{0.6, 0.2, 0.5}}, {"axis", Vec3{0, 1, 0}}, {"length", 0.6}, {"radius", 0.3}});
  return body;
}

double area_of(const json& rows) {
  double area = 0.0;
  for (const json& r : rows) {
    area += (r[2].get<double>() - r[0].get<double>()) * (r[3].get<double>() - r[1].get<double>());
  }
  return area;
}

}  // namespace

TEST_CASE("the section of a body shall be what the middle plane cuts of it") {
  const auto s = setup();
  const json rows = dust::report::section_of(s.domain, drum());
  // Squares of 1/300 of 2 m along a rim of 1.9 m: the area is known to some 1 %.
  CHECK(area_of(rows) == approx(std::numbers::pi * 0.09).epsilon(0.01));
  for (const json& r : rows) {
    for (const double x : {r[0].get<double>(), r[2].get<double>()}) {
      for (const double z : {r[1].get<double>(), r[3].get<double>()}) {
        CHECK(std::hypot(x - 0.6, z - 0.5) < 0.3 + 0.01);
      }
    }
  }
}

TEST_CASE("the document of a set-up shall hold its bodies from the side and in space") {
  const auto s = setup();
  dust::bodies::BodySet bodies;
  bodies.push_back(drum());
  const json document =
      dust::report::setup_document(s, bodies, json{{"sensors", json::array()}}, json{{"end_s", 1}});
  CHECK(document["kind"] == "setup");
  CHECK(document["view"] == json{0.0, 0.0, 2.0, 1.0});
  REQUIRE(document["bodies"].size() == 1);
  CHECK(document["bodies"][0]["segments"].size() > 40);
  // Its rim, seen along its axis: all of it lies on the circle.
  for (const json& piece : document["bodies"][0]["segments"]) {
    CHECK(std::hypot(piece[0].get<double>() - 0.6, piece[1].get<double>() - 0.5) ==
          approx(0.3).epsilon(1e-5));
  }
  const json& surfaces = document["space"]["surfaces"];
  CHECK(surfaces["names"] == json{"drum"});
  CHECK(surfaces["sets"][0]["bodies"][0][0] == 0);
  CHECK(surfaces["sets"][0]["triangles"].get<std::size_t>() > 50);
  CHECK(document["space"]["is_thin"] == false);
}
