// SPDX-License-Identifier: Apache-2.0
// What every sensor owes its users. A new sensor is added to `subjects` with one set of parameters
// and one other value for each of them.
#include "support/sensor_bench.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <set>

using namespace dust;
using namespace dust::test;
using sdk::Value;
using sdk::Vec3;

namespace {

struct Subject {
  std::string name;
  std::map<std::string, Value> parameters;
  std::map<std::string, Value> others;  ///< a value per parameter that must change some figure
};

const std::vector<Subject>& subjects() {
  static const std::vector<Subject> list = {
      {"box_concentration",
       {{"min", Vec3{0.1, 0, 0.02}}, {"max", Vec3{0.2, 0.011, 0.2}}},
       {{"min", Vec3{0.12, 0, 0.02}},
        {"max", Vec3{0.17, 0.011, 0.2}},
        {"steady_after", 0.03},
        {"coarser_than", 100e-6},
        {"finer_than", 500e-6}}},
      {"carry_back",
       {{"min", Vec3{0, 0, 0.1}}, {"max", Vec3{0.08, 0.011, 0.12}}},
       {{"min", Vec3{0.02, 0, 0.1}},
        {"max", Vec3{0.06, 0.011, 0.12}},
        {"direction", Vec3{1, 0, 0}},
        {"faster_than", 0.5},
        {"steady_after", 0.03}}},
      {"angle_of_repose",
       {{"form", std::string("planar")}, {"coarser_than", 250e-6}},
       {{"form", std::string("crater")},
        {"centre", Vec3{0.2, 0, 0.1}},
        {"direction", Vec3{0, 1, 0}},
        {"min", Vec3{0.12, 0, 0}},
        {"max", Vec3{0.17, 0.011, 0.35}},
        {"from_share", 0.5},
        {"to_share", 0.5},
        {"cell", 0.01},
        {"steady_after", 0.03},
        {"coarser_than", 400e-6},
        {"finer_than", 500e-6}}},
      {"coordination",
       {},
       {{"steady_after", 0.03},
        {"coarser_than", 100e-6},
        {"finer_than", 500e-6},
        {"with_walls", false}}},
      {"discharge",
       {{"centre", Vec3{0.14, 0.005, 0.16}}, {"hole", 0.04}},
       {{"centre", Vec3{0.14, 0.005, 0.14}},
        {"hole", 0.05},
        {"direction", Vec3{1, 0, 0}},
        {"reach", 0.004},
        {"opened_at", 0.01},
        {"from_share", 0.5},
        {"to_share", 0.6},
        {"bulk_density", 1500.0},
        {"grain_diameter", 1e-3},
        {"beverloo_c", 0.7},
        {"beverloo_k", 2.0}}},
      {"kinetic_energy",
       {},
       {{"steady_after", 0.03},
        {"coarser_than", 100e-6},
        {"finer_than", 500e-6},
        {"settled_below", 1.0}}},
      {"segregation",
       {{"split", 100e-6}, {"min", Vec3{0, 0, 0}}, {"max", Vec3{0.33, 0.011, 0.35}}},
       {{"split", 400e-6},
        {"min", Vec3{0.1, 0, 0}},
        {"max", Vec3{0.2, 0.011, 0.35}},
        {"cells", Vec3{8, 1, 2}},
        {"direction", Vec3{1, 0, 0}},
        {"steady_after", 0.03},
        {"coarser_than", 20e-6},
        {"finer_than", 500e-6}}},
      {"size_distribution",
       {},
       {{"min", Vec3{0.12, 0, 0}},
        {"max", Vec3{0.17, 0.011, 0.35}},
        {"steady_after", 0.03},
        {"coarser_than", 100e-6},
        {"finer_than", 500e-6}}},
      {"stress",
       {{"min", Vec3{0, 0, 0}}, {"max", Vec3{0.33, 0.011, 0.35}}},
       {{"min", Vec3{0.05, 0, 0}},
        {"max", Vec3{0.2, 0.011, 0.35}},
        {"cells", Vec3{3, 1, 2}},
        {"steady_after", 0.03}}},
      {"low_pressure",
       {},
       {{"count", std::int64_t{1}},
        {"averaging_after", 0.04},
        {"average_along", Vec3{0, 1, 0}},
        {"separation", 0.05},
        {"block", 0.01}}},
      {"plane_flux",
       {{"point", Vec3{0.15, 0, 0.1}},
        {"normal", Vec3{1, 0, 0}},
        {"min", Vec3{0.15, 0, 0}},
        {"max", Vec3{0.15, 0.011, 0.35}}},
       {{"point", Vec3{0.16, 0, 0.1}},
        {"normal", Vec3{-1, 0, 0}},
        {"min", Vec3{0.15, 0.005, 0}},
        {"max", Vec3{0.15, 0.005, 0.35}},
        {"steady_after", 0.03},
        {"coarser_than", 100e-6},
        {"finer_than", 500e-6}}},
      {"trajectory",
       {{"from", Vec3{0.08, 0, 0.2}}, {"drops", std::vector<double>{0.02, 0.1}}},
       {{"from", Vec3{0.09, 0, 0.2}},
        {"drops", std::vector<double>{0.03, 0.1}},
        {"along", Vec3{-1, 0, 0}},
        {"steady_after", 0.03},
        {"coarser_than", 100e-6},
        {"finer_than", 500e-6}}},
      {"wall_load",
       {{"walls", std::vector<std::string>{"belt"}}},
       {{"walls", std::vector<std::string>{"chute"}},
        {"about", Vec3{0.1, 0, 0.2}},
        {"averaging_after", 0.03},
        {"least_energy", 1e-9},
        {"largest_energy", 1e-8},
        {"bins", std::int64_t{3}}}}};
  return list;
}

constexpr int k_samples = 90;

/// A stream in free flight from a belt's end, dust that rides back, air with two wells.
class Scene {
 public:
  World world;
  double mass_scale = 1.0;

  explicit Scene(bool is_empty = false) : is_empty_(is_empty) {
    if (is_empty_) return;
    world.set_cells(33, 5, 35);
    world.spacing = {0.01, 0.0022, 0.01};
  }

  void show(sdk::Sensor& sensor) {
    if (!is_empty_) {
      fill(world.time + world.interval);
      world.emitted_mass += mass_scale * 6e-6;
    }
    step(sensor, world);
  }

 private:
  void fill(double time) {
    world.grains.clear();
    for (int n = 0; n < 400; ++n) {
      // Grain n starts at its own moment and height again and again.
      const double phase = random_.uniform(static_cast<std::uint64_t>(n), 0);
      const double since = std::fmod(time + 0.2 * phase, 0.2);
      if (since < world.interval) continue;
      add(n, since, 0.7 + 0.2 * random_.uniform(static_cast<std::uint64_t>(n), 1));
    }
    for (int n = 0; n < 60; ++n) ride(n, time);
    touch(time);
    load_walls(time);
    for (int k = 0; k < 35; ++k) {
      for (int j = 0; j < 5; ++j) {
        for (int i = 0; i < 33; ++i) {
          const double a = std::hypot(i - 8.0, k - 20.0);
          const double b = std::hypot(i - 20.5, k - 9.5);
          const double c = std::hypot(i - 12.0, k - 20.0);  // 4 cells from the first
          world.pressure_at(i, j, k) = static_cast<float>(
              (1 + 0.3 * std::sin(300 * time)) *
              (-std::exp(-a * a) - 0.6 * std::exp(-b * b) - 0.9 * std::exp(-c * c)));
        }
      }
    }
  }

  /// Riders press each other and the belt, more and more of them as time swings.
  void touch(double time) {
    world.contacts.clear();
    const auto last = static_cast<std::int32_t>(world.grains.size());
    const int pairs = 20 + static_cast<int>(15 * std::sin(200 * time));
    for (std::int32_t i = last - 60; i < last - 60 + pairs; ++i) {
      const double force = mass_scale * 1e-6 * (1 + i % 7);
      const Vec3 branch{1e-4 * (1 + i % 3), 0, 2e-4};
      world.contacts.push_back({i, i + 1, (-force / norm(branch)) * branch, branch, 1e-9});
      world.contacts.push_back({i, -1, {0, 0, force}, {0, 0, -2e-4}, 1e-9});
      world.contacts.push_back({i + 1, i + 3, {0, 0, 0}, {0, 0, 2e-4}, -1e-9});
    }
  }

  /// A belt that carries and is hit, and a plate of the group "chute".
  void load_walls(double time) {
    const double swing = std::sin(300 * time);
    world.walls = {
        {"belt",
         "",
         {0.01, 0, -0.1 - 0.02 * swing},
         {0, 1e-3, 0},
         0.02 + 0.004 * swing,
         mass_scale * (0.01 + 0.001 * swing),
         40},
        {"plate", "chute", {0.2, 0, -0.3 * swing}, {0, 2e-3, 1e-4}, 0, mass_scale * 2e-3, 7}};
    world.impacts.clear();
    for (int n = 0; n < 20; ++n) {
      const double u = random_.uniform(static_cast<std::uint64_t>(n), 3);
      world.impacts.push_back(
          {n % 2, std::pow(10.0, -11 + 4 * u), 1e-10 * u, n % 3 == 0 ? 0.05 : 1.0});
    }
  }

  void finish(Grain& g, int n) {
    g.diameter = n % 3 == 0 ? 10e-6 : n % 3 == 1 ? 300e-6 : 600e-6;
    g.mass = mass_scale * 1388.0 * g.diameter * g.diameter * g.diameter;
    g.weight = n % 3 == 0 ? 0.05 : 1.0;
    g.force = {0, 0, -9.81 * g.mass};
    world.grains.push_back(g);
  }

  void add(int n, double since, double speed) {
    Grain g;
    const double y = 0.011 * random_.uniform(static_cast<std::uint64_t>(n), 2);
    const auto place = [&](double t) {
      return Vec3{0.07 + speed * t, y, 0.205 - 0.5 * 9.81 * t * t};
    };
    g.before = place(since - world.interval);
    g.now = place(since);
    g.velocity = {speed, 0, -9.81 * since};
    finish(g, n);
  }

  void ride(int n, double time) {
    const double speed = n % 2 == 0 ? 0.8 : 0.3;
    const double place = std::fmod(0.08 * n / 60 + 10.0 - speed * time, 0.08);
    Grain g;
    g.now = {place, 0.005, 0.115};
    g.before = g.now + Vec3{speed * world.interval, 0, 0};
    g.velocity = {-speed, 0, 0};
    finish(g, n);
  }

  bool is_empty_;
  sdk::Random random_{7, sdk::stream_of("scene")};
};

Figures run(const Subject& subject, const std::map<std::string, Value>& parameters,
            double mass_scale = 1.0) {
  const auto sensor = load_sensor(subject.name).make(parameters);
  Scene scene;
  scene.mass_scale = mass_scale;
  for (int s = 0; s < k_samples; ++s) scene.show(*sensor);
  return summary_of(*sensor);
}

bool is_same(const Figure& a, const Figure& b) {
  return a.value == b.value && a.uncertainty == b.uncertainty && a.unit == b.unit;
}

bool are_same(const Figures& a, const Figures& b) {
  return std::equal(a.all().begin(), a.all().end(), b.all().begin(), b.all().end(),
                    [](const auto& x, const auto& y) {
                      return x.first == y.first && is_same(x.second, y.second);
                    });
}

bool is_snake_case(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '/';
  });
}

}  // namespace

TEST_CASE("every parameter of a sensor shall be named by the rules and say what it means") {
  for (const Subject& subject : subjects()) {
    CAPTURE(subject.name);
    const SensorKind kind = load_sensor(subject.name);
    CHECK(kind.info.kind == "sensor");
    CHECK(kind.info.name == subject.name);
    CHECK(!kind.info.summary.empty());
    CHECK(!kind.info.equation.empty());
    CHECK(!kind.info.source.empty());
    std::set<std::string> names;
    for (const sdk::Parameter& p : kind.info.parameters) {
      CAPTURE(p.name);
      CHECK(is_snake_case(p.name));
      CHECK(names.insert(p.name).second);
      REQUIRE(!p.sentence.empty());
      CHECK(p.sentence.back() == '.');
    }
    std::ifstream readme(std::string(DUST_SOURCE) + "/plugins/sensor/" + subject.name +
                         "/README.md");
    const std::string text{std::istreambuf_iterator<char>(readme), {}};
    CHECK(text.find("model: " + subject.name) != std::string::npos);
  }
}

TEST_CASE("every parameter of a sensor shall matter") {
  for (const Subject& subject : subjects()) {
    CAPTURE(subject.name);
    const Figures base = run(subject, subject.parameters);
    for (const sdk::Parameter& p : load_sensor(subject.name).info.parameters) {
      CAPTURE(p.name);
      REQUIRE(subject.others.contains(p.name));
      auto parameters = subject.parameters;
      parameters[p.name] = subject.others.at(p.name);
      CHECK(!are_same(base, run(subject, parameters)));
    }
  }
}

TEST_CASE("a sensor shall see something in a scene made for it") {
  for (const Subject& subject : subjects()) {
    CAPTURE(subject.name);
    int seen = 0;
    int with_error = 0;
    const Figures figures = run(subject, subject.parameters);
    for (const auto& [name, figure] : figures.all()) {
      CAPTURE(name);
      CHECK(std::isfinite(figure.value));
      CHECK(std::isfinite(figure.uncertainty));
      CHECK(is_snake_case(name));
      CHECK(!figure.unit.empty());
      seen += figure.value != 0.0;
      with_error += figure.uncertainty > 0.0;
    }
    CHECK(seen >= 4);
    CHECK(with_error >= 1);
  }
}

TEST_CASE("a sensor shall be linear in mass") {
  // A power of two, so that every product is exact.
  constexpr double k_scale = 4.0;
  for (const Subject& subject : subjects()) {
    CAPTURE(subject.name);
    const Figures light = run(subject, subject.parameters);
    const Figures heavy = run(subject, subject.parameters, k_scale);
    REQUIRE(light.names() == heavy.names());
    for (const auto& [name, figure] : light.all()) {
      CAPTURE(name);
      // Forces and energies of the scene grow with the masses, but for those of the impacts.
      const bool is_mass =
          figure.unit.rfind("kg", 0) == 0 || (figure.unit == "J" && subject.name != "wall_load") ||
          (figure.unit == "Pa" && subject.name == "stress");  // other pressures are the air's
      const Figure& other = heavy.at(name);
      CHECK(other.value == doctest::Approx((is_mass ? k_scale : 1.0) * figure.value).epsilon(1e-9));
      if (figure.uncertainty >= 0.0) {
        CHECK(other.uncertainty ==
              doctest::Approx((is_mass ? k_scale : 1.0) * figure.uncertainty).epsilon(1e-9));
      } else {
        CHECK(other.uncertainty < 0.0);
      }
    }
  }
}

TEST_CASE("a sensor shall give zeros of the same names where there is nothing") {
  for (const Subject& subject : subjects()) {
    CAPTURE(subject.name);
    const Figures full = run(subject, subject.parameters);
    const auto sensor = load_sensor(subject.name).make(subject.parameters);
    const std::vector<std::string> series_before = series_of(*sensor).names();
    Scene scene(true);
    for (int s = 0; s < k_samples; ++s) {
      scene.show(*sensor);
      REQUIRE(series_of(*sensor).names() == series_before);
      REQUIRE(summary_of(*sensor).names() == full.names());
    }
    const Figures nothing = summary_of(*sensor);
    for (const auto& [name, figure] : nothing.all()) {
      CAPTURE(name);
      if (name == "observed_time") continue;  // how long it looked is no find
      CHECK(figure.value == 0.0);
      CHECK(figure.uncertainty <= 0.0);
    }
  }
}

TEST_CASE("a sensor that is saved and loaded at any moment shall go on with the same bits") {
  for (const Subject& subject : subjects()) {
    CAPTURE(subject.name);
    const SensorKind kind = load_sensor(subject.name);
    for (const int pause : {0, 1, 37, 89}) {
      const auto whole = kind.make(subject.parameters);
      auto part = kind.make(subject.parameters);
      Scene scene;
      Scene same;
      for (int s = 0; s < k_samples; ++s) {
        if (s == pause) {
          MemoryArchive archive;
          part->save(archive);
          part = kind.make(subject.parameters);
          part->load(archive);
          REQUIRE(are_same(summary_of(*whole), summary_of(*part)));
          REQUIRE(are_same(series_of(*whole), series_of(*part)));
        }
        scene.show(*whole);
        same.show(*part);
      }
      CHECK(are_same(summary_of(*whole), summary_of(*part)));
      CHECK(are_same(series_of(*whole), series_of(*part)));
    }
  }
}
