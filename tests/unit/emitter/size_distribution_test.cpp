// SPDX-License-Identifier: Apache-2.0
#include "dust/sdk/size_distribution.hpp"

#include "support/approx.hpp"
#include "unit/emitter/emitter_bench.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

using namespace dust;
using sdk::SizeDistribution;
using sdk::SizeParameters;

namespace {

// Simpson's rule with 64 steps a class: h = 0.003 in ln d leaves about h^4 / 180 times the fourth
// derivative, below 1e-9.
constexpr double k_quadrature = 1e-9;

double normal(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

std::vector<double> mass_shares(const SizeDistribution& s) {
  std::vector<double> m;
  double sum = 0.0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    m.push_back(s.fractions()[i] * std::pow(s.diameters()[i], 3));
    sum += m.back();
  }
  for (double& v : m) v /= sum;
  return m;
}

double edge(const SizeParameters& p, std::size_t i) {
  return p.smallest * std::pow(p.largest / p.smallest,
                               static_cast<double>(i) / static_cast<double>(p.size_classes));
}

/// Share of class i where Q is the law's share below a diameter.
template <class Law>
double share(const SizeParameters& p, std::size_t i, Law below) {
  return (below(edge(p, i + 1)) - below(edge(p, i))) / (below(p.largest) - below(p.smallest));
}

SizeParameters lognormal(const char* by) {
  SizeParameters p;
  p.distribution = "lognormal";
  p.by = by;
  p.median = 400e-6;
  p.spread = 1.4;
  p.smallest = 100e-6;
  p.largest = 1.6e-3;
  return p;
}

}  // namespace

TEST_CASE("a lognormal law shall keep number and mass of every class") {
  // A law lognormal by number with median m is lognormal by mass with median m exp(3 ln^2 sigma)
  // (Hatch and Choate, J. Franklin Inst. 207 (1929) 369), and the other way round.
  for (const char* by : {"number", "mass"}) {
    CAPTURE(by);
    const SizeParameters p = lognormal(by);
    const double width = std::log(p.spread);
    const double shift = std::exp(3.0 * width * width);
    const double number_median = std::string(by) == "number" ? p.median : p.median / shift;
    const auto below = [&](double median) {
      return [=](double d) { return normal(std::log(d / median) / width); };
    };
    const SizeDistribution s(p);
    REQUIRE(s.size() == 12);
    const auto masses = mass_shares(s);
    for (std::size_t i = 0; i < s.size(); ++i) {
      CHECK(s.fractions()[i] ==
            test::approx(share(p, i, below(number_median))).scale(1.0).epsilon(k_quadrature));
      CHECK(
          masses[i] ==
          test::approx(share(p, i, below(number_median * shift))).scale(1.0).epsilon(k_quadrature));
      CHECK(s.diameters()[i] > edge(p, i));
      CHECK(s.diameters()[i] < edge(p, i + 1));
    }
  }
}

TEST_CASE("a Rosin-Rammler law shall keep the mass of every class and its mean volume") {
  SizeParameters p;
  p.distribution = "rosin_rammler";
  p.characteristic_diameter = 500e-6;
  p.exponent = 3.0;
  p.smallest = 200e-6;
  p.largest = 900e-6;
  const SizeDistribution s(p);
  const auto masses = mass_shares(s);
  const auto below = [&](double d) { return 1.0 - std::exp(-std::pow(d / 500e-6, 3.0)); };
  for (std::size_t i = 0; i < s.size(); ++i) {
    CHECK(masses[i] == test::approx(share(p, i, below)).epsilon(k_quadrature));
  }
  // With n = 3 and t = (d/d')^3 the number is the exponential integral of exp(-t)/t dt, times the
  // same factor in every class: E1(a) - E1(b). E1 by its series, E1(x) = -g - ln x - sum (-x)^k/(k
  // k!).
  const auto e1 = [](double x) {
    double sum = -0.57721566490153286 - std::log(x);
    double term = 1.0;
    for (int k = 1; k < 200; ++k) {
      term *= -x / k;
      sum -= term / k;
    }
    return sum;
  };
  const auto t = [](double d) { return std::pow(d / 500e-6, 3.0); };
  const double all = e1(t(p.smallest)) - e1(t(p.largest));
  for (std::size_t i = 0; i < s.size(); ++i) {
    const double number = (e1(t(edge(p, i))) - e1(t(edge(p, i + 1)))) / all;
    CHECK(s.fractions()[i] == test::approx(number).epsilon(k_quadrature));
  }
}

TEST_CASE("a uniform law by number shall have the mean volume of its integral") {
  SizeParameters p;
  p.distribution = "uniform";
  p.by = "number";
  p.smallest = 300e-6;
  p.largest = 600e-6;
  for (const std::int64_t classes : {1, 5, 40}) {
    p.size_classes = classes;
    const SizeDistribution s(p);
    // Mean of d^3 over [a, b] = (b^4 - a^4) / (4 (b - a)), whatever the number of classes.
    const double cubes = (std::pow(600e-6, 4) - std::pow(300e-6, 4)) / (4 * 300e-6);
    // A single class over a factor of two is what the quadrature does least well.
    CHECK(s.mean_volume() ==
          test::approx(std::numbers::pi / 6 * cubes).epsilon(classes == 1 ? 1e-7 : k_quadrature));
  }
}

TEST_CASE("a table by mass shall give the numbers of grains that the masses need") {
  // Table 4.1 of the sand: 25 g of 2653 kg/m3 are 162,997 grains.
  SizeParameters p;
  p.diameters = {300e-6, 425e-6, 500e-6, 600e-6};
  p.mass_fractions = {6.21, 18.29, 26.05, 49.45};
  const SizeDistribution s(p);
  const auto numbers = s.for_mass(25e-3, 2653.0);
  std::int64_t count = 0;
  double mass = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    count += numbers[i];
    mass += static_cast<double>(numbers[i]) * 2653.0 * sdk::sphere_volume(p.diameters[i]);
    const double wanted =
        p.mass_fractions[i] / 100.0 * 25e-3 / 2653.0 / sdk::sphere_volume(p.diameters[i]);
    CHECK(std::abs(static_cast<double>(numbers[i]) - wanted) <= 1.5);
  }
  // The shares are given to 0.005 % of the mass, that is 33 of the finest grains.
  CHECK(std::abs(static_cast<double>(count) - 162997.0) <= 33.0);
  CHECK(std::abs(mass - 25e-3) < 0.5 * 2653.0 * sdk::sphere_volume(600e-6));
  std::int64_t thousand = 0;
  for (const auto n : s.for_count(1000)) thousand += n;
  CHECK(thousand == 1000);
  CHECK_THROWS_WITH_AS(static_cast<void>(s.for_mass(1e15, 2653.0)),
                       "so much mass of so small grains is more than 1e15 grains",
                       sdk::ParameterError);
}

TEST_CASE("sizes that contradict each other shall be refused with the reason") {
  const auto says = [](SizeParameters p) { return test::refusal([&] { SizeDistribution s(p); }); };
  CHECK(says({}) == "diameters is empty: give at least one, or a distribution");
  SizeParameters table;
  table.diameters = {1e-3, 2e-3};
  CHECK(says(table) == "give either number_fractions or mass_fractions");
  table.number_fractions = {1.0};
  CHECK(says(table) == "number_fractions has 1 entries for 2 diameters");
  table.number_fractions = {0.0, 0.0};
  CHECK(says(table) == "the fractions add up to nothing");
  table.number_fractions = {1.0, 1.0};
  table.median = 1e-3;
  CHECK(says(table) == "median belongs to distribution: lognormal; remove it");
  SizeParameters law = lognormal("mass");
  law.largest = law.smallest;
  CHECK(says(law) == "largest must be larger than smallest");
  law = lognormal("mass");
  law.spread = 0.4;
  CHECK(says(law) ==
        "distribution: lognormal needs spread, the geometric standard deviation, above 1");
  law = lognormal("mass");
  law.distribution = "rosin_rammler";
  CHECK(says(law) == "median belongs to distribution: lognormal; remove it");
}

TEST_CASE("a feed shall release a law in its shares") {
  test::Parameters p{{"mass_flow", 6e-3},
                     {"min", sdk::Vec3{0, 0, 0.2}},
                     {"max", sdk::Vec3{10e-3, 10e-3, 0.2}},
                     {"velocity", sdk::Vec3{0, 0, -0.15}},
                     {"distribution", std::string("uniform")},
                     {"by", std::string("number")},
                     {"smallest", 300e-6},
                     {"largest", 600e-6},
                     {"size_classes", std::int64_t{3}}};
  const auto feed = test::emitter("feed", p);
  std::map<double, double> real;
  std::vector<sdk::InsertionRequest> requests;
  for (int n = 0; n < 300; ++n) feed->propose(test::context(1e-3 * n, 1e-3 * (n + 1)), requests);
  for (const auto& s : requests) real[s.diameter] += 1.0 / static_cast<double>(requests.size());
  const auto shares = feed->request().shares;
  REQUIRE(shares.size() == 3);
  REQUIRE(requests.size() > 5000);
  for (const auto& share : shares) {
    // No size strays by more than its share of 500 grains.
    CHECK(std::abs(real[share.diameter] - share.number_fraction) <
          500.0 * share.number_fraction / static_cast<double>(requests.size()));
  }
}
