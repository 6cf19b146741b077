// SPDX-License-Identifier: Apache-2.0
#include "unit/sensor/coverage.hpp"

#include "dust/sdk/error.hpp"
#include "support/approx.hpp"

#include <doctest/doctest.h>

using namespace dust;
using namespace dust::test;
using sdk::Vec3;

namespace {

const SensorKind& kind() {
  static const SensorKind loaded = load_sensor("box_concentration");
  return loaded;
}

const std::map<std::string, sdk::Value> k_box = {{"min", Vec3{0.01, 0, 0.01}},
                                                 {"max", Vec3{0.02, 0.01, 0.03}}};
constexpr double k_volume = 0.01 * 0.01 * 0.02;

Grain at(Vec3 place, double diameter, double mass, double weight) {
  Grain g;
  g.before = g.now = place;
  g.diameter = diameter;
  g.mass = mass;
  g.weight = weight;
  return g;
}

}  // namespace

TEST_CASE("the concentration in a box shall be the weighted mass inside per volume") {
  const auto sensor = kind().make(k_box);
  SyntheticScene world;
  world.emitted_mass = 5e-6;
  // A lattice of 4 x 4 x 4 over twice the box in x: half of it lies inside.
  for (int i = 0; i < 64; ++i) {
    const Vec3 place{0.01 + 0.02 * (i % 4 + 0.5) / 4, 0.01 * (i / 4 % 4 + 0.5) / 4,
                     0.01 + 0.02 * (i / 16 + 0.5) / 4};
    const bool is_fine = i / 16 % 2 == 0;
    world.grains.push_back(
        at(place, is_fine ? 10e-6 : 600e-6, is_fine ? 1e-12 : 3e-9, is_fine ? 0.05 : 1.0));
  }
  step(*sensor, world);
  const Figures figures = summary_of(*sensor);
  const double mass = 16 * 0.05e-12 + 16 * 3e-9;
  CHECK(figures["mass_concentration"] == test::approx(mass / k_volume).epsilon(1e-12));
  CHECK(figures["class_10_um/mass_concentration"] ==
        test::approx(16 * 0.05e-12 / k_volume).epsilon(1e-12));
  CHECK(figures["class_600_um/number_concentration"] == test::approx(16 / k_volume).epsilon(1e-12));
  CHECK(figures["class_300_um/mass_concentration"] == 0.0);
  CHECK(figures["grams_per_tonne"] == test::approx(1e6 * mass / 5e-6).epsilon(1e-12));
  CHECK(series_of(*sensor)["number"] == test::approx(16.8).epsilon(1e-12));
}

TEST_CASE("the diameters shall restrict what counts in a box") {
  auto parameters = k_box;
  parameters["finer_than"] = 100e-6;
  const auto sensor = kind().make(parameters);
  SyntheticScene world;
  world.grains = {at({0.015, 0.005, 0.02}, 10e-6, 1.0, 1.0),
                  at({0.015, 0.005, 0.02}, 300e-6, 10.0, 1.0)};
  step(*sensor, world);
  CHECK(series_of(*sensor)["mass"] == 1.0);
}

TEST_CASE("the error of a concentration shall cover the truth at its rate, with any weight") {
  // Every sample is a fresh population, so that all of the scatter is that of counting.
  for (const int copies : {1, 20}) {
    Coverage coverage;
    double error = 0.0;
    for (int run = 0; run < k_runs; ++run) {
      Dice dice(run);
      const auto sensor = kind().make(k_box);
      SyntheticScene world;
      for (int sample = 0; sample < 160; ++sample) {
        world.grains.clear();
        const int n = dice.poisson(0.5 * copies);
        for (int i = 0; i < n; ++i) {
          world.grains.push_back(at({0.015, 0.005, 0.02}, 10e-6, 1e-12, 1.0 / copies));
          world.grains.back().before = {0, 0, 0};
        }
        step(*sensor, world);
      }
      const Figure figure = summary_of(*sensor).at("mass_concentration");
      coverage.add(figure, 0.5e-12 / k_volume);
      error += figure.uncertainty / k_runs;
    }
    CHECK(coverage.one() > k_one_low);
    CHECK(coverage.one() < k_one_high);
    CHECK(coverage.two() > k_two_low);
    // 80 real grains seen, 20 times as many computed ones with copies: the error falls by the root.
    const double expected = 0.5e-12 / k_volume / std::sqrt(80.0 * copies);
    // Where chance makes neighbouring batches alike, the error is wider: a fifth in the mean of 16.
    CHECK(error > 0.95 * expected);
    CHECK(error < 1.28 * expected);
  }
}

TEST_CASE("what is in a box at the end shall have the error of lumps that come and go") {
  // Every 20 samples a lump of 100 grains is in the box or is not, each with even odds: the mass at
  // one moment is off its mean by half a lump, ten times more than counting says.
  Coverage coverage;
  double error = 0.0;
  for (int run = 0; run < k_runs; ++run) {
    Dice dice(run);
    const auto sensor = kind().make(k_box);
    SyntheticScene world;
    world.emitted_mass = 1e-3;
    bool is_there = false;
    for (int sample = 0; sample < 640; ++sample) {
      if (sample % 20 == 0) is_there = dice.uniform() < 0.5;
      // A tenth is always there: an empty box has no error.
      world.grains.assign(is_there ? 100 : 10, at({0.015, 0.005, 0.02}, 10e-6, 1e-12, 1.0));
      for (Grain& grain : world.grains) grain.before = {0, 0, 0};
      step(*sensor, world);
    }
    const Figure figure = summary_of(*sensor).at("grams_per_tonne");
    coverage.add(figure, 1e6 * 55e-12 / 1e-3);
    if (figure.uncertainty > 0.0) error += figure.uncertainty / k_runs;
  }
  const double counting = 1e6 * std::sqrt(100.0) * 1e-12 / 1e-3;
  MESSAGE("within two errors: " << coverage.two() << ", errors of counting: " << error / counting);
  CHECK(coverage.two() > k_two_low);
  CHECK(error > 3.0 * counting);
}

TEST_CASE("the error in a box shall cover the truth where each grain stays for a while") {
  // Grains come one by one, at random, and stay for 25 of 400 samples: 16 populations. The
  // samples of one are alike, though batches of 13 to 25 samples do not look it.
  int covered = 0, with_error = 0;
  constexpr int k_stay = 25, k_samples = 400;
  for (int run = 0; run < k_runs; ++run) {
    Dice dice(run);
    const auto sensor = kind().make(k_box);
    SyntheticScene world;
    std::vector<int> left;  // samples that each grain still stays
    const auto come = [&](int samples) {
      for (int n = dice.poisson(1.0); n > 0; --n) left.push_back(samples);
    };
    for (int n = 1; n < k_stay; ++n) come(n);
    for (int sample = 0; sample < k_samples; ++sample) {
      come(k_stay);
      world.grains.assign(left.size(), at({0.015, 0.005, 0.02}, 10e-6, 1e-12, 1.0));
      for (std::size_t n = 0; n < left.size(); ++n) {
        if (left[n] == k_stay) world.grains[n].before = {0, 0, 0};
      }
      step(*sensor, world);
      for (int& samples : left) --samples;
      std::erase(left, 0);
    }
    const Figure figure = summary_of(*sensor).at("number_concentration");
    if (figure.uncertainty < 0.0) continue;
    ++with_error;
    covered += std::abs(figure.value - k_stay / k_volume) <= 1.96 * figure.uncertainty;
  }
  const double share = static_cast<double>(covered) / with_error;
  MESSAGE("95 % intervals cover " << share << " of " << with_error);
  CHECK(with_error > 0.5 * k_runs);
  CHECK(share > 0.88);
  CHECK(share <= 0.99);
}

TEST_CASE("a box shall say that it has seen too few grains, or that it still fills up") {
  SyntheticScene world;
  world.emitted_mass = 1e-6;
  const auto few = kind().make(k_box);
  for (int sample = 0; sample < 160; ++sample) {
    // The same five grains all the time.
    world.grains.assign(5, at({0.015, 0.005, 0.02}, 10e-6, 1e-12, 1.0));
    step(*few, world);
  }
  CHECK(summary_of(*few).at("mass_concentration").uncertainty == sdk::k_few_grains);
  CHECK(summary_of(*few).at("class_10_um/number_concentration").uncertainty == sdk::k_few_grains);
  CHECK(summary_of(*few).at("grams_per_tonne").uncertainty == sdk::k_few_grains);
  const auto filling = kind().make(k_box);
  world.time = 0.0;
  for (int sample = 0; sample < 160; ++sample) {
    world.grains.push_back(at({0.015, 0.005, 0.02}, 10e-6, 1e-12, 1.0));
    step(*filling, world);
  }
  CHECK(summary_of(*filling).at("mass_concentration").uncertainty == sdk::k_not_steady);
  CHECK(summary_of(*filling).at("grams_per_tonne").uncertainty == sdk::k_not_steady);
  // Forty grains of which one is exchanged in every eighth sample: half of them in all.
  const auto slow = kind().make(k_box);
  const auto quick = kind().make(k_box);
  world.time = 0.0;
  Dice dice(1);
  for (int sample = 0; sample < 160; ++sample) {
    const auto look = [&](sdk::Sensor& sensor, int exchanged) {
      world.grains.assign(40, at({0.015, 0.005, 0.02}, 10e-6, 1e-12, 1.0));
      for (Grain& grain : world.grains) grain.mass *= 1.0 + 0.3 * dice.uniform();
      for (int n = 0; n < exchanged; ++n) {
        world.grains[static_cast<std::size_t>(n)].before = {0, 0, 0};
      }
      step(sensor, world);
    };
    look(*slow, sample % 8 == 0 ? 1 : 0);
    look(*quick, 1);
  }
  CHECK(summary_of(*slow).at("mass_concentration").uncertainty == sdk::k_not_steady);
  CHECK(summary_of(*quick).at("mass_concentration").uncertainty > 0.0);
}

TEST_CASE("a box without volume shall be refused") {
  auto parameters = k_box;
  parameters["max"] = Vec3{0.01, 0.01, 0.03};
  CHECK_THROWS_AS((void)kind().make(parameters), sdk::ParameterError);
}
