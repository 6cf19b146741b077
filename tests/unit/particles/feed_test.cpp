// SPDX-License-Identifier: Apache-2.0
#include "support/dem_rig.hpp"

#include "dust/sdk/error.hpp"
#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <numbers>

using dust::sdk::Emitter;
using dust::sdk::EmitterContext;
using dust::sdk::InsertionRequest;
using dust::sdk::Random;
using dust::sdk::Value;
using dust::sdk::Vec3;
using dust::test::approx;
using namespace dust::test;

namespace {

constexpr double k_density = 2650.0;
constexpr double k_flow = 6e-3;

std::map<std::string, Value> transfer_point() {
  return {{"mass_flow", k_flow},
          {"min", Vec3{26e-3, 1.5e-3, 0.22}},
          {"max", Vec3{34e-3, 9.5e-3, 0.22}},
          {"velocity", Vec3{0, 0, -0.15}},
          {"diameters", std::vector<double>{10e-6, 300e-6, 420e-6, 500e-6, 600e-6}},
          {"number_fractions", std::vector<double>{0.0055, 0.2443, 0.2670, 0.2287, 0.2545}},
          {"rare_below", 100e-6},
          {"copies_of_rare", std::int64_t{20}}};
}

std::vector<InsertionRequest> run(Emitter& feed, int from, int to) {
  std::vector<InsertionRequest> requests;
  for (int n = from; n < to; ++n) {
    feed.propose({.begin = 1e-3 * n,
                  .end = 1e-3 * (n + 1),
                  .grain_density = k_density,
                  .gravity = {0, 0, -9.81},
                  .random = Random(1, 42)},
                 requests);
  }
  return requests;
}

double mass(const InsertionRequest& s) {
  return s.weight * k_density * std::numbers::pi / 6.0 * s.diameter * s.diameter * s.diameter;
}

}  // namespace

TEST_CASE("the feed shall release its mass flow to within one grain at any time") {
  auto feed = ModelLoader::make<Emitter>("emitter", "feed", transfer_point());
  const auto requests = run(*feed, 0, 700);
  const double largest = k_density * std::numbers::pi / 6.0 * std::pow(600e-6, 3);
  double released = 0.0;
  double last = 0.0;
  REQUIRE(requests.size() > 20000);
  for (const InsertionRequest& s : requests) {
    CHECK_MESSAGE(s.time >= last, "seeds in order of time");
    REQUIRE(std::abs(released - k_flow * s.time) < largest);
    released += mass(s);
    last = s.time;
  }
  CHECK(last < 0.7);
}

TEST_CASE("the feed shall follow the size distribution, rare sizes with their weights") {
  auto feed = ModelLoader::make<Emitter>("emitter", "feed", transfer_point());
  std::map<double, double> real;
  double sum = 0.0;
  std::size_t copies = 0;
  for (const InsertionRequest& s : run(*feed, 0, 700)) {
    real[s.diameter] += s.weight;
    sum += s.weight;
    if (s.diameter < 100e-6) {
      ++copies;
      CHECK(s.weight == approx(0.05));
    }
  }
  const std::map<double, double> shares{
      {10e-6, 0.0055}, {300e-6, 0.2443}, {420e-6, 0.2670}, {500e-6, 0.2287}, {600e-6, 0.2545}};
  for (const auto& [diameter, share] : shares) {
    // No size strays by more than its share of 500 grains.
    CHECK(std::abs(real[diameter] - share * sum) < share * 500 + 1);
  }
  CHECK(copies > 2500);
}

TEST_CASE("seeds shall not overlap when they move on with the stream") {
  auto feed = ModelLoader::make<Emitter>("emitter", "feed", transfer_point());
  const auto requests = run(*feed, 0, 40);
  const Vec3 velocity{0, 0, -0.15};
  std::size_t near = 0;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    CHECK(requests[i].position.x - 0.5 * requests[i].diameter >= 26e-3);
    CHECK(requests[i].position.y + 0.5 * requests[i].diameter <= 9.5e-3);
    for (std::size_t j = i + 1; j < requests.size(); ++j) {
      const Vec3 d = requests[j].position - requests[i].position -
                     (requests[j].time - requests[i].time) * velocity;
      const double reach = 0.5 * (requests[i].diameter + requests[j].diameter);
      REQUIRE(norm(d) >= reach);
      near += norm(d) < 1.1 * reach ? 1 : 0;
    }
  }
  CHECK(near > 20);
}

TEST_CASE("seeds shall start wholly behind the opening, rare ones one interval in front of it") {
  auto feed = ModelLoader::make<Emitter>("emitter", "feed", transfer_point());
  std::size_t rare = 0;
  for (const InsertionRequest& s : run(*feed, 0, 100)) {
    // The largest grain has a radius of 0.3 mm; an interval of 1 ms at 0.15 m/s is 0.15 mm.
    const bool is_rare = s.diameter < 100e-6;
    CHECK(s.position.z == approx(0.22 + (is_rare ? -0.15e-3 : 0.3e-3)).epsilon(1e-12));
    CHECK(s.velocity == Vec3{0, 0, -0.15});
    rare += is_rare ? 1 : 0;
  }
  CHECK(rare > 0);
}

TEST_CASE("a resumed feed shall go on with the same requests") {
  auto whole = ModelLoader::make<Emitter>("emitter", "feed", transfer_point());
  auto first = ModelLoader::make<Emitter>("emitter", "feed", transfer_point());
  auto second = ModelLoader::make<Emitter>("emitter", "feed", transfer_point());
  const auto expected = run(*whole, 0, 30);
  auto requests = run(*first, 0, 13);
  MemoryArchive archive;
  first->save(archive);
  second->load(archive);
  const auto rest = run(*second, 13, 30);
  requests.insert(requests.end(), rest.begin(), rest.end());
  REQUIRE(requests.size() == expected.size());
  for (std::size_t n = 0; n < requests.size(); ++n) {
    CHECK(requests[n].time == expected[n].time);
    CHECK(requests[n].position == expected[n].position);
    CHECK(requests[n].diameter == expected[n].diameter);
  }
}

TEST_CASE("an opening that cannot pass the flow shall be refused with the numbers") {
  auto parameters = transfer_point();
  parameters["velocity"] = Vec3{0, 0, -0.05};
  auto feed = ModelLoader::make<Emitter>("emitter", "feed", parameters);
  CHECK_THROWS_AS(run(*feed, 0, 1), dust::sdk::ParameterError);
  parameters["velocity"] = Vec3{0.1, 0, 0};
  CHECK_THROWS_AS(ModelLoader::make<Emitter>("emitter", "feed", parameters),
                  dust::sdk::ParameterError);
}

TEST_CASE("an opening narrower than the largest grain shall be refused with both sizes") {
  auto parameters = transfer_point();
  parameters["max"] = Vec3{34e-3, 2e-3, 0.22};
  CHECK_THROWS_WITH_AS(ModelLoader::make<Emitter>("emitter", "feed", parameters),
                       "the opening is narrower than the largest grain: 0.0005 m along y, and the "
                       "grain has 0.0006 m",
                       dust::sdk::ParameterError);
}

namespace {

/// Rubble: 0.5 to 60 mm, 5 % solids.
std::map<std::string, Value> rubble() {
  return {{"mass_flow", 0.05 * k_density * 0.2 * 0.2 * 2.0},
          {"min", Vec3{0, 0, 1}},
          {"max", Vec3{0.2, 0.2, 1}},
          {"velocity", Vec3{0, 0, -2.0}},
          {"distribution", std::string("rosin_rammler")},
          {"characteristic_diameter", 20e-3},
          {"exponent", 1.0},
          {"smallest", 0.5e-3},
          {"largest", 60e-3},
          {"size_classes", std::int64_t{12}},
          {"rare_below", 1e-3},
          {"copies_of_rare", std::int64_t{2}}};
}

}  // namespace

TEST_CASE("a feed from half a millimetre to sixty shall find places, without overlaps") {
  auto feed = ModelLoader::make<Emitter>("emitter", "feed", rubble());
  const auto requests = run(*feed, 0, 60);
  double released = 0.0;
  double largest = 0.0;
  double one_of_each = 0.0;
  std::map<double, double> masses;
  for (const InsertionRequest& s : requests) {
    released += mass(s);
    largest = std::max(largest, s.diameter);
    masses[s.diameter] = mass(s);
  }
  for (const auto& [diameter, one] : masses) one_of_each += one;
  CHECK(largest > 40e-3);
  REQUIRE(requests.size() > 5000);
  CHECK(std::abs(released - std::get<double>(rubble()["mass_flow"]) * 0.06) < one_of_each);
  // In the frame that moves with the stream, large ones against all.
  std::size_t overlaps = 0;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    if (requests[i].diameter < 3e-3) continue;
    for (std::size_t j = 0; j < requests.size(); ++j) {
      if (i == j) continue;
      const Vec3 apart = (requests[i].position - requests[i].time * requests[i].velocity) -
                         (requests[j].position - requests[j].time * requests[j].velocity);
      const double reach = 0.5 * (requests[i].diameter + requests[j].diameter);
      overlaps += dot(apart, apart) < reach * reach ? 1 : 0;
    }
  }
  CHECK(overlaps == 0);
}

TEST_CASE("a resumed feed of such sizes shall go on with the same requests") {
  auto whole = ModelLoader::make<Emitter>("emitter", "feed", rubble());
  const auto all = run(*whole, 0, 20);
  auto first = ModelLoader::make<Emitter>("emitter", "feed", rubble());
  auto requests = run(*first, 0, 9);
  MemoryArchive archive;
  first->save(archive);
  auto second = ModelLoader::make<Emitter>("emitter", "feed", rubble());
  second->load(archive);
  const auto rest = run(*second, 9, 20);
  requests.insert(requests.end(), rest.begin(), rest.end());
  REQUIRE(requests.size() == all.size());
  for (std::size_t n = 0; n < all.size(); ++n) {
    CHECK(requests[n].position == all[n].position);
    CHECK(requests[n].time == all[n].time);
  }
}
