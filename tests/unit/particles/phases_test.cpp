// SPDX-License-Identifier: Apache-2.0
#include "dust/sdk/random.hpp"
#include "graph/task_graph.hpp"
#include "support/approx.hpp"
#include "support/dem_rig.hpp"

#include <doctest/doctest.h>
#include <oneapi/tbb/global_control.h>

#include <atomic>
#include <functional>
#include <string>
#include <vector>

using dust::graph::TaskGraph;
using dust::particles::Dem;
using dust::particles::NewGrain;
using dust::sdk::Vec3;
using dust::test::approx;
using namespace dust::test;

namespace {

/// 12^3 grains of 1 mm in a loose heap with dust of 0.1 mm between them, in a box periodic in x.
std::unique_ptr<Dem> heap(bool has_dust, bool all_step = false) {
  DemRig rig;
  rig.options.all_step = all_step;
  const int sand = rig.material(2650, 5e6, 0.3);
  rig.law(sand, sand, 0.6, 0.5, 0.3);
  rig.setup.domain.min = {0, -1, 0};
  rig.setup.domain.max = {0.0144, 1, 1};
  rig.periodic(0);
  rig.wall(4, sand);
  rig.diameters = {1e-4, 1e-3};
  rig.setup.gravity = {0, 0, -9.81};
  auto dem = rig.make();
  const dust::sdk::Random random(11, 1);
  std::vector<NewGrain> grains;
  for (std::uint64_t n = 0; n < 12 * 12 * 12; ++n) {
    const Vec3 u{random.uniform(n, 0) - 0.5, random.uniform(n, 1) - 0.5,
                 random.uniform(n, 2) - 0.5};
    NewGrain g{.diameter = 1e-3};
    const auto i = static_cast<double>(n % 12);
    const auto j = static_cast<double>(n / 12 % 12);
    const auto k = static_cast<double>(n / 144);
    g.position = 1.2e-3 * Vec3{i + 0.5, j + 0.5, k + 0.8} + 1e-4 * u;
    g.velocity = 0.3 * u;
    grains.push_back(g);
    if (!has_dust || n % 3 != 0) continue;
    NewGrain d{.diameter = 1e-4};
    d.position = g.position + 0.6e-3 * Vec3{1, 1, 1};
    grains.push_back(d);
  }
  dem->insert(grains);
  return dem;
}

std::string state(Dem& dem) {
  const auto rows = dem.rows();
  std::string bytes;
  for (std::size_t n = 0; n < rows.count; ++n) {
    for (const double* p : {rows.position_of(n), rows.velocity_of(n), rows.rotation_of(n)}) {
      bytes.append(reinterpret_cast<const char*>(p), 3 * sizeof(double));
    }
  }
  return bytes;
}

using Step = std::function<void(Dem&, double)>;

std::string after(bool has_dust, int steps, const Step& step) {
  auto dem = heap(has_dust);
  for (int n = 0; n < steps; ++n) {
    dem->neighbours();
    step(*dem, n * dem->coarse_step());
    dem->advance_fine();
  }
  return state(*dem);
}

}  // namespace

TEST_CASE(
    "the phases one by one shall give the bits of the fused step, with any number of threads") {
  constexpr int k_steps = 400;
  for (const bool has_dust : {false, true}) {
    const auto phases = [](Dem& dem, double time) {
      dem.contact(time);
      dem.force();
      dem.integrate();
    };
    const auto fused = [](Dem& dem, double time) { dem.step_tiles(time); };
    std::vector<std::string> states;
    for (const std::size_t threads : {1, 2}) {
      const oneapi::tbb::global_control control(
          oneapi::tbb::global_control::max_allowed_parallelism, threads);
      states.push_back(after(has_dust, k_steps, phases));
      states.push_back(after(has_dust, k_steps, fused));
    }
    for (const auto& s : states) CHECK(s == states.front());
    CHECK(states.front() != after(has_dust, k_steps - 1, fused));
  }
}

TEST_CASE("a stage between force and integration shall act in the step it stands in") {
  // Weight taken off again: nothing falls. The stage sees complete forces and no moved particle.
  auto dem = heap(false, true);
  double time = 0.0;
  std::atomic<std::size_t> acted_on = 0;
  TaskGraph graph("dem_step");
  graph.given({"grain.position", "grain.velocity"});
  graph.add({"neighbour", {"grain.position"}, {"contact.list"}, [&] { dem->neighbours(); }});
  graph.add({"contact", {"grain.position", "contact.list"}, {"grain.force"}, [&] {
               dem->contact(time);
             }});
  graph.add({"force", {"grain.force"}, {"grain.force"}, [&] { dem->force(); }});
  graph.add({"levitation", {"grain.force"}, {"grain.force"}, [&] {
               const double mass = 2650.0 * 3.14159265358979323846 / 6.0 * 1e-9;
               dem->add_force([&](std::size_t) {
                 ++acted_on;
                 return Vec3{0, 0, mass * 9.81};
               });
             }});
  graph.add({"integration", {"grain.force"}, {"grain.position", "grain.velocity"}, [&] {
               dem->integrate();
             }});
  graph.fuse({.part = "tile",
              .nodes = {"contact", "force", "integration"},
              .work = [&] { FAIL("nodes with a stage between them have been fused"); },
              .shares = [] { return std::vector<double>{}; }});
  graph.build();
  const auto momentum = [&] {
    const auto rows = dem->rows();
    double sum = 0.0;
    for (std::size_t n = 0; n < rows.count; ++n)
      sum += rows.velocity_of(n)[2] / rows.inverse_mass(n);
    return sum;
  };
  const double before = momentum();
  const double mass_total = 12 * 12 * 12 * 2650.0 * 3.14159265358979323846 / 6.0 * 1e-9;
  constexpr int k_steps = 50;  // none reaches the floor
  for (int n = 0; n < k_steps; ++n) {
    graph.run();
    dem->advance_fine();
    time += dem->coarse_step();
  }
  CHECK(acted_on == static_cast<std::size_t>(k_steps) * 12 * 12 * 12);
  // Without the stage the momentum would change by the weight times the time.
  CHECK(std::abs(momentum() - before) < 1e-9 * mass_total * 9.81 * time);
}

TEST_CASE("the times of the phases shall be shared out to one") {
  auto dem = heap(false);
  CHECK(dem->phase_shares()[0] == 0.0);
  dem->neighbours();
  dem->step_tiles(0.0);
  const auto shares = dem->phase_shares();
  CHECK(shares[0] > 0.0);
  CHECK(shares[0] + shares[1] + shares[2] == approx(1.0));
}
