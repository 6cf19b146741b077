// SPDX-License-Identifier: Apache-2.0
#include "support/approx.hpp"
#include "unit/emitter/emitter_bench.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace dust;
using namespace dust::test;
using sdk::Vec3;

namespace {

Parameters box(const char* arrangement, double edge, double spacing) {
  return {{"min", Vec3{1e-3, 0, 0}},
          {"max", Vec3{1e-3 + edge, edge, edge}},
          {"arrangement", std::string(arrangement)},
          {"spacing", spacing},
          {"diameters", std::vector<double>{0.5e-3}}};
}

/// Smallest distance of two centres when the box repeats itself.
double smallest_distance(const std::vector<sdk::InsertionRequest>& requests, double period) {
  double smallest = 1.0;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    for (std::size_t j = i + 1; j < requests.size(); ++j) {
      Vec3 d = requests[i].position - requests[j].position;
      for (int k = 0; k < 3; ++k) d[k] -= period * std::round(d[k] / period);
      smallest = std::min(smallest, norm(d));
    }
  }
  return smallest;
}

}  // namespace

TEST_CASE("a simple lattice shall have one site a cube at its spacing, also through the sides") {
  const auto requests = requests_of(*emitter("lattice", box("simple", 6e-3, 1e-3)));
  CHECK(requests.size() == 216);
  CHECK(smallest_distance(requests, 6e-3) == test::approx(1e-3).epsilon(1e-12));
  for (const auto& s : requests) CHECK(s.position.x > 1e-3);
}

TEST_CASE("a face-centred lattice shall have four sites a cube and twelve neighbours each") {
  const double spacing = 1e-3;
  const double edge = 4 * std::sqrt(2.0) * spacing;
  const auto requests = requests_of(*emitter("lattice", box("face_centred", edge, spacing)));
  CHECK(requests.size() == 256);
  CHECK(smallest_distance(requests, edge) == test::approx(spacing).epsilon(1e-12));
  int neighbours = 0;
  for (const auto& s : requests) {
    Vec3 d = s.position - requests[0].position;
    for (int k = 0; k < 3; ++k) d[k] -= edge * std::round(d[k] / edge);
    neighbours += std::abs(norm(d) - spacing) < 1e-9 ? 1 : 0;
  }
  CHECK(neighbours == 12);
}

TEST_CASE("grains with full jitter shall still not overlap, and move") {
  for (const char* kind : {"simple", "face_centred"}) {
    auto p = box(kind, 8e-3, 0.6e-3);
    const auto still = requests_of(*emitter("lattice", p));
    p["jitter"] = 1.0;
    const auto requests = requests_of(*emitter("lattice", p));
    REQUIRE(requests.size() == still.size());
    CHECK(overlaps(requests) == 0);
    double moved = 0.0;
    for (std::size_t n = 0; n < requests.size(); ++n) {
      moved = std::max(moved, norm(requests[n].position - still[n].position));
    }
    CHECK(moved > 0.04e-3);
    CHECK(moved <= 0.05e-3);
  }
}

TEST_CASE("the scatter of velocities shall have its variance and no drift") {
  auto p = box("simple", 20e-3, 1e-3);
  p["velocity"] = Vec3{0.3, 0, 0};
  p["velocity_scatter"] = 0.1;
  const auto requests = requests_of(*emitter("lattice", p));
  REQUIRE(requests.size() == 8000);
  Vec3 mean;
  Vec3 squares;
  for (const auto& s : requests) {
    mean += s.velocity / 8000.0;
    for (int d = 0; d < 3; ++d)
      squares[d] += std::pow(s.velocity[d] - (d == 0 ? 0.3 : 0.0), 2) / 8000;
  }
  // The drift is taken away to rounding of a sum of 8000 terms of 0.1.
  CHECK(norm(mean - Vec3{0.3, 0, 0}) < 1e-13);
  // The variance of n normal numbers scatters by sqrt(2/n) = 1.6 %: three of these.
  for (int d = 0; d < 3; ++d) CHECK(squares[d] == test::approx(0.01).epsilon(0.05));
}

TEST_CASE("fewer grains than sites shall be spread, more shall be refused, sizes come in numbers") {
  auto p = box("simple", 10e-3, 1e-3);
  p["count"] = std::int64_t{250};
  p["diameters"] = std::vector<double>{0.4e-3, 0.8e-3};
  p["number_fractions"] = std::vector<double>{0.8, 0.2};
  const auto requests = requests_of(*emitter("lattice", p));
  REQUIRE(requests.size() == 250);
  CHECK(std::count_if(requests.begin(), requests.end(),
                      [](const auto& s) { return s.diameter > 0.5e-3; }) == 50);
  CHECK(std::count_if(requests.begin(), requests.end(),
                      [](const auto& s) { return s.position.z < 5e-3; }) == 125);
  // The order is random: the first fifth is not all of one size.
  const auto coarse = std::count_if(requests.begin(), requests.begin() + 50,
                                    [](const auto& s) { return s.diameter > 0.5e-3; });
  CHECK(coarse > 0);
  CHECK(coarse < 50);
  p["count"] = std::int64_t{1001};
  CHECK(refusal([&] { emitter("lattice", p); }) ==
        "the box has 1000 sites for 1001 grains: widen it or reduce spacing or count");
  p["spacing"] = 0.7e-3;
  CHECK(refusal([&] { emitter("lattice", p); }).find("neighbours would overlap") !=
        std::string::npos);
}

TEST_CASE("a box with more sites than any machine holds shall be refused before they are made") {
  Parameters p = box("simple", 6e-3, 1e-3);
  p["max"] = Vec3{1e12, 6e-3, 6e-3};
  CHECK(refusal([&] { emitter("lattice", p); }) ==
        "the box from min to max has 3.6e+16 sites, and at most 5e+07 are placed: make it smaller "
        "or spacing wider");
}
