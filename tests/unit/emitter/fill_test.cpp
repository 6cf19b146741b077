// SPDX-License-Identifier: Apache-2.0
#include "dust/sdk/sphere.hpp"
#include "support/approx.hpp"
#include "unit/emitter/emitter_bench.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace dust;
using namespace dust::test;
using sdk::Vec3;

namespace {

Parameters sand(double mass) {
  return {{"mass", mass},
          {"diameters", std::vector<double>{300e-6, 425e-6, 500e-6, 600e-6}},
          {"mass_fractions", std::vector<double>{6.21, 18.29, 26.05, 49.45}}};
}

Parameters with(Parameters p, const Parameters& more) {
  for (const auto& [key, value] : more) p[key] = value;
  return p;
}

const Parameters k_box{{"min", Vec3{0, 0, 0}}, {"max", Vec3{10e-3, 8e-3, 12e-3}}};
const Parameters k_frustum{{"region", std::string("cylinder")},
                           {"from", Vec3{1e-3, 2e-3, 3e-3}},
                           {"to", Vec3{5e-3, 2e-3, 13e-3}},
                           {"radius", 2e-3},
                           {"end_radius", 5e-3}};

double mass_of(const std::vector<sdk::InsertionRequest>& requests) {
  double mass = 0.0;
  for (const auto& s : requests) mass += 2650.0 * sdk::sphere_volume(s.diameter);
  return mass;
}

}  // namespace

TEST_CASE("a filled box shall hold its mass, within half a grain, without overlaps") {
  // 30 % of 0.96 cm3.
  const double mass = 0.30 * 0.96e-6 * 2650.0;
  const auto fill = emitter("fill", with(sand(mass), k_box));
  const auto requests = requests_of(*fill);
  CHECK(std::abs(mass_of(requests) - mass) < 0.5 * 2650.0 * sdk::sphere_volume(600e-6));
  REQUIRE(requests.size() > 3000);
  CHECK(overlaps(requests) == 0);
  double by_size = 0.0;
  for (const auto& s : requests) {
    const double r = 0.5 * s.diameter;
    for (int d = 0; d < 3; ++d) {
      CHECK(s.position[d] >= r * (1.0 - 1e-12));
      CHECK(s.position[d] <= std::get<Vec3>(k_box.at("max"))[d] - r * (1.0 - 1e-12));
    }
    if (s.diameter == 300e-6) by_size += 2650.0 * sdk::sphere_volume(s.diameter);
  }
  // 6.21 % of the mass, to within two grains of that size.
  CHECK(std::abs(by_size - 0.0621 * mass) < 2.0 * 2650.0 * sdk::sphere_volume(300e-6));
}

TEST_CASE("grains shall lie wholly within a slanting frustum and fill all of it") {
  const auto fill = emitter(
      "fill",
      with({{"count", std::int64_t{1500}}, {"diameters", std::vector<double>{400e-6}}}, k_frustum));
  const auto requests = requests_of(*fill);
  REQUIRE(requests.size() == 1500);
  CHECK(overlaps(requests) == 0);
  const Vec3 from{1e-3, 2e-3, 3e-3};
  const Vec3 along = Vec3{4e-3, 0, 10e-3};
  const double length = norm(along);
  double mean = 0.0;
  for (const auto& s : requests) {
    const double t = dot(s.position - from, along) / length;
    const double off = norm(s.position - from - (t / length) * along);
    CHECK(t >= 200e-6 * (1 - 1e-9));
    CHECK(t <= length - 200e-6 * (1 - 1e-9));
    // Distance from the mantle of half-angle atan(3 / length).
    const double clearance = (2e-3 + 3e-3 * t / length - off) / std::hypot(1.0, 3e-3 / length);
    CHECK(clearance >= 200e-6 * (1 - 1e-9));
    mean += t / length / 1500.0;
  }
  // Centre of volume of the frustum the centres may lie in: radii inset by r / cos. With the full
  // radii a = 2, b = 5: (a^2 + 2ab + 3b^2) / (4 (a^2 + ab + b^2)) = 0.635; inset it is 0.65. 1500
  // random places scatter by 0.25 / sqrt(1500) = 0.006.
  CHECK(mean == test::approx(0.648).epsilon(0.04));
}

TEST_CASE("what stands in the region shall be kept clear") {
  struct Ball final : sdk::Surroundings {
    [[nodiscard]] bool is_free(Vec3 x, double r) const override {
      return norm(x - Vec3{5e-3, 4e-3, 6e-3}) >= 3e-3 + r;
    }
  } ball;
  const auto fill = emitter(
      "fill",
      with({{"count", std::int64_t{2000}}, {"diameters", std::vector<double>{400e-6}}}, k_box));
  auto c = context(0.0, 1e-3);
  c.surroundings = &ball;
  std::vector<sdk::InsertionRequest> requests;
  fill->propose(c, requests);
  REQUIRE(requests.size() == 2000);
  for (const auto& s : requests) CHECK(ball.is_free(s.position, 200e-6));
}

TEST_CASE("a region that cannot hold its grains shall be refused with the volume that could") {
  // 60 % of the box: known when the scenario is read.
  const auto dense = emitter("fill", with(sand(0.60 * 0.96e-6 * 2650.0), k_box));
  const auto at_reading = refusal([&] {
    std::vector<sdk::InsertionRequest> none;
    dense->propose(context(0.0, 0.0), none);
  });
  CHECK(at_reading.find("the region cannot hold the grains: they would take up ") == 0);
  CHECK(at_reading.find("give a region of at least 1.74545 cm3") != std::string::npos);
  // More grains than a whole number can tell.
  const auto absurd = emitter("fill", with(sand(1e30), k_box));
  CHECK(refusal([&] { requests_of(*absurd); }).find("the region cannot hold the grains") == 0);
  // Equal spheres jam at 0.38: 0.45 runs out while placing.
  const auto jammed = emitter("fill", {{"count", std::int64_t{430}},
                                       {"diameters", std::vector<double>{1e-3}},
                                       {"min", Vec3{0, 0, 0}},
                                       {"max", Vec3{8e-3, 8e-3, 8e-3}}});
  const auto at_start = refusal([&] { requests_of(*jammed); });
  CHECK(at_start.find("only ") == 0);
  CHECK(at_start.find(" of 430 grains") != std::string::npos);
  CHECK(at_start.find("found a place") != std::string::npos);
  CHECK(at_start.find("Give a region of at least") != std::string::npos);
}

TEST_CASE("a filling shall come once, at its moment, also through a checkpoint") {
  auto p = with({{"count", std::int64_t{10}}, {"diameters", std::vector<double>{400e-6}}}, k_box);
  p["time"] = 2.5e-3;
  const auto whole = emitter("fill", p);
  for (int n = 0; n < 6; ++n) {
    std::vector<sdk::InsertionRequest> requests;
    whole->propose(context(1e-3 * n, 1e-3 * (n + 1)), requests);
    CHECK(requests.size() == (n == 2 ? 10 : 0));
    for (const auto& s : requests) CHECK(s.time == 1e-3 * n);
  }
  MemoryArchive archive;
  whole->save(archive);
  const auto loaded = emitter("fill", p);
  loaded->load(archive);
  std::vector<sdk::InsertionRequest> requests;
  loaded->propose(context(2e-3, 3e-3), requests);
  CHECK(requests.empty());
}

TEST_CASE("a filling without amount, or with both, or a wrong region, shall be refused") {
  const Parameters one{{"diameters", std::vector<double>{400e-6}}};
  const auto says = [&](const Parameters& p) {
    return refusal([&] { emitter("fill", with(one, p)); });
  };
  CHECK(says(k_box) == "give either mass or count, above 0");
  CHECK(says(with(k_box, {{"mass", 1e-3}, {"count", std::int64_t{1}}})) ==
        "give either mass or count, above 0");
  CHECK(says({{"mass", 1e-3}, {"max", Vec3{1e-3, 1e-3, 1e-4}}}) ==
        "the box from min to max is narrower than the largest grain");
  CHECK(says(with(with(k_box, k_frustum), {{"mass", 1e-3}})) ==
        "min and max belong to region: box; a cylinder has from, to and radius");
  CHECK(says({{"mass", 1e-3}, {"region", std::string("cylinder")}, {"to", Vec3{0, 0, 1e-2}}}) ==
        "region: cylinder needs radius");
}
